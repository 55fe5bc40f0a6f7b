# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Results as tables of other packages and in notebooks, and one kind of error for a wrong name."""

import sys

import numpy as np
import pytest

import asperity
from asperity.errors import UnknownName
from conftest import STATE

SCENE = {**STATE, "surface": {"sites": 16, "rms": 0.3}}


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    return asperity.sweep(SCENE, {"surface.rms": [0.2, 0.4]}, out=tmp_path_factory.mktemp("sweep") / "out")


def test_arrays_of_xarray_have_units_and_places(path_run, state_run, swept):
    pytest.importorskip("xarray", reason="no xarray: apt-get install python3-xarray")
    series = path_run.series.to_xarray()
    assert series.force.attrs == {"units": "eV/Å"} and series.sizes == {"row": len(path_run.series["force"])}
    assert (series.force.values == path_run.series["force"]).all()
    maps = state_run.fields["relaxed"].to_xarray()
    assert maps.pressure.dims == ("y", "x") and maps.pressure.attrs["units"] == "GPa"
    spacing = state_run.edge / maps.sizes["x"]
    assert maps.x.values[:2] == pytest.approx([0.5 * spacing, 1.5 * spacing]) and maps.x.attrs["units"] == "Å"
    assert float(maps.gap.sel(y=2.5 * spacing, x=0.5 * spacing, method="nearest")) == state_run.fields["relaxed"].gap[2, 0]
    assert state_run.substrate.to_xarray().height.attrs["units"] == "Å"
    table = swept.table.to_xarray()
    assert table["binding_energy"].attrs["units"] == "meV/Å^2" and table.sizes["point"] == 2
    assert swept.means.to_xarray()["binding_energy"].sizes["point"] == 2
    surface = asperity.surface(SCENE).to_xarray()
    assert surface.heights.shape == (16, 16) and float(surface.x[-1]) == pytest.approx(15.5 * 2.6)


def test_frames_are_those_of_the_trajectory(path_run, state_run):
    frames = path_run.frames
    assert len(frames) == len(frames.steps) > 1 and (np.diff(frames.steps) == 300).all() and len(frames[1:]) == len(frames) - 1
    first = frames[0]
    assert first.shape == (32 * 32, 3) and frames.velocity(0).shape == first.shape and (frames[-1] == frames[len(frames) - 1]).all()
    with pytest.raises(IndexError, match="output.trajectory"):
        frames[len(frames)]
    assert len(state_run.frames) == 0
    with pytest.raises(UnknownName, match="output.velocities"):
        state_run.frames.velocity(0)
    pytest.importorskip("xarray", reason="no xarray: apt-get install python3-xarray")
    found = frames.to_xarray()
    assert found.position.shape == (len(frames), 1024, 3) and found.time.attrs["units"] == "ps"
    assert found.velocity.attrs["units"] == "Å/ps" and list(found.component.values) == ["x", "y", "z"]


def test_a_missing_package_is_named_with_its_remedy(state_run, monkeypatch):
    for name, call in (("xarray", state_run.series.to_xarray), ("pandas", state_run.series.frame)):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(asperity.SceneError, match=f"needs a Python package, {name}(?s:.*)fix: .*{name}"):
            call()


def results_of(state_run, swept, place):
    """Everything that a call of the package returns."""
    yield from (state_run, state_run.series, state_run.fields["relaxed"], state_run.substrate, state_run.frames, state_run.theory,
                swept, swept.table, swept.means, asperity.check(SCENE), asperity.plan(SCENE), asperity.surface(SCENE),
                asperity.theory(SCENE))
    found = asperity.estimate(SCENE, parts="convergence", out=place / "estimate")
    yield from (found, found.first, asperity.cost(SCENE, parameters=["tolerance"], out=place / "cost"))
    states = pytest.importorskip("asperity.studies.states").states
    yield states(SCENE, starts=2)


def test_every_result_shows_itself_and_refuses_a_wrong_name(state_run, swept, place, light):
    kinds = 0
    for one in results_of(state_run, swept, place):
        html = one._repr_html_()
        assert "<table>" in html and html.count("<tr>") >= 1, type(one)
        with pytest.raises(UnknownName, match="has no (?s:.*)it has ") as raised:
            one.binding_enregy
        assert isinstance(raised.value, (AttributeError, KeyError)) and not hasattr(one, "binding_enregy")
        kinds += 1
    assert kinds == 17


@pytest.mark.parametrize("wrong", [
    lambda run, sweep: asperity.estimat, lambda run, sweep: run.fields["relaxd"], lambda run, sweep: run.series["forse"],
    lambda run, sweep: run["binding_enregy"], lambda run, sweep: run.plot.sepration(), lambda run, sweep: run.plot.map("gpa"),
    lambda run, sweep: sweep.table["surface.rsm"], lambda run, sweep: sweep.plot("gama"), lambda run, sweep: run.scene.surface.rsm,
    lambda run, sweep: asperity.export(run.directory, "vkt"), lambda run, sweep: asperity.estimate(SCENE, parts=["tial"], out="e"),
    lambda run, sweep: asperity.cost(SCENE, parameters=["tolerence"], out="c")])
def test_a_wrong_name_is_one_kind_of_error(state_run, swept, place, wrong):
    with pytest.raises(UnknownName) as raised:
        wrong(state_run, swept)
    assert "fix: " in str(raised.value)


MISTAKEN = """
import asperity
found = asperity.adhesion("scan.gwy", young="1 GPa", poisson=0.3, adhesion="50 mJ/m2")
good = found.result.frames[0].mean() + found.estimate.first.estimate + asperity.surface("s.toml").edge
found.estimate.frist
asperity.adhesion("scan.gwy", yuong="1 GPa", nu=0.3, w="50 mJ/m2")
asperity.check("s.toml").longest_timstep
asperity.run("s.toml").frames.velocty(0)
asperity.theory("s.toml").theory.persson.gama_eff
"""


def test_planted_mistakes_are_found_by_both_checkers(tmp_path):
    """Five of them, by mypy and, where it is installed, by pyright."""
    import json
    import re
    import shutil
    import subprocess

    from conftest import ROOT

    script = tmp_path / "script.py"
    script.write_text(MISTAKEN)
    tried = 0
    for checker in ("mypy", "pyright", "basedpyright"):
        program = shutil.which(checker)
        if not program:
            continue
        tried += 1
        if checker == "mypy":
            words = [program, str(script), "--config-file", str(ROOT / "pyproject.toml"), "--cache-dir", str(tmp_path / "cache")]
            said = subprocess.run(words, capture_output=True, text=True, env={"MYPYPATH": str(ROOT / "python"), "PATH": ""}).stdout
            lines = {int(n) for n in re.findall(r"script\.py:(\d+): error", said)}
        else:
            (tmp_path / "pyrightconfig.json").write_text(json.dumps({"extraPaths": [str(ROOT / "python")], "typeCheckingMode": "standard"}))
            said = subprocess.run([program, "--outputjson", "-p", str(tmp_path)], capture_output=True, text=True).stdout
            lines = {one["range"]["start"]["line"] + 1 for one in json.loads(said)["generalDiagnostics"] if one["severity"] == "error"
                     and one["rule"] not in ("reportMissingImports", "reportMissingModuleSource")}
        assert lines == {5, 6, 7, 8, 9}, said
    if not tried:
        pytest.skip("no mypy or pyright: pip install mypy basedpyright")
