# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity convert`: the same map from every format, the same atoms, and what is refused."""

import importlib.util
import json
import os
import re
import subprocess
import sys
import types

import h5py
import numpy
import pytest

from asperity import errors
from asperity.errors import InputOutputError, SceneError
from asperity.maps.convert import convert
from conftest import command

N, PIXEL = 24, 0.25  # nm
X, Y = numpy.meshgrid(numpy.arange(N), numpy.arange(N), indexing="ij")
HEIGHTS = numpy.round(numpy.sin(1 + 0.9 * X + 0.31 * Y * Y / 7) + 0.5 * numpy.cos(0.2 * X * Y / 3), 4)  # [x, y], nm
MICROMETRES = f"{N * PIXEL / 1000} µm"


def rows(separator="\t", number=repr):
    return "".join(separator.join(number(float(h)) for h in HEIGHTS[:, y]) + "\n" for y in range(N))


def points():
    return "".join(f"{x * PIXEL} {y * PIXEL} {float(HEIGHTS[x, y])!r}\n" for x in reversed(range(N)) for y in range(N))


SPIP = "# File Format = ASCII\n" + "".join(f"# {a}-pixels = {N}\n# {a}-length = {N * PIXEL}\n" for a in "xy")
TEXTS = {  # file, its content, what the file leaves open
    "gwyddion.txt": (f"# Channel: Z\n# Width: {MICROMETRES}\n# Height: 6 nm\n# Value units: m\n"
                     + rows(number=lambda h: f"{h!r}e-9"), ""),
    "spip.asc": (SPIP + "# Bit2nm = 0.5\n# Start of Data:\n" + rows(number=lambda h: repr(2 * h)), ""),
    "edge.txt": ("# edge: 60 Å\n# z-unit: nm\n" + rows(), ""),
    "german.txt": ("# Kanal: Topografie\n# Breite: 0,0060 µm\n# Höhe: 6,00 nm\n# Wert-Einheiten: nm\n"
                   + rows(number=lambda h: repr(h).replace(".", ",")), ""),
    "mixed.txt": ("# Channel: Topografie\n# Breite: 0,0060 µm\n# Höhe: 6,00 nm\n# Value units: nm\n"
                  + rows(number=lambda h: repr(h).replace(".", ",")), ""),
    "comma.txt": (rows(";", lambda h: repr(h).replace(".", ",")), "unit size"),
    "list.csv": ("\ufeff" + rows(", "), "unit size"),
    "grid.asc": (f"ncols {N}\nNROWS {N}\nxllcorner 7\ncellsize {PIXEL}\nNODATA_value -9999\n" + rows(" "), "unit"),
    "points.xyz": (points(), "unit"),
    "points.txt": (points(), "unit"),
}
INSTRUMENTS = ("map.gwy", "map.nc", "map.x3p", "map.sdf")


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    place = tmp_path_factory.mktemp("maps")
    for name, (text, _) in TEXTS.items():
        (place / name).write_text(text)
    numpy.save(place / "map.npy", HEIGHTS.T)
    with h5py.File(place / "other.h5", "w") as file:
        file["group/map"] = HEIGHTS.T
        file["group/map"].attrs.update({"unit": "nm", "size_x": N * PIXEL})
        file["line"] = numpy.arange(3)
    return place


def read(place, source):
    """The map as the program reads it: its heights (Å, as made, not detrended), and what it prints."""
    scene = place / "map.toml"
    left_open = TEXTS.get(source.name, ("", "unit size" if source.suffix == ".npy" else ""))[1]
    file = source
    if source.suffix not in (".npy", ".h5"):
        file = place / (source.name + ".h5")
        file.unlink(missing_ok=True)
        command("convert", source, file)
    scene.write_text(f'[surface]\nkind = "file"\nfile = "{file}"\nsites = {N}\nspacing = "{PIXEL} nm"\n'
                     + 'detrend = "none"\n' + ('file_unit = "nm"\n' if "unit" in left_open else "")
                     + (f'file_size = "{N * PIXEL} nm"\n' if "size" in left_open else ""))
    return scene


@pytest.mark.parametrize("name", [*TEXTS, "map.npy", "other.h5"])
def test_every_format_gives_the_same_heights(place, tmp_path, name):
    text = command("surface", read(tmp_path, place / name), "--out", tmp_path / "out")
    assert re.search(r"size +60 x 60 Å", text[: text.index("the surface made")])
    with h5py.File(tmp_path / "out/heights.h5") as file:
        found = file["heights"][:]
    if name in ("gwyddion.txt", "spip.asc"):  # numbers in m; half numbers
        assert found == pytest.approx(10 * HEIGHTS.T, rel=1e-15, abs=0)
    else:
        assert (found == 10 * HEIGHTS.T).all()


def test_gaps_are_missing_points(tmp_path):
    holes = {"bad.txt": "# Width: 2 nm\n# Height: 2 nm\n1 2\nbad void\n", "esri.asc": "ncols 2\nnrows 2\ncellsize 1\n"
             "nodata_value -1\n1 2\n-1 -1\n", "points.xyz": "0 0 1\n1 0 2\n1 1 nan\n", "inf.txt": "1 2\ninf -inf\n"}
    for name, text in holes.items():
        (tmp_path / name).write_text(text)
        assert "points without a height: 2" in convert(tmp_path / name, tmp_path / f"{name}.h5")
        with h5py.File(tmp_path / f"{name}.h5") as file:
            assert numpy.array_equal(file["heights"], [[1, 2], [numpy.nan, numpy.nan]], equal_nan=True), name


REFUSED = {
    "the commas may be": ["1,5 2,5\n3,5 4,5\n", "1.5\t2,5\n3,5\t4,5\n"],
    "not of one length": ["1 2\n3\n"],
    "no row of numbers": ["1 2\n3 x\n", "1 2\n0x10 3\n"],
    "is no size": ["# Width: 15\n1 2\n3 4\n", "# Width: 15 nM\n1 2\n", "# Width: -1 nm\n1 2\n"],
    "is no factor": ["# Bit2nm = 0\n1 2\n", "# Bit2nm = x\n1 2\n"],
    "not whole": ["# x-pixels = 7\n1 2\n", "ncols 2\nnrows 3\ncellsize 1\n1 2\n3 4\n"],
    "no pixel size": ["ncols 2\nnrows 1\n1 2\n"],
    "no header of a grid": ["ncols 2\nnrows two\n1 2\n"],
}


def test_what_could_become_a_wrong_map_is_refused(tmp_path):
    bad, out = tmp_path / "bad.txt", tmp_path / "out.h5"
    for said, texts in REFUSED.items():
        for text in texts:
            bad.write_text(text)
            with pytest.raises(InputOutputError, match=said):
                convert(bad, out)
    xyz = tmp_path / "bad.xyz"
    for said, text in (("no point of a map", "1 2\n3 4\n"),
                       ("on no grid", "0 0 1\n1 0 2\n2.5 0 4\n0 1 1\n1 1 1\n2.5 1 1\n"),
                       ("on no grid", "".join(f"{i} {i} 1\n" for i in range(3000))), ("on no grid", "0 0 1\n1 0 2\n"),
                       ("stands twice", "0 0 1\n0 1 2\n1 0 3\n1 1 4\n1 1 5\n"), ("no point of a map", "nan 0 1\n")):
        xyz.write_text(text)
        with pytest.raises(InputOutputError, match=said):
            convert(xyz, out)
    assert not out.exists()
    # A comment that only looks like a size; commas that separate.
    bad.write_text("# Width: see the paper\n1,2\n3,4\n")
    convert(bad, out)
    with h5py.File(out) as file:
        assert file["heights"][:].tolist() == [[1, 2], [3, 4]] and not set(file["heights"].attrs)
    with pytest.raises(SceneError, match="is there already"):
        convert(bad, out)
    with pytest.raises(InputOutputError, match="is no name of an HDF5 file"):
        convert(bad, tmp_path / "out.npy")
    with pytest.raises(InputOutputError, match="cannot be written"):
        convert(bad, bad / "out.h5")
    with pytest.raises(InputOutputError, match="cannot be read\n.*there is no such file\n.*check the path"):
        convert(tmp_path / "none.txt", tmp_path / "none.h5")


def test_hdf5_of_other_programs(place, tmp_path):
    """Is read as it is, and its conversion refused; damaged files end in a message."""
    scene = tmp_path / "scene.toml"
    scene.write_text(f'[surface]\nkind = "file"\nfile = "other.h5"\nsites = {N}\nspacing = "{PIXEL} nm"\n')
    other = (place / "other.h5").read_bytes()
    with pytest.raises(InputOutputError, match="needs no conversion"):
        convert(place / "other.h5", tmp_path / "no.h5")
    with h5py.File(tmp_path / "two.h5", "w") as file:
        file["a"], file["b/c"] = HEIGHTS.astype("f4"), numpy.full((2, 2), 7)
        file["b/c"].attrs["units"] = numpy.bytes_("nm")  # of fixed length
        file.create_dataset("declared", (3000, 3000), "f4", chunks=(100, 100))
        file.create_dataset("packed", data=numpy.zeros((N, N)), compression="gzip")
        file["text"] = numpy.array([[b"a"]])
    for name, says in (("", "holds more than one map"), (":/declared", "9000000 numbers are declared, and 0 bytes"),
                       (":/text", "is no height map"), (":/x", "has no data set /x"), (":/b", "has no data set /b"),
                       (":/a", "the file does not say the unit")):
        command("check", scene, "--set", f"surface.file=two.h5{name}", "surface.file_size=60",
                expect=0 if name == ":/a" else 2, says=says)
    command("surface", scene, "--out", tmp_path / "c", "--set", "surface.file=two.h5:/b/c", "surface.sites=4",
            "surface.spacing=2 nm", "surface.file_size=8 nm", "surface.resample=band-limited", says="heights in nm")
    command("check", scene, "--set", "surface.file=two.h5:/packed", "surface.file_size=60")
    random, kinds = numpy.random.default_rng(36), set()
    for _ in range(20):
        damaged = bytearray(other)
        for at in random.integers(8, 3000, 8):
            damaged[at % len(damaged)] = random.integers(256)
        (tmp_path / "other.h5").write_bytes(damaged)
        done = subprocess.run([os.environ["ASPERITY_PROGRAM"], "surface", scene, "--out", tmp_path / "damaged"],
                              capture_output=True, text=True)
        assert done.returncode in (0, 2), done.stderr
        kinds.add(done.returncode)
    assert kinds == {0, 2}


def test_a_surface_needs_neither_interface_nor_drive(tmp_path):
    """Pixels of 0.1 µm are no lattice of atoms, and a surface."""
    numpy.savetxt(tmp_path / "map.txt", HEIGHTS)
    scene = tmp_path / "wide.toml"
    scene.write_text(f'[surface]\nkind = "file"\nfile = "map.txt"\nsites = {N}\nspacing = "0.1 µm"\n')
    command("surface", scene, "--out", tmp_path / "wide", "--set", "drive.velocity=1e9", says="1000")
    command("check", scene, expect=2, says="interface.potential")
    command("surface", scene, "--set", "surface.file=gone.txt", expect=2, says="there is no such file")
    for size in ("5000 km", "1 m"):
        command("surface", scene, "--set", f"surface.file_size={size}", "surface.spacing=2.6",
                "surface.resample=band-limited", expect=2, says="check the map's size and unit (surface.file_size)")


def test_what_is_not_understood_is_said(tmp_path):
    said = "".join(f"# {line}\n" for line in ("Breite: 3 nm", "rms: 3", "by: M. Meyer"))
    (tmp_path / "m.txt").write_text(said + "1 2\n3 4\n")
    text = convert(tmp_path / "m.txt", tmp_path / "m.h5")
    assert "note: the header 'breite: 3 nm' is not understood" in text and "rms" not in text and "Meyer" not in text
    (tmp_path / "p.txt").write_text("0 0 1\n1 0 2\n2.5 0 4\n0 1 1\n1 1 1\n")
    assert "as points x, y and height they are on no grid" in convert(tmp_path / "p.txt", tmp_path / "p.h5")
    with pytest.raises(InputOutputError, match="has no channel '2'\n.*holds one map"):
        convert(tmp_path / "m.txt", tmp_path / "no.h5", "2")
    (tmp_path / "l.data").write_text("title\n\n1 atoms\n\nAtoms\n\n1 1 1 2 3 4\n")
    with pytest.raises(InputOutputError, match="why: no atom style is named, and 6 columns"):
        convert(tmp_path / "l.data", tmp_path / "no.h5")


def test_channels_of_an_instrument(tmp_path, monkeypatch):
    """The one that is taken is named, and the others; the one asked for by name or number is taken."""
    def channel(index, name, dim=2, unit="nm"):
        return types.SimpleNamespace(index=index, name=name, dim=dim, unit=unit, physical_sizes=(3.0, 3.0),
                                     heights=lambda: numpy.full((3, 3), float(index)))

    channels = [channel(0, "ZSensor"), channel(1, "Phase", unit=None), channel(2, "Height"), channel(3, "Line", 1)]
    reader = types.SimpleNamespace(channels=channels, default_channel=channels[0],
                                   topography=lambda channel_index: channels[channel_index])
    monkeypatch.setitem(sys.modules, "SurfaceTopography", types.SimpleNamespace(open_topography=lambda path: reader))
    scan, out = tmp_path / "scan.gwy", tmp_path / "scan.h5"
    scan.write_bytes(b"GWYP\0\0")
    for wanted, taken in ((None, 0), ("Height", 2), ("3", 2), ("1", 0)):
        out.unlink(missing_ok=True)
        said = convert(scan, out, wanted)
        assert f"channel {taken + 1} ({channels[taken].name}) was taken; --channel takes another: " in said
        assert "2 Phase" in said and "4 Line" in said
        with h5py.File(out) as file:
            assert (file["heights"][:] == taken).all()
    out.unlink()
    for wanted, says in (("Phase", "does not say the unit of channel 2 .Phase."), ("4", "it is a line scan"),
                         ("5", "has no channel '5'\n.*1 ZSensor, 2 Phase, 3 Height, 4 Line"), ("", "no channel ''")):
        with pytest.raises(InputOutputError, match=says):
            convert(scan, out, wanted)


# Atoms. Three of them in a box of 10 x 12 Å with its corner at (1, -2, 5); the last one on its far edge.
PLACES = ((1.5, -1.0, 5.25), (10.75, 9.0, 6.0), (11.0, -2.0, 7.0))


def lammps(style="", before=" 1", after="", title="any title"):
    return (f"{title}\n\n3 atoms\n1 atom types\n1 11 xlo xhi\n-2 10 ylo yhi\n5 8 zlo zhi\n\nMasses\n\n1 197.0 # Au\n\n"
            f"Atoms{style}\n\n" + "".join(f"{i + 1}{before} {x} {y} {z}{after}\n" for i, (x, y, z) in enumerate(PLACES))
            + "\nVelocities\n\n1 0 0 0\n2 0 0 0\n3 0 0 0\n")


def atoms_of(tmp_path, text, name="solid.data"):
    (tmp_path / name).write_text(text)
    (tmp_path / "atoms.h5").unlink(missing_ok=True)
    said = convert(tmp_path / name, tmp_path / "atoms.h5")
    with h5py.File(tmp_path / "atoms.h5") as file:
        assert file["box"][:].tolist() == [10.0, 12.0]
        assert file["position"][:].tolist() == [[0.5, 1.0, 5.25], [9.75, 11.0, 6.0], [0.0, 0.0, 7.0]]  # folded back
        return file["type"].attrs["names"], file["type"][:].tolist(), said


@pytest.mark.parametrize("style, before, after", [
    (" # atomic", " 1", ""), ("", " 1", ""), ("", " 1", " 0 0 -1"), (" # charge", " 1 -0.5", ""), ("", "\t1", " # Au"),
    (" # molecular", " 7 1", ""), (" # bond", " 7 1", " 0 0 0"), (" # angle", " 7 1", ""), (" # full", " 7 1 0.25", ""),
    ("", " 7 1 0.25", ""), ("", " 7 1 0.25", " 0 0 0"), ("  # atomic  ", " Au", "\r")])
def test_atom_styles_of_lammps(tmp_path, style, before, after):
    names, kinds, said = atoms_of(tmp_path, lammps(style, before, after))
    assert (names, kinds) == ("Au" if "Au" in before else "1", [0, 0, 0])
    assert "3 atoms of type" in said and "10 x 12 Å; 0 coordinates" in said


def test_types_and_places_of_lammps(tmp_path):
    names, kinds, _ = atoms_of(tmp_path, lammps(before=" 2").replace("\n2 2 10.75", "\n2 1 10.75"))
    assert (names, kinds) == ("2 1", [0, 1, 0])
    assert "1 coordinates" in atoms_of(tmp_path, lammps().replace(" 1.5 ", " -8.5 "))[2]


@pytest.mark.parametrize("old, new", [
    *((" 1.5 -1", f" {number} -1") for number in ("nan", "inf", "1e999", "0x10", "1,5", "--1", "1.5e", "1e8", "-9.5")),
    ("-1.0 5.25", "-1.0 -5.25"), *(("3 atoms", number) for number in ("4 atoms", "2 atoms", "-3 atoms", "3")),
    ("\nAtoms", "\nAtomz"), ("1 11 xlo xhi", ""), ("-2 10 ylo yhi", "10 ylo yhi"), ("1 11 xlo xhi", "11 1 xlo xhi"),
    ("1 11 xlo xhi", "1 11 xlo xhi\n0.5 0 0 xy xz yz"), ("1 11 xlo xhi", "10 0 0 avec"),
    ("any title", "title, units = lj"), ("any title", "ITEM: TIMESTEP"), ("\n2 1 10.75", "\n1 1 10.75"),
    ("\n2 1 10.75", "\n2 1.5 10.75"), ("\n2 1 10.75", "\n2.5 1 10.75"), ("\n2 1 10.75", "\n2 1 0 10.75"),
    ("Velocities", "Atoms"), ("Atoms", "Atoms # sphere"), ("Atoms", "Atoms # full"), ("7.0\n", "7.0 0 0 0.5\n"),
    ("\n3 1 11", "\n# 3 1 11")])
def test_what_could_become_other_atoms_is_refused(tmp_path, old, new):
    text = lammps()
    assert old in text
    (tmp_path / "solid.data").write_text(text.replace(old, new, 1))
    with pytest.raises(InputOutputError):
        convert(tmp_path / "solid.data", tmp_path / "atoms.h5")


def test_what_is_not_read_of_atoms_is_said(tmp_path):
    for text, says in ((lammps(), "Masses, Velocities"), (lammps(" # full", " 1 1 0.5"), "Masses, Velocities, charges")):
        (tmp_path / "solid.data").write_text(text)
        (tmp_path / "atoms.h5").unlink(missing_ok=True)
        assert f"note: sections and columns that are not read, since a rigid substrate is types and places: {says}" in convert(
            tmp_path / "solid.data", tmp_path / "atoms.h5")
    text = lammps()[:lammps().index("\nVelocities")].replace("Masses\n\n1 197.0 # Au\n\n", "")
    (tmp_path / "plain.data").write_text(text + "\n")
    assert "not read" not in convert(tmp_path / "plain.data", tmp_path / "plain.h5")


def test_atoms_that_stand_twice_or_are_cut_anywhere_are_refused(tmp_path):
    text = lammps()
    twice = text.replace("3 atoms", "2 atoms").replace("\n2 1 10.75", "\n1 1 10.75")
    for bad, says in ((twice, "atom 1 "), *((text[:end], "") for end in range(10, text.index("\nVelocities")))):
        (tmp_path / "bad.data").write_text(bad)
        with pytest.raises(InputOutputError, match=says):
            convert(tmp_path / "bad.data", tmp_path / "atoms.h5")


LATTICE = 'Lattice="10 0 0 0 12 0 0 0 3" Origin="1 -2 5"'


def extended(second=LATTICE, before="Au ", after=""):
    return f"3\n{second}\n" + "".join(f"{before}{x} {y} {z}{after}\n" for x, y, z in PLACES)


def test_extended_xyz(tmp_path):
    if not importlib.util.find_spec("ase"):
        with pytest.raises(InputOutputError, match="needs ASE"):
            atoms_of(tmp_path, extended(), "solid.xyz")
        return
    assert atoms_of(tmp_path, extended(), "solid.xyz")[:2] == ("Au", [0, 0, 0])
    for second, before, after in ((' Properties=species:S:1:pos:R:3 pbc="T T F"', "Au ", ""),
                                  (' note="a = b" Properties=id:I:1:species:S:1:pos:R:3:q:R:1', "7 Au ", " 0.5")):
        atoms_of(tmp_path, extended(LATTICE + second, before, after), "solid.extxyz")
    (tmp_path / "note.extxyz").write_text(extended(LATTICE + ' note="a = b" Properties=id:I:1:species:S:1:pos:R:3:q:R:1', "7 Au ", " 0.5"))
    said = convert(tmp_path / "note.extxyz", tmp_path / "note.h5").partition("types and places: ")[2]
    assert {"id", "q", "note"} <= set(said.splitlines()[0].split(", "))
    assert atoms_of(tmp_path, extended().replace("Au 11", "C 11"), "solid.xyz")[:2] == ("Au C", [0, 0, 1])
    for old, new in ((" 1.5 -1", " nan -1"), (" 1.5 -1", " 1e8 -1"), ("5.25", "-5.25"), ("3\n", "4\n"), ("3\n", "2\n"),
                     ('="10 0', '="10 1'), ('="10 0', '="10'), ('="10 0', '="-10 0'), (LATTICE, "a film of gold"),
                     (LATTICE, LATTICE + ' pbc="T F T"'), (LATTICE, LATTICE + " Properties=species:S:1"),
                     ("Au 10.75", "10.75"), ("3\n", extended() + "3\n")):
        (tmp_path / "bad.xyz").write_text(extended().replace(old, new, 1))
        with pytest.raises(InputOutputError):
            convert(tmp_path / "bad.xyz", tmp_path / "bad.h5")


def test_files_of_instruments_are_refused_without_surface_topography(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "SurfaceTopography", None)
    (tmp_path / "no.gwy").write_bytes(b"GWYP\0\0")
    managed = tmp_path / "EXTERNALLY-MANAGED"
    monkeypatch.setattr("sysconfig.get_path", lambda name: str(tmp_path))
    with pytest.raises(InputOutputError, match="fix: .* -m pip install SurfaceTopography"):
        convert(tmp_path / "no.gwy", tmp_path / "no.h5")
    managed.touch()  # Debian's Python takes nothing by pip
    monkeypatch.setattr("sys.prefix", sys.base_prefix)
    with pytest.raises(InputOutputError, match="fix: .* -m venv .*pip install numpy .* SurfaceTopography; export ASPERITY"):
        convert(tmp_path / "no.gwy", tmp_path / "no.h5")
    assert errors.to_install("ase") == "apt-get install python3-ase"


@pytest.fixture(scope="module")
def instruments(place):
    topography = pytest.importorskip("SurfaceTopography").Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm")
    topography.to_gwy(str(place / "map.gwy"))
    topography.to_netcdf(str(place / "map.nc"))
    topography.to_x3p(str(place / "map.x3p"))
    head = {"ManufacID": "test", "CreateDate": "210120261200", "ModDate": "210120261200", "NumPoints": N,
            "NumProfiles": N, "Xscale": PIXEL * 1e-9, "Yscale": PIXEL * 1e-9, "Zscale": 1e-9, "Zresolution": 1e-12,
            "Compression": 0, "DataType": 7, "CheckType": 0}
    (place / "map.sdf").write_text("aISO-1.0\n" + "".join(f"{k} = {v}\n" for k, v in head.items()) + "*\n"
                                   + rows(" ") + "*\n")
    (place / "no.gwy").write_text("no map")
    with pytest.raises(InputOutputError, match="cannot be read"):
        convert(place / "no.gwy", place / "no.h5")
    return place


@pytest.mark.parametrize("name", [*TEXTS, "map.npy", *INSTRUMENTS])
def test_statistics_are_those_of_surface_topography(instruments, tmp_path, name):
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    if name in INSTRUMENTS:
        (tmp_path / "named.toml").write_text(f'[surface]\nkind = "file"\nfile = "{instruments / name}"\nsites = {N}\n')
        assert f"asperity convert {instruments / name} map.h5" in command("check", tmp_path / "named.toml", expect=2)
    text = command("surface", read(tmp_path, instruments / name), "--out", tmp_path / "out")
    of_file = text[: text.index("the surface made")]

    def told(what):
        return float(re.search(rf"{what} +([-+.0-9e]+)", of_file)[1])

    own = SurfaceTopography.Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm")
    assert told("rms height") == pytest.approx(10 * own.rms_height_from_area(), rel=1e-6)
    assert told("rms slope") == pytest.approx(own.rms_gradient(), rel=1e-6)
    assert told("rms curvature") == pytest.approx(own.rms_curvature_from_area() / 10, rel=1e-6)
    assert told("lowest") == pytest.approx(10 * HEIGHTS.min(), rel=1e-6)
    assert re.search(r"size +60 x 60 Å", of_file)

    periodic = SurfaceTopography.Topography(HEIGHTS, (N * PIXEL, N * PIXEL), unit="nm", periodic=True)
    with h5py.File(tmp_path / "out/heights.h5") as file:
        assert file["heights"][:] == pytest.approx(10 * HEIGHTS.T, abs=1e-6)
        q, c1d = periodic.power_spectrum_from_profile(window=None, resampling_method=None)
        n = len(q) - 1
        assert 10 * file["spectrum/line_q"][:n] == pytest.approx(numpy.asarray(q)[1:], rel=1e-6)
        assert file["spectrum/c1d"][:n] / 1e3 == pytest.approx(numpy.asarray(c1d)[1:], rel=1e-6, abs=1e-9)
        # SurfaceTopography ends before half the period.
        r, acf = (numpy.asarray(a)[1:N // 2] for a in periodic.autocorrelation_from_profile(resampling_method=None))
        assert file["spectrum/line_r"][:-1] / 10 == pytest.approx(r, rel=1e-6)
        assert file["spectrum/autocorrelation"][:-1] / 100 == pytest.approx(acf, rel=1e-6)
        slope = numpy.asarray(periodic.scale_dependent_slope_from_profile(resampling_method=None)[1])[:N // 2 - 1]
        assert file["spectrum/scale_dependent_slope"][:-1] == pytest.approx(slope, rel=1e-6)
        # C(q) is C2D / (2 pi)^2, averaged over rings that are one q_L wide.
        c2d = periodic.power_spectrum_from_area(window=None, return_map=True)[2]
        k = numpy.fft.fftfreq(N, 1 / N)
        ring = numpy.rint(numpy.hypot(k[:, None], k)).astype(int)
        c = [c2d[ring == i].mean() / (2 * numpy.pi) ** 2 for i in range(1, N // 2 + 1)]
        assert file["spectrum/realised"][:] / 1e4 == pytest.approx(c, rel=1e-6)
    assert json.load(open(tmp_path / "out/result.json"))["surface"]["rms"] == pytest.approx(
        10 * periodic.rms_height_from_area(), rel=1e-6)


def test_no_size_is_made_up_for_a_map_that_does_not_tell_its_unit(tmp_path):
    """A scene would take the heights for nm and the width for Å."""
    (tmp_path / "m.csv").write_text("x,y,z\n" + "\n".join(f"{x},{y},{x * y % 7}" for x in range(20) for y in range(20)) + "\n")
    said = convert(tmp_path / "m.csv", tmp_path / "m.h5")
    assert said.startswith(f"{tmp_path / 'm.h5'}: 20 x 20 points, 20 x 20 of an unknown unit, heights in an unknown unit (set surface.file_unit)")
    assert "refuses" not in said and " nm" not in said
