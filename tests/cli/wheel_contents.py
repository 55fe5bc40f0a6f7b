# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""wheel_contents.py WHEEL: what the wheel that is passed on must hold, once, and no library without its licence (exit code 1)."""

import re
import sys
import zipfile
from email.parser import Parser

# What the licence text of each part names; the name of the part is in that of the file.
TEXTS = {"LICENSE": "The Asperity authors", "boost": "Boost Software License", "cli11": "Henry Schreiner", "fftw3": "Matteo Frigo",
         "fmtlib": "Victor Zverovich", "gcc-": "GCC Runtime Library Exception", "hdf5": "The HDF Group", "nlohmann-json": "Niels Lohmann",
         "pybind11": "Wenzel Jakob", "random123": "D. E. Shaw Research", "tomlplusplus": "Mark Gillard"}
LIBRARIES = {"libfftw3": "fftw3", "libfftw3f": "fftw3", "libfmt": "fmtlib", "libgomp": "gcc-", "libtomlplusplus": "tomlplusplus"}
DATA = ("share/scenes/first-contact.toml", "share/scenes/README.md", "share/examples/first_contact.ipynb", "reports/templates/page.html",
        "results/names.pyi", "_engine.pyi", "py.typed")
NEWEST_LIBC = (2, 34)  # of RHEL 9 and its like


def faults_of(path):
    wheel = zipfile.ZipFile(path)
    sizes = {info.filename: info.file_size for info in wheel.infolist()}
    (info,) = {name.split("/")[0] for name in sizes if ".dist-info/" in name}
    texts = {name.split("/")[-1]: wheel.read(name).decode() for name in sizes if name.startswith(f"{info}/licenses/")}
    metadata = Parser().parsestr(wheel.read(f"{info}/METADATA").decode())

    for name in sizes:
        library = re.match(r"asperity\.libs/([A-Za-z0-9]+)", name)
        if library and library[1] not in LIBRARIES:
            yield f"{name} is new: its licence must be among TEXTS"
    for part, holder in TEXTS.items():
        if not any(part in name and holder in " ".join(text.split()) for name, text in texts.items()):
            yield f"no licence text of {part.strip('-')} ({holder})"
    everything = " ".join(texts.values())
    for name in sorted(set(re.findall(r"/usr/share/common-licenses/((?:L?GPL|GFDL|Apache)-[\d.]*\d)", everything))):
        if f"{name}.txt" not in texts:
            yield f"a licence refers to {name}, which is not in the wheel"
    if "GPL-2.0-or-later" not in metadata["License-Expression"] or "GNU GENERAL PUBLIC LICENSE" not in texts.get("GPL-2.txt", ""):
        yield "FFTW is inside, and the wheel is not under the GPL"
    sources = re.findall(r"(?m)^([a-z]\S*) \d", texts.get("SOURCES.txt", ""))
    for part in TEXTS:
        if part != "LICENSE" and not any(part in source and f"{source}.txt" in texts for source in sources):
            yield f"SOURCES.txt does not name the sources of {part.strip('-')}, or another file its licence"
    if sorted(metadata.get_all("License-File", [])) != sorted(texts):
        yield "License-File of METADATA differs from the folder licenses"

    for key in ("Author", "Summary", "Keywords", "Requires-Python", "Classifier"):
        if not metadata[key]:
            yield f"METADATA has no {key}"
    if not metadata.get_payload().lstrip().startswith("# Asperity"):
        yield "METADATA has no README"
    for name in DATA:
        if f"asperity/{name}" not in sizes:
            yield f"no {name}"
    engines = [name for name in sizes if "/_engine." in name and name.endswith(".so")]
    programs = [name for name, size in sizes.items() if size > 3_000_000]
    if len(engines) != 1 or programs != engines or any("/bin/" in name for name in sizes):
        yield f"the engine is there twice: {engines + programs}"
    tag = re.search(r"manylinux_(\d+)_(\d+)_x86_64\.whl$", str(path))
    if not tag or (int(tag[1]), int(tag[2])) > NEWEST_LIBC:
        yield "the wheel needs a newer C library than {}.{}: auditwheel show -v names the functions".format(*NEWEST_LIBC)


if __name__ == "__main__":
    faults = list(faults_of(sys.argv[1]))
    print("\n".join(faults))
    sys.exit(bool(faults))
