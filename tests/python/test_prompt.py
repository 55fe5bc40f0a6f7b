# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Asperity at the prompt of Python: what can be asked, written, shown and plotted there, and what it says."""

import inspect
import io
import re
import sys
from pathlib import Path

import numpy
import pytest
from matplotlib.figure import Figure

import asperity
from asperity import terminal
from asperity.plots import style
from asperity.running import program
from conftest import SMALL

TINY = {"name": "tiny", "surface": {"sites": 16, "rms": 0.5}, "drive": {"velocity": 100.0, "timestep": 20.0}}
STATIC = {"name": "static", "surface": {"sites": 16, "rms": 0.3}, "drive": {"mode": "quasistatic"}}
EDGE = 16 * 2.6
pytestmark = pytest.mark.usefixtures("light")
MPA = 160217.66208  # in an eV/Å³


def axes():
    return Figure().add_subplot()


def curves(ax):
    return {curve.label: curve for curve in style.drawn(ax).curves}


def test_what_there_is():
    assert {"run", "load", "sweep", "Simulation", "Statics", "states", "SceneError", "__version__"} <= set(dir(asperity))
    assert re.fullmatch(r"\d+\.\d+.*", asperity.__version__)
    for name in ("run", "sweep", "Simulation", "Statics", "Result", "Sweep"):
        assert getattr(asperity, name).__doc__


def test_objects_show_themselves_in_two_lines(path_run, tmp_path):
    sweep = asperity.Sweep("t", {}, ["surface.rms"], [
        {"set": {"surface.rms": rms}, "theory": {}, "status": "done", "result": {f"column_{i}": 1.0 for i in range(60)}}
        for rms in (1.0, 2.0)], simulated=True)
    sim, statics = asperity.Simulation(TINY), asperity.Statics(STATIC)
    for thing in (path_run, path_run.series, path_run.fields["relaxed"], sweep, sim, statics, sim.energy, statics.now,
                  path_run.plot, sim.top, statics.copy(), statics.maps(), statics.free(), sim.substrate, sweep.table):
        shown = repr(thing)
        assert len(shown.splitlines()) <= 2 and len(shown) < 400 and " object at 0x" not in shown, shown
    assert "MPa" in repr(sim) and "MPa" in repr(statics) and "tiny" in repr(sim)


def test_numbers_may_have_units():
    sim, statics = asperity.Simulation(TINY), asperity.Statics(STATIC)
    sim.top.position, sim.top.velocity = "-0.1 nm", "0.2 Å/ps"
    assert (sim.top.position, sim.top.velocity) == (pytest.approx(-1.0), pytest.approx(20.0))
    statics.mean_height = "1.2 nm"
    assert statics.relax().mean_height == pytest.approx(12.0)
    with_top = asperity.Statics(STATIC)
    with_top.top = numpy.float32(-1.5)
    assert with_top.relax().top == -1.5
    with_top.top = "-0.2 nm"
    assert with_top.relax().top == pytest.approx(-2.0)
    assert with_top.stiffness == 0.0
    assert asperity.Statics(STATIC, {"drive.stiffness": "20 mN/m"}).stiffness == pytest.approx(0.02)
    for thing, name, called in ((statics, "mean_height", "mean_height"), (with_top, "top", "top"),
                                (statics, "load", "load"), (sim.top, "position", "top.position"),
                                (sim.top, "velocity", "top.velocity")):
        for wrong, says in (("abc", '"abc" cannot be read as a quantity'), ("3 K", "3 K"), ([1, 2], "is given [1, 2]")):
            with pytest.raises(asperity.SceneError, match="fix:") as error:
                setattr(thing, name, wrong)
            assert str(error.value).startswith(called) and says in str(error.value)
    with pytest.raises(asperity.SceneError, match="restore: is given 3\n.*\n.*copy()"):
        statics.restore(3)
    with pytest.raises(asperity.SceneError, match="time is None\n.*\n.*give a number or a text"):
        statics.hold(None)


def test_a_wrong_column_of_a_simulation_is_answered_with_those_that_there_are():
    with pytest.raises(KeyError, match="series: has no 'x'\n.*it has step, time, .*force"):
        asperity.Simulation(TINY).series["x"]


def test_geometry_and_stress():
    sim, statics = asperity.Simulation(TINY), asperity.Statics(STATIC)
    for solids in (sim, statics):
        assert solids.spacing == pytest.approx(2.6) and solids.edge == pytest.approx(EDGE)
        assert solids.area == pytest.approx(EDGE**2) and solids.substrate.edge == pytest.approx(EDGE)
        height = solids.substrate.height
        assert height.shape == (16, 16) and abs(height.mean()) < 1e-9 and not height.flags.writeable
    assert statics.substrate.height.std() == pytest.approx(0.3)
    statics.load = "100 MPa"
    force = statics.relax().force
    assert statics.stress == pytest.approx(100.0, rel=1e-3) == force / EDGE**2 * MPA
    sim.step(400)
    assert sim.stress == pytest.approx(sim.force / EDGE**2 * MPA) and sim.stress != 0.0


def test_the_heights_keep_the_solids_alive():
    height = asperity.Statics(STATIC).substrate.height
    assert height.std() == pytest.approx(0.3)


def test_the_top_takes_a_velocity_in_words():
    sim = asperity.Simulation(TINY)
    sim.top.velocity = "-2 m/s"
    assert sim.top.velocity == pytest.approx(-2.0)
    start = sim.top.position
    sim.step(50)
    assert sim.top.position - start == pytest.approx(-2.0 * 50 * 20e-15 * 1e10)  # m/s, steps, fs, Å
    sim.top.velocity = 3
    assert sim.top.velocity == 3.0
    with pytest.raises(asperity.SceneError, match="'furlongs' is no unit"):
        sim.top.velocity = "2 furlongs"
    with pytest.raises(AttributeError, match="speed"):
        sim.top.speed = 1.0


def test_what_a_script_wrote_can_be_plotted(tmp_path):
    sim = asperity.Simulation(TINY)
    sim.every(20, lambda s: s.maps().gap.min(), "smallest_gap")
    while not sim.done:
        sim.step(100)
    result = asperity.load(sim.write(tmp_path / "mine"))
    for name in ("separation", "contact", "energy", "loading", "balance", "height"):
        assert getattr(result.plot, name)(axes()).has_data(), name
    assert result.plot.map("gap", axes()).images and result.plot.pressures(axes(), state="now").lines
    run = asperity.run(TINY, {"output.series": 20}, out=tmp_path / "run")
    for name in ("separation", "contact"):
        mine, theirs = curves(getattr(result.plot, name)(axes())), curves(getattr(run.plot, name)(axes()))
        assert mine.keys() == theirs.keys() and "approach" in next(iter(mine))
    for name in ("segment", "top_displacement", "mean_height", "force"):
        steps, at, of = numpy.intersect1d(run.series["step"], result.series["step"], return_indices=True)
        assert len(steps) > 40 and numpy.array_equal(run.series[name][at], result.series[name][of]), name
    assert result.report().exists()
    with pytest.raises(asperity.UnknownName, match="has no state 'relaxed'\\n.*it has now"):
        result.plot.map("gap", axes(), state="relaxed")


def test_a_path_led_by_hand_is_called_so(tmp_path):
    sim = asperity.Simulation(TINY)
    sim.every(10, lambda s: s.force, "again")
    sim.step(100)
    sim.top.velocity = "-50 m/s"
    sim.step(200)
    result = asperity.load(sim.write(tmp_path / "led"))
    found = curves(result.plot.loading(axes()))
    assert set(found) == {"approach", "led by the script"}
    assert len(found["approach"].x) == 10 and len(found["led by the script"].x) == 20


def test_calls_of_the_pages(path_run, results):
    """Plots and attributes that docs/howto/results.md names."""
    page = (Path(__file__).resolve().parents[2] / "docs/howto/results.md").read_text(encoding="utf-8")
    said = re.search(r"^`plot` has(.*?)\n\n|^`plot` has(.*?)\n`asperity", page, re.M | re.S)[0]
    named = set(re.findall(r"`(\w+)`", said)) - {"plot"}
    assert named == set(dir(path_run.plot)), named ^ set(dir(path_run.plot))
    for segment, name in zip(path_run.segments, path_run.segment_names):
        assert segment.name == name and isinstance(segment.work_of_drive, float)
    slid = asperity.run(SMALL, {"drive": {"path": ["height 3.0", "slide x 2", "pull-off"], "control": "mean-height",
                                          "mode": "quasistatic"}, "surface.sites": 16}, out=results / "slid")
    assert list(curves(slid.plot.friction(axes()))) == ["slide x 2"]
    assert any("friction" in segment for segment in slid.segments)
    page = slid.report().read_text(encoding="utf-8").replace("\u2060", "").replace("\u00a0", " ")
    assert "Segments of the path" in page and "work of the drive, meV/Å² (mJ/m²)" in page
    assert f"<td>{asperity.terminal.number(slid.segments[-1].work_of_drive, 2)} (" in page


def test_errors_name_the_script():
    for call in (lambda: asperity.run({"surface": {"sitse": 16}}), lambda: asperity.Simulation({"surface": {"sitse": 16}}),
                 lambda: asperity.Statics({"surface": {"sitse": 16}}),
                 lambda: asperity.sweep({"surface": {"sitse": 16}}, {"surface.rms": [0.1]}),
                 lambda: asperity.estimate({"surface": {"sitse": 16}})):
        with pytest.raises(asperity.SceneError) as error:
            call()
        assert "test_prompt.py:" in str(error.value) and "/tmp" not in str(error.value), error.value
        assert "sites" in str(error.value)
    for call in (asperity.run, asperity.Simulation, asperity.Statics):
        with pytest.raises(asperity.SceneError) as error:
            call(STATIC, {"surface": {"sitse": 16}})
        assert str(error.value).startswith("test_prompt.py:") and "--set" not in str(error.value), error.value


def test_overrides_may_be_nested(tmp_path):
    nested = {"surface": {"rms": 0.2, "seed": 7}, "drive": {"path": ["relax"]}}
    flat = {"surface.rms": 0.2, "surface.seed": 7, "drive.path": ["relax"]}
    one, two = (asperity.run(TINY, given, out=tmp_path / name) for name, given in (("a", nested), ("b", flat)))
    assert one.scene.surface.seed == 7 and one.binding_energy == two.binding_energy
    assert asperity.Simulation(TINY, {"surface": {"sites": 24}}).edge == pytest.approx(24 * 2.6)
    assert asperity.Statics(STATIC, {"surface": {"sites": 24}}).edge == pytest.approx(24 * 2.6)


class Screen(io.StringIO):
    def isatty(self):
        return True


class Notebook(io.StringIO):
    """As a kernel's stream."""


Notebook.__module__ = "ipykernel.iostream"


@pytest.mark.parametrize("stream, shown", [(Screen, True), (Notebook, True), (io.StringIO, False)])
def test_progress_is_shown_where_somebody_looks(tmp_path, monkeypatch, stream, shown):
    monkeypatch.setattr(sys, "stderr", there := stream())
    assert terminal.progress_shown(None) == shown
    assert terminal.progress_shown(True) and not terminal.progress_shown(False)
    scene = {**TINY, "drive": {"path": ["relax"]}}
    asperity.sweep(scene, {"surface.rms": [0.1, 0.2]}, out=tmp_path / "sweep")
    assert ("done in" in there.getvalue()) == shown, there.getvalue()
    asperity.sweep(scene, {"surface.rms": [0.1, 0.2]}, out=tmp_path / "quiet", progress=False)
    assert there.getvalue().count("done in") == 2 * shown


def stand_in(place, monkeypatch, *lines):
    """Puts a script of the shell in the program's place. `lines`: its last ones; $program is the program's path."""
    monkeypatch.setenv("program", program.path())
    (place / "program").write_text("\n".join(["#!/bin/sh", *lines]) + "\n")
    (place / "program").chmod(0o755)
    monkeypatch.setattr(program, "path", lambda: str(place / "program"))


def test_run_says_how_far_it_is(tmp_path, capfd, monkeypatch):
    stand_in(tmp_path, monkeypatch, 'exec "$program" "$@" --wall-limit 4s')  # the first line comes after two seconds
    with pytest.raises(asperity.Stopped):
        asperity.run({**TINY, "surface": {"sites": 256, "rms": 0.5}, "drive": {"velocity": 0.01}}, out=tmp_path / "told", progress=True)
    assert re.search(r"%.*MPa, contact", capfd.readouterr().err)


@pytest.mark.parametrize("asked", [True, None])
def test_what_a_run_says_is_shown_where_it_is_asked_for(tmp_path, capfd, monkeypatch, asked):
    """Without being asked, there is neither a terminal nor a notebook here."""
    stand_in(tmp_path, monkeypatch, """echo '{"fraction": 0.5, "text": "half of it"}' >&2""", 'exec "$program" "$@"')
    asperity.run({**TINY, "drive": {"path": ["relax"]}}, out=tmp_path / "run", progress=asked)
    said = capfd.readouterr().err
    assert said.startswith("half of it\n") if asked else said == ""


def test_a_wrong_name_is_told_what_there_is(path_run, results):
    for error, call, says in (
            (KeyError, lambda: path_run["gama"], "binding_energy"), (KeyError, lambda: path_run.series["time_"], "force"),
            (KeyError, lambda: path_run.plot.map("gapp"), "has no map 'gapp'\n.*it has .*\n.*did you mean gap?"),
            (asperity.InputOutputError, lambda: asperity.load_sweep(path_run.directory), "asperity.load"),
            (asperity.InputOutputError, lambda: asperity.load_sweep("none"), "no such directory"),
            (asperity.SceneError, lambda: asperity.run({"block": {"poisson": 0.6}}), "block.poisson = 0.6 is")):
        with pytest.raises(error, match=says):
            call()
    sweep = asperity.sweep(STATIC, {"surface.rms": [0.1, 0.2], "drive.path": "relax"}, out=results / "wrong-names")
    with pytest.raises(KeyError, match="binding_energy"):
        sweep.table["gama"]
    # One kind of error, whatever it is a name of.
    found = asperity.estimate(STATIC, {"surface.rms": 0.1, "drive.path": "relax"}, parts="tail", out=results / "wrong-estimate")
    for call in (lambda: path_run.binding_enregy, lambda: path_run["gama"], lambda: path_run.work_of_drive.aproach,
                 lambda: path_run.series["time_"], lambda: path_run.fields["relaxt"], lambda: path_run.fields["relaxed"].gapp,
                 lambda: path_run.plot.sepration, lambda: path_run.plot.map("gapp"), lambda: path_run.plot.map("gap", state="relaxt"),
                 lambda: path_run.needed("scene.surface.rsm"), lambda: sweep.table["binding_enregy"], lambda: sweep.plot("gama"),
                 lambda: found.number("gamma")):
        with pytest.raises(asperity.UnknownName) as error:
            call()
        assert isinstance(error.value, asperity.SceneError) and "why: it has " in str(error.value) and "fix: " in str(error.value)
    assert not hasattr(path_run, "gama") and path_run.get("gama", 3) == 3 and "did you mean binding_energy?" in str(
        pytest.raises(AttributeError, getattr, path_run, "binding_enregy").value)
    with pytest.raises(asperity.InputOutputError, match="holds a sweep"):
        asperity.load(results / "wrong-names")


def checked_things(path_run):
    """Functions, constructors and methods of the package for users, those of compiled classes left out."""
    sweep = asperity.Sweep("t", {}, ["surface.rms"], [], simulated=True)
    for name in [*asperity.__all__, "Simulation", "Statics", "states"]:
        thing = getattr(asperity, name)
        if not (isinstance(thing, type) and issubclass(thing, BaseException)):
            yield name, thing
    for name in asperity.crack.__all__:
        yield name, getattr(asperity.crack, name)
    statics = asperity.Statics(STATIC)
    for thing in (path_run, path_run.series, path_run.plot, sweep, sweep.table, statics, asperity.Simulation(TINY)):
        for kind in [kind for kind in type(thing).__mro__ if kind.__module__.startswith("asperity.") and "values" not in kind.__module__
                     and kind.__name__ not in ("Named", "Attributes")]:
            for name, member in vars(kind).items():
                if not name.startswith("_") and inspect.isfunction(member):
                    yield f"{kind.__name__}.{name}", getattr(thing, name)
    for name in ("separation", "gaps"):
        yield name, getattr(path_run.plot, name)


def test_calls_with_wrong_arguments_end_in_the_errors_of_the_package(path_run):
    names = set()
    for name, thing in checked_things(path_run):
        with pytest.raises(asperity.WrongCall, match=r"has no argument 'nonsense'\n    why: (its arguments are|it takes none)"):
            thing(nonsense=1)
        with pytest.raises(asperity.WrongCall, match="is given 30 values without a name"):
            thing(*range(30))
        names.add(name)
    assert {"run", "tip", "Result", "Simulation", "Statics.hold", "Simulation.step", "Sweep.frame", "Sweep.plot", "Result.report",
            "modulus", "gaps", "Series.frame", "RunPlots.map"} <= names
    for call, said in ((lambda: asperity.run("s.toml", rnaks=2), "run(): has no argument 'rnaks'\n    why: its arguments are scene, overrides, "
                        "out, ranks, progress\n    fix: did you mean ranks?; keys of the scene go into overrides: {\"surface.rms\": 2.0}"),
                       (lambda: asperity.tip(raduis="20 nm"), "did you mean radius?"), (lambda: asperity.adhesion("m.npy", yuong=1), "young?"),
                       (lambda: asperity.load(), "load(): is not given directory\n    why: its arguments are directory"),
                       (lambda: asperity.run("s.toml", scene="t.toml"), "run(): is given scene twice"),
                       (lambda: path_run.plot.map("gap", axx=None), "did you mean ax?")):
        with pytest.raises(TypeError) as error:
            call()
        assert isinstance(error.value, asperity.SceneError) and said in str(error.value)


def test_warnings_name_the_line_of_the_script():
    with pytest.warns(asperity.SceneWarning, match="drive.velocity") as told:
        asperity.Simulation(TINY)
    assert [Path(one.filename).name for one in told] == [Path(__file__).name]
