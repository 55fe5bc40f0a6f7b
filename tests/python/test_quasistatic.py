# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Runs without time as a user meets them: stopped and taken up again they end the same, and their files say what
there is."""

import importlib
from pathlib import Path

import pytest

import asperity
from conftest import ROOT, command, found

PATH = """[surface]
sites = 24
rms = 0.8
[block]
thickness = 90
[drive]
mode = "quasistatic"
"""
FIELDS = '[output]\nfields = ["relaxed", "pull-off", "every:40"]\n'
HELD = "drive.control=mean-height"
CYCLES = 'drive.path=["approach", "pull-off", "approach", "pull-off"]'


@pytest.fixture()
def place(place):
    (place / "path.toml").write_text(PATH + FIELDS)
    return place


def run(out, *sets, scene="path.toml", expect=0, says=(), more=()):
    return command("run", scene, "--progress", "off", "--out", out, *more, *(["--set", *sets] if sets else []),
                   expect=expect, says=says)


def resume(out, *sets, **keys):
    return run(out, *sets, more=["--resume", "auto"], **keys)


def stop_at_once(out, *sets):
    """By a wall limit that has passed when the run first looks: before its first point, on any machine."""
    run(out, *sets, more=["--wall-limit", "0.001s"], expect=75)
    stopped = asperity.load(out).run
    assert stopped.stopped == "wall_limit" and stopped.steps == 0


def stop(out, points, *sets):
    run(out, f"drive.max_steps={points}", *sets)
    stopped = asperity.load(out).run
    assert stopped.stopped == "max_steps" and stopped.steps == points


def test_a_path_and_the_same_at_a_held_mean_height(place):
    run("whole", says="interface energy + energy dissipated")
    whole = asperity.load("whole")
    # The balance: approach + lost = state = pull-off - lost, to the tolerance on the way.
    work, lost = whole.work_of_drive, whole.lost
    assert lost.approach > 1 and lost.pull_off > 1
    assert -work.approach + lost.approach == pytest.approx(whole.binding_energy, abs=0.1)
    assert work.pull_off - lost.pull_off == pytest.approx(whole.binding_energy, abs=0.1)
    assert {"relaxed", "pull-off", "step-40"} <= set(whole.fields)
    assert "dissipated" in whole.series and "time" not in whole.series
    stop_at_once("parts")
    resume("parts", "drive.max_steps=37")
    resume("parts")
    assert found("parts") == found("whole")
    # Held, nothing falls as a whole, and the two works are the state's energy.
    run("held", HELD)
    held = asperity.load("held")
    assert held.binding_energy == pytest.approx(whole.binding_energy, abs=0.1)
    for work in held.work_of_interface.approach, -held.work_of_interface.pull_off:
        assert work == pytest.approx(whole.binding_energy, abs=0.5)
    stop("held-parts", 20, HELD)
    before = Path("held-parts/result.json").read_bytes()
    resume("held-parts", expect=2, says="differs from it in drive.control")
    assert before == Path("held-parts/result.json").read_bytes()
    resume("held-parts", HELD)
    assert found("held-parts") == found("held")


def test_two_cycles(place):
    """Maps of both states at zero load; each branch's loss is of the last one, the energy of all."""
    run("cycles", CYCLES)
    assert {"relaxed", "relaxed-2"} <= set(asperity.load("cycles").fields)
    run("parts", CYCLES, "drive.max_steps=150")
    resume("parts", CYCLES)
    assert found("parts") == found("cycles")


def test_walls(place):
    wall = ["interface.kind=wall", "interface.adhesion=60", 'output.fields=["relaxed"]']
    run("wall", *wall, says="interface energy + energy dissipated")
    stop("parts", 30, *wall)
    resume("parts", *wall)
    assert found("parts") == found("wall")
    # No relaxation is given up by a force that is not summed on the way (763 points were then needed).
    Path("soft.toml").write_text(PATH.replace("24", "64").replace("0.8", "2").replace("90", "64"))
    run("soft", HELD, "drive.tolerance=1e-4", "interface.kind=wall", "interface.adhesion=50 meV/Å^2",
        "interface.range=1 Å", scene="soft.toml")
    assert asperity.load("soft").run.steps < 500


def test_many_loads_of_a_wall_that_repels(place):
    # The energy is convex: nothing is lost, and no load costs much more than the largest alone.
    wall = ["output.fields=[]", "interface.kind=wall", "interface.adhesion=0", "surface.sites=32", "block.thickness=32", "block.young=10 GPa"]
    loads = [0.1, 1.0, 10.0, 100.0, 500.0]
    up = "drive.path=" + str([f"load {p} MPa" for p in loads]).replace("'", '"')
    run("one", *wall, 'drive.path=["load 500 MPa"]')
    run("many", *wall, up)
    one, many = asperity.load("one"), asperity.load("many")
    assert [s["pressure"] for s in many["segments"]] == pytest.approx(loads, rel=1e-3)  # the accuracy of a load
    assert many.run.iterations < 2.5 * one.run.iterations
    assert many.run.steps < 2.0 * one.run.steps
    assert all(s["lost"] == 0.0 and s["work_of_drive"] == pytest.approx(s["stored"]) for s in many["segments"])
    total = sum(s["work_of_drive"] for s in many["segments"])
    assert total == pytest.approx(one["segments"][0]["work_of_drive"], rel=1e-4)
    stop("parts", 5, *wall, up)
    resume("parts", *wall, up)
    assert found("parts") == found("many")


def test_works_over_soft_walls_are_within_two_standard_errors(place, monkeypatch):
    # Where many patches come off, another tolerance leads to another sequence of instabilities.
    monkeypatch.syspath_prepend(ROOT / "scenes" / "validation")
    scene = importlib.import_module("works").soft_wall(10)
    default, close = (asperity.run({}, scene | {"drive.tolerance": t}, out=f"{t}", progress=False) for t in (2.5e-4, 2e-5))
    for way in ("approach", "pull_off"):
        error = abs(getattr(default.work_of_drive, way) - getattr(close.work_of_drive, way))
        uncertain = [getattr(r.work_of_drive.uncertainty, way) for r in (default, close)]
        assert error <= 2.0 * sum(uncertain)
        assert uncertain[1] < 0.7 * uncertain[0], "a smaller tolerance brackets instabilities more closely"


def test_one_relaxation_stopped_inside(place):
    zero = ["drive.path=relax", 'output.fields=["relaxed"]', "surface.sites=64", "drive.tolerance=1e-6"]
    run("zero", *zero)
    stop_at_once("parts", *zero)
    resume("parts", *zero)
    assert asperity.load("parts").binding_energy == pytest.approx(asperity.load("zero").binding_energy, abs=1e-6)


@pytest.mark.parametrize("sets, expect, says", [
    (['output.fields=["every:10", "every:7"]'], 2, "twice"),
    ([HELD, 'drive.path=["relax"]', "output.fields=[]"], 0, "drive.control has no effect"),
    (["output.fields=[]", 'drive.path=["relax","pull-off"]', "drive.load=100"], 0, "carries drive.load")])
def test_what_a_check_says(place, sets, expect, says):
    command("check", "path.toml", "--set", *sets, expect=expect, says=says)


def test_a_path_that_never_adheres_says_so(place):
    stiff = ["surface.sites=32", "surface.rms=3", "block.thickness=32", "block.young=1000", "interface.kind=wall", "interface.adhesion=1",
             "drive.mode=quasistatic"]
    Path("rough.toml").write_text("")
    said = command("run", "rough.toml", "--progress", "off", "--set", *stiff)
    assert "the solids do not stick (below 1 % of flat on flat)" in said
    assert "do not stick" not in command("run", "rough.toml", "--progress", "off", "--out", "sticky", "--set", *stiff[:3], "drive.path=relax")


def test_a_spring_of_the_machine_leaves_states_as_they_are_and_resumes_to_the_same_bits(place):
    sets = ["surface.sites=16", "block.thickness=16", "interface.kind=wall", 'drive.path=["relax", "pull-off"]', "drive.load=20"]
    run("rigid", *sets)
    run("sprung", *sets, "drive.stiffness=0.5")
    rigid, sprung = asperity.load("rigid"), asperity.load("sprung")
    for name in ("binding_energy", "relaxed.elastic_energy", "contact_fraction"):
        assert sprung.number(name) == rigid.number(name), name  # the load's state, without the spring's energy
    assert sprung.number("energy.damped") > 2 * rigid.number("energy.damped")  # a soft spring jumps out of contact
    drive, top, force = (sprung.series[name] for name in ("drive_displacement", "top_displacement", "top_force"))
    assert (top - drive) * 0.5 / 16.021766208 == pytest.approx(force, abs=1e-6 * abs(force).max())
    run("stopped", *sets, "drive.stiffness=0.5", "drive.max_steps=20")
    resume("stopped", *sets, "drive.stiffness=0.5")
    again = asperity.load("stopped")
    assert (again.series["top_force"] == force).all() and again.number("energy.work") == sprung.number("energy.work")
