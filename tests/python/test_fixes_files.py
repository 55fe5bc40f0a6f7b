# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whoever follows the fix of a message about a map or a file of atoms has a file that is read as he meant it: every message of
the catalogue on files that a scene names, that `asperity convert` reads and of which `asperity adhesion` makes a scene."""

import gzip
import re
import sys
import types
import zipfile
from pathlib import Path

import h5py
import numpy as np
import pytest

import asperity
from asperity.maps import height_map
from asperity.maps.convert import convert, read_heights
from asperity.studies import map_scene
from following import ask, followed, messages_in, not_followed

SOURCES = ("io/map_", "io/height_map", "io/atoms_file", "io/scene_file", "io/hdf5_numbers", *(f"asperity/maps/{name}.py" for name in (
    "arrays", "atoms", "channels", "convert", "height_map", "missing_waves", "text")), "map_scene.py")
EXCUSED = {
    "is larger than the memory": "a machine's memory",
    "free memory, or raise ulimit -u": "a machine's memory",
    "the system gives no file in memory": "a machine's system",
    "the height map cannot be opened...check its permissions": "whoever tests may read all files",
    "the height map cannot be opened ... check": "a file that is lost between two looks at it",
    "the height map is too long": "a file of gigabytes",
    "is in no format that is read without SurfaceTopography": "a package to be installed",
    "needs ASE": "a package to be installed",
    "it is a line scan ... measure or export an area": "a file of an instrument, with SurfaceTopography (test_convert.py)",
    "does not say the unit of channel": "a file of an instrument, with SurfaceTopography (test_convert.py)",
    "take a copy that is whole, or write it again": "damage that libhdf5 itself does not refuse",
}
HEIGHTS = np.round(np.random.default_rng(1).normal(0, 1, (32, 32)), 3)
MAP = {"surface.kind": "file", "surface.sites": "32", "block.thickness": "32", "drive.path": "relax", "surface.spacing": "2.6",
       "interface.kind": "wall"}
SOLID = ("solid\n\n2 atoms\n1 atom types\n0 41.6 xlo xhi\n0 41.6 ylo yhi\n0 9 zlo zhi\n\nAtoms # atomic\n\n1 1 1 1 1\n2 1 5 5 1\n")


def text(heights=HEIGHTS, above="", separator=" "):
    return above + "".join(separator.join(map(repr, map(float, row))) + "\n" for row in heights)


def points(heights=HEIGHTS, above="", x=1.0, y=1.0):
    return above + "".join(f"{x * i} {y * k} {heights[k, i]}\n" for k in range(len(heights)) for i in range(heights.shape[1]))


def npy(array):
    return lambda file: np.save(file, array)


def hdf5(sets=None, **attributes):
    def write(file):
        with h5py.File(file, "w") as out:
            for name, array in (sets or {"heights": HEIGHTS}).items():
                out[name] = array
                out[name].attrs.update(attributes)
    return write


def npz(**arrays):
    return lambda file: np.savez(file, **arrays)


def claimed(*shapes):
    """Returns what writes an .npz whose headers claim arrays of these shapes; nothing of them is there."""
    def write(file):
        with zipfile.ZipFile(file, "w") as out:
            for k, shape in enumerate(shapes):
                with out.open(f"{k}.npy", "w") as member:
                    np.lib.format.write_array_header_1_0(member, {"descr": "<f8", "fortran_order": False, "shape": shape})
    return write


def unwritten(shape):
    """Returns what writes an HDF5 file with a data set of this shape, of which nothing is on the disk."""
    def write(file):
        with h5py.File(file, "w") as out:
            out.create_dataset("heights", shape, "f8")
    return write


def archive(member):
    """Returns what writes a zip file with one member, as office programs do."""
    def write(file):
        with zipfile.ZipFile(file, "w") as out:
            out.writestr(member, "<xml/>")
    return write


def write(name, content):
    if callable(content):
        content(name)
    elif isinstance(content, bytes):
        Path(name).write_bytes(content)
    else:
        Path(name).write_text(content)


def holed(k):
    heights = HEIGHTS.copy()
    heights.ravel()[:k] = np.nan
    return heights


ANG = {"unit": "Å"}
# What a scene says of a file; the file and settings, and what follows from the fix (None: the same file)
OF_SCENES = [
    ('name one: file = "(.*)"', ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS})), None, {"surface.file": "{0}"}),
    ('name one: file = "FILE:/NAME"', ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS})), None, {"surface.file": "m.h5:/a"}, {"surface.file": "m.h5:/c"}),
    ("name another data set", ("m.h5", hdf5({"heights": HEIGHTS[0], "b": HEIGHTS})), None, {"surface.file": "m.h5:/b"}),
    ("convert it first: (asperity convert .*)", ("m.h5", hdf5({"heights": HEIGHTS[None]})), "convert", {}),
    ("convert it first: (asperity convert .*)", ("m.h5", hdf5({"Measurement_000/x": HEIGHTS, "b": HEIGHTS})), ("m.h5", hdf5()), {}),
    ("correct the attribute, or remove it", ("m.h5", hdf5(scale=0.0)), ("m.h5", hdf5(scale=1.0)), {}),
    ("convert it first: (asperity convert .*)", ("m.txt", text(above="# Width: 8.32 nm\n# Height: 8.32 nm\n# Value units: Å\n")), "convert", {}),
    ("convert it first: (asperity convert .*)", ("m.txt", text(separator=";")), "convert", {}),
    ("export the heights again", ("m.txt", "# nothing\n"), ("m.txt", text()), {}),
    ("give every row as many numbers", ("m.txt", text() + "1 2\n"), ("m.txt", text()), {}),
    (r"convert it first: (asperity convert .* --channel 1)", ("m.txt", text(HEIGHTS[:16, :16]) + "\n" + text(HEIGHTS[16:, :16])), "convert", {"surface.resample": "band-limited"}),
    ("or take those lines out", ("m.txt", text(HEIGHTS[:16]) + "\n" + text(HEIGHTS[16:])), ("m.txt", text()), {}),
    ("convert it first: (asperity convert .*)", ("m.txt", points(x=2.6, y=2.6)), "convert", {"surface.file_unit": "Å"}),
    ("save it again: numpy.save", ("m.npy", b"\x93NUMPY\1\0"), ("m.npy", npy(HEIGHTS)), {}),
    (r"convert it first: (asperity convert .* --channel 1)", ("m.npy", npy(HEIGHTS[None])), "convert", {}),
    ("name another file", ("m.npy", npy(HEIGHTS[0])), ("m.npy", npy(HEIGHTS)), {}),
    ("a text matrix must not be called .h5", ("m.h5", text()), ("m.txt", text()), {}),
    ("convert it first: (asperity convert .*)", ("m.xyz", points(x=2.6, y=2.6)), "convert", {"surface.file_unit": "Å"}),
    ('say which it is: surface.file_unit = "(.*)"', ("m.h5", hdf5(size_x=8.32, unit="V")), None, {"surface.file_unit": "{0}"}),
    ('say which it is: surface.file_unit = "(.*)"', ("m.h5", hdf5(size_x=8.32)), None, {"surface.file_unit": "{0}"}),
    ('say which it is: surface.file_size = "(.*)", its edge', ("m.h5", hdf5(size_x=8.32, unit="nm", size_unit="V")), None, {"surface.file_size": "{0}", "surface.spacing": "31.25"}),
    ('say it: surface.file_size = "(.*)", its edge', ("m.h5", hdf5(size_x=0.0, unit="nm")), None, {"surface.file_size": "{0}", "surface.spacing": "31.25"}),
    ("set surface.file_unit, or", ("m.txt", text(HEIGHTS * 1e10)), None, {"surface.file_unit": "pm", "surface.rms": "1"}),
    ("mark points without a height as nan", ("m.txt", text(np.where(HEIGHTS > 2, 1e12, HEIGHTS))), ("m.txt", text(np.where(HEIGHTS > 2, np.nan, HEIGHTS))), {"surface.file_missing": "fill"}),
    ('surface.file_missing = "(fill)"', ("m.txt", text(holed(5))), None, {"surface.file_missing": "{0}"}),
    ("cut out a piece that is whole", ("m.txt", text(holed(900))), ("m.txt", text()), {}, {"surface.file_missing": "fill"}),
    ("measure or export an area", ("m.txt", text(HEIGHTS[:1])), ("m.txt", text()), {}),
    ('surface.file_crop = "(middle)"', ("m.txt", text(np.vstack([HEIGHTS, HEIGHTS]))), None, {"surface.file_crop": "{0}"}),
    ("cut a square out of it before", ("m.txt", text(np.vstack([HEIGHTS, HEIGHTS]))), ("m.txt", text()), {}),
    ("resample it to square pixels", ("m.h5", hdf5(size_x=8.32, size_y=10.0, unit="nm")), ("m.h5", hdf5(size_x=8.32, size_y=8.32, unit="nm")), {}),
    ("check that it is whole", ("m.h5", lambda file: (hdf5()(file), Path(file).write_bytes(Path(file).read_bytes()[:1600]))), ("m.h5", hdf5()), {}),
    ("set surface.sites = (.*), or", ("m.txt", text(HEIGHTS[:16, :16])), None, {"surface.sites": "{0}"}),
]
ATOMS = [("/position is", {"position": np.zeros((3, 2)), "type": np.zeros(3), "box": [41.6, 41.6]}, {}),
         ('take "Å" or "(nm)"', None, {"unit": "parsec"})]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()


def check(file, settings, more=()):
    words = {**MAP, "surface.file": file, **dict(more), **settings}
    return ask("check", "-", "--set", *(f"{key}={value}" for key, value in words.items()))


@pytest.mark.parametrize("case", OF_SCENES, ids=range(len(OF_SCENES)))
def test_a_fix_of_a_scene_with_a_map(case):
    says, (name, bad), good, settings, *more = case
    write(name, bad)
    code, said = check(name, {}, *more)
    found = re.search(says, said)
    assert code == 2 and found, said
    settings = {key: value.replace("{0}", found[1]) if "{0}" in value else value for key, value in settings.items()}
    if good == "convert":
        words = found[1].split()[1:]
        if words[1] == words[2]:
            pytest.fail(f"it converts a file into itself: {said}")
        code, now = ask(*words)
        assert code == 0, f"{said}\n---\n{now}"
        name = words[2]
    elif good:
        name = good[0]
        write(*good)
    code, now = check(name, settings)
    assert code == 0, f"{said}\n---\n{now}"
    followed(said)


@pytest.mark.parametrize("says, sets, attributes", ATOMS, ids=range(len(ATOMS)))
def test_a_fix_of_a_file_of_atoms(says, sets, attributes):
    whole = {"position": np.stack([*np.meshgrid(2.6 * np.arange(16), 2.6 * np.arange(16)), np.zeros((16, 16))], -1).reshape(-1, 3),
             "type": np.zeros(256), "box": np.array([41.6, 41.6])}
    atoms = {"surface.kind": "atoms", "surface.sites": "16", "interface.kind": "atoms", "block.thickness": "16"}

    def write_atoms(sets, **attributes):
        write("a.h5", hdf5(sets, names="Au", **attributes))

    write_atoms(sets or whole, **attributes)
    code, said = check("a.h5", atoms)
    found = re.search(says, said)
    assert code == 2 and found, said
    write_atoms({**whole, "position": whole["position"] / (10 if found.groups() else 1), "box": whole["box"] / (10 if found.groups() else 1)},
                **({"unit": found[1]} if found.groups() else {}))
    code, now = check("a.h5", atoms)
    assert code == 0, f"{said}\n---\n{now}"
    followed(said)


def test_text_of_atoms_is_converted():
    write("a.data", SOLID)
    code, said = check("a.data", {"surface.kind": "atoms", "surface.sites": "16", "interface.kind": "atoms", "block.thickness": "16"})
    found = re.search(r"convert it first: (asperity convert \S+ \S+)", said)
    assert code == 2 and found, said
    assert ask(*found[1].split()[1:])[0] == 0
    code, now = check("a.h5", {"surface.kind": "atoms", "surface.sites": "16", "interface.kind": "atoms", "block.thickness": "16"})
    assert code == 0, now
    followed(said)


def as_map(name, content, **options):
    """Reads a map as `adhesion` does."""
    write(name, content)
    return height_map.read_map(name, **{"unit": "nm", **options})


def as_file(name, content, channel=None, target="t.h5"):
    """Converts a file."""
    write(name, content)
    Path("t.h5").unlink(missing_ok=True)
    return convert(name, target, channel)


def as_heights(name, content, source=None, channel=None):
    write(name, content)
    return read_heights(source or name, channel)


def scene_of(name, content, work="50 mJ/m^2", young="100 GPa", **options):
    write(name, content)
    made = Path("made")
    made.mkdir(exist_ok=True)
    return map_scene.scene_of(name, young, 0.25, work, made, **options)


def pair_of(name, content, poisson=None, young="70 GPa", other=None, second=True, **options):
    """The scene of a map and of that of a second solid."""
    other = other or ("second.npy", npy(ROUGH))
    write(*other)
    given = map_scene.SecondSolid.given(other[0] if second else None, young, poisson)
    return scene_of(name, content, second=given, **{**SCAN, **options})


GWYDDION = "# Width: 8.32 nm\n# Height: 8.32 nm\n# Value units: Å\n"
SCAN = {"size": "32 nm", "unit": "Å"}
WAVES = np.hypot(*np.meshgrid(np.fft.fftfreq(64), np.fft.fftfreq(64)))
ROUGH = np.fft.ifft2(np.fft.fft2(np.random.default_rng(3).normal(0, 3, (64, 64))) / (1 + (WAVES / 0.05) ** 2)).real
NARROW = ("second.h5", hdf5({"heights": ROUGH}, size_x=30.0, size_y=30.0, unit="nm"))
# What is said, what reads, the bad input and the good one; a group of what is said stands for {0}
OF_FILES = [
    ("correct the attribute, or remove it", as_map, ("m.h5", hdf5(scale=-1.0, **ANG)), ("m.h5", hdf5(**ANG))),
    ("export the heights", as_file, ("m.npz", npz(a=HEIGHTS[0], b=HEIGHTS[1])), ("m.npz", npz(a=HEIGHTS))),
    ("leave --channel out", as_file, ("m.txt", text(), "2"), ("m.txt", text())),
    ("or its number: --channel (\\d+)", as_file, ("m.npz", npz(a=HEIGHTS, b=HEIGHTS), "c"), ("m.npz", npz(a=HEIGHTS, b=HEIGHTS), "{0}")),
    ("name one, or its number: --channel (\\d+)", as_file, ("m.npz", npz(a=HEIGHTS, b=HEIGHTS)), ("m.npz", npz(a=HEIGHTS, b=HEIGHTS), "{0}")),
    ("take another channel", as_file, ("m.csv", points(above="x(nm) y(nm) phase(deg) z(nm)\n").replace("\n", " 1\n").replace("(nm) 1", "(nm)"), "1"),
     ("m.csv", points(above="x(nm) y(nm) phase(deg) z(nm)\n").replace("\n", " 1\n").replace("(nm) 1", "(nm)"), "2")),
    ("export the heights, as text with a header", as_file, ("m.png", b"\x89PNG\r\n\x1a\n"), ("m.txt", text(above=GWYDDION))),
    ("is a spreadsheet(?s:.*)export the heights as text: a matrix of numbers", as_file, ("m.xlsx", archive("xl/workbook.xml")), ("m.txt", text())),
    ("is a text of an office program(?s:.*)export the heights as text", as_file, ("m.docx", archive("word/document.xml")), ("m.txt", text())),
    ("is a PDF document(?s:.*)or lines of x, y and z", as_file, ("m.pdf", b"%PDF-1.5\n"), ("m.txt", points())),
    ("is packed by gzip(?s:.*)unpack it", as_file, ("m.txt.gz", gzip.compress(text().encode())), ("m.txt", text())),
    ("is force curves of JPK(?s:.*)export the height image", as_file, ("m.jpk-force", archive("segments/0/header.properties")), ("m.txt", text())),
    ("is an archive of contact.engineering(?s:.*)unpack it", as_file, ("m.zip", archive("meta.yml")), ("m.txt", text())),
    ("is a document of Digital Surf MountainsMap(?s:.*)or as text", as_file, ("m.mnt", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"), ("m.txt", text())),
    ("are the limit(?s:.*)save the map alone", as_file, ("m.npz", claimed((16384, 16384), (8, 8))), ("m.npz", npz(a=HEIGHTS))),
    ("are the limit(?s:.*)cut out the part that is needed", as_map, ("m.h5", unwritten((1 << 15, 1 << 15))), ("m.h5", hdf5(**ANG))),
    ("take it all the same: --channel (1)", as_file, ("m.txt", text(above="# Channel: Deflection\n" + GWYDDION)),
     ("m.txt", text(above="# Channel: Deflection\n" + GWYDDION), "{0}")),
    ("a curve, of force(?s:.*)export the scan of the heights, as a matrix of numbers", as_file,
     ("m.txt", "".join(f"{0.1 * k} {np.exp(-k)} {0.5 * np.exp(-k)}\n" for k in range(1000)).replace("0.1 ", "0.13 ", 1)), ("m.txt", text())),
    ("is empty(?s:.*)export it again", as_file, ("m.txt", ""), ("m.txt", text())),
    ("is a damaged archive(?s:.*)copy or export it again", as_file, ("m.npz", b"PK\x03\x04 and no more"), ("m.npz", npz(a=HEIGHTS))),
    ("check the path", lambda name: read_heights(name), ("gone.txt",), None),
    ("one of them is meant(?s:.*)leave one out", as_heights, ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS}), "m.h5:/a", "b"), ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS}), "m.h5:/a")),
    ("correct the file; what --size", as_file, ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS}, size_x=0.0, size_y=0.0), "1"), ("m.h5", hdf5({"a": HEIGHTS, "b": HEIGHTS}, size_x=8.0, size_y=8.0), "1")),
    ("for example (t.h5)", as_file, ("m.txt", text(above=GWYDDION), None, "t.csv"), ("m.txt", text(above=GWYDDION), None, "{0}")),
    ("it holds atoms(?s:.*)leave --channel out", as_file, ("a.data", SOLID, "1"), ("a.data", SOLID)),
    # Atoms
    ("write_data, in units of style metal", as_file, ("a.data", SOLID.replace("solid", "solid, units = lj", 1)), ("a.data", SOLID.replace("solid", "solid, units = metal", 1))),
    ("atom styles are atomic(?s:.*)Atoms # (molecular)", as_file, ("a.data", SOLID.replace(" # atomic", "").replace("1 1 1 1 1", "1 1 1 1 1 1").replace("2 1 5 5 1", "2 1 1 5 5 1")),
     ("a.data", SOLID.replace("atomic", "molecular").replace("1 1 1 1 1", "1 1 1 1 1 1").replace("2 1 5 5 1", "2 1 1 5 5 1"))),
    ("correct it, or write it again", as_file, ("a.data", SOLID.replace("2 atoms", "3 atoms")), ("a.data", SOLID)),
    ("repeat or cut the atoms to a square box", as_file, ("a.data", SOLID.replace("zlo zhi\n", "zlo zhi\n1 0 0 xy xz yz\n")), ("a.data", SOLID)),
    ("correct it, or write it again", as_file, ("a.data", SOLID.replace("1 1 1 1 1", "1 1 1e9 1 1")), ("a.data", SOLID)),
    ("correct it, or write it again", as_file, ("a.data", SOLID.replace("2 1 5 5 1", "2 1 500 5 1")), ("a.data", SOLID)),
    # Arrays and text
    (r"export heights, \[y, x\]", as_file, ("m.npy", npy(np.zeros((32, 32, 3)))), ("m.npz", npz(heights=HEIGHTS))),
    (r"is no map of heights(?s:.*)export heights, \[y, x\]", as_file, ("m.npy", npy(np.zeros(32))), ("m.npz", npz(heights=HEIGHTS))),
    ("write decimal points, or", as_file, ("m.txt", text().replace(".", ",").replace(" ", " 1.0 ", 1)), ("m.txt", text())),
    ("or separate the numbers by tabs", as_file, ("m.txt", text().replace(".", ",")), ("m.txt", text(separator="\t").replace(".", ","))),
    ("or put a # before them", as_file, ("m.txt", text() + "the end\n"), ("m.txt", text() + "# the end\n")),
    ("correct it, or write it again", as_file, ("m.txt", text() + "1 2\n"), ("m.txt", text())),
    ("export it again", as_file, ("m.txt", text(above="# File Format = ASCII\n# x-pixels = 40\n")), ("m.txt", text(above="# File Format = ASCII\n# x-pixels = 32\n"))),
    ("correct the header", as_file, ("m.txt", text(above=GWYDDION.replace("8.32 nm", "-1 nm", 1))), ("m.txt", text(above=GWYDDION))),
    ("correct the header", as_file, ("m.txt", text(above="# Bit2nm = zero\n")), ("m.txt", text(above="# Bit2nm = 0.5\n"))),
    ("export the grid again", as_file, ("m.asc", text(above="ncols 32\nnrows 32\ncellsize 0\n")), ("m.asc", text(above="ncols 32\nnrows 32\ncellsize 1\n"))),
    ("interpolate them onto a grid", as_file, ("m.xyz", points().replace("1.0 0.0", "1.3 0.0")), ("m.xyz", points())),
    ("a matrix of heights must not be called .xyz", as_file, ("m.xyz", text(above=GWYDDION)), ("m.txt", text(above=GWYDDION))),
    ("call the columns of the places x and y", as_file, ("m.csv", points(above="easting northing z\n")), ("m.csv", points(above="x y z\n"))),
    ("or put a # before the names", as_file, ("m.csv", text(HEIGHTS[:, :3], above="height of film\n")), ("m.csv", text(HEIGHTS[:, :3], above="# height of film\n"))),
    ("write both in one unit", as_file, ("m.csv", points(above="x(nm) y(um) z(nm)\n")), ("m.csv", points(above="x(nm) y(nm) z(nm)\n"))),
    # adhesion
    ("name it: --unit (nm)", lambda *a, unit=None: as_map(*a, unit=unit), ("m.txt", text()), ("m.txt", text(), {"unit": "{0}"})),
    ("say how wide it is: --size", as_map, ("m.h5", hdf5(size_x=0.0, size_y=0.0, **ANG)), ("m.h5", hdf5(size_x=0.0, size_y=0.0, **ANG), {"size": 1000.0})),
    ("name the unit: --unit nm", as_map, ("m.txt", text(), {"unit": "parsec"}), ("m.txt", text(), {"unit": "nm"})),
    (r'write the one that is meant: \S* ?"(.*?)"', scene_of, ("m.npy", npy(ROUGH), {"work": 0.05, **SCAN}), ("m.npy", npy(ROUGH), {"work": "{0}", **SCAN})),
    ('for example "(500 nm)"', scene_of, ("m.npy", npy(ROUGH), {**SCAN, "size": "-1 nm"}), ("m.npy", npy(ROUGH), {**SCAN, "size": "{0}"})),
    ("take one of (keep)", scene_of, ("m.npy", npy(ROUGH), {**SCAN, "line_noise": "none"}), ("m.npy", npy(ROUGH), {**SCAN, "line_noise": "{0}"})),
    ("are too few(?s:.*)or leave it out", scene_of, ("m.npy", npy(ROUGH), {"sites": 3, **SCAN}), ("m.npy", npy(ROUGH), SCAN)),
    ("export the whole map", scene_of, ("m.npy", npy(ROUGH[:8, :8]), SCAN), ("m.npy", npy(ROUGH), SCAN)),
    ('--size "(.*)"', scene_of, ("m.npy", npy(ROUGH), {"unit": "Å"}), ("m.npy", npy(ROUGH), {"unit": "Å", "size": "{0}"})),
    ("export a part that was measured", scene_of, ("m.npy", npy(np.full((64, 64), np.nan)), SCAN), ("m.npy", npy(ROUGH), SCAN)),
    ("resample it before", scene_of, ("m.h5", hdf5({"heights": ROUGH}, size_x=30.0, size_y=40.0, unit="nm")), ("m.h5", hdf5({"heights": ROUGH}, size_x=30.0, size_y=30.0, unit="nm"))),
    ("or correct the unit of the file", scene_of, ("m.npy", npy(ROUGH), {**SCAN, "size": "32 m"}), ("m.npy", npy(ROUGH), SCAN)),
    ("cut it to one side of the step", scene_of, ("m.npy", npy(ROUGH + 500 * (np.arange(64) > 31)), SCAN), ("m.npy", npy(ROUGH[:, :32][:32]), SCAN)),
    ('for example "(50 mJ/m\\^2)"', scene_of, ("m.npy", npy(ROUGH), {"work": "0 J/m^2", **SCAN}), ("m.npy", npy(ROUGH), {"work": "{0}", **SCAN})),
    ('--range "(.*)"; or', scene_of, ("m.npy", npy(ROUGH), {"young": "1 MPa", "reach": "3 Å", "work": "0.5 mJ/m^2", **SCAN}), ("m.npy", npy(ROUGH), {"young": "1 MPa", "reach": "{0}", "work": "0.5 mJ/m^2", **SCAN})),
    ("or leave it out for the numbers", scene_of, ("m.npy", npy(ROUGH), {"young": "100 MPa", "reach": "1 Å", "work": "5 mJ/m^2", **SCAN}), ("m.npy", npy(ROUGH), {"young": "100 MPa", "work": "5 mJ/m^2", **SCAN})),
    ("or a stiffer solid", scene_of, ("m.npy", npy(ROUGH), {"young": "0.1 MPa", **SCAN}), ("m.npy", npy(ROUGH), SCAN)),
    ('for example "(100 MPa)", or leave', scene_of, ("m.npy", npy(ROUGH), {"load": "5 nN", **SCAN}), ("m.npy", npy(ROUGH), {"load": "{0}", **SCAN})),
    ('for example load "(.*)", or take', scene_of, ("m.npy", npy(ROUGH), {"hardness": "1 GPa", "load": "2 GPa", **SCAN}),
     ("m.npy", npy(ROUGH), {"hardness": "1 GPa", "load": "{0}", **SCAN})),
    ('for example "(1 GPa)", or leave', scene_of, ("m.npy", npy(ROUGH), {"hardness": "none", **SCAN}), ("m.npy", npy(ROUGH), {"hardness": "{0}", **SCAN})),
    ("name its map: --counter", pair_of, ("m.npy", npy(ROUGH), {"second": False}), ("m.npy", npy(ROUGH), {"second": True})),
    ('give it a modulus: --counter-young "(.*)"', pair_of, ("m.npy", npy(ROUGH), {"young": None, "poisson": 0.3}), ("m.npy", npy(ROUGH), {"young": "{0}", "poisson": 0.3})),
    ('for example --counter-young "(.*)"', pair_of, ("m.npy", npy(ROUGH), {"young": "-1 GPa"}), ("m.npy", npy(ROUGH), {"young": "{0}"})),
    ("for example --counter-poisson 0.3", pair_of, ("m.npy", npy(ROUGH), {"poisson": 0.7}), ("m.npy", npy(ROUGH), {"poisson": 0.3})),
    ("or give the size of both: --size", pair_of, ("m.h5", hdf5({"heights": ROUGH}, size_x=32.0, size_y=32.0, unit="nm"), {"size": None, "unit": None, "other": NARROW}), ("m.npy", npy(ROUGH), {"other": NARROW})),
    ('if the attraction does reach so far, --range "(.*)"', scene_of, ("m.npy", npy(ROUGH), {"young": "3 MPa", "work": "3 mJ/m^2", **SCAN}), ("m.npy", npy(ROUGH), {"young": "3 MPa", "work": "3 mJ/m^2", "reach": "{0}", **SCAN})),
]


def done(read, given):
    *words, options = given if isinstance(given[-1], dict) else (*given, {})
    return read(*words, **options)


@pytest.mark.parametrize("says, read, bad, good", OF_FILES, ids=range(len(OF_FILES)))
def test_a_fix_of_a_file(says, read, bad, good):
    with pytest.raises(asperity.Error) as error:
        done(read, bad)
    said = str(error.value)
    found = re.search(says, said)
    assert found, said

    def put(value):
        if isinstance(value, dict):
            return {key: put(one) for key, one in value.items()}
        return value.replace("{0}", found[1]) if isinstance(value, str) and "{0}" in value else value

    if good:
        done(read, tuple(map(put, good)))
    followed(said)


@pytest.mark.parametrize("name, content, says", [
    ("m.nid", b"[DataSet]\nGr0-Name=Spec forward\n\0\xff", "a file of Nanosurf in which no map is found(?s:.*)export the scan of the heights"),
    ("m.zip", archive("data.bin"), "an archive in which no map is found(?s:.*)it holds 1 files: data.bin(?s:.*)unpack it"),
    ("m.dat", b"\x01\x02\x1b[31mred\0\0\0", r"in no format that a reader of maps knows\n    why: it begins with \.\.\.\[31mred(?s:.*)export the heights as text")])
def test_a_file_that_no_reader_knows_is_one_line(name, content, says, monkeypatch):
    class UnknownFileFormat(Exception):
        pass

    def open_topography(path):
        raise UnknownFileFormat("No reader takes it:\n" + "\n".join(f"reader {k}: \x1b[31m" for k in range(60)))

    monkeypatch.setitem(sys.modules, "SurfaceTopography", types.SimpleNamespace(open_topography=open_topography))
    with pytest.raises(asperity.Error) as error:
        as_file(name, content)
    said = str(error.value)
    assert re.search(says, said) and len(said.splitlines()) == 3 and "\x1b" not in said, said
    as_file("m.txt", text())
    followed(said)


def test_what_the_program_reads_itself_is_named_in_the_scene():
    write("m.npy", npy(HEIGHTS))
    with pytest.raises(asperity.Error, match="name it in the scene") as error:
        convert("m.npy", "t.h5")
    assert check("m.npy", {})[0] == 0
    followed(str(error.value))
    write("a.data", SOLID)
    with pytest.raises(asperity.Error, match='surface.kind = "atoms"') as error:
        read_heights("a.data")
    convert("a.data", "a.h5")
    code, now = check("a.h5", {"surface.kind": "atoms", "surface.sites": "16", "interface.kind": "atoms", "block.thickness": "16"})
    assert code == 0, now
    followed(str(error.value))
    assert len(messages_in(str(error.value))) == 1


def test_a_scene_is_no_map():
    write("h.csv", "x,y,z\n" + "\n".join(f"{x},{y},{x + y}" for x in range(4) for y in range(4)) + "\n")
    write("s.toml", '[surface]\nkind = "file"\nfile = "h.csv"\n')
    with pytest.raises(asperity.Error, match="name the map that the scene names") as error:
        convert("s.toml", "t.h5")
    convert("h.csv", "t.h5")
    followed(str(error.value))


def test_every_message_is_followed():
    left = not_followed(SOURCES, EXCUSED)
    assert not left, "\n".join(left)
