# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""asperity.Simulation and Statics: the numbers of a run, views, the drive by hand, fields, files, and bad use."""

import ast
import gc
import os
import signal
import subprocess
import sys
import threading
import warnings
import weakref
from pathlib import Path

import numpy
import pytest

import asperity
from conftest import ROOT, SMALL

TINY = {"name": "tiny", "surface": {"sites": 16, "rms": 0.5},
        "drive": {"velocity": 100.0, "timestep": 20.0}}


def tiny(**overrides):
    return asperity.Simulation(TINY, {key.replace("__", "."): value for key, value in overrides.items()})


def in_contact(**overrides):
    """Attracted, on the way in."""
    sim = tiny(**overrides)
    while sim.force > -1.0:
        sim.step(20)
    return sim


def state(sim):
    return numpy.stack([*sim.u, *sim.v])


@pytest.mark.parametrize("device", ["none", "emulated"])
def test_numbers_are_those_of_a_run(path_run, device):
    """By name, unit and value."""
    sim = asperity.Simulation(SMALL, {"numerics.device": device})
    sim.every(100, lambda s: s.energy.balance_error, "error")
    assert sim.step(10**9) == sim.steps == path_run.run.steps
    assert sim.done and sim.segment == "done" and sim.step(5) == 0
    series = sim.series
    of_run = numpy.isin(path_run.series["step"], series["step"])  # the run also records the step after each way
    assert of_run.sum() == len(series["step"]) > 8
    assert (path_run.series["balance_error"][of_run] == series.pop("error")).all()
    for name, values in series.items():
        assert (path_run.series[name][of_run] == values).all(), name
        assert path_run.series.unit(name) == sim._units[name], name
    for way in ("approach", "pull_off"):
        assert getattr(sim.work_of_interface, way) == getattr(path_run.work_of_interface, way)
        assert getattr(sim.work_of_drive, way) == getattr(path_run.work_of_drive, way)
    assert sim.lost_in_cycle == path_run.lost.cycle


def test_relax_is_the_state_of_a_run_and_changes_nothing(path_run):
    sim = asperity.Simulation(SMALL)
    while sim.work_of_interface.approach is None:
        sim.step()
    before = state(sim)
    found = sim.relax()
    assert found.binding_energy == path_run.binding_energy
    assert found.contact_fraction == path_run.contact_fraction
    maps = path_run.fields["relaxed"]
    assert (found.maps.gap == maps.gap).all() and (found.maps.pressure == maps.pressure).all()
    assert found.maps.contact.mean() == found.contact_fraction
    assert (state(sim) == before).all()
    sim.step(10**9)
    assert sim.work_of_interface.pull_off == path_run.work_of_interface.pull_off


def test_maps_of_a_slide_are_of_one_step():
    """The force of the next step, which starts from the sites and the place that the maps show."""
    sim = tiny(drive__path=["approach", "slide x 5 Å"])
    while sim.segment != "slide x 5 Å":
        sim.step(50)
    for _ in range(3):
        sim.step(37)
        pressed = sim.maps().pressure.sum() * 2.6**2 / 160.2176634
        sim.step(1)
        assert pressed == pytest.approx(sim.force, abs=1e-6)


@pytest.mark.parametrize("device", ["none", "emulated"])
def test_views_are_views(device):
    sim = in_contact(numerics__device=device)
    u = sim.u
    assert u.z.shape == (16, 16) and not u.z.flags.owndata
    before = u.z.copy()
    sim.step(7)
    assert (u.z != before).all() and (sim.u.z == u.z).all()
    # A push on one site is felt: by it in the next step, by its neighbours in the one after.
    other = in_contact(numerics__device=device)
    other.step(7)
    other.u.z[0, 3] += 0.01
    assert other.u.z[0, 3] == u.z[0, 3] + 0.01
    sim.step(), other.step()
    moved = sim.v.z != other.v.z
    assert moved[0, 3] and moved[15, 3]  # also across the periodic edge
    sim.v.x[5, 5] = 1e-3
    sim.step()
    assert sim.v.x[5, 5] == pytest.approx(1e-3, abs=5e-4)
    assert abs(sim.energy.balance_error) < 0.02


def test_forces_and_heights():
    sim = in_contact()
    assert sim.f.z.sum() == pytest.approx(sim.force, rel=1e-9)
    heights = sim.substrate.height
    assert heights.shape == (16, 16) and heights.std() == pytest.approx(0.5, rel=1e-9)
    for view in (heights, sim.f.z):
        with pytest.raises(ValueError, match="read-only"):
            view[0, 0] = 1.0
    assert sim.substrate.edge == pytest.approx(16 * sim.spacing)
    maps = sim.maps()
    assert maps.pressure.sum() * 1e9 * sim.spacing**2 * 1e-20 == pytest.approx(
        (sim.force) * 1.602176634e-9, rel=0.2)  # a step later


def test_arrays_keep_the_simulation_alive():
    sim = in_contact()
    u, gone = sim.u.z, weakref.ref(sim)
    sim.every(10, lambda s, held=sim.top: None)
    values = u.copy()
    del sim
    gc.collect()
    assert gone() is None and (u == values).all()


def test_top_by_hand():
    sim = in_contact()
    scene_velocity = sim.top.velocity
    assert scene_velocity == pytest.approx(-100.0)
    sim.top.velocity = 0.0
    place = sim.top.position
    assert sim.step(50) == 50 and sim.top.position == place
    sim.top.velocity = 20.0  # m/s: 0.2 Å/ps
    sim.step(50)
    assert sim.top.position - place == pytest.approx(0.2 * 50 * 0.02, rel=1e-9)
    sim.top.position = place
    assert sim.top.position == place
    sim.step(20)
    assert abs(sim.energy.balance_error) < 0.02
    sim.top.velocity = None
    assert sim.top.velocity == pytest.approx(scene_velocity)
    sim.step(10**6)
    assert sim.done


def test_external_field_does_work():
    # A uniform pull, sideways and up, on a block out of reach whose top stands still.
    sim = tiny()
    sim.top.velocity = 0.0
    sim.step(1)
    field = numpy.zeros((16, 16, 3))
    field[..., 0], field[..., 2] = 0.02, 0.01
    sim.external = field
    start, force = sim.u.x.mean(), sim.force
    for _ in range(40):
        sim.step(10)
        assert abs(sim.energy.balance_error) < 1e-3
    assert sim.u.x.mean() > start and sim.external_work > 0.01
    assert sim.force == pytest.approx(force, abs=abs(sim.force) + 1.0)  # the substrate's alone
    sim.external.x[...] = 0.0  # in place
    sim.external.z[...] = 0.0
    sim.step(2)
    work = sim.external_work
    sim.step(50)
    assert sim.external_work == work
    sim.external = None
    assert sim.external is None
    # The same as three planes.
    one, two = tiny(), tiny()
    one.external, two.external = field, [field[..., c] for c in range(3)]
    one.step(30), two.step(30)
    assert (state(one) == state(two)).all()


def test_save_and_resume(tmp_path):
    sim = in_contact()
    sim.external = numpy.full((3, 16, 16), 1e-3)
    sim.top.velocity = -20.0
    sim.step(33)
    sim.save(tmp_path / "a.h5")
    again = asperity.Simulation.resume(tmp_path / "a.h5")
    assert again.force == sim.force and again.energy.kinetic == sim.energy.kinetic
    assert again.contact == sim.contact and again.time == sim.time
    assert (again.f.z == sim.f.z).all() and again.external_work == sim.external_work
    for s in (sim, again):
        s.step(40)
        s.top.velocity = None
        s.external = None
        s.step(10**6)
    assert sim.steps == again.steps and (state(sim) == state(again)).all()
    assert sim.work_of_drive.pull_off == again.work_of_drive.pull_off
    assert sim.energy.balance_error == again.energy.balance_error


def test_save_replaces_nothing_but_its_own_files(tmp_path, state_run):
    sim = tiny()
    sim.step(3)
    theirs = tmp_path / "notes.h5"
    theirs.write_text("mine")
    link, dangling = tmp_path / "link.h5", tmp_path / "dangling.h5"
    link.symlink_to(theirs)
    dangling.symlink_to(tmp_path / "nothing")
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")
    for place, says in ((theirs, "no file of Simulation.save"), (link, "symbolic link"), (dangling, "symbolic link"),
                        (tmp_path / "folder", "is a directory"), (tmp_path / "pipe", "no regular file"),
                        (state_run.directory / "run.h5", "no file of Simulation.save")):
        with pytest.raises(asperity.SceneError, match=says) as error:
            sim.save(place)
        assert "fix: name another file" in str(error.value)
    assert theirs.read_text() == "mine" and link.is_symlink() and dangling.is_symlink()
    assert (tmp_path / "pipe").is_fifo() and not (tmp_path / "nothing").exists()
    assert asperity.load(state_run.directory).binding_energy == state_run.binding_energy
    sim.save(tmp_path / "a.h5")
    sim.step(4)
    sim.save(tmp_path / "a.h5")
    assert asperity.Simulation.resume(tmp_path / "a.h5").steps == 7
    assert sorted(f.name for f in tmp_path.iterdir()) == ["a.h5", "dangling.h5", "folder", "link.h5", "notes.h5", "pipe"]


def test_observers():
    sim, seen = tiny(), []
    sim.every(10, lambda s: seen.append((s.steps - 1, s.energy.elastic)))
    sim.step(25)
    assert [n for n, _ in seen] == [0, 10, 20]

    def wrong(s):
        if s.steps > 60:
            raise ZeroDivisionError("of mine")

    sim.every(5, wrong)
    with pytest.raises(ZeroDivisionError, match="of mine"):
        sim.step(100)
    assert sim.steps == 61
    with pytest.raises(asperity.SceneError, match="observer"):
        nested = tiny()
        nested.every(1, lambda s: s.step())
        nested.step()


def test_what_observers_return_becomes_columns(tmp_path):
    sim = tiny()
    sim.every(10, lambda s: s.u.z.min(), "lowest")
    sim.every(20, lambda s: {"twice": 2.0 * s.force, "half": s.energy.elastic / 2})

    def gap(s):
        return s.maps().gap.min() if s.steps - 1 >= 30 else None

    sim.every(15, gap)
    sim.step(65)
    series = sim.series
    assert series["step"].tolist() == [0, 10, 20, 30, 40, 45, 50, 60]
    assert set(series["time"]) == {n * 0.02 for n in series["step"]}
    assert numpy.isnan(series["lowest"]).tolist() == [False] * 5 + [True] + [False] * 2
    twice = ~numpy.isnan(series["twice"])
    assert twice.tolist() == [True, False, True, False, True, False, False, True]
    assert (series["twice"][twice] == 2 * series["force"][twice]).all()
    assert (series["half"][twice] == series["elastic_energy"][twice] / 2).all()
    assert (~numpy.isnan(series["gap"])).tolist() == [False, False, False, True, False, True, False, True]
    # As a result.
    result = asperity.load(sim.write(tmp_path / "mine"))
    assert set(result.series) == set(series)
    for name, values in series.items():
        assert numpy.array_equal(result.series[name], values, equal_nan=True)
    assert result.series.unit("force") == "eV/Å" and result.key("surface.sites") == 16 and result.name == "tiny"
    assert (result.fields["now"].gap == sim.maps().gap).all()
    assert (result.substrate.height == sim.substrate.height).all()
    assert result.run.steps == 65 and not result.notes
    with pytest.raises(asperity.SceneError, match="already holds a result"):
        sim.write(tmp_path / "mine")
    for wrong, says in ((lambda s: "high", "columns are made of numbers"),
                        (lambda s: {"force": 1.0}, "has one of that name")):
        sim = tiny()
        sim.every(1, wrong)
        with pytest.raises(asperity.SceneError, match=says):
            sim.step()


def test_notes_on_a_scene_are_warnings():
    thin = {**STATIC, "block": {"thickness": 8}}
    for kind, scene in ((asperity.Simulation, {**TINY, "block": {"thickness": 8}}), (asperity.Statics, thin)):
        with pytest.warns(asperity.SceneWarning, match="thinner .8 layers. than wide .16 sites.") as seen:
            kind(scene)
        assert {w.filename for w in seen} == {__file__}  # where a user's script called it
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tiny(drive__velocity=50)
        with pytest.raises(asperity.SceneWarning):
            asperity.Statics(thin)


def test_ctrl_c_ends_between_steps():
    sim = tiny()
    sim.top.velocity = 0.0
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))  # runs: step releases the GIL
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        sim.step(10**9)
    timer.join()
    assert 0 < sim.step(3) == 3


def test_two_at_once():
    one, two, alone = tiny(), tiny(), tiny()
    threads = [threading.Thread(target=s.step, args=(200,)) for s in (one, two)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    alone.step(100), alone.step(100)
    assert (state(one) == state(alone)).all() and (state(two) == state(alone)).all()


def test_bad_use(tmp_path):
    def refused(words, call):
        with pytest.raises(asperity.SceneError) as error:
            call()
        text = str(error.value)
        assert words in text and "fix:" in text, text

    refused("cannot step", lambda: tiny(drive__path='["relax"]'))
    refused("cannot step", lambda: tiny(drive__mode="quasistatic"))
    refused("surface.sites", lambda: tiny(surface__sites=-3))
    refused("surface.sitess", lambda: tiny(surface__sitess=3))
    refused("timestep", lambda: tiny(drive__timestep=1000.0))
    sim = in_contact()
    good = state(sim)

    broken = numpy.where(numpy.arange(256).reshape(16, 16, 1) == 37, numpy.nan, numpy.zeros((16, 16, 3)))
    for says, field in (("(16, 16)", numpy.zeros((16, 16))), ("[8, 16]", numpy.zeros((8, 16, 3))),
                        ("nan at [y, x] = [2, 5]", broken)):
        refused(says, lambda: setattr(sim, "external", field))
    with pytest.raises(ValueError, match="broadcast"):
        sim.u.z[...] = numpy.zeros((3, 3))
    for many in ("many", 1.5):
        with pytest.raises(TypeError, match="whole number"):
            sim.step(many)
    for thing, misspelt in ((sim, "extrenal"), (sim.top, "velocty"), (asperity.Statics(STATIC), "mean_heigth")):
        with pytest.raises(AttributeError, match=misspelt):
            setattr(thing, misspelt, 1.0)
    refused("-1", lambda: sim.step(-1))
    refused("0 steps", lambda: sim.every(0, print))
    refused("function", lambda: sim.every(3, None))

    refused("top.velocity", lambda: setattr(sim.top, "velocity", float("nan")))
    sim.external = numpy.zeros((3, 16, 16))
    refused("external field", sim.relax)
    sim.external = None
    assert (state(sim) == good).all()
    # No number among the positions: refused before the step, and mended.
    sim.u.x[3, 4] = numpy.nan
    refused("nan at [y, x] = [3, 4]", lambda: sim.step(1))
    sim.u.x[3, 4] = good[0][3, 4]
    sim.step(1)
    # Through the substrate: the guard ends it, and nothing but a new one goes on.
    sim.u.z[...] -= 200.0
    with pytest.raises(asperity.PhysicsError, match="passed through|balance|diverged"):
        sim.step(5)
    for call in (lambda: sim.step(1), sim.relax, lambda: sim.save(tmp_path / "a.h5")):
        refused("has ended", call)
    assert sim.u.z.shape == (16, 16)
    # Files that hold no simulation.
    refuse_file = tmp_path / "nothing.h5"
    refuse_file.write_bytes(b"no file of HDF5")
    for file in (refuse_file, tmp_path / "missing.h5"):
        with pytest.raises(asperity.InputOutputError):
            asperity.Simulation.resume(file)
    with pytest.raises(asperity.SceneError, match="numerics.device"):
        tiny(numerics__device="emulated").f


STATIC = {"name": "static", "surface": {"sites": 16, "rms": 1.0}, "block": {"thickness": 16},
          "drive": {"mode": "quasistatic", "control": "mean-height"}}


@pytest.mark.parametrize("hold", ["top", "mean-height"])
def test_statics_meets_the_path_of_a_run(results, hold):
    """Led to points of a run's path on the way in, and out again, it has their forces, energies and losses."""
    soft = {"drive.control": hold, "block.thickness": 128}
    run = asperity.run(STATIC, soft, out=results / f"statics-{hold}")
    statics, name = asperity.Statics(STATIC, soft), {"top": "top", "mean-height": "mean_height"}[hold]
    column = {"top": "top_displacement"}.get(name, name)
    series, inwards = run.series, run.series["segment"] == 0
    scale, depth = abs(series["force"]).max(), abs(series["interface_energy"]).max()
    # Each path knows the place of an instability to one of its steps: points beside one may be on either side of it.
    top = series["top_displacement"]
    unstable = top[1:][numpy.diff(series["dissipated"]) > 0]
    clear = abs(top[:, None] - unstable).min(axis=1, initial=numpy.inf) > 0.01
    for way in (inwards, ~inwards):
        for k in numpy.flatnonzero(way & clear)[2::6]:
            setattr(statics, name, series[column][k])
            point = statics.relax()
            assert getattr(point, name) == pytest.approx(series[column][k], abs=1e-12)
            assert point.force == pytest.approx(series["force"][k], abs=2e-3 * scale)
            energy = series["interface_energy"][k] + series["elastic_energy"][k]
            assert point.energy == pytest.approx(energy, abs=2e-3 * depth)
            assert point.dissipated == pytest.approx(series["dissipated"][k], abs=2e-3 * depth)
    assert (point.dissipated > 0.05 * depth) == (hold == "top")  # the block snaps on its own spring
    # It starts and ends out of reach: what was put in and not given back was lost.
    setattr(statics, name, getattr(statics, name) + 30.0)
    apart = statics.relax()
    assert abs(apart.energy) < 1e-3 and apart.contact == 0.0
    assert apart.work == pytest.approx(apart.dissipated, abs=2e-3 * depth)


def test_statics_under_loads():
    statics, area = asperity.Statics(STATIC), (16 * 2.6) ** 2
    per_mpa = area / 160217.66208

    def at(load):
        statics.load = load
        return statics.relax()

    rest = at(0.0)
    assert rest.contact > 0.0 and abs(rest.force) < 1e-2
    pressed = at("1 GPa")
    assert pressed.force == pytest.approx(1000 * per_mpa, abs=1e-2)
    assert pressed.mean_height < rest.mean_height and pressed.contact >= rest.contact
    less = at(300.0)
    assert less.force == pytest.approx(300 * per_mpa, abs=1e-2) and less.mean_height > pressed.mean_height
    pulled = at(-100.0)
    assert pulled.force == pytest.approx(-100 * per_mpa, abs=1e-2)
    assert statics.maps().pressure.mean() == pytest.approx(-0.1, abs=0.01)
    with pytest.raises(asperity.PhysicsError, match="did not reach the pull"):
        at("-50 GPa")
    left = statics.relax()  # at its last point
    assert left.contact == pulled.contact and left.force == pytest.approx(pulled.force, abs=1e-2)
    assert at(0.0).contact == pytest.approx(rest.contact, abs=0.05)


@pytest.mark.parametrize("hold", ["top", "mean-height"])
def test_statics_copied_and_set_free(hold):
    """A copy leads back to where it was taken; what is set free is a state of a run, from wherever it started."""
    statics = asperity.Statics(STATIC, {"drive.control": hold, "drive.tolerance": 1e-6})
    name = {"top": "top", "mean-height": "mean_height"}[hold]
    setattr(statics, name, getattr(statics, name) - 10.0)
    held = statics.relax()
    there = statics.copy()
    assert there.u.shape == (3, 16, 16) and there.u[2].mean() == pytest.approx(
        held.mean_height - asperity.Statics(STATIC).mean_height, abs=1e-9)
    rest = statics.free()
    assert rest.contact_fraction > 0.0 and abs(rest.maps.pressure.mean()) < 1e-4 and rest.residual < 1e-6
    at_rest = statics.relax()  # held where the free state is, no force is needed
    assert abs(at_rest.force) < 1e-4 and at_rest.number == at_rest.work == at_rest.dissipated == 0
    assert -1000 * at_rest.energy / (16 * 2.6)**2 == pytest.approx(rest.binding_energy, abs=1e-4)
    assert at_rest.mean_height == pytest.approx(rest.mean_height, abs=1e-6)
    statics.restore(there)
    back = statics.relax()
    assert (back.energy, back.force) == pytest.approx((held.energy, held.force), abs=1e-4)
    assert statics.free().binding_energy == pytest.approx(rest.binding_energy, abs=1e-5)
    # In another engine, and written to: the sites come back from 0.1 Å.
    other, moved = asperity.Statics(STATIC, {"drive.control": hold, "drive.tolerance": 1e-6}), there
    moved.u[...] += 0.1 * numpy.sin(numpy.arange(16.0))
    other.restore(asperity.running.engine.State(moved.u, moved.top))
    assert other.free().binding_energy == pytest.approx(rest.binding_energy, abs=1e-4)
    for wrong in (asperity.running.engine.State(numpy.zeros((3, 8, 8))),
                  asperity.running.engine.State(numpy.full((3, 16, 16), numpy.nan))):
        with pytest.raises(asperity.SceneError, match="fix:"):
            statics.restore(wrong)
    with pytest.raises(asperity.SceneError, match="3, y, x"):
        asperity.running.engine.State(numpy.zeros((2, 4, 4)))


def test_statics_refuses():
    statics = asperity.Statics(TINY)  # of a scene in time the solids alone
    statics.top = -1.0
    assert statics.relax().top == -1.0
    for wrong in (lambda: setattr(statics, "mean_height", 3.0), lambda: setattr(statics, "top", float("inf")),
                  lambda: setattr(statics, "load", "3 Å")):
        with pytest.raises(asperity.SceneError, match="fix:"):
            wrong()
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    held = asperity.Statics(STATIC, {"surface.sites": 64, "drive.tolerance": 1e-6})
    held.mean_height = 2.9
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        held.relax()
    timer.join()
    part_way = held.now.number
    held.mean_height = held.mean_height - 0.5 if part_way else 20.0
    held.relax()
    with pytest.raises(AttributeError, match="written"):
        held.load


def test_without_the_module(tmp_path):
    """The package works without it, and says what to build."""
    (tmp_path / "asperity").symlink_to(ROOT / "python/asperity")
    code = ("import asperity, asperity.results.result\n"
            "try: asperity.Simulation\n"
            "except ImportError as error: print(error)")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path,
                          env={**os.environ, "ASPERITY_PROGRAM": "/bin/true", "PYTHONPATH": str(tmp_path)})
    assert "pybind11-dev" in done.stdout and not done.stderr, done.stdout + done.stderr


def test_stub_names_what_the_module_has():
    """And the other way round; of each class its public members, read-only ones without a setter."""
    tree = ast.parse((ROOT / "python/asperity/_engine.pyi").read_text())
    generated = ast.parse((ROOT / "python/asperity/results/names.pyi").read_text(encoding="utf-8"))
    bases = {node.name: node.body for node in generated.body if isinstance(node, ast.ClassDef)}
    module = sys.modules[asperity.Simulation.__base__.__module__]
    stub = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")}
    assert stub.keys() == {name for name, value in vars(module).items() if isinstance(value, type)}
    for name, node in stub.items():
        node.body += [member for base in node.bases for member in bases.get(base.id, ())]
        kind = getattr(module, name)
        there = {member for member in vars(kind) if not member.startswith("__") and member != "_pybind11_conduit_v1_"}
        told = {n.name if isinstance(n, ast.FunctionDef) else n.target.id for n in node.body
                if isinstance(n, (ast.FunctionDef, ast.AnnAssign))} - {"__init__"}
        assert told == there, name
        written = {n.name for n in node.body if isinstance(n, ast.FunctionDef)
                   and any(isinstance(d, ast.Attribute) and d.attr == "setter" for d in n.decorator_list)}
        written |= {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)
                    and not n.target.id.startswith("_") and not ast.unparse(n.annotation).startswith("Final[")}
        assert written == {m for m in there if not m.startswith("_") and getattr(vars(kind)[m], "fset", None)}, name


def test_help_says_units():
    names = [(kind, name) for kind in (asperity.Simulation, asperity.Statics) for name in dir(kind)
             if not name.startswith("_")]
    for kind, name in names:
        assert getattr(kind, name).__doc__, name
    text = "".join(getattr(kind, name).__doc__ for kind, name in names)
    for words in ("eV/Å", "ps", "Å/fs", "meV/Å²", "MPa", "Ctrl-C"):
        assert words in text


def test_numbers_are_shown_by_name():
    sim = asperity.Simulation({"surface": {"sites": 16}, "block": {"thickness": 8}})
    sim.step(5)
    shown = repr(sim.energy)
    assert shown.startswith("Energies(balance_error=") and f"elastic={sim.energy.elastic:.6g}" in shown


@pytest.mark.parametrize("name", sorted(p.stem for p in (ROOT / "examples").glob("*.py")))
def test_examples(name, tmp_path):
    script = ROOT / "examples" / f"{name}.py"
    lines = [line for line in script.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) < 40
    sites = "32" if name == "load_cycles" else "16"  # on fewer, steeper ones sites that move sideways lead elsewhere
    done = subprocess.run([sys.executable, str(script), sites, "--plot", "picture.svg"], capture_output=True, text=True,
                          cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    assert done.returncode == 0 and done.stdout.strip(), done.stdout + done.stderr
    assert [p.name for p in Path(tmp_path).iterdir()] == ["picture.svg"]
    assert (tmp_path / "picture.svg").stat().st_size < 60_000
    if name == "load_cycles":  # what the first cycle dissipates in jumps, the second does again
        first, second = (float(line.split()[-2]) for line in done.stdout.splitlines() if "dissipates" in line)
        assert first > 1.0 and second == pytest.approx(first, rel=0.02)
        contact = [float(line.split()[6]) for line in done.stdout.splitlines() if "GPa" in line]
        contact = numpy.array(contact).reshape(4, 20)
        assert (contact[::2, ::-1] >= contact[1::2] - 0.2).all() and (contact[::2, ::-1] > contact[1::2] + 20.0).any()


def test_statics_goes_on_after_a_load_that_it_cannot_reach():
    statics = asperity.Statics({"surface": {"sites": 16, "rms": 0.6}, "block": {"thickness": 16}})
    statics.mean_height = 5.0
    before, u = statics.relax(), statics.copy()
    for load in ("-1e5 MPa", -5e4):
        statics.load = load
        with pytest.raises(asperity.PhysicsError, match="did not reach the pull"):
            statics.relax()
        assert repr(statics.now) == repr(before)
        assert (statics.copy().u == u.u).all()
        assert repr(statics.relax()) == repr(before)  # without a target
    statics.mean_height = 4.5
    after = statics.relax()
    other = asperity.Statics({"surface": {"sites": 16, "rms": 0.6}, "block": {"thickness": 16}})
    for height in (5.0, 4.5):
        other.mean_height = height
        there = other.relax()
    assert repr(after) == repr(there)


@pytest.mark.parametrize("kind", ["Simulation", "Statics"])
def test_what_could_not_be_made_can_be_looked_at(kind):
    """An error's frames hold no object of the engine that is none, and that of a derived class shows itself."""
    class Derived(getattr(asperity, kind)):
        def __init__(self, scene):
            super().__init__(scene)

    for make in (getattr(asperity, kind), Derived):
        with pytest.raises(asperity.SceneError) as error:
            make({"surface": {"sites": 3}})
        frames = [frame.frame.f_locals for frame in error.traceback]
        there = [value for names in frames for value in list(names.values()) if isinstance(value, getattr(asperity, kind))]
        assert [repr(value) for value in there] == [f"<{kind} that could not be made>"] * (make is Derived)
