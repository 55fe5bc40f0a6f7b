# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Commands as functions: they return what the commands print."""

import json
import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity.running import program
from conftest import ROOT, STATE, command, unfolded

SPOKEN = (  # function, a message in the words of the command line, and in those of Python
    ("adhesion", "name it: --unit nm", 'name it: unit="nm"'), ("adhesion", '--size "100 nm"', 'size="100 nm"'),
    ("adhesion", '--sites 96, or --range "10 Å"; or leave it out', 'sites=96, or range="10 Å"; or leave it out'),
    ("adhesion", '--line-noise "isotropic" takes it off', 'line_noise="isotropic" takes it off'),
    ("adhesion", "leave --channel out", "leave channel out"),
    ("adhesion", "of several: --channel 2", 'of several: channel="2"'), ("prony", "say --poisson 0.49", "say poisson=0.49"),
    ("prony", "--relaxed 9 MPa", 'relaxed="9 MPa"'), ("prony", "take more branches (--branches)", "take more branches (branches)"),
    ("prony", "say --modulus E, or", 'say modulus="E", or'), ("prony", "--channel 2", "--channel 2"), ("cost", "--target good", 'target="good"'),
    ("estimate", "for example --set drive.path=relax", 'for example overrides={"drive.path": "relax"}'),
    ("sweep", "for example --set surface.rms=1,2,3; for", 'for example values={"surface.rms": [1, 2, 3]}; for'),
    ("tip", 'write --radius "20 nm"', 'write radius="20 nm"'))


@pytest.mark.parametrize("name, text, wanted", SPOKEN, ids=[text for _, text, _ in SPOKEN])
def test_messages_are_in_the_words_of_the_caller(name, text, wanted):
    """The arguments that a message of Python names are arguments of the function."""
    from asperity.arguments import command_line, spoken

    function = getattr(asperity, name).__wrapped__
    assert spoken(text, function) == wanted
    with command_line():
        assert spoken(text, function) == text


def test_a_number_without_a_unit_is_read_as_people_mean_it():
    for argument, value, wanted in (("radius", 20e-9, 'radius="20 nm"'), ("young", 3e9, 'young="3 GPa"'),
                                    ("young", 3, 'young="3 GPa" or young="3 MPa"'),
                                    ("adhesion", 0.05, 'adhesion="0.05 J/m^2"'), ("stiffness", 0.2, 'stiffness="0.2 N/m" or stiffness="0.2 mN/m"')):
        given = {"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2", "stiffness": "0.2 N/m",
                 argument: value}
        with pytest.raises(asperity.SceneError) as error:
            asperity.tip(**given)
        assert str(error.value).endswith("write the one that is meant: " + wanted), error.value


SCENE = {**STATE, "surface": {"sites": 24, "rms": 0.5}}


@pytest.fixture()
def file(place):
    (place / "state.toml").write_text('[surface]\nsites = 24\nrms = 0.5\n[block]\n[drive]\npath = ["relax"]\n')
    return "state.toml"


def test_check_returns_the_scene_or_all_mistakes():
    found = asperity.check(SCENE, {"surface.spacing": 2.5})
    assert found.name == "state" and found.scene.surface.spacing == 2.5 and found.scene.block.young == 77.2
    assert 10.0 < found.longest_timestep < 200.0 and found.edge_pinning == 1.0  # fs
    assert any("has no effect" in note for note in asperity.check(SCENE, {"drive.velocity": 2.0}).notes)
    with pytest.raises(asperity.SceneError, match="morse_a = 2 1/Å has no effect"):
        asperity.check(SCENE, {"interface.morse_a": 2.0})
    with pytest.raises(asperity.SceneError, match="test_functions.py") as error:
        asperity.check(SCENE, {"block.poisson": 0.6, "surface.rms": -1.0})
    assert error.value.problems == 2


def test_the_answer_to_a_refused_scene_has_its_problems(file):
    # `check --json` answers with exit code 2 if the scene can be read and not run, and says nothing if it cannot be read.
    found = program.check(file, ['drive.path=["approach"]', "drive.timestep=200"])
    assert found["scene"]["drive"]["timestep"] == 200.0
    assert [one["what"] for one in found["problems"]] and "stability limit" in found["problems"][0]["what"]
    with pytest.raises(asperity.SceneError, match="block.poisson"):
        program.check(file, ["block.poisson=0.6"])


def test_plan_returns_what_the_command_says(file):
    found = asperity.plan(file)
    told = json.loads(command("plan", file, "--json"))
    assert found.name == "state" and found.bytes["altogether"] == pytest.approx(told["bytes"]["altogether"], rel=0.01)
    assert found.seconds["altogether"] > 0.0 and found.effects["theory"]["on"] is True
    assert asperity.plan(file, {"surface.sites": 96}).bytes["altogether"] > 2.0 * found.bytes["altogether"]


def test_surface_returns_the_heights():
    found = asperity.surface(SCENE, {"surface.rms": "0.1 nm"})
    assert found.heights.shape == (24, 24) and found.rms == pytest.approx(1.0) == pytest.approx(found.heights.std())
    slopes = [(np.roll(found.heights, 1, axis) - found.heights) / 2.6 for axis in (0, 1)]
    assert found.slope == pytest.approx(np.sqrt(sum((s**2).mean() for s in slopes)), rel=1e-6) and found.doubts == []


def test_defaults_are_the_keys():
    keys = asperity.defaults()
    assert keys["surface.rms"]["unit"] == "Å" and "relax" in keys["drive.path"]["doc"]
    keys["surface.rms"]["unit"] = "nm"
    assert asperity.defaults()["surface.rms"]["unit"] == "Å"  # a copy


def test_theory_is_that_of_the_command(file):
    found = asperity.theory(file, {"surface.rms": 0.4})
    told = json.loads(command("theory", file, "--json", "--set", "surface.rms=0.4"))
    assert found.theory == told["theory"] and found.delta_gamma == told["delta_gamma"]
    assert 0.0 < found.theory.persson.gamma_eff < found.delta_gamma and found.theory.renormalised.contact_fraction > 0.5
    assert unfolded(str(found)) in command("theory", file, "--set", "surface.rms=0.4", "--out", "there")
    # No module takes the name, whatever was imported before.
    code = "import asperity.theories.combined, asperity.plots, asperity; print(callable(asperity.theory), callable(asperity.cost))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env={"PYTHONPATH": str(ROOT / "python")})
    assert done.stdout.split() == ["True", "True"], done.stderr


def test_cost_is_that_of_the_command(place, file):
    found = asperity.cost(file, out="cost", parameters=["tolerance"], target=0.05, jobs=2)
    assert found.chosen is not None and found.chosen.error["state"] <= 0.05
    assert found.rows[0].parameter == "reference" and found.rows[0].seconds > 0.0
    assert {"cost.csv", "cost-state.svg"} <= {path.name for path in (place / "cost").iterdir()}
    said = command("cost", file, "--out", "cost", "--parameters", "tolerance", "--target", "5%", "--progress", "off")
    last = f"--set {' '.join(found.chosen.setting)}" if found.chosen.setting else "The scene as it is: nothing is to be set."
    assert "are there already" in said and said.splitlines()[-1] == last
    with pytest.raises(asperity.SceneError, match="this scene has"):
        asperity.cost(file, out="other", parameters=["layers"])
    with pytest.raises(asperity.SceneError, match='target="good"(?s:.*)for example target="1%", or target="0.01"'):
        asperity.cost(file, out="other", target="good")
    assert not (place / "other").exists()


def test_convert_and_export(place, state_run):
    np.savetxt("map.txt", 0.1 * np.random.default_rng(1).standard_normal((24, 24)))
    assert "24 x 24 points" in asperity.convert("map.txt", "map.h5") and (place / "map.h5").exists()
    written = asperity.export(state_run.directory, "vtk")
    assert written and all(path.exists() for path in written)
    with pytest.raises(asperity.SceneError, match="formats: "):
        asperity.export(state_run.directory, "doc")


def test_results_are_tables_in_a_notebook(place, state_run, light):
    html = state_run._repr_html_()
    assert html.count("<tr>") == 7 and "binding energy" in html and f"{state_run.binding_energy / state_run.delta_gamma:.4f}" in html
    sweep = asperity.sweep(SCENE, {"surface.rms": [0.2, 0.4]}, out="sweep")
    html = sweep._repr_html_()
    assert html.count("<tr>") == 3 and "surface.rms" in html and "2 done" not in html
    found = asperity.estimate(SCENE, parts="tail", out="estimate")
    assert "γ_eff = " in found._repr_html_() and "<table>" in found._repr_html_()
    state_run["name"] = "<b>"  # what a scene says is no HTML
    assert "<b>:" not in state_run._repr_html_() and "&lt;b&gt;" in state_run._repr_html_()
