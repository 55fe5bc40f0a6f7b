# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Running scenes and reading results: values, arrays, units, errors, damaged files."""

import ast
import json
import os
import re
import shutil
import subprocess
import sys
import types

import h5py
import numpy as np
import pytest

import asperity
from asperity.results.result import finite
from asperity.running import program, scene
from conftest import ROOT, SMALL, STATE, command, unsealed


def test_a_result_is_what_the_files_hold(path_run):
    stored = json.loads((path_run.directory / "result.json").read_text())
    assert path_run.binding_energy == stored["binding_energy"]
    assert path_run.work_of_interface.pull_off == stored["work_of_interface"]["pull_off"]
    assert path_run["theory"]["persson"]["gamma_eff"] == path_run.number("theory.persson.gamma_eff")
    assert set(path_run) == set(stored)
    with h5py.File(path_run.directory / "run.h5") as file:
        assert (path_run.series["force"] == file["series/force"][:]).all()
        pressure = file["fields/relaxed/pressure"][:]
        assert (path_run.fields["relaxed"].pressure == pressure).all()
        assert (path_run.substrate.height == file["substrate/height"][:]).all()
    assert pressure[3, 5] != pressure[5, 3]  # or the test could not tell x from y
    assert path_run.series.unit("force") == "eV/Å"
    assert path_run.fields["relaxed"].unit("pressure") == "GPa"
    assert path_run.title == "small: rms 0.5 Å, 32 × 32"
    with pytest.raises(AttributeError, match="binding_energy"):
        path_run.binding_enrgy
    with pytest.raises(AttributeError, match="pressure"):
        path_run.fields["relaxed"].presure


def test_series_are_frames_where_pandas_is(path_run, monkeypatch):
    class Frame(dict):  # what a frame is made from
        def __init__(self, columns):
            super().__init__(columns)
            self.attrs = {}

        def assign(self, **columns):
            self.update(columns)
            return self

    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=Frame))
    frame = path_run.series.frame()
    assert set(frame) == set(path_run.series) and (frame["force"] == path_run.series["force"]).all()
    units = frame.attrs["units"]
    assert set(units) == set(frame) and units["force"] == "eV/Å" and units["time"] == "ps" and units["step"] == "1"
    sweep = asperity.Sweep("t", {}, ["surface.rms"], [{"set": {"surface.rms": 2.0}, "theory": {}, "status": "done",
                                                       "result": {"binding_energy": 50.0}}], simulated=True)
    frame = sweep.frame()
    assert frame["binding_energy"] == [50.0] and frame["status"] == ["done"] and frame.attrs["units"]["binding_energy"] == "meV/Å^2"


def names_of_stub():
    """Classes of the stub of results: the annotations of each."""
    tree = ast.parse((ROOT / "python/asperity/results/names.pyi").read_text(encoding="utf-8"))
    return {node.name: {line.target.id: ast.unparse(line.annotation) for line in node.body if isinstance(line, ast.AnnAssign)}
            for node in tree.body if isinstance(node, ast.ClassDef)}


def untyped(value, kind, classes, path):
    """Paths of values that the stub does not have, or with another type."""
    many = re.fullmatch(r"(list|dict)\[(?:str, )?(\w+)\]", kind)
    if many:
        members = value if many[1] == "list" else list(value.values())
        assert isinstance(value, list if many[1] == "list" else dict), path
        return [found for i, member in enumerate(members) for found in untyped(member, many[2], classes, f"{path}[{i}]")]
    if kind in classes:
        return [found for name, member in value.items()
                for found in (untyped(member, classes[kind][name], classes, f"{path}.{name}") if name in classes[kind] else [f"{path}.{name}"])]
    right = {"float": (int, float), "int": (int,), "str": (str,), "bool": (bool,), "Any": (object,)}[kind]
    return [] if isinstance(value, right) and (kind in ("bool", "Any") or not isinstance(value, bool)) else [f"{path}: {value!r} is no {kind}"]


def test_the_stub_has_the_names_and_types_of_results(path_run, state_run, sphere_run, results):
    still = asperity.run(STATE, {"drive.path": ["approach", "slide x 3 Å", "pull-off"], "drive.mode": "quasistatic", "surface.rms": 0.5,
                                 "block.thickness": 24}, out=results / "still")
    classes = names_of_stub()
    classes["Numbers"] |= {"segments": "list[Segment]", "scene": "Scene"}  # of Result
    for run in (path_run, state_run, sphere_run, still):
        found = untyped({name: value for name, value in run.items() if name != "units"}, "Numbers", classes, "")
        assert not found, found
        assert set(run.series) <= set(classes["SeriesArrays"]) and set(run.substrate) <= set(classes["SubstrateMaps"])
        for state in run.fields.values():
            assert set(state) <= set(classes["StateMaps"])
    assert still.segments and still.dissipated.jumps is not None
    # A value that the stub does not have, and one of another type, are seen.
    assert untyped({"binding_energy": 1.0, "gama": 1.0, "name": 3}, "Numbers", classes, "") == [".gama", ".name: 3 is no str"]


MISTAKEN = """
import asperity
r = asperity.load("results/first-contact")
good: float = r.binding_energy + r.work_of_drive.pull_off + r.segments[0].lost + r.theory.persson.gamma_eff
r.fields["relaxed"].pressure.max(), r.series.force.min(), r.plot.separation(), r.report(), r.scene.surface.rms, r.units.binding_energy
r.binding_enregy
r.work_of_drive.aproach
r.fields["relaxed"].presure
r.series.forse
r.plot.sepration()
r.scene.surface.rsm
r.segments[0].lots
asperity.estimate("s.toml").quot()
asperity.sweep("s.toml").tabel
"""


def test_a_wrong_name_is_found_by_a_type_checker(tmp_path):
    api = pytest.importorskip("mypy.api", reason="no mypy: pip install mypy")
    (tmp_path / "script.py").write_text(MISTAKEN)
    said = api.run([str(tmp_path / "script.py"), "--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(tmp_path / "cache")])[0]
    lines = [int(n) for n in re.findall(r"script\.py:(\d+): error: .* has no attribute", said)]
    assert lines == list(range(6, 15)) and said.count("error") == 10, said  # and the line that counts them


def test_numbers_are_found_by_their_paths(path_run):
    numbers = path_run.numbers()
    assert numbers["energy.balance_error"] == path_run.energy.balance_error
    assert "scene.surface.radius" not in numbers  # "none"
    assert path_run.number("scene.surface.radius") is None
    for value in (True, "1", float("inf"), float("nan"), 10**400, None, []):  # a truth is no number
        assert finite(value) is None


def test_overrides_and_dictionaries_reach_the_program():
    text = scene.toml_of({"surface": {"sites": 64, "rms": np.float64(0.25)}, "drive": {"path": ["relax"]},
                          "block.model": "lattice"})
    assert text.startswith('block.model = "lattice"\n')
    named = {"name": "as named", "surface": {"sites": 64, "file": None}, "block.young": "80 GPa"}
    with scene.scene_file(named) as file:
        found = program.check(file, scene.assignments({"surface.rms": "0.3 nm", "drive.path": ["relax"]}))
    assert found["name"] == "as named" and not found["problems"]
    assert found["scene"]["surface"]["rms"] == pytest.approx(3.0)
    assert found["scene"]["block"]["young"] == 80.0
    assert found["scene"]["drive"]["path"] == ["relax"]


def test_the_schema_is_the_programs():
    keys = program.schema()
    assert keys["surface.rms"]["unit"] == "Å" and keys["surface.rms"]["kind"] == "number"
    assert "lattice" in keys["block.model"]["choices"]
    assert all(set(k) >= {"kind", "unit", "default", "doc"} for k in keys.values())


def test_errors_of_the_program_are_exceptions(tmp_path):
    with pytest.raises(asperity.SceneError) as error:
        asperity.run({**SMALL, "surface": {"rsm": 1, "sites": -3}}, out=tmp_path / "bad")
    assert "did you mean surface.rms?" in str(error.value) and "surface.sites" in str(error.value)
    assert "nothing was written" not in str(error.value) and not (tmp_path / "bad").exists()
    with pytest.raises(asperity.PhysicsError, match="why:"):
        asperity.run(SMALL, {"drive.timestep": 70, "drive.velocity": 200, "drive.load": 20000}, out=tmp_path / "fast")
    failed = asperity.load(tmp_path / "fast")
    assert "drive" in failed.failure_text
    assert f"at step {failed.run.steps}" in failed.failure_text  # not of the state that was put back
    with pytest.raises(asperity.InputOutputError, match="there is no such directory"):
        asperity.load(tmp_path / "gone")
    (tmp_path / "empty").mkdir()
    with pytest.raises(asperity.InputOutputError, match="holds no result"):
        asperity.load(tmp_path / "empty")
    (tmp_path / "file").write_text("")
    with pytest.raises(asperity.InputOutputError):
        asperity.run(SMALL, out=tmp_path / "file" / "x")


def test_a_directory_that_is_taken_is_not_written_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    short = {"drive.max_steps": 3}
    first, second = asperity.run(SMALL, short), asperity.run(SMALL, short)
    assert [str(r.directory) for r in (first, second)] == ["results/small", "results/small-2"]
    with pytest.raises(asperity.SceneError):
        asperity.run(SMALL, short, out=first.directory)


@pytest.mark.parametrize("closed", [False, True])
def test_a_run_file_that_another_program_writes_to_says_so(state_run, tmp_path, closed):
    shutil.copytree(state_run.directory, tmp_path / "copy")
    with h5py.File(tmp_path / "copy/run.h5", "r+") as file:
        if closed:
            file.close()
        result = asperity.load(tmp_path / "copy")
        for missing in (lambda: result.fields["relaxed"], lambda: result.series["force"]):
            with pytest.raises(asperity.UnknownName, match="run.h5 cannot be read to its end"):
                missing()


@pytest.mark.parametrize("ranks", [0, -1])
def test_no_rank_is_an_error(tmp_path, ranks):
    with pytest.raises(asperity.SceneError, match="is no number of ranks"):
        asperity.run(STATE, out=tmp_path / "none", ranks=ranks)
    assert not any(tmp_path.iterdir())


def test_ranks_change_nothing_but_their_number(tmp_path, monkeypatch):
    """They are started by the launcher of the program's MPI, which is found."""
    monkeypatch.delenv("ASPERITY_MPIRUN", raising=False)
    few = {"drive.max_steps": 20, "output.series": 5}
    one, two = (asperity.run(SMALL, few, out=tmp_path / str(n), ranks=n) for n in (1, 2))
    assert (one.run.ranks, two.run.ranks) == (1, 2)
    assert len(one.series["force"]) > 3
    assert all((one.series[name] == two.series[name]).all() for name in one.series)


def test_what_is_loaded_is_what_was_written(path_run, tmp_path):
    """Bits, blocks and lengths of result.json and run.h5: refused, or (in the digest's own name) the same numbers."""
    def damages(data):
        for place in map(int, np.linspace(0, len(data) - 1, 150)):
            yield data[:place] + bytes([data[place] ^ 1 << place % 8]) + data[place + 1:]
        for place in range(0, len(data), max(512, len(data) // 30)):
            yield data[:place] + b"0" * len(data[place:place + 512]) + data[place + 512:]
            yield data[:place]

    def loaded(name, data):
        (tmp_path / name).write_bytes(data)
        try:
            return asperity.load(tmp_path)
        except asperity.InputOutputError:
            return None

    whole = {name: (path_run.directory / name).read_bytes() for name in ("result.json", "run.h5")}
    numbers = path_run.numbers()
    for data in damages(whole["result.json"]):
        found = loaded("result.json", data)
        assert found is None or data == whole["result.json"] or found.numbers() == numbers
    assert loaded("result.json", whole["result.json"]).numbers() == numbers
    for data in damages(whole["run.h5"]):
        found = loaded("run.h5", data)
        assert data == whole["run.h5"] or (found.notes and not found.series)
    assert not loaded("run.h5", whole["run.h5"]).notes


def test_a_result_changed_on_purpose_is_read_without_its_digest(path_run, tmp_path):
    changed = dict(json.loads((path_run.directory / "result.json").read_text()), delta_gamma=1.0)
    (tmp_path / "result.json").write_text(json.dumps(changed))
    with pytest.raises(asperity.InputOutputError, match='remove the member "digest"'):
        asperity.load(tmp_path)
    del changed["digest"]
    (tmp_path / "result.json").write_text(json.dumps(changed))
    assert asperity.load(tmp_path).delta_gamma == 1.0


def damaged(path_run, tmp_path, change):
    copy = tmp_path / "copy"
    shutil.copytree(path_run.directory, copy, ignore=shutil.ignore_patterns("report*", "export"))
    change(copy / "run.h5")
    return asperity.load(copy)


def test_a_damaged_run_file_is_noted_and_the_rest_is_used(path_run, tmp_path):
    found = damaged(path_run, tmp_path, lambda f: f.write_text("nonsense"))
    assert "it is not an HDF5 file" in found.notes[0]
    assert not found.series and not found.fields and not found.substrate
    assert found.binding_energy == path_run.binding_energy


@pytest.mark.parametrize("shape", [(), (3000, 1), (4, 4, 4), (0, 0)])
def test_an_array_of_another_shape_is_a_message(path_run, tmp_path, shape):
    def change(name):
        with unsealed(name) as file:
            for place in ("substrate/height", "fields/relaxed/pressure"):
                del file[place]
                file[place] = np.zeros(shape)
    found = damaged(path_run, tmp_path, change)
    with pytest.raises(asperity.InputOutputError, match="height"):
        found.substrate.height
    with pytest.raises(asperity.InputOutputError, match="pressure"):
        found.fields["relaxed"].pressure
    assert (found.fields["relaxed"].gap == path_run.fields["relaxed"].gap).all()


def test_words_and_groups_in_place_of_numbers_are_a_message(path_run, tmp_path):
    def change(name):
        with unsealed(name) as file:
            del file["series/force"], file["substrate/height"]
            file["series/force"] = "words"
            file.create_group("substrate/height")
    found = damaged(path_run, tmp_path, change)
    assert found.notes and not found.series


def test_a_huge_array_is_not_read(path_run, tmp_path):
    def change(name):
        with unsealed(name) as file:
            del file["substrate/height"]
            file.create_dataset("substrate/height", shape=(100_000, 100_000), chunks=(1000, 1000))
    with pytest.raises(asperity.InputOutputError, match="values"):
        damaged(path_run, tmp_path, change).substrate.height


IN_TIME = ["drive.path=approach", "drive.velocity=800", "drive.timestep=20", "drive.ramp=0", "surface.rms=0.3",
           "output.series=100"]


@pytest.mark.parametrize("effects", [
    [], ["interface.frictionless=true"], ["interface.kind=wall"],
    ["drive.path=approach", "drive.mode=quasistatic", "drive.max_steps=3"],
    ["interface.kind=wall", "drive.path=approach", "drive.mode=quasistatic", "drive.max_steps=3"],
    [*IN_TIME, "block.model=lattice", "block.thickness=12"], [*IN_TIME, "block.thickness=96"]])
def test_a_run_takes_the_memory_that_its_plan_says(results, effects):
    keys = [f"surface.rms={0.2 if 'interface.kind=wall' in effects else 4}", "drive.path=relax", "drive.tolerance=0.3", *effects]

    def words(sites):
        return [word for key in [*keys, f"surface.sites={sites}"] for word in ("--set", key)]

    def peak(sites):
        # Started by a small process: the peak that the kernel tells has that of the process before it.
        starter = "import os, sys; print(os.wait4(os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:]), 0)[2].ru_maxrss)"
        out = results / f"memory {sites} {'_'.join(effects)}"
        told = subprocess.run([sys.executable, "-c", starter, os.environ["ASPERITY_PROGRAM"], "run", "-",
                               *words(sites), "--out", out, "--progress", "off"], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=True)
        assert (out / "result.json").exists()
        return 1024.0 * int(told.stdout.split()[-1])

    # The run of few sites has the libraries, whose buffers are a part of what a state over a wall takes.
    sites = 768 if "interface.kind=wall" in effects else 256
    taken = peak(sites) - peak(24)
    planned = 1e6 * float(re.search(r"^ *altogether +([0-9.]+) MB", command("plan", "-", *words(sites)), re.MULTILINE)[1])
    assert 0.85 * planned < taken < 1.15 * planned
