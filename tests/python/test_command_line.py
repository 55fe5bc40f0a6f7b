# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Commands, options and their mistakes."""

import json
import os
import re
from pathlib import Path

import h5py
import pytest

import asperity
from conftest import command


@pytest.fixture()
def place(place):
    (place / "plain.toml").write_text("[surface]\nsites = 256\n")
    return place


def keys(text):
    return re.findall("^[a-z_0-9]+ = ", text, re.M)


def test_information():
    command("--version", says="asperity 0.")
    command("info", says="version git compiler flags MPI HDF5 FFTW threads ranks processor".split())


def test_defaults_and_a_scene_to_start_from(place):
    """Nothing is wrong with it, and all keys are in it, those behind # with their defaults."""
    for words in (["defaults"], ["defaults", "--plain"]):
        text = command(*words)
        command("check", "-", given=text)
    command("init")
    command("check", "scene.toml", says="nothing wrong")
    before = Path("scene.toml").read_text()
    command("init", expect=2, says="scene.toml: is there already")
    assert Path("scene.toml").read_text() == before
    command("init", "mine.toml")
    Path("all.toml").write_text(re.sub("^# ([a-z_0-9]+ = )", r"\1", Path("mine.toml").read_text(), flags=re.M))
    assert len(keys(Path("all.toml").read_text())) == len(keys(text)) > 50
    mine, whole = (json.loads(command("check", name, "--json"))["scene"] for name in ("mine.toml", "all.toml"))
    assert mine == whole
    command("init", "nowhere/scene.toml", expect=4)


def test_the_standard_input():
    scene = "[surface]\nsites = 64\n"
    command("check", "-", given=scene, says="stdin: nothing wrong")
    command("check", "-", given="[surface]\nsites = -1\n", expect=2, says="stdin:2:")
    command("check", "-", given=scene, ranks=1, says="stdin: nothing wrong")
    command("check", "-", given=scene, ranks=2, expect=2, says="only rank 0 would have it")


def test_processes_that_mpi_does_not_connect(place):
    """A launcher says that it has started two, where MPI finds one: the first of them says so, and no run begins."""
    for step in "01":
        said = command("run", "plain.toml", "--out", "unconnected", expect=2,
                       env={"SLURM_STEP_NUM_TASKS": "2", "SLURM_PROCID": step})
        assert said == "" if step == "1" else "2 processes were started, and MPI connects none of them" in said
    assert os.listdir() == ["plain.toml"]


@pytest.mark.parametrize("words, says", [
    ([], ""), (["chek"], "did you mean `asperity check`?"), (["run"], "no scene is given"),
    (["run", "plain.toml", "--no-such-option"], "--no-such-option"),
    (["run", "plain.toml", "plain.toml"], "more than one scene"),
    (["run", "plain.toml", "--wall-limit", "soon"], "--wall-limit soon: is no length of time"),
    (["run", "plain.toml", "--progress", "loud"], "the choices are auto, bar, lines, json and off\n    fix: give one"),
    *((["run", "plain.toml", option, ""], f"{option}: is empty")
      for option in ("--resume", "--wall-limit", "--progress")),
    (["run", "plain.toml", "--resume", "gone.h5"], "there is no such file"),
    (["check", "plain.toml", "--set"], "--set"), (["plan", "plain.toml", "--ranks", "0"], "--ranks"),
    (["plan", "plain.toml", "--memory-per-node", "16"], "--memory-per-node 16: is no size of memory"),
    (["plan", "plain.toml", "--set", "drive.timestep=1000"], "stability limit")])
def test_mistakes(place, words, says):
    command(*words, expect=2, says=says)
    assert os.listdir() == ["plain.toml"]


def test_overrides(place):
    sets = ["--set", "surface.sites=64", "block.thickness=32"]
    command("check", *sets, "plain.toml", says=["64 x 64 sites", "32 layers"])
    command("check", "plain.toml", *sets, "--set", "block.thickness=48", says="48 layers")  # the last one counts


def test_a_plan_runs_nothing_and_writes_nothing(place):
    command("plan", "--set", "surface.sites=32", "block.thickness=32", "surface.rms=1", "drive.temperature=10",
            "plain.toml", "--ranks", "4", "--memory-per-node", "1GB",
            says=["4 ranks", "drive.temperature = 10 K", "wall time", "hold 4 of these ranks"])
    assert os.listdir() == ["plain.toml"]


def test_a_run_that_does_not_fit_writes_nothing(place):
    command("run", "plain.toml", "--set", "block.model=lattice", "block.thickness=1000000", "--out", "none", expect=2,
            says=["the run does not fit into memory", 'block.model = "multiscale"'])
    assert not Path("none").exists()


def test_a_run_in_parts_has_the_rows_of_one(place):
    """Stopped by drive.max_steps between two rows of the series, and resumed."""
    scene = '[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 16\n[drive]\nvelocity = 100\n'
    Path("scene.toml").write_text(scene)
    command("run", "scene.toml", "--set", "drive.max_steps=600", "--out", "whole")
    command("run", "scene.toml", "--set", "drive.max_steps=250", "--out", "parts")
    command("run", "scene.toml", "--set", "drive.max_steps=600", "--out", "parts", "--resume", "auto")
    whole, parts = (h5py.File(f"{name}/run.h5")["series"] for name in ("whole", "parts"))
    assert whole.keys() == parts.keys()
    for name in whole:
        assert (whole[name][()] == parts[name][()]).all(), name
    assert 249 not in parts["step"][()]


def test_a_load_on_a_warm_block_ends_by_its_average(place):
    scene = ('[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 16\n[drive]\npath = ["approach", "load 500 MPa", "pull-off"]\n'
             'velocity = 20\ntemperature = 200\ndamping = 1\nseed = {}\n')
    ends = []
    for seed in (1, 2, 3):
        Path("warm.toml").write_text(scene.format(seed))
        command("run", "warm.toml", "--out", f"warm{seed}", says="ends by its average over 0.872 ps")
        result = asperity.load(f"warm{seed}")
        segment = next(s for s in result.segments if "load" in s["name"])
        assert segment["pressure_averaged_over"] == pytest.approx(0.872, abs=0.01)
        assert 30 < segment["pressure_scatter"] < 500  # what a single step is wrong by
        ends.append(segment["pressure"])
    assert ends == pytest.approx([500.0] * 3, abs=5.0)
