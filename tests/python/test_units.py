# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""One table of units: wherever a quantity is read, the same words are units."""

import inspect
import itertools
import re

import h5py
import numpy as np
import pytest

import asperity
from asperity import units
from asperity.arguments import ALIASES
from asperity.commands.options import command as of_package
from asperity.maps import height_map
from asperity.maps.convert import convert
from asperity.running import program
from conftest import ROOT, command

LENGTHS = ["Å", "\u212b", "A", "Ang", "angstrom", "Angstrom", "fm", "pm", "nm", "um", "µm", "\u03bcm", "Âµm", "mm", "cm", "m", "km"]
WORKS = ["mJ/m2", "mJ/m^2", "mJ/m²", "mJ m-2", "mJ m^-2", "mN/m", "J/m2", "J/m^2", "N/m", "meV/Å^2", "eV/A2", "eV/nm2"]
STATE = {"surface": {"sites": 16, "spacing": 2.6, "rms": 0.2}, "drive": {"path": ["relax"]}}
WALL = {**STATE, "interface": {"kind": "wall", "range": 3}}


def written(amount, base, unit):
    return f"{amount / units.conversion(unit, base):.17g} {unit}"


def test_the_table_is_the_programs():
    """The source of the program has the same symbols, prefixes and spellings."""
    text = (ROOT / "io/units.cpp").read_text()
    table = re.search(r"symbols\[\] = \{(.*?)\n\};", text, re.S)[1]
    dimensions = {name: getattr(units, f"_{ours}") for name, ours in (
        ("length", "LENGTH"), ("mass", "MASS"), ("duration", "TIME"), ("temperature", "WARMTH"), ("energy", "ENERGY"), ("force", "FORCE"),
        ("pressure", "PRESSURE"), ("rate", "RATE"), ("number", "NUMBER"))}
    theirs = {name.encode().decode("unicode_escape").encode("latin-1", "ignore").decode("utf-8", "ignore") if "\\" not in name else
              name.encode().decode("unicode_escape"): (dimensions[of], float(factor), int(power), prefixed == "true")
              for name, of, factor, power, prefixed in re.findall(r'\{"([^"]+)", \{(\w+), ([\d.]+), (-?\d+)\}, (true|false)\}', table)}
    assert theirs == units.SYMBOLS
    prefixes = re.search(r"prefixes\[\] = \{(.*?)\};", text, re.S)[1]
    assert {p.encode().decode("unicode_escape") if "\\" in p else p: int(power) for p, power in
            re.findall(r'\{"([^"]+)", (-?\d+)\}', prefixes)} == units.PREFIXES
    spellings = re.search(r"spellings\[\] = \{(.*?)\n\};", text, re.S)[1]
    decoded = {re.sub(r"\\u([0-9A-Fa-f]{4})", lambda at: chr(int(at[1], 16)), a): re.sub(r"\\u([0-9A-Fa-f]{4})", lambda at: chr(int(at[1], 16)), b)
               for a, b in re.findall(r'\{"([^"]+)", "([^"]+)"\}', spellings)}
    assert decoded == units.SPELLINGS


def test_both_readers_agree():
    """Of made-up units: the module's parser and that of the program, which reads them as quantities."""
    quantity = pytest.importorskip("asperity.running.engine").quantity
    words = ["nm", "µm", "meV", "eV", "GPa", "kg", "fs", "ps", "N", "Da", "bar", "1", "parsec", "m2", "s-1", "Å^-3", "m--1", "nm^0"]
    some = [a + sign + b for a, b in itertools.product(words, words) for sign in ("/", " ", "*", "//")] + [*words, "", "/s", "m/", "m²", "s⁻²"]
    known = 0
    for unit in some:
        for base in ("Å", "GPa", "meV/Å^2", "1/ps", "eV/Å"):
            ours = units.conversion(unit, base)
            try:
                theirs = quantity("x", f"1 {unit}", base) if unit else None
            except asperity.SceneError:
                theirs = None
            assert (ours is None) == (theirs is None) and ours == pytest.approx(theirs, rel=1e-14, abs=0), unit
            known += ours is not None
    assert known > 50


@pytest.mark.parametrize("unit", LENGTHS)
def test_lengths_are_read_everywhere(place, unit):
    """A scene's key, an option, an argument of Python, a map's header as text and as HDF5, a converter."""
    spelt = written(2.6, "Å", unit)
    assert asperity.check(STATE, {"surface.spacing": spelt}).scene.surface.spacing == pytest.approx(2.6, rel=1e-12)
    factor = units.conversion(unit, "Å")
    heights = np.random.default_rng(1).normal(size=(16, 16)) / factor
    edge = 16 * 2.6 / factor
    rows = "\n".join("\t".join(f"{v:.17g}" for v in row) for row in heights)
    (place / "map.txt").write_text(f"# Channel: z\n# Width: {edge:.17g} {unit}\n# Height: {edge:.17g} {unit}\n# Value units: {unit}\n{rows}\n")
    with h5py.File(place / "map.h5", "w") as file:
        file["z"] = heights
        file["z"].attrs.update(unit=unit, size_x=edge, size_y=edge, size_unit=unit)
    np.save(place / "map.npy", heights)
    convert(place / "map.txt", place / "converted.h5")
    for name, more in (("map.txt", {}), ("map.h5", {}), ("converted.h5", {}), ("map.npy", {"unit": unit, "size": edge * factor})):
        found = height_map.read_map(str(place / name), **more)
        assert found.size == pytest.approx((41.6, 41.6), rel=1e-12) and found.heights == pytest.approx(heights * factor, rel=1e-12), name
    for name in ("map.h5", "converted.h5"):  # which the program reads
        made = asperity.surface({"surface": {"kind": "file", "file": str(place / name), "sites": 16, "spacing": 2.6}})
        assert made.heights.std() == pytest.approx(heights.std() * factor, rel=1e-9)


@pytest.mark.parametrize("unit", WORKS)
def test_works_are_read_everywhere(place, unit):
    spelt = written(12.5, "meV/Å^2", unit)
    assert asperity.check(WALL, {"interface.adhesion": spelt}).scene.interface.adhesion == pytest.approx(12.5, rel=1e-12)
    from asperity.studies.map_scene import scene_of

    np.save(place / "map.npy", np.random.default_rng(1).normal(size=(16, 16)))
    made = scene_of("map.npy", "5 GPa", 0.3, spelt, place / "made", unit="Å", size="40 Å")
    assert asperity.check(made.file).scene.interface.adhesion == pytest.approx(12.5, rel=1e-9)


def test_forces_are_read():
    for unit in ("nN", "pN", "uN", "µN", "eV/Å", "eV/A"):
        load = written(0.1, "eV/Å", unit)
        scene = {**WALL, "surface": {**STATE["surface"], "radius": 200.0}, "drive": {"mode": "quasistatic", "path": ["approach", f"load {load}"]}}
        assert load in asperity.check(scene).scene.drive.path[1]


def test_options_and_arguments_have_the_words_of_the_scene():
    """Each option of a command that makes a scene itself, and each argument of the function, is the last word of a key."""
    words = {key.partition(".")[2] for key in program.schema()}
    for name in ("adhesion", "tip"):
        options = {field: about for field, (about, _, _) in of_package(name).options.about().items() if not about.word}
        made = {field for field, about in options.items() if not about.own}
        assert {"young", "poisson", "adhesion", "hardness", "range", "size", "unit", "sites"} <= made
        for field in options:
            names = {field, *ALIASES.get(field, ())}
            assert bool(names & words) == (field in made), f"asperity {name}: {names} and the words of a scene"
    arguments = set(inspect.signature(asperity.adhesion).parameters)
    known = {"map", "out", "jobs", "channel", *words, *(alias for aliases in ALIASES.values() for alias in aliases), *ALIASES}
    assert arguments <= known, arguments - known
    assert {"young", "poisson", "adhesion", "E", "nu", "work", "w"} <= arguments


def test_names_of_one_argument(place):
    np.save(place / "map.npy", np.zeros((32, 32)))
    with pytest.raises(asperity.SceneError, match="young and E: are names of one argument"):
        asperity.adhesion("map.npy", young="1 GPa", E="1 GPa", nu=0.3, w="50 mJ/m2")
    with pytest.raises(asperity.SceneError, match="adhesion: is not given"):
        asperity.adhesion("map.npy", E="1 GPa", nu=0.3)
    command("adhesion", "map.npy", "--young", "1 GPa", "--nu", "0.6", "--w", "50 mJ/m2", "--unit", "nm", "--size", "10 nm", expect=2,
            says="poisson = 0.6")
