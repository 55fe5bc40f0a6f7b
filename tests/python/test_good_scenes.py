# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Scenes that are right: the ones that come with Asperity pass the check, and a few steps of a small one leave a
result."""

import os
from pathlib import Path

import pytest

import asperity
from conftest import ROOT, command

SMALL = "[surface]\nsites = 32\nrms = '0.5 Å'\n[drive]\nmax_steps = 20\n[output]\nseries = 10\n"
SCENES = sorted((ROOT / "scenes").rglob("*.toml"))


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_scenes_that_come_with_asperity(place, scene):
    command("check", scene, says="nothing wrong")
    assert not os.listdir()


def test_a_run_is_written_and_never_over_another(place):
    Path("small.toml").write_text(SMALL)
    run = ["run", "small.toml", "--progress", "off"]
    command(*run)
    result = asperity.load("results/small")
    assert result.run.stopped == "max_steps" and "skipping of far sites" in str(result.run.effects)
    assert result.scene.surface.sites == 32 and result.scene.drive.timestep == 10  # a default
    assert len(result.series["step"]) > 1
    before = Path("results/small/result.json").read_bytes()
    command(*run, says="results/small-2")
    assert Path("results/small-2/result.json").exists()
    command(*run, "--out", "results/small", expect=2, says="already holds a result")
    # Only one rank looks for the directory; all end with its code, and at once.
    assert command(*run, "--out", "results/small", ranks=2, expect=2).count("already holds a result") == 1
    assert Path("results/small/result.json").read_bytes() == before
    Path("file").touch()
    command(*run, "--out", "file/x", ranks=2, expect=4)
    command(*run, "--out", "else where/deep", "--set", "drive.max_steps=3")
    assert asperity.load("else where/deep").run.steps == 3


def test_a_surface_goes_out_and_comes_in_again(place):
    Path("small.toml").write_text(SMALL)
    Path("map.toml").write_text('[surface]\nkind = "file"\nfile = "surface/heights.h5"\nsites = 32\n')
    command("surface", "small.toml", "--out", "surface", says="rms height")
    command("check", "map.toml")
    command("surface", "map.toml", "--out", "again")
    made, read = asperity.load("surface").surface, asperity.load("again").surface
    for key in ("rms", "min", "max"):
        assert made[key] == pytest.approx(read[key], rel=1e-9)
