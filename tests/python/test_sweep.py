# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Sweeps: their grid, the pool of processes, tables, and how they stop, resume and fail."""

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import zlib
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np
import pytest
from matplotlib.figure import Figure

import asperity
import asperity.running.runs
from asperity import terminal
from asperity.files import store
from asperity.plots import sweep as plots
from asperity.plots.style import csv, drawn
from asperity.reports import sentences
from asperity.running import lock, pool, program
from asperity.running.scene import inputs_of
from asperity.studies import grid, sweeps
from asperity.studies.sweeps import load_sweep, load_sweeps
from asperity.studies.tables import text_of
from conftest import STATE, command, held, is_told, rows, running, started, wait_for, without_pictures

SCENE = """
[surface]
sites = 24
[block]
[drive]
path = ["relax"]
[sweep]
surface.rms = [0.2, 0.4]
surface.seed = [1, 2]
"""
PATH = """
[surface]
sites = 32
rms = 0.5
[block]
thickness = 16
[drive]
timestep = 20
max_steps = 6000
[output]
checkpoint = 0.2
"""


@pytest.fixture()
def place(place, light):
    (place / "state.toml").write_text(SCENE)
    (place / "path.toml").write_text(PATH)
    return place


def numbers(directory):
    return rows(Path(directory) / "sweep.csv")


# The grid

def axes(*sets, of_scene=()):
    return grid.axes_of(list(sets), list(of_scene))


def test_axes_come_from_the_command_line_and_the_scene():
    of_scene = [{"key": "surface.rms", "values": "1,0.2 nm,3.5", "where": "s.toml:5:1"},
                {"key": "surface.seed", "values": "1:3:1", "where": "s.toml:6:1"}]
    found, fixed = axes(of_scene=of_scene)
    assert [(a.key, a.values) for a in found] == [("surface.rms", ["1", "0.2 nm", "3.5"]),
                                                  ("surface.seed", ["1", "2", "3"])]
    assert [grid.is_seed(a.key) for a in found] == [False, True] and not fixed
    found, fixed = axes("surface.seed=4", "drive.load=1,2", of_scene=of_scene)
    assert [a.key for a in found] == ["drive.load", "surface.rms"] and fixed == ["surface.seed=4"]
    assert axes('drive.path=["approach","pull-off"]')[1] == ['drive.path=["approach","pull-off"]']
    assert axes("surface.rms=0.1:0.3:0.1")[0][0].values == ["0.1", "0.2", "0.3"]  # not 0.30000000000000004
    assert grid.points_of(axes("surface.rms=1,2", "drive.load=0,5")[0])[1] == ["surface.rms=1", "drive.load=5"]
    # A value that is no whole number is not rounded to one: the scene refuses it.
    assert axes("surface.seed=1:2:0.5")[0][0].values == ["1", "1.5", "2"]


@pytest.mark.parametrize("given, says", [
    ("surface.rms=1:2:-1", "is a range without values"), ("surface.rms=1:2", "is no range"),
    ("surface.rms=0:1:1e-9", "asks for 1e+09 values"), ("surface.rms=1,,2", "has an empty value"),
    ("surface.rms=1:100:1 surface.seed=1:200:1", "more than 10000 points"),
    ("surface.rms=1,2 surface.rms=3", "is given twice")])
def test_axes_that_make_no_sense_are_refused(given, says):
    with pytest.raises(asperity.SceneError, match=says.replace("+", r"\+")):
        axes(*given.split())


# The tables

def nine_points():
    """Three roughnesses with three seeds, the last of which lacks a run."""
    points, value = [], 10.0
    for rms in (1.0, 2.0, 3.5):
        for seed in (1, 2, 3):
            result = {"delta_gamma": 50.0, "binding_energy": value, "binding_energy_ratio": value / 50}
            points.append({"set": {"surface.rms": rms, "surface.seed": seed}, "delta_gamma": 50.0, "status": "done",
                           "theory": {"persson": {"delta_gamma": 50.0, "gamma_eff": 40.0 - rms, "contact_fraction": 0.9},
                                      "renormalised": {"gamma_eff_ratio": 0.8 - 0.1 * rms}},
                           "directory": f"rms={rms:g},seed={seed}", "result": result})
            value = value * 1.25 + 1
    points[-1].update(status="waiting", result={})
    return asperity.Sweep("s", {"surface": {"rms": 1.0}}, ["surface.rms", "surface.seed"], points, notes=["a note"],
                          simulated=True)


def test_tables_average_over_seeds(tmp_path):
    sweep = nine_points()
    average = sweep.table.averages()["binding_energy"]
    assert list(average.points) == [3, 3, 2]
    assert average.mean[0] == pytest.approx(41.375 / 3, rel=1e-14)
    assert average.deviation[0] == pytest.approx(math.sqrt((100 + 182.25 + 319.515625 - 41.375**2 / 3) / 2), rel=1e-12)
    found = sweep.json(sweep.table)
    assert found["means"][0]["binding_energy"]["mean"] == pytest.approx(41.375 / 3)
    assert found["means"][2]["binding_energy"]["count"] == 2
    assert found["points"][8]["status"] == "waiting"


def test_only_points_that_are_done_are_averaged(tmp_path):
    sweep = nine_points()
    sweep.points[1].update(status="failed")
    for i in (6, 7):  # as an unfinished run leaves them
        sweep.points[i].update(status="waiting")
    sweep.directory = tmp_path
    sweep.write()
    average = sweep.table.averages()
    assert list(average["binding_energy"].points) == [2, 3, 0] and list(average["theory.persson.gamma_eff"].points) == [3, 3, 3]
    assert average["binding_energy"].mean[0] == pytest.approx((10 + 17.875) / 2)  # the first and the third
    assert sweep.means["binding_energy.count"].tolist() == [2, 3, 0]
    rows = text_of(sweep.table)[1]
    assert rows[0][1].startswith("0.2787 ±") and rows[2][1] == "-" and rows[2][-1] == "3 waiting"
    curves = drawn(sweep.plot("gamma", Figure().add_subplot())).curves
    assert np.isnan(curves[-1].y[2]) and curves[-1].y[0] == pytest.approx((10 + 17.875) / 100)
    row = numbers(tmp_path)[1]
    assert row["status"] == "failed" and float(row["binding_energy"]) == 13.5  # the point itself is told


def test_csv_hdf5_and_json_hold_the_same(tmp_path):
    sweep = nine_points()
    sweep.directory = tmp_path / "out"
    sweep.write()
    assert {p.name for p in sweep.directory.iterdir()} == {"sweep.csv", "sweep-mean.csv", "sweep.h5", "sweep.json", store.RECORD}
    rows = numbers(sweep.directory)
    assert list(rows[0])[:5] == ["surface.rms", "surface.seed", "delta_gamma", "binding_energy", "binding_energy_ratio"]
    assert rows[7]["surface.rms"] == "3.5" and rows[8]["status"] == "waiting" and rows[8]["binding_energy"] == ""
    with h5py.File(sweep.directory / "sweep.h5") as file:
        assert list(file["points/surface.seed"]) == [1, 2, 3] * 3
        assert list(file["means/surface.rms"]) == [1, 2, 3.5]
        assert list(file["means/binding_energy.count"]) == [3, 3, 2]
        assert file["points/binding_energy"].attrs["unit"] == "meV/Å^2"
        assert file["points/surface.rms"].attrs["unit"] == "Å"
        assert np.isnan(file["points/binding_energy"][-1])
        assert file["points/theory.renormalised.gamma_eff_ratio"][0] == pytest.approx(0.7)
    back = load_sweep(sweep.directory)
    assert text_of(back.table) == text_of(sweep.table) and back.notes == ["a note"]
    written = {p.name: p.read_bytes() for p in sweep.directory.glob("*.csv")}
    back.write()
    assert written == {p.name: p.read_bytes() for p in sweep.directory.glob("*.csv")}
    assert [s.name for s in load_sweeps(tmp_path)] == ["s"]  # in a folder of its own
    with pytest.raises(asperity.InputOutputError, match="holds a sweep for each of several scenes"):
        load_sweep(tmp_path)


def test_a_table_knows_what_means_nothing():
    """Of a sphere, energies over the nominal area; the key along x is the one with the most numbers that is no seed."""
    flat = nine_points()
    flat.points = flat.points[:6]  # two roughnesses, three seeds
    assert flat.table.along == "surface.rms" and np.isfinite(flat.table.column("binding_energy_ratio")).all()
    sphere = nine_points()
    for point in sphere.points[:8]:
        point["result"].update({"contact_radius.relaxed": 30.0, "jkr.pull_off_ratio": 0.9})
    table = sphere.table
    assert np.isnan(table.column("binding_energy_ratio")).all() and (table["binding_energy_ratio"][:8] > 0).all()
    heads = text_of(table)[0]
    assert "state" not in heads and "JKR out" in heads and "theory" in heads
    assert np.isnan(table.column("no such column")).all()
    theory = asperity.Sweep("t", {}, flat.axes, flat.points).table  # the same names in a sweep of the theory alone
    assert (theory.column("theory.persson.gamma_eff") == theory["theory.persson.gamma_eff"]).all()


def test_plots_of_a_sweep_read_back_are_the_same(tmp_path):
    sweep = nine_points()
    sweep.directory = tmp_path
    sweep.write()
    def curves(of):
        ax = Figure().add_subplot()
        assert plots.plot([of], "gamma", ax)
        return [(c.label, c.x.tolist(), c.y.tolist()) for c in drawn(ax).curves]
    head = csv(sweep.plot("gamma", Figure().add_subplot()).figure).splitlines()[0]
    assert "state at zero load: γeff / Δγ, deviation over seeds and convergence of a run, added in squares" in head
    here = curves(sweep)
    assert here == curves(load_sweep(tmp_path))
    assert [label for label, _, _ in here] == ["Persson’s theory", "renormalised theory", "state at zero load"]
    assert here[2][2][0] == pytest.approx(41.375 / 150)
    assert not plots.plot([sweep], "hysteresis", Figure().add_subplot())  # no cycle
    assert not plots.plot([sweep], "works", Figure().add_subplot())  # no path


def labels(sweeps, name="gamma"):
    """Of a plot: what each curve is, and the legend."""
    ax = Figure().add_subplot()
    assert plots.plot(sweeps, name, ax)
    return [c.label for c in drawn(ax).curves], [t.get_text() for t in ax.get_legend().get_texts()]


def test_plots_tell_which_load_states_and_theory_have():
    sweep = nine_points()
    for path, load, theory, state in (
            (["relax"], 100.0, "Persson’s theory under a load of 100 MPa", "state under a load of 100 MPa"),
            (["approach"], 100.0, "Persson’s theory under a load of 100 MPa", "state at zero load"),
            (["relax"], 0.0, "Persson’s theory", "state at zero load")):
        sweep.scene["drive"] = {"path": path, "load": load}
        assert labels([sweep])[0] == [theory, theory.replace("Persson’s", "renormalised"), state]
    for point in sweep.points:  # now over the load
        point["set"] = {"drive.load": point["set"]["surface.rms"], "surface.seed": point["set"]["surface.seed"]}
    sweep.axes = ["drive.load", "surface.seed"]
    assert labels([sweep])[0] == ["Persson’s theory", "renormalised theory", "state under the load"]
    sweep.scene["drive"]["path"] = ["approach"]
    assert labels([sweep])[0] == ["Persson’s theory", "renormalised theory", "state at zero load"]


def named(name, factor=1.0, shift=0.0):
    """Nine points of another name, with another theory of Persson, at other roughnesses."""
    sweep = nine_points()
    sweep.name = name
    for point in sweep.points:
        point["theory"]["persson"]["gamma_eff"] *= factor
        point["set"]["surface.rms"] += shift
    return sweep


def test_scenes_in_one_plot_have_their_own_theory():
    states = ["a: state at zero load", "b: state at zero load"]
    assert labels([named("a"), named("b")])[0] == ["Persson’s theory", "renormalised theory", *states]  # equal: once
    ax = Figure().add_subplot()
    assert plots.plot([named("a"), named("b", 0.9)], "gamma", ax)
    told = ["a: Persson’s theory", "b: Persson’s theory", "renormalised theory", *states]
    assert [c.label for c in drawn(ax).curves] == [t.get_text() for t in ax.get_legend().get_texts()] == told
    assert len({line.get_color() for line in ax.lines[:3]}) == 3
    assert len({line._unscaled_dash_pattern for line in ax.lines[:3]}) == 3
    # Where nothing tells that they are equal, both are drawn, each its own.
    assert labels([named("a"), named("b", shift=0.25)])[0][:2] == ["a: Persson’s theory", "b: Persson’s theory"]
    near = named("b")
    for point in near.points[3:]:
        point["set"]["surface.rms"] += 0.25
    assert labels([named("a"), near])[0][:2] == ["a: Persson’s theory", "b: Persson’s theory"]  # one point is too little
    # Of other points with some in common, one curve leads through all.
    wide = named("b")
    for point in wide.points:
        if point["set"]["surface.rms"] == 3.5:
            point["set"]["surface.rms"] = 5.0
    ax = Figure().add_subplot()
    assert plots.plot([named("a"), wide], "gamma", ax)
    assert drawn(ax).curves[0].label == "Persson’s theory" and list(drawn(ax).curves[0].x) == [1, 2, 3.5, 5]
    # Of the theory alone.
    alone = [named("a"), named("b", 0.9)]
    for sweep in alone:
        sweep.simulated = False
    assert labels(alone)[0] == ["a: Persson’s theory", "b: Persson’s theory", "renormalised theory"]
    # One without a theory: the curve is not its.
    for point in alone[0].points:
        point["theory"] = {}
    assert labels(alone)[0] == ["b: Persson’s theory", "b: renormalised theory"]


def test_colours_are_told_whatever_is_drawn_first():
    sweep = nine_points()
    sweep.axes = ["surface.rms", "drive.load"]
    for point in sweep.points:
        point["set"]["drive.load"] = 100.0 * point["set"].pop("surface.seed")
    words = [f"load = {load} MPa" for load in (100, 200, 300)]
    assert labels([sweep])[1] == [*words, "Persson’s theory", "renormalised theory", "state at zero load"]
    for i, point in enumerate(sweep.points):
        del point["theory"]["persson"]["gamma_eff"]
        if i % 3:
            del point["theory"]["renormalised"]  # one curve has a theory, the others have not
    assert labels([sweep])[1] == [words[0], "renormalised theory", *words[1:], "state at zero load"]
    for point in sweep.points:
        point["theory"] = {}  # as of atoms anywhere
    assert labels([sweep])[1] == [*words, "state at zero load"]
    # The same words have the same colour in all scenes.
    other = nine_points()
    other.name, other.axes = "b", sweep.axes
    for point in other.points:
        point["set"]["drive.load"] = 100.0 * (1 + point["set"].pop("surface.seed"))
        point["theory"] = {}
    ax = Figure().add_subplot()
    assert plots.plot([sweep, other], "gamma", ax)
    colours = {}
    lines = [line for line in ax.lines if len(line.get_xdata())]
    for one, line in zip(drawn(ax).curves, lines, strict=True):
        colours.setdefault(one.label.partition(", ")[2], set()).add(line.get_color())
    assert sorted(colours) == [*words, "load = 400 MPa"] and [len(c) for c in colours.values()] == [1] * 4
    assert [t.get_text() for t in ax.get_legend().get_texts()].count(words[1]) == 1
    # What is not drawn is told, all of it.
    other.points = [{"set": {"surface.rms": rms, "drive.load": load}, "theory": {}}
                    for rms in range(9) for load in range(8)]
    third = nine_points()
    third.axes = ["surface.seed", "drive.load"]
    third.points = [{"set": {"surface.seed": 1, "drive.load": load}, "theory": {}} for load in (1.0, 2.0)]
    assert plots.parts_of([other, third])[2] == "s is not in the plots: it sweeps another key; " \
        "the plots show the first 7 of 8 curves"


@pytest.mark.parametrize("text", ['{"points": 3}', "[]", "{}",
                                  '{"points": [{"set": 3, "theory": []}], "axes": 1, "run": 2}'])
def test_damaged_sweep_json(tmp_path, text):
    (tmp_path / "sweep.json").write_text(text)
    try:
        sweep = load_sweep(tmp_path)
    except asperity.InputOutputError as error:
        assert "is no sweep" in str(error)
        return
    assert len(sweep.table.status) == 1


# The points

def test_points_are_known_by_their_result(tmp_path):
    job = pool.Job("rms=1", tmp_path / "point", "s.toml", [], {"scene": {"surface": {"rms": 1.0}}})
    assert pool.look_at(job).status == pool.WAITING  # no directory
    job.directory.mkdir()

    def status(**keys):
        (job.directory / "result.json").write_text(json.dumps({"scene": {"surface": {"rms": 1.0}}, **keys}))
        return pool.look_at(job).status

    assert status() == pool.DONE and status(run={"stopped": "max_steps"}) == pool.DONE
    assert status(run={"stopped": "signal"}) == pool.WAITING and status(run={"stopped": "wall_limit"}) == pool.WAITING
    assert status(run={"stopped": 3}) == pool.DONE  # a hostile number is no reason
    assert status(failure={"exit_code": 3, "reason": "the balance is off\n    why: ..."}) == pool.FAILED
    assert pool.look_at(job).reason == "the balance is off"
    assert status(failure={"exit_code": 4}) == pool.WAITING  # the disk may have room by now
    job.answer = {"scene": {"surface": {"rms": 2.0}}}
    with pytest.raises(asperity.SceneError, match="holds the result of another scene"):
        pool.look_at(job)


def a_map(file, seed):
    """A rough map of 24 x 24 points."""
    np.save(file, 0.3 * np.random.default_rng(seed).standard_normal((24, 24)))


def test_points_over_another_content_of_a_file_are_refused(place):
    """The same path with other bytes; the same content in other bytes is the same."""
    a_map("map.npy", 1)
    keys = {"surface.kind": "file", "surface.file": place / "map.npy", "block.thickness": 12}
    scene = {**STATE, "name": "mapped"}
    first = asperity.sweep(scene, {**keys, "drive.load": [0, 20]}, out="mapped")
    assert len(set(first.table["binding_energy"])) == 2
    np.savetxt("map.txt", np.load("map.npy"), fmt="%.17g")
    shutil.copy("map.npy", "kept.npy")
    with open("map.npy", "wb") as file:  # another header
        np.lib.format.write_array(file, np.load("kept.npy"), version=(2, 0))
    again = asperity.sweep(scene, {**keys, "drive.load": [0, 20, 40]}, out="mapped")
    assert (again.table["binding_energy"][:2] == first.table["binding_energy"]).all()
    a_map("map.npy", 2)
    with pytest.raises(asperity.SceneError, match="holds the result of another content of .*map.npy"):
        asperity.sweep(scene, {**keys, "drive.load": [0, 20]}, out="mapped")
    assert len(load_sweep("mapped").points) == 3  # as it was
    other = asperity.sweep(scene, {**keys, "drive.load": [0, 20]}, out="other")
    assert (other.table["binding_energy"] != first.table["binding_energy"]).all()
    digests = {run.surface.file_digest for run in [*first.results(), *again.results()]}
    assert len(digests) == 1 and digests != {other.results()[0].surface.file_digest}
    # Of a result that tells no digest nothing is known.
    path = place / "other/load=0/result.json"
    result = json.loads(path.read_text())
    del result["surface"]["file_digest"], result["digest"]
    path.write_text(store.sealed_json(result))
    with pytest.raises(asperity.SceneError, match="does not tell the file's digest"):
        asperity.sweep(scene, {**keys, "drive.load": [0, 20]}, out="other")


@pytest.mark.parametrize("key", ["interface.adhesion", "interface.hardness", "surface.counter"])
def test_points_over_another_content_of_any_file_are_refused(place, key):
    np.savetxt("field.txt", 1.0 + np.random.default_rng(1).random((16, 16)))
    keys = {"surface.sites": 16, "surface.rms": 0.5, "interface.kind": "wall", "interface.range": 3, "drive.mode": "quasistatic",
            "drive.path": ["approach"], "drive.load": [1, 2], key: "field.txt"}
    asperity.sweep({"name": "over a field"}, keys, out="field")
    np.savetxt("field.txt", 1.5 + np.random.default_rng(1).random((16, 16)))
    with pytest.raises(asperity.SceneError, match="holds the result of another content of field.txt"):
        asperity.sweep({"name": "over a field"}, keys, out="field")


def test_inputs_are_all_files_that_a_scene_names(place):
    """Those of the sites too, but no formula and no word."""
    for name in ("w.txt", "h.txt", "map.npy"):
        (place / name).touch()
    (place / "wall").mkdir()
    scene = {"surface": {"file": "map.npy", "counter": "none"},
             "interface": {"kind": "wall", "adhesion": "w.txt", "hardness": "h.txt:/field", "range": "stripes 1 2 20", "tail": False}}
    assert inputs_of("one.toml", scene) == ["one.toml", "map.npy", "w.txt", "h.txt:/field"]


def test_a_map_may_be_given_beside_the_scene(place):
    """A scene that is none without it; as run takes it."""
    (place / "mapped.toml").write_text('[surface]\nkind = "file"\nsites = 24\n[block]\nthickness = 12\n'
                                       '[drive]\npath = ["relax"]\n')
    a_map("a.npy", 1)
    a_map("b.npy", 2)
    words = ["sweep", "mapped.toml", "--progress", "off", "--out"]
    command(*words, "loads", "--set", "surface.file=a.npy", "drive.load=0,20")
    command(*words, "maps", "--set", "surface.file=a.npy,b.npy")
    loads, maps = load_sweep("loads").results(), load_sweep("maps").results()
    assert loads[0].binding_energy == maps[0].binding_energy != maps[1].binding_energy
    command(*words, "none", "--set", "surface.file=no.npy", "drive.load=0,20", expect=2, says="there is no such file")


def test_values_are_whatever_can_be_gone_through(place):
    scene = {**STATE}
    for values in ([1, 2, 3], (1, 2, 3), range(1, 4), np.arange(1, 4), np.array([1.0, 2.0, 3.0]),
                   (i for i in (1, 2, 3)), "1:3:1", "1,2,3", [np.int64(1), np.float32(2), 3]):
        given = {"surface.rms": values, "surface.hurst": np.float64(0.7)}
        assert asperity.sweep(scene, given, theory_only=True).table["surface.rms"].tolist() == [1, 2, 3], values


def test_a_damaged_point_is_told_and_run_again(place):
    words = ["sweep", "state.toml", "--progress", "off", "--out", "one"]
    command(*words)
    before = numbers("one")
    path = place / "one/rms=0.4,seed=1/result.json"
    whole = path.read_bytes()
    for damaged in (b"", whole.replace(b'"binding_energy": ', b'"binding_energy": 1'), whole[:200]):
        path.write_bytes(damaged)
        outcome = pool.look_at(pool.Job("rms=0.4,seed=1", path.parent, "state.toml", [], json.loads(whole)))
        assert outcome.status == pool.WAITING and outcome.damaged
    said = command(*words)
    assert "note: one/rms=0.4,seed=1/result.json cannot be read" in said and "4 of 4 points are done" in said
    assert "3 are there already" in said and numbers("one") == before
    assert (path.parent / "result-damaged.json").read_bytes() == whole[:200]
    # What is set aside replaces nothing.
    shutil.rmtree("one/rms=0.2,seed=1")
    point = place / "one/rms=0.4,seed=1"
    (point / "result.json").unlink()
    (point / "result.json").mkdir()
    (point / "result-damaged.json").unlink()
    (point / "result-damaged.json").mkdir()
    (point / "result-damaged.json/x").touch()
    said = command(*words)
    assert "4 of 4 points are done" in said and numbers("one") == before
    assert (point / "result-damaged.json/x").exists() and (point / "result-damaged-2.json").is_dir()


def test_a_lock_that_is_anothers_by_now_stays(tmp_path):
    file = tmp_path / "run.lock"
    with lock.in_use(tmp_path):
        file.unlink()  # by somebody who is certain that no such process lives
        file.write_text("host elsewhere\nprocess 7\nsince 2026-01-01 00:00:00\n")
    assert "elsewhere" in file.read_text()
    file.unlink()
    with lock.in_use(tmp_path):
        assert f"process {os.getpid()}\n" in file.read_text()  # not the program, which has ended
        with pytest.raises(asperity.InputOutputError, match=f"process {os.getpid()} on host"):
            lock.in_use(tmp_path).__enter__()
        assert lock.is_used(tmp_path)
    assert not file.exists() and not lock.is_used(tmp_path)


def test_the_lock_of_a_killed_process_is_not_kept_by_those_that_it_started(tmp_path):
    lines = ("import os, pathlib, subprocess, sys, asperity.running.lock as lock\n"
             "quiet = dict(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)\n"
             "with lock.in_use(pathlib.Path(sys.argv[1])):\n"
             "    print(subprocess.Popen(['sleep', '60'], close_fds=False, **quiet).pid, flush=True)\n"
             "    os._exit(9)")
    done = subprocess.run([sys.executable, "-c", lines, str(tmp_path)], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    try:
        assert (tmp_path / "run.lock").exists()
        with lock.in_use(tmp_path):
            pass
    finally:
        os.kill(int(done.stdout), signal.SIGKILL)


@pytest.mark.parametrize("out, says", [("", "is empty"), ("/", "root of all"), ("/../", "root of all")])
def test_a_directory_that_can_be_none_is_refused(place, out, says):
    for words in (["sweep", "state.toml"], ["cost", "path.toml", "--set", "drive.max_steps=none"], ["run", "path.toml"],
                  ["theory", "path.toml"], ["surface", "path.toml"]):
        assert says in command(*words, "--out", out, expect=2), words
    for call in (asperity.run, asperity.sweep):
        with pytest.raises(asperity.SceneError, match=says):
            call("state.toml", out=out)
    assert sorted(p.name for p in place.iterdir()) == ["path.toml", "state.toml"]
    assert not Path("/result.json").exists()


def test_the_time_left_counts_each_scene_by_its_own_points(tmp_path):
    jobs = [pool.Job(str(i), tmp_path / str(i), file, [], {}) for i, file in enumerate(["slow"] * 3 + ["fast"] * 10)]
    many = pool.Pool(jobs, [pool.Outcome() for _ in jobs], pool.PoolOptions(jobs=2, progress="off"), tmp_path)
    now = 1000.0

    def left(running, finished):
        many.running = dict.fromkeys(running, now - 100.0)
        over = sum(points for points, _ in finished.values())
        many.waiting = [i for i in range(len(jobs)) if i not in running][over:]
        many.done, many.seconds = (Counter({name: both[k] for name, both in finished.items()}) for k in (0, 1))
        return many._left(running, now)

    assert left({0: 0.0, 1: 0.0}, {}) == ""
    assert left({0: 0.5, 1: 0.5}, {}) == " | at least 3 min 20 s left"  # two halves and a whole one of 200 s, by two
    assert left({2: 0.5, 3: 0.5}, {"slow": (2, 400.0)}) == " | 16 min 40 s left"
    # How far a point has come is not known: it lasts as long as those of its scene have, or nothing is known of it.
    assert left({9: 0.0}, {"slow": (3, 600.0), "fast": (5, 900.0)}) == " | 6 min 40 s left"
    assert left({0: 0.0}, {"fast": (10, 100.0)}) == " | at least 10 s left"
    assert left({0: 0.0, 1: 0.0}, {"fast": (11, 100.0)}) == ""


@pytest.mark.parametrize("words, says", [
    (["--set", "surface.rms=0.2,-1"], "surface.rms = -1 is out of range"),
    (["--set", "drive.mode=dynamic", "drive.path=approach", "drive.timestep=10,500", "block.model=lattice"],
     "over the stability limit"),
    (["--set", "surface.rms=0.2,0.02nm,0.2"], "two points are the same"),
    (["--set", "surface.rms=1", "surface.seed=1"], "nothing to sweep"), (["--jobs", "0"], "is no number from 1"),
    (["--wall-limit", "soon"], "is no length of time"), (["--progress", "loud"], "choices: auto, bar, lines, off"),
    (["--theory-only", "--set", "surface.rms=0.2,-1"], "surface.rms = -1 is out of range"),
    (["--theory-only", "--set", "surface.rms=1", "surface.seed=1"], "nothing to sweep"),
    (["state.toml"], "has the name of another scene"), (["--set", "surface.rsm=1,2"], "did you mean surface.rms?")])
def test_what_is_wrong_is_said_before_anything_runs(place, words, says):
    assert says in command("sweep", "state.toml", *words, "--out", "no/such", expect=2)
    assert sorted(p.name for p in place.iterdir()) == ["path.toml", "state.toml"]


ALONE = [{}, {"OMPI_COMM_WORLD_SIZE": "1", "OMPI_COMM_WORLD_RANK": "0", "PMIX_RANK": "0"},
         {"PMI_SIZE": "1", "PMI_RANK": "0"},
         # What SLURM sets in the script of a batch job, whatever its number of tasks, and in a step of one task.
         {"SLURM_JOB_ID": "7", "SLURM_NTASKS": "4", "SLURM_NPROCS": "4", "SLURM_PROCID": "0"},
         {"SLURM_NTASKS": "4", "SLURM_PROCID": "0", "SLURM_STEP_NUM_TASKS": "1", "PMIX_RANK": "0"}]
AMONG_OTHERS = [{"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0", "PMIX_RANK": "0"},
                {"PMI_SIZE": "2", "PMI_RANK": "0"}, {"SLURM_STEP_NUM_TASKS": "2", "SLURM_PROCID": "0"},
                {"PMIX_RANK": "0"}]


@pytest.mark.parametrize("env", ALONE)
def test_one_process_of_a_launcher_is_one_process(place, env, monkeypatch):
    for name, value in env.items():
        monkeypatch.setenv(name, value)
    command("theory", "state.toml", "--json", "--set", "surface.kind=flat")  # a command of Python, and the program that it starts
    command("check", "-", given=SCENE, says="nothing wrong")


def test_a_sweep_is_not_one_of_several_ranks(place):
    def start(words, env):
        return subprocess.Popen([os.environ["ASPERITY_PROGRAM"], *words], env={**os.environ, **env}, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    others = [{name: "1" if "RANK" in name or "PROCID" in name else value for name, value in env.items()} for env in AMONG_OTHERS]
    commands = (["sweep", "state.toml"], ["sweep", "state.toml", "--theory-only"])
    # Side by side: the others wait for the first.
    first, second = ([start(words, env) for words in commands for env in all_of] for all_of in (AMONG_OTHERS, others))
    for one, other in zip(first, second, strict=True):
        assert "not one of several ranks" in one.communicate()[0] and one.returncode == 2
        assert other.communicate()[0] == "" and other.returncode == 2  # one of them says it
    assert not (place / "results").exists()
    for env in AMONG_OTHERS:
        with pytest.MonkeyPatch.context() as patch:
            for name, value in env.items():
                patch.setenv(name, value)
            with pytest.raises(asperity.SceneError, match="not one of several ranks"):
                asperity.sweep("path.toml", {"surface.rms": [1, 2]}, out="none")
            with pytest.raises(asperity.SceneError, match="not one of several ranks"):
                asperity.run("path.toml", out="none")


def test_the_table_is_the_same_for_any_number_of_jobs_and_from_python(place, monkeypatch):
    said = command("sweep", "state.toml", "--out", "one", "--progress", "off")
    assert "4 of 4 points are done" in said and "±" in said
    command("sweep", "state.toml", "--out", "two", "--progress", "off", "--jobs", "2")
    sweep = asperity.sweep(STATE, {"surface.rms": [0.2, 0.4], "surface.seed": "1:2:1"}, out="three", jobs=2)
    assert numbers("one") == numbers("two") == numbers("three")
    for name in ("sweep.csv", "sweep-mean.csv", "sweep.json", "sweep.h5", "gamma.svg", "gamma.pdf", "area.png"):
        assert (place / "one" / name).stat().st_size > 0
    # A point is what a run makes of it.
    alone = asperity.run("state.toml", {"surface.rms": 0.4, "surface.seed": 2}, out="alone")
    assert alone.binding_energy == sweep.results()[3].binding_energy == sweep.table["binding_energy"][3]
    assert sweep.table.units["binding_energy"] == "meV/Å^2"
    # It goes on: points that are there stay, new ones come, another scene is not mixed in.
    before = (place / "one/rms=0.2,seed=1/result.json").stat().st_mtime_ns
    shutil.rmtree("one/rms=0.4,seed=1")
    said = command("sweep", "state.toml", "--set", "surface.rms=0.2,0.4,0.6", "--out", "one", "--progress", "off")
    assert "3 are there already" in said and "6 of 6 points are done" in said
    assert (place / "one/rms=0.2,seed=1/result.json").stat().st_mtime_ns == before
    table = load_sweep("one").table
    command("sweep", "state.toml", "--set", "surface.rms=0.8", "surface.seed=1:2:1", "--out", "one", "--progress", "off",
            expect=2, says=["holds a sweep over surface.rms, surface.seed", "this one is over surface.seed"])
    # Before anything is computed: the program is not asked for a theory.
    with monkeypatch.context() as patch:
        patch.setattr(program, "theory_points", lambda *_, **__: pytest.fail("a theory was computed"))
        with pytest.raises(asperity.SceneError, match="another scene\n.*block.thickness is 24 there and 12 here"):
            asperity.sweep("state.toml", {"block.thickness": 12}, out="one")
    # Other values: what is done stays in the tables.
    said = command("sweep", "state.toml", "--set", "surface.rms=0.5,0.6", "--out", "one", "--progress", "off")
    assert "4 more points of an earlier call" in said and "2 are there already" in said
    now = load_sweep("one").table
    assert list(now["surface.rms"]) == [0.2, 0.2, 0.4, 0.4, 0.5, 0.5, 0.6, 0.6] and set(now.status) == {"done"}
    assert list(now["binding_energy"][:4]) == list(table["binding_energy"][:4])
    command("sweep", "state.toml", "--set", "surface.rms=0.2,0.4,0.6", "--out", "one", "--progress", "off")
    # A point of another program is told.
    point = place / "one/rms=0.2,seed=1/result.json"
    result = json.loads(point.read_text())
    ours, result["run"]["git"] = result["run"]["git"], "another"
    result.pop("digest")
    point.write_text(store.sealed_json(result))
    words = ["sweep", "state.toml", "--set", "surface.rms=0.2,0.4,0.6", "--out", "one", "--progress", "off"]
    assert "another (1)" in command(*words) and f"{ours} (5)" in command(*words)


def test_numbers_keep_three_digits():
    """In a table of soft matter as in one of metals; the rule of io/terminal.cpp."""
    for value, text in ((69.912, "69.91"), (55.6251, "55.63"), (-1.0, "-1.00"), (0.0, "0.00"), (-0.0, "0.00"),
                        (0.99951, "1.00"), (0.5, "0.500"), (0.00412, "0.00412"), (4.127e-7, "4.13e-07"),
                        (-3e-4, "-3.00e-04"), (12345.678, "12345.68"), (5.4321e12, "5.432e+12"), (math.nan, "-")):
        assert terminal.number(value, 2) == text
    sweep = nine_points()
    for point in sweep.points:
        for name in point["result"]:
            point["result"][name] *= 1e-5
    cells = [cell for row in text_of(sweep.table)[1] for cell in row]
    assert "2.76e-06 ± 7.89e-07" in cells, cells
    assert sentences.energy(3.21e-5) == "3.21e-05 meV/Å² (5.14e-04 mJ/m²)"
    assert sentences.energy(-55.6251) == "−55.63 meV/Å² (−891 mJ/m²)"
    assert sentences.percent(1.234e-5) == "0.00123\u00a0%" and sentences.percent(0.4567) == "45.7\u00a0%"


def test_jobs_and_executors_that_are_none_are_refused(place):
    values = {"surface.rms": [0.2, 0.4]}
    for jobs in (0, -1, 1.5, True, "2", None, 10**9):
        with pytest.raises(asperity.SceneError, match="is no number of points side by side|give a whole number"):
            asperity.sweep("state.toml", values, out="none", jobs=jobs)
    for executor in ("mpi", 3, object()):
        with pytest.raises(asperity.SceneError, match="is no executor"):
            asperity.sweep("state.toml", values, out="none", executor=executor)
    gone = ThreadPoolExecutor(1)
    gone.shutdown()
    with pytest.raises(asperity.SceneError, match="executor: takes no points\n.*shutdown"):
        asperity.sweep("state.toml", values, out="none", executor=gone)
    for ranks in (0, 1.5, True, "2"):
        with pytest.raises(asperity.SceneError, match="is no number of ranks|ranks is .*\n.*\n.*give a whole number"):
            asperity.run("state.toml", out="none", ranks=ranks)
    assert not Path("none/sweep.json").exists()


def test_points_share_the_processors_unless_somebody_has_chosen(place, monkeypatch):
    def threads(directory):
        return asperity.load(f"{directory}/seed=1").run.threads
    words = ["sweep", "state.toml", "--progress", "off", "--jobs", "2", "--set", "surface.rms=0.2", "--out"]  # two seeds
    monkeypatch.delenv("OMP_NUM_THREADS")
    command(*words, "shared")
    assert threads("shared") == max(1, len(os.sched_getaffinity(0)) // 2)
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    command(*words, "chosen")
    assert threads("chosen") == 3


def test_the_theory_of_a_realised_spectrum_has_all_seeds(place):
    given = {"surface.rms": [0.2, 0.4], "surface.seed": [1, 2]}
    sweep = asperity.sweep({**STATE, "theory": {"spectrum": "realised"}}, given, out="realised", jobs=2)
    assert {p["set"]["surface.seed"] for p in sweep.theory} == {1, 2} and len(sweep.theory) == 2 * sweeps.CURVE
    points, curve = (t.average(t.column("theory.persson.gamma_eff_ratio")) for t in (sweep.table, sweep.curves))
    assert points.deviation[1] > 1e-5  # the seeds are told apart
    assert curve.mean[[0, -1]] == pytest.approx(points.mean, rel=1e-12)
    assert len(asperity.sweep(STATE, given, out="target", jobs=2).theory) == sweeps.CURVE


def test_several_scenes_share_their_plots(place):
    (place / "other.toml").write_text(SCENE.replace("0.2, 0.4", "0.3, 0.5"))
    command("sweep", "state.toml", "other.toml", "--out", "both", "--progress", "off", "--jobs", "2")
    assert {s.name for s in load_sweeps(Path("both"))} == {"state", "other"}
    ax = Figure().add_subplot()
    assert plots.plot(load_sweeps(Path("both")), "gamma", ax)
    assert {"other: state at zero load", "state: state at zero load"} <= {c.label for c in drawn(ax).curves}
    assert (place / "both/gamma.svg").exists()


def test_a_directory_has_one_sweep_at_a_time(place):
    """The second sweep, and a run, are refused; what a killed sweep left behind is no obstacle."""
    words = ["sweep", "path.toml", "--set", "drive.velocity=30,40", "--progress", "off", "--out", "one"]
    with started(*words) as child:
        wait_for((place / "one/velocity=30/run.journal").exists)
        child.send_signal(signal.SIGSTOP)  # it cannot end meanwhile, however slow the machine is
        for second in (words, ["run", "path.toml", "--out", "one"]):
            command(*second, expect=4, says=f"process {child.pid} on host {os.uname().nodename} has had it since 20")
    assert (place / "one/run.lock").exists()
    assert "2 of 2 points are done" in command(*words)
    assert not (place / "one/run.lock").exists()
    # Of another machine nothing can be known.
    lock = "host elsewhere\nprocess 7\nsince 2026-01-01 00:00:00\n"
    (place / "one/run.lock").write_text(f"{lock}digest {store.digest_text(zlib.crc32(lock.encode()))}\n")
    assert "process 7 on host elsewhere" in command(*words, expect=4)


TWO = ["sweep", "path.toml", "--set", "drive.velocity=30,40", "--jobs", "2", "--progress", "off", "--out"]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The table of a sweep that was not stopped."""
    work = tmp_path_factory.mktemp("whole")
    (work / "path.toml").write_text(PATH)
    with without_pictures():
        command(*TWO, "whole", cwd=work)
    return numbers(work / "whole")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_sweep_that_is_stopped_goes_on_to_the_same_table(place, whole, number):
    points = [place / f"cut/velocity={v}" for v in (30, 40)]
    with started(*TWO, "cut") as child:
        wait_for(lambda: any((p / "checkpoint.h5").exists() for p in points))
        with held(f"--out {place}/cut") as going:
            child.send_signal(number)
            wait_for(lambda: all(map(is_told, going)))
        assert child.wait() == (75 if number == signal.SIGINT else -number)
    wait_for(lambda: not running(f"--out {place}/cut"))  # a point that the sweep left behind stops as well
    assert any((p / "checkpoint.h5").exists() for p in points)
    command(*TWO, "cut")
    assert numbers("cut") == whole


def test_a_point_that_fails_is_told_and_the_others_go_on(place):
    words = ["sweep", "path.toml", "--set", "drive.load=0,-8500", "drive.velocity=100", "drive.timestep=40",
             "--progress", "off", "--out", "part"]
    said = command(*words, expect=3)
    assert "failed: load=-8500 (exit 3)" in said and "1 of 2 points are done" in said
    part = load_sweep("part")
    assert [p["status"] for p in part.points] == ["done", "failed"]
    assert "failure" not in part.points[0] and part.points[1]["failure"]["exit_code"] == 3
    assert part.points[1]["failure"]["reason"] == asperity.load("part/load=-8500").failure_text.split("\n")[0]
    assert "1 failed before" in command(*words, expect=3)


def test_a_launcher_gives_ranks(place):
    command("sweep", "path.toml", "--set", "drive.velocity=30,40", "drive.max_steps=20", "--progress", "off", "--out",
            "ranks", "--launch", " ".join(asperity.running.runs.launcher(2)))
    assert asperity.load("ranks/velocity=30").run.ranks == 2
    said = command("sweep", "path.toml", "--set", "drive.velocity=30,40", "--progress", "off", "--out", "none",
                   "--launch", "no-such-launcher", expect=127)
    assert "'no-such-launcher' of --launch cannot be started" in said


def test_the_theory_alone(place, monkeypatch):
    # Seeds mean nothing to the theory of a target spectrum.
    written = ["sweep.csv", "sweep.json", "gamma.svg", "area.svg", "full-contact.svg"]
    command("sweep", "state.toml", "--theory-only", "--set", "surface.rms=0.2:0.6:0.2", "drive.load=0,100", "--out",
            "theory", says=["6 points in", *written])
    assert all((place / "theory" / name).stat().st_size > 0 for name in written)
    rows = numbers("theory")
    assert [r["status"] for r in rows] == ["adhesive"] * 6 and all(None not in {*row, *row.values()} for row in rows)
    assert list(rows[0])[:4] == ["surface.rms", "drive.load", "theory.persson.gamma_eff",
                                 "theory.persson.contact_fraction"]
    points = json.loads((place / "theory/sweep.json").read_text())["points"]
    assert [p["set"]["surface.rms"] for p in points] == [0.2, 0.2, 0.4, 0.4, 0.6, 0.6]
    one = program.theory_points("state.toml", [["surface.rms=0.4"]])[0]["theory"]["persson"]
    assert float(rows[2]["theory.persson.gamma_eff"]) == pytest.approx(one["gamma_eff"], rel=1e-9)
    assert "already holds a sweep" in command("sweep", "state.toml", "--theory-only", "--set", "surface.rms=1,2",
                                              "--out", "theory", expect=2)
    said = command("sweep", "state.toml", "--theory-only", "--set", "theory.area_factor=none,gaussian", "surface.rms=1",
                   "--out", "words")
    assert "no plots" in said and numbers("words")[0]["theory.area_factor"] == "none"
    # Without values: roughnesses to a good way past the end of adhesion.
    monkeypatch.setattr(sweeps, "ROUGHNESSES", 10)
    (place / "plain.toml").write_text("[surface]\nsites = 24\n")
    command("sweep", "plain.toml", "--theory-only", "--out", "plain")
    end = program.theory_points("plain.toml", [[]], profile=True)[0]["theory"]["persson"]["critical_rms"]
    rms = [float(r["surface.rms"]) for r in numbers("plain")]
    assert len(rms) == 10 and 1.05 * end < rms[-1] < 2.0 * end
    stored = json.loads((place / "plain/sweep.json").read_text())["run"]
    assert stored["version"] in command("--version") and {"git", "compiler", "flags"} <= stored.keys()
    table = asperity.sweep(STATE, {"surface.rms": "0.5:2:0.5"}, out="py", theory_only=True).table
    assert len(gamma := table["theory.persson.gamma_eff"]) == 4 and (np.diff(gamma) < 0).all()


def test_the_progress_of_a_run_never_runs_back(tmp_path):
    """A line that is half written, a sentence between two lines, and a second segment do not lower it."""
    from asperity.running.pool import LOG, Job, _fraction

    job, seen = Job("a", tmp_path, "", [], {}), []
    for line in ('{"fraction": 0.3, "text": ""}\n', '{"fraction": 0.54, "text": ""}\n', '{"text": "pull-off begins"}\n', '{"fraction": 0.0',
                 ', "text": ""}\n', '{"fraction": null, "text": ""}\n', '{"fraction": 0.67, "text": ""}\n'):
        with open(tmp_path / LOG, "a") as log:
            log.write(line)
        seen.append(_fraction(job))
    assert seen == [0.3, 0.54, 0.54, 0.54, 0.54, 0.54, 0.67]
