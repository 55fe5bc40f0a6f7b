# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The states of a contact as a user meets them: told apart by the work between them and by a load, the same after a
stop, and where lateral forces make more of them than a path leads to."""

import json
from pathlib import Path

import numpy as np
import pytest

import asperity
import asperity.studies.states
from asperity.files import store
from conftest import command, started, wait_for

SCENE = """surface = { sites = 64, rms = 4, seed = 2 }
block = { thickness = 64 }
interface = { frictionless = true }
drive = { path = ["relax"] }
"""
AREA = (64 * 2.6)**2
RUN = ["run", "hill.toml", "--progress", "off", "--out"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    work = tmp_path_factory.mktemp("whole")
    (work / "hill.toml").write_text(SCENE)
    said = command("states", "hill.toml", cwd=work, says=["to the next, MPa", "run, approach", "May be missed: "])
    found = json.loads((work / "results/hill-states/states.json").read_text())
    assert f"has a binding energy of {found['states'][1]['binding_energy']:.4g} meV/Å² (" in said
    assert not list(work.glob("results/*/*.npz"))
    command("states", "hill.toml", cwd=work, expect=2, says="already holds a result")
    return found


@pytest.fixture()
def place(place):
    (place / "hill.toml").write_text(SCENE)
    return place


def test_two_states_and_the_work_between_them(whole, place):
    first, deeper = whole["states"]
    assert whole["deepest_found"] == 1 and first["found"][:2] == ["run", "approach"] and whole["approach_less_run"] == 0.0
    assert first["binding_energy"] == asperity.run("hill.toml").binding_energy < deeper["binding_energy"] / 2
    # A path from the one to the other: no force at both ends, between them the work and the barrier.
    statics = asperity.Statics("hill.toml", {"drive.control": "mean-height"})
    statics.free()
    largest, work, z = 0.0, 0.0, first["mean_height"]
    while z > deeper["mean_height"]:
        z = max(z - 0.1, deeper["mean_height"])
        statics.mean_height = z
        point = statics.relax()
        largest, work = max(largest, point.force), point.work
    assert abs(point.force) < 1e-2 * largest and point.dissipated < 1e-3 * abs(point.work)
    assert -1000 * work / AREA == pytest.approx(deeper["binding_energy"] - first["binding_energy"], abs=1e-3)
    assert first["barrier"] == pytest.approx(largest / AREA * 160217.66, rel=0.01) and deeper["barrier"] is None


def test_a_state_before_a_point_that_is_refused():
    """Rubber is not pressed as far in as a step leads."""
    found = asperity.states(Path(__file__).parents[2] / "scenes/rubber.toml", {"surface.sites": 32})
    assert found["states"][0]["found"][:2] == ["run", "approach"]
    assert found["ended"].startswith("the next point inwards failed: a mean height of ")
    assert " lies too far inside the substrate (flat surfaces at this distance press with " in found["ended"]


def test_a_load_tells_states_apart(whole, place):
    """In MPa."""
    barrier, heights = whole["states"][0]["barrier"], {}
    for factor in (0.8, 1.2):
        heights[factor] = asperity.Statics("hill.toml", {"drive.load": factor * barrier}).free().mean_height
    assert heights[0.8] > sum(state["mean_height"] for state in whole["states"]) / 2 > heights[1.2]
    found = asperity.states("hill.toml", {"drive.load": 0.5 * barrier})["states"]  # the load is part of the way
    assert len(found) == 2 and found[0]["barrier"] == pytest.approx(0.5 * barrier, rel=0.02)


def test_a_search_that_is_stopped_again_and_again(whole, place, monkeypatch):
    monkeypatch.setattr(asperity.studies.states, "SAVE_EVERY", 0.0)

    def until(number):
        def stop(text):
            told.append(text)
            if len(told) == number:
                raise KeyboardInterrupt

        told = []
        return stop

    for number in (1, 30, 25):
        with pytest.raises(KeyboardInterrupt):
            asperity.states("hill.toml", out="parts", report=until(number))
    assert {path.name for path in Path("parts").iterdir()} == {"states-unfinished.npz", store.RECORD}
    with pytest.raises(asperity.SceneError, match="another scene"):
        asperity.states("hill.toml", {"surface.seed": 3}, out="parts")
    parts = asperity.states("hill.toml", out="parts")
    assert parts["points"] == whole["points"]
    for one, other in zip(parts["states"], whole["states"], strict=True):
        for key in ("binding_energy", "mean_height", "contact_fraction"):
            assert one[key] == pytest.approx(other[key], abs=1e-3)
    assert {path.name for path in Path("parts").iterdir()} == {"states.json", store.RECORD}
    Path("broken").mkdir()
    Path("broken/states-unfinished.npz").write_bytes(b"PK no such file")
    store._update(Path("broken"), lambda _: {"states-unfinished.npz": store.UNFINISHED})
    with pytest.raises(asperity.SceneError, match="cannot be read"):
        asperity.states("hill.toml", out="broken")


def test_lateral_forces_on_a_soft_steep_surface(place):
    """An approach, a run, a press and random starts end in states of their own, and none is called complete."""
    Path("soft.toml").write_text("surface = { sites = 16, rms = 4, seed = 2, rolloff = 1 }\n"
                                 "block = { young = 8, thickness = 16 }\ndrive = { path = [\"relax\"] }\n")
    said = command("states", "soft.toml", says=["mJ/m²) relative to that of a run", "The deepest state found by the path and 20 random starts",
                                             "A further start ends deeper with a probability of at most 0.048"])
    assert "deepest" not in said.replace("The deepest state found by the path and 20 random starts", "")
    found = json.loads(Path("results/soft-states/states.json").read_text())
    by = {name: state for state in found["states"] for name in state["found"]}
    assert by["run"]["binding_energy"] == pytest.approx(asperity.run("soft.toml").binding_energy, abs=1e-9)
    assert found["approach_less_run"] == by["approach"]["binding_energy"] - by["run"]["binding_energy"]
    assert abs(found["approach_less_run"]) > 0.1 and f"{found['approach_less_run']:+.3g} meV/Å²" in said
    pressed = found["states"][-1]
    assert pressed["found"][0] == "outwards" and abs(pressed["binding_energy"] - by["run"]["binding_energy"]) > 0.2
    # Starts of our own (flat layers at random heights, sites moved by 0.15 Å, L-BFGS) came to 44.25, 11 of 14 of them deeper
    # than all that the path leads to.
    deepest = found["states"][found["deepest_found"]]
    assert deepest["found"] == ["random start"] and deepest["binding_energy"] > 44.25
    assert deepest["binding_energy"] == max(found["start_energies"]) and len(found["start_energies"]) == found["starts"] == 20
    assert found["starts_at_deepest"] == sum(e >= 0.99 * deepest["binding_energy"] for e in found["start_energies"]) >= 5
    assert sum(s["found"] == ["random start"] for s in found["states"]) == 1
    assert by["approach"]["barrier"] > 21.6  # MPa; a path of its own found this at least
    assert found["pressed_to"] == pytest.approx(0.125 * 8000 / (1 - 0.42**2), rel=1e-3)
    # Each is a state: set free from a little beside it the sites come back.
    statics = asperity.Statics("soft.toml", {"drive.tolerance": 1e-6})
    rest = statics.free()
    there = statics.copy()
    there.u[...] += 1e-3
    statics.restore(there)
    assert statics.free().binding_energy == pytest.approx(rest.binding_energy, abs=1e-6)


def test_random_starts_lie_on_the_substrate(place):
    """No site is nearer to the substrate than flat solids at rest, on either side of it; over a wall none moves sideways."""
    for kind, sideways in (("atoms", 1.3), ("wall", 0.0)):
        statics = asperity.Statics({}, {"surface.sites": 16, "surface.rms": 4, "block.young": 8, "block.thickness": 16,
                                        "interface.kind": kind, "drive.path": "relax"})
        search, heights = asperity.studies.states.Search(statics, 1), np.asarray(statics.substrate.height)
        search.log["datum"] = datum = statics.mean_height
        levels, touching = [], 0
        for seed in range(30):
            u = search.laid(np.random.default_rng(seed)).u
            z, apart = u[2] + datum, search.case["separation"]
            below = heights if kind == "wall" else _bilinear(heights, u, statics.spacing)
            assert (z - below).min() > apart - 1e-9
            touching += np.isclose(z - below, apart).any()
            flat = z[~np.isclose(z - below, apart)]
            assert flat.size == 0 or np.ptp(flat) < 1e-9
            assert np.abs(u[:2]).max() <= sideways and (kind == "wall" or np.ptp(u[0]) > 0.0)
            levels.append(flat.mean() if flat.size else z.min())
        assert np.ptp(levels) > 0.8 * np.ptp(heights) and touching > 20


def _bilinear(heights, u, spacing):
    """The heights under the sites, one site at a time."""
    n, found = len(heights), np.empty(u.shape[1:])
    for y, x in np.ndindex(found.shape):
        fx, fy = x + 0.5 + u[0, y, x] / spacing, y + 0.5 + u[1, y, x] / spacing
        i, j = int(np.floor(fx)), int(np.floor(fy))
        fx, fy = fx - i, fy - j
        found[y, x] = sum(w * heights[(j + b) % n, (i + a) % n] for a, b, w in (
            (0, 0, (1 - fx) * (1 - fy)), (1, 0, fx * (1 - fy)), (0, 1, (1 - fx) * fy), (1, 1, fx * fy)))
    return found


def test_a_checkpoint_while_a_relaxation_goes_on(place):
    """It survives a kill."""
    words = [*RUN, "killed", "--set", "surface.sites=256", "block.thickness=256", "drive.tolerance=1e-13",
             "output.checkpoint=0.1s"]
    with started(*words):
        wait_for(Path("killed/checkpoint.h5").exists)
    assert Path("killed/checkpoint.h5").exists()


def test_jkr_is_of_a_state_without_load(place):
    for load in (0, 20):
        command(*RUN, f"sphere-{load}", "--set", "surface.kind=flat", "surface.radius=500", f"drive.load={load}")
        assert (asperity.load(f"sphere-{load}").find("jkr.relaxed") is not None) == (load == 0)


@pytest.mark.parametrize("words, says", [
    (["hill.toml", "--starts", "0"], "0 is no number from 1"), (["hill.toml", "hill.toml"], "more than one scene"),
    (["nothing.toml"], "there is no such file"), (["hill.toml", "--out", "hill.toml"], "is not a directory"),
    (["hill.toml", "--set", "block.strain=finite"], "finite")])
def test_what_is_refused(place, words, says):
    command("states", *words, expect=2, says=says)
    assert not Path("results").exists()


def test_a_block_over_another_lattice(place):
    """A copy has the sites of the block, not the atoms of the substrate; so do the parts of the sites in contact."""
    scene = {"surface": {"sites": 16, "rms": 1.5, "lattice_ratio": 1.618}, "block": {"thickness": 16}, "drive": {"path": ["relax"]}}
    with pytest.warns(asperity.SceneWarning):
        statics = asperity.Statics(scene)
    assert statics.copy().u.shape == (3, 16, 16) and not statics.copy().u.any()
    statics.mean_height = 4.3
    assert statics.relax().contact == statics.maps().contact.mean() > 0.5
    with pytest.warns(asperity.SceneWarning):
        found = asperity.states(scene, starts=5)
    assert found["starts"] == 5 and min(found["start_energies"]) > 0.9 * max(found["start_energies"]) > 50.0
