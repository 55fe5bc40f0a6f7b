# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""All states of a contact as a user meets them: in result.json and in the summary, the same after stops, and told apart
by a load: under less than the barrier a relaxation stays near the first, under more it ends in the second."""

import os
import subprocess
from pathlib import Path

import pytest
from conftest import command, started, wait_for

import asperity

SCENE = """surface = { sites = 64, rms = 4, seed = 2 }
block = { thickness = 64 }
interface = { frictionless = true }
drive = { path = ["zero-load"], states = "all" }
theory = { renormalised = false }
"""
RUN = ["run", "hill.toml", "--progress", "off", "--out"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    work = tmp_path_factory.mktemp("whole")
    (work / "hill.toml").write_text(SCENE)
    command(*RUN, "whole", cwd=work, says=["2 stable states", "May be missed"])
    return asperity.load(work / "whole")


@pytest.fixture()
def place(place):
    (place / "hill.toml").write_text(SCENE)
    return place


def test_two_states(whole):
    states = whole.states
    assert len(states.all) == 2 and states.search.ended == "no area left to attract"
    assert states.first.binding_energy == whole.binding_energy < states.deepest.binding_energy / 2


def test_a_search_that_is_stopped_again_and_again(place, whole):
    """A first relaxation that was stopped ends at another place within the tolerance; the search resumes to the bit."""
    command(*RUN, "parts", "--wall-limit", "0.01s", expect=75)
    words = [os.environ["ASPERITY_PROGRAM"], *RUN, "parts", "--resume", "auto", "--wall-limit", "0.08s"]
    for _ in range(8):
        if (code := subprocess.run(words, capture_output=True).returncode) != 75:
            break
    if code == 75:
        command(*RUN, "parts", "--resume", "auto")
    parts = asperity.load("parts").states
    for one, other in zip(parts.all, whole.states.all, strict=True):
        for key in ("binding_energy", "mean_height", "contact_fraction"):
            assert one[key] == pytest.approx(other[key], abs=1e-3)
    assert parts.search.points == whole.states.search.points


def test_states_stay_known_on_the_path_that_follows(place, whole):
    """Also over a stop."""
    sets = ["--set", "drive.mode=quasistatic", 'drive.path=["zero-load", "pull-off"]']
    command(*RUN, "apart", *sets, "drive.max_steps=3")
    command(*RUN, "apart", "--resume", "auto", *sets)
    states = asperity.load("apart").states
    assert len(states.all) == 2
    assert states.deepest.binding_energy == pytest.approx(whole.states.deepest.binding_energy, abs=1e-3)


def test_a_checkpoint_while_a_relaxation_goes_on(place):
    """It survives a kill."""
    words = [*RUN, "killed", "--set", "surface.sites=256", "block.thickness=256", "drive.states=first",
             "drive.tolerance=1e-13", "output.checkpoint=0.1s"]
    with started(*words):
        wait_for(Path("killed/checkpoint.h5").exists)
    assert Path("killed/checkpoint.h5").exists()


def test_a_load_tells_states_apart(place, whole):
    """In MPa."""
    heights = {}
    for factor in (0.8, 1.2):
        load = factor * whole.states.first.barrier
        command(*RUN, f"load-{factor}", "--set", "drive.states=first", f"drive.load={load}")
        heights[factor] = asperity.load(f"load-{factor}").zero_load.mean_height
    assert heights[0.8] > sum(state["mean_height"] for state in whole.states.all) / 2 > heights[1.2]


def test_jkr_is_of_a_state_without_load(place):
    for load in (0, 20):
        command(*RUN, f"sphere-{load}", "--set", "surface.kind=flat", "surface.radius=500", "drive.states=first",
                f"drive.load={load}")
        assert (asperity.load(f"sphere-{load}").find("jkr.zero_load") is not None) == (load == 0)
    command("check", "hill.toml", "--set", 'drive.path=["approach"]', "drive.mode=quasistatic", says="drive.states")
