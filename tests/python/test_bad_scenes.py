# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Scenes that are wrong: exit 2, position, reason and remedy, and nothing written. (Wrong keys, types, units, ranges,
choices, paths and TOML: tests/io/scene_reader_test.cpp, tests/engine/scene_test.cpp.)"""

import os
from pathlib import Path

import pytest

from conftest import command

MAP = '[surface]\nkind = "file"\nfile = "map.txt"\nsites = 32'
BAD = {
    "cutoff over many sites": (
        "[surface]\nsites = 130\n[block]\nthickness = 4\n[interface]\ncutoff = 160",
        ["scene.toml:6:10: interface.cutoff = 160 Å reaches over too many atoms", "it may be 156 Å"]),
    "cutoff over many rows": (
        "[surface]\nsites = 32\nlattice_ratio = 10\n[interface]\ncutoff = 35",
        ["scene.toml:5:10: interface.cutoff = 35 Å reaches over too many atoms", "it may be 27.3 Å"]),
    "time step": ("[surface]\nsites = 32\n[drive]\ntimestep = 200.0",
                  ["scene.toml:4:12: drive.timestep = 200 fs is over the stability limit"]),
    "a model that is gone": (
        '[block]\nmodel = "spectral"',
        ['scene.toml:2:9: block.model = "spectral" is not a choice any more', "leave block.model out"]),
    "a key that is gone": (
        '[numerics]\naccuracy = "1%"',
        ["scene.toml:2:1: numerics.accuracy is not a key any more", "asperity cost SCENE --target 1%"]),
    "a search for states": (
        '[drive]\npath = ["relax"]\nstates = "all"',
        ["scene.toml:3:1: drive.states is not a key any more", "`asperity states SCENE` searches for further states"]),
    "absorbing seams": (
        '[block]\nseams = "absorb"',
        ["scene.toml:2:1: block.seams is not a key any more", "leave it out; drive.damping with drive.damping_from"]),
    "waves at finite strain": (
        '[block]\nstrain = "finite"\n[drive]\npath = ["relax"]',
        ['scene.toml:2:10: block.strain = "finite" on a quasi-static path', "waves do not add up"]),
    "a wall in time": ('[interface]\nkind = "wall"', ['scene.toml:2:8: interface.kind = "wall" on a dynamic path']),
    "mean height in time": (
        '[drive]\ncontrol = "mean-height"',
        ['scene.toml:2:11: drive.control = "mean-height" on a dynamic path', 'take drive.mode = "quasistatic"']),
    "several": ("[surface]\nrms = -1\nhurst = 3\n[drive]\nspeed = 1\n",
                ["scene.toml:2:7", "scene.toml:3:9", "scene.toml:5:1", "3 problems"]),
    # What stands in the map is looked at before anything is written.
    "NaN in a map": (MAP, ["map.txt:5:63", "the height in row 5, column 32 is nan"]),
    "map that is not square": (MAP, ["not square"]),
}


@pytest.mark.parametrize("name", BAD)
def test_a_wrong_scene(place, name):
    text, says = BAD[name]
    Path("scene.toml").write_text(text + "\n")
    rows = [["0"] * 32 for _ in range(31 if "square" in name else 32)]
    rows[4][31] = "nan" if "NaN" in name else "0"
    Path("map.txt").write_text("".join(" ".join(row) + "\n" for row in rows))
    for word in ("check", "run"):
        command(word, "scene.toml", expect=2, says=[*says, "fix: ", "nothing was written"])
    assert sorted(os.listdir()) == ["map.txt", "scene.toml"]


def test_no_scene_and_wrong_overrides(place):
    command("check", "gone.toml", expect=2, says=["gone.toml: the scene cannot be read", "there is no such file"])
    command("check", ".", expect=2, says="it is a directory")
    Path("scene.toml").write_text("[surface]\nsites = 64\n")
    wrong = ["scene.toml", "--set", "surface.rms=-1"]
    command("check", *wrong, expect=2, says="--set surface.rms=-1: surface.rms = -1 is out of range")
    command("run", "scene.toml", "--set", "rms=1", expect=2, says="did you mean surface.rms?")
    # One rank speaks and all end alike.
    assert command("run", *wrong, ranks=2, expect=2).count("is out of range") == 1
    # 12 sites of 2.6 Å can be cut in few tiles only.
    few = ["--set", "surface.sites=12", "surface.rolloff=2", "drive.max_steps=1"]
    command("run", "scene.toml", *few, ranks=7, expect=2, says="rank")
    assert os.listdir() == ["scene.toml"]
