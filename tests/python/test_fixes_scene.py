# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whoever follows the fix of a message about a scene has a scene that is taken: every message of the catalogue, with a bad
input and the fix done as the message says it."""

import math
import os
import re
from pathlib import Path

import h5py
import numpy as np
import pytest

import asperity
from asperity.running.engine import _engine as engine
from following import ask, followed, not_followed
from ways_out import ways_of

SOURCES = ("engine/scene/", "engine/surface/", "engine/options/", "engine/case/", "engine/theory/", "engine/interface/", "decomposition/",
           "io/scene_reader", "io/scene_toml", "io/table_file", "io/units")
EXCUSED = {
    "Å from here": "followed in test_fixes_commands.py",
    "give the path of a file that `asperity prony` made": "followed in test_fixes_rubber.py",
    "make the file anew by `asperity prony`": "followed in test_fixes_rubber.py",
    "the attraction did not reach the pull": "followed in test_fixes_commands.py",
    "its surface does not fit into memory": "a machine's memory",
    "is larger than the memory": "a machine's memory",
    "has what is no number": "the reader of tables refuses it before",
    "the substrate has no atoms": "the reader of atoms refuses it before",
    "the scene's keys lead there": "the checks of the keys come before",
    "scene_toml.cpp...check its permissions": "whoever tests may read all files",
    "kernels of level": "followed below where the program has kernels for other processors",
    "is built for another processor": "a machine's processor",
}
STILL = {"surface.sites": "16", "block.thickness": "16", "drive.path": "relax"}
MOVING = {"surface.sites": "16", "block.thickness": "16"}
TURNS = {**MOVING, "drive.path": '["approach", "pull-off", "approach", "pull-off"]', "drive.timestep": "30"}
WARM = {**MOVING, "drive.temperature": "10"}
QUASI = {**MOVING, "drive.mode": "quasistatic"}
COATED = '[["1 nm", "10 GPa", 0.3]]'
WALL = {**STILL, "interface.kind": "wall"}
FREE = {"surface.sites": "16", "drive.mode": "quasistatic", "interface.kind": "wall", "surface.boundary": "free"}
TIP = {**FREE, "surface.kind": "flat", "surface.radius": "10 nm", "interface.adhesion": "1", "interface.range": "0.25", "drive.path": "approach"}
PAIR = {**WALL, "surface.kind": "flat", "surface.counter": "map.txt"}
LED = {**PAIR, "drive.mode": "quasistatic", "drive.path": "approach"}
PULLED = {**WALL, "drive.mode": "quasistatic", "drive.path": "approach, pull-off"}
ATOMS = {**STILL, "surface.kind": "atoms", "surface.file": "atoms.h5", "interface.pairs": '["Au 0.1 3.28", "B 0.05 3"]'}
TWINS = {"surface.file": "twins.h5"}
MAP = {**STILL, "surface.kind": "file", "surface.file": "map.txt"}
TABLE = {**STILL, "surface.rms": "0", "interface.potential": "table", "interface.table": "good.txt"}
LEAD = '["approach", "load 1 MPa"]'
FIELDS = "output.fields"
FIELD = "interface.adhesion"
FOLDER: list[Path] = []
BASES = (STILL, MOVING, TURNS, WARM, QUASI, WALL, FREE, TIP, PAIR, LED, PULLED, ATOMS, MAP, TABLE, {**MOVING, "numerics.device": "emulated"})
FEATURES = {"layers": {"block.layers": COATED}, "branches": {"block.prony": '[[1.0, "1 ns"]]'}, "hardness": {"interface.hardness": "1"},
            "spring": {"drive.stiffness": "0.2"}, "sphere": {"surface.radius": "1000"}, "slide": {"drive.path": '["approach", "slide x 5 Å"]'},
            "field": {FIELD: "stripes 1 2 20"}, "stress": {"output.stress": "section"}}
EVERY = os.environ.get("ASPERITY_LONG")
TRIED = (*(base for base in BASES if EVERY or base not in (TURNS, PULLED)),
         *({**QUASI, **FEATURES[one]} for one in (FEATURES if EVERY else ("branches", "spring", "slide"))),
         *({**PULLED, **FEATURES[one]} for one in (FEATURES if EVERY else ("layers", "branches", "hardness", "field", "stress"))))
"""Scenes on which each key is tried: all of them, or those that find a problem which no other one before finds."""
EXAMPLES = {
    "drive.path": [f"[{path}]" for path in (
        '"relax"', '"approach"', '"approach", "pull-off"', '"approach", "slide x 5 Å"', '"approach", "slide x 5 Å under load"', '"pull-off"',
        '"approach", "slide x 5 Å until steady"', '"approach", "load 1 MPa"', '"approach", "height 3 Å"', '"approach", "hold 5 ps"',
        '"approach", "approach"', '"relax", "pull-off"', '"hold 5 ps"', '"slide x 5 Å"', '"approach", "relax"',
        '"approach", "height 3 Å", "slide x 5 Å under load"')],
    "block.prony": ['[[1.0, "1 ns"]]', '[[1.0, "2 ns"], [2.0, "1 ns"]]'], "block.layers": [COATED, '[["20 nm", "10 GPa", 0.3]]', '[["0.5 Å", "10 GPa", 0.3]]'],
    "surface.counter_layers": [COATED, '[["20 nm", "10 GPa", 0.3]]'], "interface.pairs": ['["Au 0.1 3"]'], FIELD: ["0", "1", "stripes 1 2 20"],
    "interface.hardness": ["1", "stripes 1 2 20", "1e-6"], "interface.table": ["good.txt", "short.txt"], "surface.counter": ["map.txt", "none"],
    "surface.file": ["map.txt", "atoms.h5", "plane.txt"], FIELDS: [f'["{one}"]' for one in ("relaxed", "pull-off", "segments", "after-approach:5")],
    "numerics.device": ["emulated", "none", "7"], "output.trajectory": ["10", "none"], "interface.adhesion_size": ["41.6"]}
"""Values of keys whose schema names none that is usual."""


def line_of(r, eV=0.1, d=1.0, end="\n"):
    """A row of a table: Morse with a well of eV at 2.9 Å."""
    x = math.exp(-1.5 * (r - 2.9) * d)
    return f"{r:.4f} {eV * (x * x - 2 * x):.12g}{end}"


ROWS = [1.8 + 0.05 * k for k in range(220)]
FILES = {
    "good.txt": "".join(line_of(r) for r in ROWS),
    "coarse.txt": "".join(line_of(r) for r in ROWS[::12]),
    "noisy.txt": "".join(f"{r:.3f} {float(line_of(r).split()[1]) + (4e-6 * (-1) ** k if r > 6.8 else 0):.7f}\n" for k, r in enumerate(ROWS)),
    "unnamed.txt": "".join(line_of(r, end=" 0\n") for r in ROWS),
    "ragged.txt": "".join(line_of(r) for r in ROWS) + "13 0 0\n",
    "words.txt": "1.8 none\n" + "".join(line_of(r) for r in ROWS[1:]),
    "single.txt": "".join(line_of(r).split()[0] + "\n" for r in ROWS),
    "joule.txt": "# r V(kcal/mol)\n" + "".join(line_of(r) for r in ROWS),
    "short.txt": "".join(line_of(r) for r in ROWS[:6]), "late.txt": "".join(line_of(r) for r in ROWS[20:]),
    "monotonous.txt": "".join(line_of(r) for r in ROWS[24:]),
    "misnamed.txt": "# r F\n" + "".join(line_of(r) for r in ROWS),
    "descends.txt": "".join(line_of(r) for r in reversed(ROWS)),
}


def lammps(units, columns=4, again=False):
    rows = "".join(f"{k + 1} {line_of(r).strip()}{' 0' if columns == 4 else ''}\n" for k, r in enumerate(ROWS))
    return f"# UNITS: {units}\n\nAB\nN {len(ROWS)} R 1.8 12.75\n\n" + rows + (f"\nCD\nN {len(ROWS)} R 1.8 12.75\n\n" + rows if again else "")


FILES |= {"real.txt": lammps("real"), "si.txt": lammps("si"), "metal.txt": lammps("metal"), "two.txt": lammps("metal", again=True),
          "three.txt": lammps("metal", 3), "plane.txt": ("1 " * 16 + "\n") * 16, "minus.txt": "-1 " * 16 + "\n" + ("1 " * 16 + "\n") * 15,
          "map.txt": "\n".join(" ".join(str((3 * x + 5 * y) % 7 / 10) for x in range(16)) for y in range(16))}


@pytest.fixture(scope="module", autouse=True)
def files(light_module, tmp_path_factory):
    before, place = os.getcwd(), tmp_path_factory.mktemp("fixes")
    os.chdir(place)
    FOLDER.append(place)
    for name, text in FILES.items():
        Path(name).write_text(text)
    for name, n, twins in ("atoms.h5", 16, 0), ("wide.h5", 80, 0), ("twins.h5", 16, 2), ("long.h5", 16, 0):
        with h5py.File(name, "w") as file:
            x, y = np.meshgrid(2.6 * np.arange(n), 2.6 * np.arange(n))
            file["position"] = np.stack([x.ravel(), y.ravel(), np.zeros(n * n)], axis=1)
            file["position"][:twins] = 0
            file["type"] = np.arange(n * n) % 2
            file["type"].attrs["names"] = "Au B"
            file["box"] = [2.6 * n, 2.6 * n * (2 if name == "long.h5" else 1)]
    yield
    os.chdir(before)


# What the message says (groups of it go into the good settings), the bad settings, the good ones (None: left out), on a base
CASES = [
    ("give another length, or the number itself", {"surface.sites": "1 Å"}, {"surface.sites": "16"}, STILL),
    ("write q_max with the same number", {"surface.cutoff": "4"}, {"surface.cutoff": None, "surface.q_max": "4"}, STILL),
    ("leave block.model out, and take", {"block.model": "spectral"}, {"block.model": None, "drive.mode": "quasistatic"}, MOVING),
    ("leave it out; drive.damping", {"block.seams": "absorb"}, {"block.seams": None, "drive.damping": "0.05", "drive.damping_from": "0.5"}, MOVING),
    ("write interface.morse_r_min", {"interface.morse_r0": "3", "interface.potential": "morse"}, {"interface.morse_r0": None, "interface.morse_r_min": "3"}, STILL),
    ('write law = "smeared"', {"interface.law": "lennard-jones"}, {"interface.law": "smeared"}, WALL),
    ('write control = "top"', {"drive.hold": "top"}, {"drive.hold": None, "drive.control": "top"}, QUASI),
    ("leave it out; `asperity states", {"drive.states": "all"}, {"drive.states": None}, STILL),
    ("write displacement_step", {"drive.step": "0.1"}, {"drive.step": None, "drive.displacement_step": "0.1"}, QUASI),
    ("leave it out; `asperity theory`", {"theory.renormalised": "true"}, {"theory.renormalised": None}, STILL),
    ("leave it out; `asperity cost", {"numerics.accuracy": "1%"}, {"numerics.accuracy": None}, STILL),
    ('write "relaxed"', {FIELDS: "zero-load"}, {FIELDS: "relaxed"}, STILL),
    ('write "after-approach:N"', {FIELDS: '["after-zero-load:5"]'}, {FIELDS: '["after-approach:5"]'}, MOVING),
    # Segments
    ('write "relax"', {"drive.path": "zero-load"}, {"drive.path": "relax"}, STILL),
    ('did you mean "(.*)"', {"drive.path": "aproach"}, {"drive.path": "{0}"}, MOVING),
    ('segments are "(\\w+)"(?s:.*)take one of these', {"drive.path": "wiggle"}, {"drive.path": "{0}"}, MOVING),
    ('for example "(slide x.*)"', {"drive.path": '["approach", "slide z 5 Å"]'}, {"drive.path": '["approach", "{0}"]'}, MOVING),
    ('take "(relax)"', {"drive.path": "relax 3"}, {"drive.path": "{0}"}, STILL),
    ('for example "(load.*)"', {"drive.path": '["approach", "load"]'}, {"drive.path": '["approach", "{0}"]'}, MOVING),
    ('for example "(height.*)"', {"drive.path": '["approach", "height 3 kg"]'}, {"drive.path": '["approach", "{0}"]'}, QUASI),
    ('for example "(hold.*)"', {"drive.path": '["approach", "hold -1 ps"]'}, {"drive.path": '["approach", "{0}"]'}, MOVING),
    ("give a distance, negative", {"drive.path": '["approach", "slide x 0 Å"]'}, {"drive.path": '["approach", "slide x -3 Å"]'}, MOVING),
    # Paths
    (r"for example path = (\[.*\])", {"drive.path": "[]"}, {"drive.path": "{0}"}, MOVING),
    ('put a "pull-off" before it', {"drive.path": '["approach", "approach"]'}, {"drive.path": '["approach", "pull-off", "approach"]'}, MOVING),
    ('or lead it further with "load"', {"drive.path": '["approach", "approach"]'}, {"drive.path": LEAD}, MOVING),
    ("take it out, or", {"drive.path": '["approach", "relax"]'}, {"drive.path": '["approach"]'}, QUASI),
    ('put an "approach" before it', {"drive.path": '["slide x 5 Å"]'}, {"drive.path": '["approach", "slide x 5 Å"]'}, QUASI),
    ('put an "approach" before it', {"drive.path": '["hold 5 ps"]'}, {"drive.path": '["approach", "hold 5 ps"]'}, MOVING),
    ("take a larger interface.cutoff and tail = false", {"drive.path": '["approach", "slide x 5 Å"]', "interface.tail": "true"}, {"interface.cutoff": "14", "interface.tail": "false"}, QUASI),
    ('leave "under load"', {"drive.path": '["approach", "slide x 5 Å under load"]'}, {"drive.path": '["approach", "slide x 5 Å"]'}, QUASI),
    ('put a "load" before it', {"drive.path": '["height 3 Å", "slide x 5 Å under load"]'}, {"drive.path": '["height 3 Å", "load 1 MPa", "slide x 5 Å under load"]'}, PULLED),
    ("take it out, or give the block", {"drive.path": '["approach", "hold 5 ps"]'}, {"drive.path": '["approach"]'}, QUASI),
    ("viscoelastic branches \\(block.prony\\)", {"drive.path": '["approach", "hold 5 ps"]'}, {"block.prony": '[[1.0, "1 ns"]]'}, QUASI),
    # A substrate of atoms
    ('surface.kind = "file" with a map', {"interface.kind": "wall"}, {"surface.kind": "file", "surface.file": "map.txt", "interface.pairs": None}, ATOMS),
    ("take a larger interface.cutoff, and tail = false", {"interface.tail": "true"}, {"interface.tail": "false", "interface.cutoff": "14"}, ATOMS),
    ("take a cutoff of (100 Å) or less", {"interface.cutoff": "101"}, {"interface.cutoff": "{0}"}, {**ATOMS, "surface.sites": "80", "surface.file": "wide.h5"}),
    ("leave it out; give /position", {"surface.file_unit": "nm"}, {"surface.file_unit": None}, ATOMS),
    # The interface
    (r"take (\S+ Å) \(4 r0\) and interface.tail = true", {"surface.sites": "130", "block.thickness": "4", "interface.cutoff": "160"}, {"interface.cutoff": "{0}", "interface.tail": "true"}, STILL),
    ("take a larger surface.spacing, or", {"surface.sites": "1010", "surface.spacing": "0.026", "surface.rms": "0.01"}, {"surface.spacing": "2.6"}, STILL),
    ("or a smaller surface.lattice_ratio", {"surface.sites": "32", "surface.lattice_ratio": "10", "interface.cutoff": "35"}, {"surface.lattice_ratio": "5"}, STILL),
    ("give rolloff <= q_max", {"surface.rolloff": "5", "surface.q_max": "4"}, {"surface.rolloff": "4"}, STILL),
    ("give a smaller rolloff", {"surface.rolloff": "9"}, {"surface.rolloff": "8"}, STILL),
    ("or more sites", {"surface.rolloff": "9"}, {"surface.sites": "20"}, STILL),
    ("give a larger radius", {"surface.radius": "10"}, {"surface.radius": "100"}, STILL),
    ("or fewer sites", {"surface.radius": "40", "surface.sites": "32"}, {"surface.sites": "16"}, STILL),
    ('take kind = "flat" and no file', {"surface.rms": "0"}, {"surface.kind": "flat", "surface.rms": None, "surface.file": None}, MAP),
    ('take drive.mode = "dynamic" with an approach', {"block.strain": "finite"}, {"drive.mode": "dynamic", "drive.path": '["approach"]'}, STILL),
    ("write the branches in the order", {"block.prony": '[[1.0, "2 ns"], [2.0, "1 ns"]]'}, {"block.prony": '[[2.0, "1 ns"], [1.0, "2 ns"]]'}, QUASI),
    ("or thinner layers", {"block.layers": '[["20 nm", "10 GPa", 0.3]]'}, {"block.layers": COATED}, QUASI),
    ("take a thicker layer", {"block.layers": '[["0.5 Å", "10 GPa", 0.3]]'}, {"block.layers": COATED}, QUASI),
    ("or a smaller surface.spacing", {"block.layers": '[["1 Å", "10 GPa", 0.3]]'}, {"surface.spacing": "1.9"}, {**QUASI, "interface.kind": "wall", "block.model": "lattice"}),
    # A surface that yields
    ("take a smaller load", {"interface.hardness": "1", "drive.load": "1000"}, {"drive.load": "900"}, PULLED),
    ("or a larger hardness", {"interface.hardness": "1", "drive.load": "1000"}, {"interface.hardness": "2"}, PULLED),
    ("take a hardness above 0 at each site", {"interface.hardness": "stripes 0 1GPa 20"}, {"interface.hardness": "stripes 0.5 1GPa 20"}, PULLED),
    # Fields of the work of adhesion, and shapes
    ('write "(.*)", as in', {FIELD: "stripes 1 2"}, {FIELD: "stripes 1 2 20"}, WALL),
    ('as in "(.*)"', {FIELD: "discs 1 2 1 ps 4 nm"}, {FIELD: "discs 1 2 1 nm 4 nm"}, WALL),
    ('as in "(.*)"', {FIELD: "patches 1 -2 20 1"}, {FIELD: "patches 1 2 20 1"}, WALL),
    ("take a shorter period", {FIELD: "stripes 1 2 100 nm"}, {FIELD: "stripes 1 2 2 nm"}, WALL),
    ("or a wider box", {FIELD: "stripes 1 2 5 nm"}, {"surface.sites": "32"}, WALL),
    ("take an amplitude from 0 to 1", {FIELD: "rings 10 2 20"}, {FIELD: "rings 10 1 20"}, WALL),
    ("give the path of a map", {FIELD: "none.txt"}, {FIELD: "map.txt"}, WALL),
    ('write, for example, "(.*)"', {FIELD: "none.txt"}, {FIELD: "stripes 10 mJ/m^2 50 mJ/m^2 2 nm"}, WALL),
    ("take surface.spacing = ([\\d.]+)", {FIELD: "map.txt", FIELD + "_size": "30"}, {"surface.spacing": "{0}"}, WALL),
    ("with interface.adhesion_size = ([\\d.]+)", {FIELD: "map.txt", FIELD + "_size": "30"}, {FIELD + "_size": "{0}"}, WALL),
    ("give a map of that size", {FIELD: "map.txt", "surface.sites": "20"}, {"surface.sites": "16"}, WALL),
    ("or set surface.sites = (\\d+)", {FIELD: "map.txt", "surface.sites": "20"}, {"surface.sites": "{0}"}, WALL),
    ("take a period of (.* Å) at least", {FIELD: "stripes 1 5 2.6"}, {FIELD: "stripes 1 5 {0}"}, WALL),
    ("has a seed of 1.5(?s:.*)write", {FIELD: "patches 1 2 8 1.5"}, {FIELD: "patches 1 2 8 1"}, WALL),
    ("set the negative values", {FIELD: "minus.txt"}, {FIELD: "map.txt"}, WALL),
    ("give interface.adhesion a number", {"drive.path": '["approach", "slide x 5 Å"]', FIELD: "stripes 1 2 20"}, {FIELD: "1.5"}, {**QUASI, "interface.kind": "wall"}),
    ("take interface.kind = \"wall\" and another interface.law", {FIELD: "map.txt"}, {"interface.kind": "wall"}, STILL),
    ("take an adhesion above zero", {FIELD: "0", "interface.law": "9-3"}, {FIELD: "1"}, WALL),
    ("above zero, or law = \"exponential\"", {FIELD: "0", "interface.law": "9-3"}, {"interface.law": "exponential"}, WALL),
    ("take a small work of adhesion in place of 0", {FIELD: "stripes 0 2 20", "interface.law": "9-3"}, {FIELD: "stripes 0.1 2 20"}, WALL),
    ("of 0, or law = \"exponential\"", {FIELD: "stripes 0 2 20", "interface.law": "9-3"}, {"interface.law": "exponential"}, WALL),
    ("give a fraction below 1", {"drive.damping_from": "1"}, {"drive.damping_from": "0.5"}, WARM),
    ("give a damping, for example (.*)", {"drive.damping": "0"}, {"drive.damping": "{0}"}, WARM),
    ("or take it out of output.fields", {FIELDS: '["after-approach:5"]'}, {FIELDS: None}, STILL),
    ("take a dynamic path with a pull-off", {FIELDS: '["after-approach:5"]'}, {"drive.path": "approach, pull-off"}, STILL),
    ('take "relaxed" in its place', {FIELDS: "segments"}, {FIELDS: "relaxed"}, STILL),
    ("add it to drive.path", {FIELDS: "pull-off"}, {"drive.mode": "quasistatic", "drive.path": '["relax", "pull-off"]'}, STILL),
    # Free edges
    ('take drive.mode = "quasistatic"', {"surface.boundary": "free", "interface.kind": "wall"}, {"drive.mode": "quasistatic", "block.thickness": None}, MOVING),
    ('take interface.kind = "wall"', {"surface.boundary": "free"}, {"interface.kind": "wall", "block.thickness": None}, QUASI),
    (r"take surface.sites = (\d+) and a load of (\S+ nN) at most", {"drive.load": "20 uN"}, {"surface.sites": "{0}", "drive.load": "{1}"}, TIP),
    ("or a stiffer block", {"interface.adhesion": "3000", "block.young": "20", "surface.sites": "40"}, {"block.young": "200000"}, TIP),
    ("or a load of (.* nN) at most", {"drive.load": "200 nN", "interface.adhesion": "0"}, {"drive.load": "{0}"}, TIP),
    # Devices
    ('or drive.mode = "dynamic" with an approach', {"numerics.device": "emulated"}, {"drive.mode": "dynamic", "drive.path": "approach"}, STILL),
    # Potentials
    ('take interface.kind = "atoms"', {"interface.kind": "wall", "interface.law": "smeared"}, {"interface.kind": "atoms", "interface.law": None}, TABLE),
    ("take a cutoff beyond the well; 4 r0 is usual", {"interface.cutoff": "2.5"}, {"interface.cutoff": "4 r0"}, TABLE),
    ("a r_min above ln 2", {"interface.potential": "morse", "interface.morse_r_min": "0.2"}, {"interface.morse_r_min": "2.9"}, STILL),
    ('as in "(Au 0.1.*)" \\(', {"interface.pairs": '["Au", "B 0.1 3"]'}, {"interface.pairs": '["{0}", "B 0.1 3"]'}, ATOMS),
    ('or "(Au 100 meV.*)"', {"interface.pairs": '["Au 0.1 3 3 3", "B 0.1 3"]'}, {"interface.pairs": '["{0}", "B 0.1 3"]'}, ATOMS),
    ('write "type (morse) D a r_min"', {"interface.pairs": '["Au morse 1", "B 0.1 3"]'}, {"interface.pairs": '["Au {0} 0.1 1.5 3.1", "B 0.1 3"]'}, ATOMS),
    ('write "type (table) FILE"', {"interface.pairs": '["Au table", "B 0.1 3"]'}, {"interface.pairs": '["Au {0} good.txt", "B 0.1 3"]'}, ATOMS),
    ('write "type epsilon r0"', {"interface.pairs": '["Au -0.1 3", "B 0.1 3"]'}, {"interface.pairs": '["Au 0.1 3", "B 0.1 3"]'}, ATOMS),
    ('may be half the box(?s:.*) or "type epsilon r0 cutoff"', {"interface.pairs": '["Au 0.1 3 40", "B 0.1 3"]'}, {"interface.pairs": '["Au 0.1 3 20", "B 0.1 3"]'}, ATOMS),
    ("there are (lennard-jones)(?s:.*)", {"interface.pairs": '["Au buckingham 0.1 3", "B 0.1 3"]'}, {"interface.pairs": '["Au {0} 0.1 3", "B 0.1 3"]'}, ATOMS),
    ("take a cutoff beyond the well", {"interface.pairs": '["Au table good.txt 2.5", "B 0.1 3"]'}, {"interface.pairs": '["Au table good.txt", "B 0.1 3"]'}, ATOMS),
    ("leave one of them out", {"interface.pairs": '["Au 0.1 3", "Au 0.1 3", "B 0.1 3"]'}, {"interface.pairs": '["Au 0.1 3", "B 0.1 3"]'}, ATOMS),
    ("give one of them a larger cutoff", {"interface.pairs": '["Au 0.1 3 3.1", "B 0.1 3 3.1"]'}, {"interface.pairs": '["Au 0.1 3 12", "B 0.1 3 3.1"]'}, ATOMS),
    # Proportions
    ("block.surface_stress, interface", {"block.surface_stress": "1e25"}, {"block.surface_stress": None}, WALL),
    ("is out of all proportion(?s:.*)correct the number or its unit", {"surface.rms": "1e40"}, {"surface.rms": "0.5"}, STILL),
    ("times as strong(?s:.*)or those of interface.epsilon", {"block.young": "1e-20"}, {"block.young": "10"}, STILL),
    ("decide the state(?s:.*)decide both", {"interface.stiffness": "1e25"}, {"interface.stiffness": None}, WALL),
    ("below a tenth of its width, here (.*)", {"surface.rms": "3 mm"}, {"surface.rms": "{0}"}, STILL),
    ("correct the number or its unit", {"interface.range": "3 mm"}, {"interface.range": "3 Å"}, WALL),
    (r"or take a wider box \(surface.sites\)", {"interface.range": "50 Å"}, {"surface.sites": "32"}, WALL),
    ("; drive.max_steps makes a part of it", {"drive.velocity": "5 µm/s"}, {"drive.max_steps": "100"}, MOVING),
    ("correct block.young or block.thickness", {"block.young": "1 MPa", "block.thickness": "1000000", "interface.epsilon": "1e-7"}, {"block.young": "10 GPa", "block.thickness": "16", "drive.timestep": "10"}, TURNS),
    ("or give drive.ramp", {"block.young": "1 MPa", "block.thickness": "1000000", "interface.epsilon": "1e-7"}, {"drive.ramp": "10 ps"}, TURNS),
    ("give a shorter time", {"drive.path": '["approach", "hold 1 ms"]'}, {"drive.path": '["approach", "hold 1 ps"]'}, MOVING),
    ("take a longer range of the attraction", {"interface.range": "1e-4", "surface.rms": "30"}, {"interface.range": "1"}, PULLED),
    ("or a shorter way", {"interface.range": "2e-5", "drive.path": '["height 20 Å", "height 0 Å", "height 20 Å"]'}, {"drive.path": '["height 1 Å"]', "surface.rms": "0.1"}, PULLED),
    (r"take a load below (\S+ MPa)", {"drive.load": "100 TPa"}, {"drive.load": "{0}"}, STILL),
    # Resolving
    ("give the path of a height map", {"surface.file": "gone.h5"}, {"surface.file": "map.txt"}, MAP),
    ("give the path of a file of atoms", {"surface.file": "gone.h5"}, {"surface.file": "atoms.h5"}, ATOMS),
    ('needs surface.file(?s:.*)give the path', {"surface.kind": "file"}, {"surface.file": "map.txt"}, STILL),
    ('write a number from 1 on behind it: "(.*)"', {FIELDS: '["every:x"]'}, {FIELDS: "{0}"}, QUASI),
    ("leave one of them out", {FIELDS: '["relaxed", "relaxed"]'}, {FIELDS: "relaxed"}, STILL),
    (r"a potential that is zero at about surface.spacing \(interface.r0\)", {"interface.r0": "0.5", "interface.cutoff": "4"}, {"interface.r0": "2.6", "interface.cutoff": "4 r0"}, STILL),
    ("take a smaller pull", {"drive.load": "-50 GPa"}, {"drive.load": "-1 GPa"}, STILL),
    ('interface.edge_pinning = "(allow)"', {"interface.range": "0.05", "surface.radius": "300"}, {"interface.edge_pinning": "{0}"}, {**PULLED, "interface.adhesion": "3", "surface.rms": "0"}),
    # Tables of potentials
    ("give about (.*) rows with the same", {"interface.table": "coarse.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("or take interface.cutoff = (.*)", {"interface.table": "noisy.txt"}, {"interface.cutoff": "{0}"}, TABLE),
    ("or fit a smooth curve to them", {"interface.table": "noisy.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("write the names of the columns", {"interface.table": "unnamed.txt"}, {"interface.table": "named.txt"}, TABLE),
    ("write the table that is meant", {"interface.table": "two.txt"}, {"interface.table": "metal.txt"}, TABLE),
    ("give every row as many numbers", {"interface.table": "ragged.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("write numbers separated by blanks", {"interface.table": "words.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("write it again with pair_write", {"interface.table": "three.txt"}, {"interface.table": "metal.txt"}, TABLE),
    ("multiply the energies by", {"interface.table": "real.txt"}, {"interface.table": "converted.txt"}, TABLE),
    ("convert the distances to Å", {"interface.table": "si.txt"}, {"interface.table": "metal.txt"}, TABLE),
    ("write 2 numbers a line", {"interface.table": "single.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("write the names of the columns", {"interface.table": "misnamed.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("convert the column to eV", {"interface.table": "joule.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("correct the table", {"interface.table": "descends.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("give the path of such a file", {"interface.table": "gone.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("8 pairs of numbers at least", {"interface.table": "short.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("must be negative and between the ends", {"interface.table": "monotonous.txt"}, {"interface.table": "good.txt"}, TABLE),
    ("begin it at a smaller distance", {"interface.table": "late.txt"}, {"interface.table": "good.txt"}, TABLE),
    # Surfaces of files
    (r"give each type its potential, for example interface.pairs = (\[.*\]) with", {"interface.pairs": None}, {"interface.pairs": "{0}"}, ATOMS),
    (r"give it a potential there", {"interface.pairs": '["Au 0.1 3.28", "C 0.1 3"]'}, {"interface.pairs": '["Au 0.1 3.28", "B 0.1 3"]'}, ATOMS),
    (r"take surface.sites = (\d+) and surface.spacing = (\S+), or", {"surface.sites": "20"}, {"surface.sites": "{0}", "surface.spacing": "{1}"}, ATOMS),
    ("or repeat or cut the atoms", {"surface.file": "wide.h5", "surface.spacing": "2.5"}, {"surface.file": "atoms.h5", "surface.spacing": "2.6"}, ATOMS),
    ("repeat or cut the atoms to the block's square box", {"surface.file": "long.h5"}, {"surface.file": "atoms.h5"}, ATOMS),
    ("give each atom of the periodic box once", TWINS, {"surface.file": "atoms.h5"}, ATOMS),
    ("set surface.sites = (\\d+)", {"surface.sites": "20"}, {"surface.sites": "{0}"}, MAP),
    ('surface.resample = "(band-limited)"', {"surface.sites": "20"}, {"surface.resample": "{0}"}, MAP),
    (r"correct the unit of the file \(surface.file_unit\)", {"surface.file_unit": "µm"}, {"surface.file_unit": "Å"}, MAP),
    # Two solids
    (r"take surface.counter_poisson = (\S+) and surface.counter_young = (\S+), which", {"block.prony": '[[1.0, "1 ns"]]', "surface.counter_young": "3",
     "surface.counter_poisson": "0.1"}, {"surface.counter_poisson": "{0}", "surface.counter_young": "{1}"}, LED),
    ("leave the layers and surface stresses of both solids out", {"block.prony": '[[1.0, "1 ns"]]', "surface.counter_young": "3", "block.poisson": "0.3",
     "surface.counter_poisson": "0.3", "surface.counter_layers": COATED}, {"surface.counter_layers": None}, LED),
    ("or leave counter_young and counter_poisson out", {"block.prony": '[[1.0, "1 ns"]]', "surface.counter_young": "3", "surface.counter_poisson": "0.1"},
     {"surface.counter_young": None, "surface.counter_poisson": None}, LED),
    ("or leave prony out", {"block.prony": '[[1.0, "1 ns"]]', "surface.counter_young": "3", "surface.counter_poisson": "0.1"}, {"block.prony": None}, LED),
    ("name the map of the second solid in surface.counter", {"surface.counter": None, "surface.counter_turn": "90"}, {"surface.counter": "map.txt"}, PAIR),
    ("give surface.counter_young", {"surface.counter_poisson": "0.3"}, {"surface.counter_young": "3"}, PAIR),
    (r"take block.thickness = (\d+) or more", {"surface.counter_young": "3", "surface.counter_layers": '[["20 nm", "1 GPa", 0.3]]'}, {"block.thickness": "{0}"}, PAIR),
    ("leave surface.radius or surface.counter out", {"surface.radius": "100 nm", "drive.path": '["approach", "slide x 1 Å"]'}, {"surface.radius": None}, LED),
    ('leave "until steady" out, and give the slide a length', {"drive.path": '["approach", "slide x 1 Å until steady"]'}, {"drive.path": '["approach", "slide x 1 Å"]'}, LED),
    ("give output.stress_friction", {"drive.path": '["approach", "slide x 1 Å"]', "output.stress": "section"}, {"output.stress_friction": "0.2"}, LED),
    ("give the path of a height map", {"surface.counter": "gone.txt"}, {"surface.counter": "map.txt"}, PAIR),
    ("take a quarter turn \\(surface.counter_turn = (90)\\)", {"surface.counter_turn": "30"}, {"surface.counter_turn": "{0}"}, PAIR),
    (r"give a map ([\d.]+) Å wide", {"surface.counter_turn": "30", "surface.resample": "band-limited"}, {"surface.counter_size": "{0}", "surface.counter_crop": "middle"}, PAIR),
    ('take surface.counter_crop = "(middle)"', {"surface.counter_size": "60", "surface.resample": "band-limited"}, {"surface.counter_crop": "{0}"}, PAIR),
    (r"with surface.counter_size = ([\d.]+)", {"surface.counter_size": "60", "surface.resample": "band-limited"}, {"surface.counter_size": "{0}"}, PAIR),
    # Values
    ("give a value in that range", {"surface.rms": "-1"}, {"surface.rms": "1"}, STILL),
    (r'another unit is written as in "(.*)"', {"block.young": "1e8"}, {"block.young": "{0}"}, STILL),
    ('did you mean "(.*)"', {"surface.kind": "self-afine"}, {"surface.kind": "{0}"}, STILL),
    ('choices: "(\\w+)"(?s:.*)take one of them', {"surface.kind": "xyz"}, {"surface.kind": "{0}"}, STILL),
    ('did you mean "(.*)"', {FIELDS: "relaxd"}, {FIELDS: "{0}"}, STILL),
    ("write, for example, (0.5)", {"surface.hurst": "true"}, {"surface.hurst": "{0}"}, STILL),
    ('write, for example, "(.*)"', {"block.young": "true"}, {"block.young": "{0}"}, STILL),
    (r"write, for example, (\d+) \(", {"surface.seed": "1.5"}, {"surface.seed": "{0}"}, STILL),
    (r"write, for example, (true)", {"interface.tail": "perhaps"}, {"interface.tail": "{0}"}, STILL),
    (r"write, for example, (\[.*\])", {"block.prony": "9.0"}, {"block.prony": "{0}"}, QUASI),
    (r'"(none)" is allowed too', {"drive.max_steps": "-1"}, {"drive.max_steps": "{0}"}, MOVING),
    (r"for example, (512) \(no quotes\)", {"surface.sites": "3 kg"}, {"surface.sites": "{0}"}, {**STILL, "block.thickness": "4"}),
    (r'or "(133 nm)"', {"surface.sites": "-1 nm"}, {"surface.sites": "{0}"}, {**STILL, "block.thickness": "4"}),
    ("give a finite number", {"surface.rms": "nan"}, {"surface.rms": "1"}, STILL),
    (r"or one with a unit, for example \"(.*)\"", {"block.young": "77 parsec"}, {"block.young": "{0}"}, STILL),
    (r"give a bare number, for example (\S+)", {"surface.hurst": "0.8 nm"}, {"surface.hurst": "{0}"}, STILL),
    ("did you mean (\\S+)\\?", {"surface.rmss": "1"}, {"surface.rmss": None, "{0}": "1"}, STILL),
    ("`asperity defaults` lists every key", {"nothing.like_it": "1"}, {"nothing.like_it": None}, STILL),
]
TEXT = "[surface]\nsites = 16\n[block]\nthickness = 16\n[drive]\npath = [\"relax\"]\n"
TEXTS = [
    (r"a line is \[section\]", "surface sites\n", ""),
    ("there is no value behind the =", "[numerics]\nprecision =\n", "[numerics]\nprecision = \"double\"\n"),
    ("stand in quotes: (.*)", "[interface]\nr0 = 3 Å\n", "[interface]\n{0}\n"),
    ("one before this place is not closed", "[output]\nfields = [\"relaxed\"\n", "[output]\nfields = [\"relaxed\"]\n"),
    (r"strings stand in quotes, lists in \[brackets\]", "[surface]\nkind = self-affine, flat\n", "[output]\nfields = [\"relaxed\"]\n"),
    ("the keys of a scene are section.name", "a" + ".b" * 40 + " = 1\n", ""),
    ("a section stands in one place", "[surface]\nrms = 1\n", ""),
    (r"write \[(.*)\]", "[[output]]\n", "[{0}]\n"),
    (r"did you mean \[(.*)\]", "[outputs]\n", "[{0}]\n"),
    ("take one of them", "[qqqqqq]\n", "[output]\n"),
    ("is it a scene", "".join(f"k{k} = 1\n" for k in range(60)), ""),
    ("several values of a key are for `asperity sweep`", "[output]\nseries = [1, 2]\n", "[output]\nseries = 1\n"),
]


def check(settings):
    return ask("check", "-", "--set", *(f"{key}={value}" for key, value in settings.items()))


def filled(text, groups):
    for k, group in enumerate(groups):
        text = text.replace(f"{{{k}}}", group)
    return text


def problems_of(settings):
    """The problems of a scene; each with the key that it names first."""
    try:
        engine.check([f"{key}={value}" for key, value in settings.items()])
    except asperity.Error as error:
        return [{**one, "key": (re.match(r"[a-z]+\.\w+", one["what"]) or [one["where"]])[0]} for one in error.listed]
    return []


def kind_of(problem):
    """A problem without its numbers and values."""
    return tuple(re.sub(r'-?\d[\d.e+-]*|"[^"]*"', "#", problem[part]) for part in ("key", "what", "why", "fix"))


def values_of(key, about):
    """Values of a key to be tried: all that it can be by name, and numbers that are usual, at an end or out of all proportion."""
    if key in EXAMPLES:
        return EXAMPLES[key]
    named = [*about.get("choices", []), *([about["word"]] if "word" in about else []), *(["true", "false"] if about["kind"] == "boolean" else [])]
    if about["kind"] not in ("number", "integer"):
        return named
    usual = about["default"] if isinstance(about["default"], (int, float)) and about["default"] else 1
    whole = about["kind"] == "integer"
    return named + [f"{round(value) if whole else value:.12g}" for value in (0, usual / 2, 2 * usual, 100 * usual, usual / 100, 1e12 * usual, usual / 1e12) if not (whole and value > 1e9)]


def changed(settings, way):
    """The settings after a way out."""
    return {key: value for key, value in {**settings, **way}.items() if value is not None}


def test_every_way_out():
    """Every key at each of its values on the bases: of each problem that this finds, all ways out that are said by keys. After each the
    problem is gone, and who goes on in this manner comes to a scene that is taken, or to a fix that asks for more than keys."""
    keys = asperity.defaults()
    tried, failed, offered = set(), [], 0
    for base in TRIED:
        for key, about in keys.items():
            for value in values_of(key, about):
                settings = {**base, key: value}
                for problem in problems_of(settings):
                    if (kind := kind_of(problem)) in tried:
                        continue
                    tried.add(kind)
                    ways = ways_of(problem["key"], problem["fix"], keys)
                    for way in ways:
                        offered += 1
                        after, taken, left, turns = changed(settings, way), dict(way), [problem], 0
                        while left and turns < 6:
                            left = problems_of(after)
                            if any(kind_of(one) == kind for one in left):
                                failed.append(f"{settings}: {problem['what']}: after {way} it is still there")
                                break
                            further = [ways_of(one["key"], one["fix"], keys) for one in left]
                            if not all(further):
                                break
                            turns += 1
                            onward = [way for way in further[0] if all(taken.get(key, value) == value for key, value in way.items())] if left else []
                            if left and not onward:
                                failed.append(f"{settings}: {problem['what']}: after {way} only what takes it back: {left[0]['what']}")
                                break
                            taken |= onward[0] if left else {}
                            after = changed(after, taken)
                        if turns == 6:
                            failed.append(f"{settings}: {problem['what']}: after {way} there is no end: {left[0]['what']}")
                    if ways:
                        followed(f"{problem['where']}: {problem['what']}\n    why: {problem['why']}\n    fix: {problem['fix']}")
    print(len(tried), offered)
    assert not failed, f"{len(failed)}\n" + "\n".join(failed)
    assert len(tried) > 230 and offered > 170


@pytest.mark.parametrize("says, bad, good, base", CASES, ids=range(len(CASES)))
def test_a_fix_of_a_setting(says, bad, good, base):
    named = "# r V F\n" + FILES["unnamed.txt"]
    Path("named.txt").write_text(named)
    Path("converted.txt").write_text(lammps("metal"))
    code, said = check({key: value for key, value in {**base, **bad}.items() if value is not None})
    assert code == 2, said
    found = re.search(says, said)
    assert found, said
    settings = {**base, **bad, **{filled(key, found.groups()): value and filled(value, found.groups()) for key, value in good.items()}}
    now = problems_of({key: value for key, value in settings.items() if value is not None})
    assert not now, f"{said}\n--- after {good}:\n{now}"
    followed(said)


@pytest.mark.parametrize("says, bad, good", TEXTS, ids=range(len(TEXTS)))
def test_a_fix_of_a_text(says, bad, good):
    code, said = ask("check", "-", given=bad + TEXT if says != "a section stands in one place" else TEXT + bad)
    found = re.search(says, said)
    assert code == 2 and found, said
    code, now = ask("check", "-", given=filled(good, found.groups()) + TEXT)
    assert code == 0, f"{said}\n---\n{now}"
    followed(said)


@pytest.mark.parametrize("says, bad, good", [
    ("for example --set (.*)", "surface.rms", "{0}"), ("for example --set (.*)", "=1", "{0}"),
    ("an override is section.key=value", "output.series={a" + ".b" * 40 + "=1}", "output.series=1")])
def test_a_fix_of_an_override(says, bad, good):
    code, said = ask("check", "-", "--set", bad, given=TEXT)
    found = re.search(says, said)
    assert code == 2 and found, said
    assert ask("check", "-", "--set", filled(good, found.groups()), given=TEXT)[0] == 0
    followed(said)


def test_a_fix_of_the_file(tmp_path):
    (tmp_path / "x.toml").write_text(TEXT)
    said = ask("check", "gone.toml")[1]
    assert "`asperity init` writes a scene" in said
    assert ask("init", tmp_path / "new.toml")[0] == 0 and ask("check", tmp_path / "new.toml")[0] == 0
    followed(said)
    said = ask("check", tmp_path)[1]
    assert "name a .toml file in it" in said and ask("check", tmp_path / "x.toml")[0] == 0
    followed(said)
    said = ask("check", tmp_path / "x")[1]
    assert f"did you mean {tmp_path / 'x.toml'}" in said.replace("\n", " ")
    followed(said)
    (tmp_path / "large.toml").write_text("#" * (5 << 20))
    said = ask("check", tmp_path / "large.toml")[1]
    assert "a text of a few kB" in said
    followed(said)


@pytest.mark.parametrize("says, bad, good, base", [
    ("take a surface with heights: (self-affine), flat or file", {}, {"surface.kind": "{0}", "interface.pairs": None, "surface.file": None}, ATOMS),
    ("leave block.layers out", {"block.layers": COATED}, {"block.layers": None}, QUASI),
    ("leave surface.counter_layers out", {"surface.counter_young": "3", "surface.counter_layers": COATED}, {"surface.counter_layers": None}, PAIR),
    ("leave surface.counter out", {"drive.path": '["approach", "slide x 1 Å"]', "block.prony": '[[1.0, "1 ns"]]'}, {"surface.counter": None}, LED),
    ('take boundary = "periodic"', {}, {"surface.boundary": "periodic"}, FREE),
    ("give interface.adhesion a number", {FIELD: "stripes 1 2 20"}, {FIELD: "1.5"}, WALL),
    ("leave block.surface_stress out", {"block.surface_stress": "0.03"}, {"block.surface_stress": None}, QUASI),
    ("leave interface.hardness out", {"interface.hardness": "1"}, {"interface.hardness": None}, PULLED),
    ("give a larger q_max", {"surface.q_max": "1", "surface.rolloff": "1"}, {"surface.q_max": "4"}, STILL),
    ('or kind = "flat"', {"surface.q_max": "1", "surface.rolloff": "1"}, {"surface.kind": "flat", "surface.q_max": None, "surface.rolloff": None}, STILL),
    ("give a rough surface of at least 4 sites", {"surface.file": "plane.txt"}, {"surface.file": "map.txt"}, MAP)])
def test_a_fix_of_the_theory(place, says, bad, good, base):
    def theory(settings):
        return ask("theory", "-", "--out", "out", "--set", *(f"{k}={v}" for k, v in settings.items() if v is not None), given=TEXT)

    for name in ("atoms.h5", "plane.txt", "map.txt"):
        Path(name).symlink_to(FOLDER[0] / name)
    code, said = theory({**base, **bad})
    found = re.search(says, said)
    assert code == 2 and found, said
    code, now = theory({**base, **bad, **{key: value and filled(value, found.groups()) for key, value in good.items()}})
    assert code == 0, said + now
    followed(said)


def test_kernels_that_a_device_does_not_match():
    words = ["check", "-", "--set", "numerics.device=emulated", "drive.path=approach"]
    said = ask(*words, given=TEXT, env={"ASPERITY_KERNELS": "v2"})[1]
    if "and no ASPERITY_KERNELS" not in said:
        pytest.skip("the program has kernels for one processor")
    assert ask(*words, given=TEXT)[0] == 0
    assert ask(*words[:3], "numerics.device=none", "drive.path=approach", given=TEXT, env={"ASPERITY_KERNELS": "v2"})[0] == 0
    followed(said)


def test_a_map_is_no_scene():
    np.save("map.npy", np.random.default_rng(0).normal(size=(16, 16)))
    said = ask("check", "map.npy")[1]
    assert "or name the map in a scene" in said, said
    code, now = ask("check", "-", "--set", "surface.kind=file", "surface.file=map.npy", "surface.file_unit=Å", "surface.sites=16", given=TEXT)
    assert code == 0, now
    followed(said)


def test_fewer_ranks():
    said = ask("plan", "-", "--ranks", "64", "--set", "surface.sites=12", "surface.rolloff=2", given=TEXT)[1]
    assert "use fewer ranks" in said, said
    code, now = ask("plan", "-", "--ranks", "4", "--set", "surface.sites=12", "surface.rolloff=2", given=TEXT)
    assert code == 0, now
    followed(said)


def test_every_message_is_followed():
    left = not_followed(SOURCES, EXCUSED)
    assert not left, "\n".join(left)
