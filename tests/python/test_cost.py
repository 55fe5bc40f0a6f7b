# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What accuracy costs: errors, fronts and choices on made-up runs, the parameters of a scene, one run."""

import json
import math

import numpy as np
import pytest

import asperity
from asperity.reports import cost as report_cost
from asperity.results.result import Values
from asperity.running import program
from asperity.running.scene import scene_file
from asperity.studies import cost
from asperity.studies.cost_parameters import Base, CostCase, Parameter, Row, cost_case, grains_of, numbers_of
from asperity.studies.variations import NAN, Variations, joined
from conftest import command, rows, started, wait_for

pytestmark = pytest.mark.usefixtures("light_module")


def test_energies_are_compared_over_their_own_flat():
    a = numbers_of(Values({"delta_gamma": 50.0, "binding_energy": 30.0, "contact_fraction": 0.5}))
    b = numbers_of(Values({"delta_gamma": 100.0, "binding_energy": 60.0, "contact_fraction": 0.49}))
    errors = cost.errors_of(b, a)
    assert errors[0] == 0 and errors[1] == pytest.approx(-0.02) and math.isnan(errors[2])
    assert cost.largest_error(b, a, "state") == pytest.approx(0.02)


def test_what_was_not_followed_answers_nothing():
    reference = np.array([0.5, 0.9, 0.5, 0.5, 100.0])
    state_only = np.array([0.51, 0.9, NAN, NAN, NAN])
    assert cost.largest_error(state_only, reference, "state") == pytest.approx(0.02)
    assert math.isnan(cost.largest_error(state_only, reference, "path"))
    assert math.isnan(cost.largest_error(state_only, state_only, "path"))
    # What the reference itself lacks is not asked for.
    assert cost.largest_error(np.array([0.5, 0.9, 0.45, NAN, NAN]), np.array([0.5, 0.9, 0.5, NAN, NAN]),
                              "path") == pytest.approx(0.1)


def test_the_front_holds_what_nothing_beats_in_both():
    seconds, errors = [1, 2, 3, 4, 2, 5, 1], [0.5, 0.2, 0.2, 0.1, 0.3, NAN, 0.5]
    assert list(cost.pareto_front(seconds, errors)) == [True, True, False, True, False, False, True]


def case(same_experiment=False, **sections):
    with scene_file(sections) as file:
        found = program.check(file)
    return cost_case(Variations(found["scene"], found["longest_timestep"]), [], same_experiment)


def parameters(**sections):
    return [k.name for k in case(**{"surface": {"sites": 16}, **sections}).parameters]


def test_parameters_are_those_that_the_scene_has():
    assert parameters() == ["cutoff", "tail", "layers", "thickness", "precision", "timestep", "velocity", "damping",
                            "tolerance", "step", "model"]
    assert parameters(drive={"path": ["relax"]}) == ["cutoff", "tail", "thickness", "precision", "tolerance"]
    assert "damping" not in parameters(drive={"damping": 0})
    for other in ({"interface": {"kind": "wall"}, "drive": {"path": ["relax"]}}, {"surface": {"sites": 16, "lattice_ratio": 2.0}}):
        assert "precision" not in parameters(**other)  # pairs are in double
    wall = {"kind": "wall"}
    assert parameters(interface=wall, drive={"path": ["relax"]}) == ["thickness", "spacing", "tolerance"]  # it has no cutoff
    assert "tail" in parameters(interface={**wall, "law": "smeared"}, drive={"path": ["relax"]})
    for parameter in case(surface={"sites": 32}).parameters:  # no value comes twice
        assert len({tuple(row.setting) for row in parameter.rows}) == len(parameter.rows) > 1, parameter.name
    for bad in ({"block": {"strain": "finite"}}, {"drive": {"temperature": 300}}, {"drive": {"max_steps": 10}}):
        with pytest.raises(asperity.SceneError):
            parameters(**bad)
    assert joined(["a.b=1", "c.d=2"], ["a.b=3"]) == ["c.d=2", "a.b=3"]


PHYSICS = ("interface.", "surface.", "drive.mode", "drive.path", "drive.velocity", "drive.damping", "block.thickness")


@pytest.mark.parametrize("sections, names", [
    ({}, ["layers", "precision", "timestep"]), ({"drive": {"mode": "quasistatic"}}, ["precision", "tolerance", "step"]),
    ({"drive": {"path": ["relax"]}}, ["precision", "tolerance"]),
    ({"block": {"strain": "finite"}}, ["layers", "precision", "timestep"])])
def test_a_target_chooses_no_physics(sections, names):
    found = case(True, surface={"sites": 16}, **sections)
    assert [k.name for k in found.parameters] == names and found.bases[0].setting == []
    for setting in [found.reference, *(row.setting for k in found.parameters for row in k.rows)]:
        assert setting and not any(one.startswith(PHYSICS) for one in setting)


def made_up(values, exact=False, others=0.1):
    """Parameters with values of (own error, seconds) over references of one second, which may be chosen if `exact`. The scene and
    all that varies one parameter alone have the error of the `others` too."""
    best, parameters = np.array([1.0, 1.0, NAN, NAN, NAN]), []
    for name, some in values.items():
        settings = [(str(i), f"a.{name}={i}", *found) for i, found in enumerate(some)] + [("best", f"a.{name}=9", 0.0, 1.0)]
        lines = [Row(name, label, [setting], [setting], numbers=best * (1 + others) * [1 + error, 1, 1, 1, 1], seconds=seconds)
                 for label, setting, error, seconds in settings]
        parameters.append(Parameter(name, lines, name, exact, False))
    made = cost.Cost(CostCase([], "", parameters, [Base("", [], list(values), "state")]))
    for row, error in zip(made.rows, (0.0, others)):
        row.numbers, row.seconds = best * (1 + error), 1.0
    made.compare()
    return made


def outcome_of(made, targets, measured):
    """Labels of the combinations that were run, of which the last has the errors of `measured`; NaN: the run fails."""
    ran, added = [], {row.label: error for _, error, row in made.combinations(made.case.bases[0])}

    def run(rows):
        for row in rows:
            ran.append(row.label)
            row.numbers = made.rows[0].numbers + [measured.get(row.label, added[row.label]), 0, 0, 0, 0]
            row.seconds = 0.5
        return len(ran) < measured.get("stopped", 99)

    made.target = targets[-1]
    assert made.choose(targets, run) == ("stopped" not in measured)
    return made.chosen and made.chosen.label, ran


VALUES = {"one": [(8e-3, 0.1), (4e-3, 0.5), (0.0, 0.9)], "other": [(8e-3, 0.1), (1e-3, 0.5)]}


def test_errors_add_and_times_multiply():
    """Each of the cheapest is within 1 %, both together are not."""
    assert outcome_of(made_up(VALUES), [0.01], {}) == ("0, 1", ["0, 1"])
    assert outcome_of(made_up(VALUES), [0.02], {}) == ("0, 0", ["0, 0"])
    # "best" has no error by definition: only a reference in which nothing of it is left may be chosen.
    made = made_up(VALUES)
    assert outcome_of(made, [5e-4], {}) == (None, []) and made.smallest == pytest.approx(0.1)
    assert outcome_of(made_up(VALUES, exact=True), [5e-4], {})[0] == "2, best"


def test_a_base_of_which_nothing_is_varied_is_left_out():
    """`--parameters timestep`: nothing of a quasi-static path is varied."""
    made = made_up(VALUES)
    made.case.bases.insert(0, Base("quasi-static", ["drive.mode=quasistatic"], ["tolerance"], "state"))
    assert made.choose((0.01,), lambda rows: True) and "quasi-static" not in [row.label for row in made.rows]


def test_only_what_was_measured_is_chosen():
    """A combination that misses, or whose run fails, gives way to one that promises half of its error."""
    assert outcome_of(made_up(VALUES), [0.02], {"0, 0": 0.03}) == ("2, 0", ["0, 0", "2, 0"])
    assert outcome_of(made_up(VALUES), [0.02], {"0, 0": NAN}) == ("2, 0", ["0, 0", "2, 0"])
    # Where none promises half, one that promises less takes the place of one that failed, not of one that misses.
    close = {"one": [(8e-3, 0.1), (7e-3, 0.2)]}
    assert outcome_of(made_up(close), [0.02], {"0": NAN}) == ("1", ["0", "1"])
    assert outcome_of(made_up(close), [0.02], {"0": 0.03}) == (None, ["0"])
    made = made_up(VALUES)
    assert outcome_of(made, [0.02], {"0, 0": NAN, "2, 0": 0.021, "2, 1": 0.04}) == (None, ["0, 0", "2, 0", "2, 1"])
    answer = report_cost.answer_of(made)
    assert "No settings keep 2 %" in answer and "2.1 %" in answer


def test_whatever_was_run_and_keeps_the_target_is_chosen():
    """The scene as it is, or one value alone, where a combination is not faster, or none keeps the target."""
    for wrong in (NAN, 0.04):
        made = made_up({"one": [(0.03, 0.1)]}, others=0.003)
        made.rows[1].seconds = 3.0
        assert outcome_of(made, [0.01], {"0": wrong}) == ("as it is", [])
        answer = report_cost.answer_of(made).splitlines()
        assert "within 1 %" in answer[0] and "0.3 %" in answer[0] and answer[-1] == "The scene as it is: nothing is to be set."
    # The value that a parameter's own errors are taken against has none by definition, and is not chosen.
    made = made_up({"one": [(0.03, 0.1)]}, others=0.003)
    made.rows[1].numbers, made.rows[-1].seconds = made.rows[1].numbers * 1.05, 0.01
    assert outcome_of(made, [0.01], {})[0] is None and made.smallest == pytest.approx(0.033, abs=1e-3)
    # One value alone, which two together spoil.
    made = made_up(VALUES, others=1e-4)
    assert outcome_of(made, [0.01], {"0, 1": 0.03, "1, 1": 0.03, "2, 1": 0.03})[0] == "0"


def test_an_area_is_known_to_one_site():
    """An error of none is stated by no setting: one of 256 sites, of which 128 touch."""
    found = Values({"delta_gamma": 50.0, "binding_energy": 25.0, "contact_fraction": 0.5,
                    "scene": {"surface": {"sites": 16, "spacing": 2.6}}})
    made, grains = made_up({"one": [(0.03, 0.1), (1e-3, 0.5)]}, others=0.0), grains_of(found)
    assert grains[:2] == pytest.approx([1e-6, 1 / 256])
    for row in made.rows:
        row.numbers, row.grains = row.numbers * numbers_of(found), grains
    made.compare()
    assert [row.error["state"] for row in made.rows] == pytest.approx([1 / 128, 1 / 128, 0.03, 1 / 128, 1 / 128])
    assert outcome_of(made, [5e-3], {}) == (None, []) and "0.781 %" in report_cost.answer_of(made)
    assert "< 0.78" in report_cost.text_of(made)
    # Errors of two settings add up without it.
    made = made_up({"one": [(3e-3, 0.1)], "other": [(6e-3, 0.1)]})
    made.rows[0].grains = grains * [0, 2, 0, 0, 0]
    made.compare()
    assert [error for _, error, row in made.combinations(made.case.bases[0])] == pytest.approx([9e-3])


def test_searches_share_their_runs():
    made = made_up(VALUES)
    assert outcome_of(made, (0.02, 0.05, 0.01), {})[1] == ["0, 0", "0, 1"]
    assert sum(r.parameter == "combination" for r in made.rows) == 2
    outcome_of(made, [0.006], {"stopped": 1})


def test_targets():
    for text in ("1%", "1 %", "0.01", " 1e-2 ", "1.0e0%"):
        assert cost.target_of(text) == pytest.approx(0.01)
    for text in ("", "one", "1%%", "0", "-1%", "1", "100 %", "nan", "inf", "1.2.3", "%", "1e-400"):
        with pytest.raises(asperity.SceneError, match="--target"):
            cost.target_of(text)


TINY = """[surface]
sites = 16
rms = 0.5
[block]
thickness = 16
[drive]
velocity = 40
timestep = 20
"""
AT_REST = ["drive.mode=quasistatic", "drive.tolerance=0.001"]


@pytest.mark.parametrize("given, best", [
    ([], ["block.model=lattice", "drive.timestep=10"]),
    (AT_REST, ["drive.tolerance=1e-4", "drive.displacement_step=0.0625"]),
    (["drive.path=relax"], ["drive.tolerance=2.5e-05"])], ids=["in time", "quasi-static", "state"])
def test_the_settings_for_a_target_keep_it(tmp_path, monkeypatch, given, best):
    """What is printed, put behind `run`, against the same experiment with the best numerics."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.toml").write_text(TINY)
    words = ["cost", "tiny.toml", "--progress", "off", "--out", "cost", *(["--set", *given] if given else [])]
    said = command(*words, "--target", "2%").splitlines()
    settings = said[-1].split()[1:] if said[-1].startswith("--set ") else []
    assert settings or said[-1].startswith("The scene as it is")

    def quantities(*more):
        place = "run-" + str(len(list(tmp_path.iterdir())))
        command("run", "tiny.toml", "--progress", "off", "--out", place, "--set", *given, *more)
        result = Values(json.loads((tmp_path / place / "result.json").read_text()))
        flat = result.number("delta_gamma")
        found = {"gamma": result.number("binding_energy") / flat, "contact": result.number("contact_fraction")}
        if given != ["drive.path=relax"]:
            found |= {"in": result.number("work_of_drive.approach") / flat, "force": result.number("pull_off_force"),
                      "out": result.number("work_of_drive.pull_off") / flat}
        return found

    reference, reached = quantities(*best), quantities(*settings)
    errors = {key: abs(reached[key] / value - 1.0) for key, value in reference.items()}
    errors["contact"] = max(errors["contact"], 1 / 16**2 / reference["contact"])  # one site
    assert 0 < max(errors.values()) <= 0.02, errors
    told = float(next(line for line in said if "error" in line and "of the reference" in line).split("error")[1].split("%")[0])
    assert told / 100 == pytest.approx(max(errors.values()), rel=0.01)

    # Of what was run nothing is run again; there is no setting with no error but the reference.
    before = {path: path.stat().st_mtime_ns for path in tmp_path.glob("cost/*/result.json")}
    said = command(*words, "--target", "1e-13", expect=3).splitlines()
    assert "No settings keep 1e-11 %: the smallest error" in said[-2]
    assert not any(line.startswith("--set") for line in said)
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())


def test_a_target_that_is_none_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.toml").write_text(TINY)
    assert "a relative error is needed" in command("cost", "tiny.toml", "--target", "good", expect=2)
    command("cost", "tiny.toml", "--target", "1%", "--parameters", "cutoff", expect=2, says="layers, precision")
    assert [p.name for p in tmp_path.iterdir()] == ["tiny.toml"]


def test_the_cheapest_within_each_target():
    made = made_up({"timestep": [(1.76e-2, 2.0), (4.4e-3, 4.0), (1.1e-3, 8.0)]}, others=0.0)
    for row, seconds in ((made.rows[1], 9.0), (made.rows[-1], 10.0)):  # the scene and the best value: no error
        row.seconds = seconds
    made.compare()
    assert [row.label for row in made.cheapest["state"]] == ["0", "1", "as it is"]
    assert made.rows[4].front["state"] and not made.rows[-1].front["state"]
    assert len(report_cost.csv_of(made).splitlines()) == 1 + len(made.rows)


def settings(directory):
    """The scene's parameters without the times and what follows from them."""
    return [{k: v for k, v in row.items() if "front" not in k and k != "ratio"}
            for row in rows(directory / "cost.csv") if row["parameter"] != "combination"]


def test_cost_runs_stops_and_goes_on(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.toml").write_text("[surface]\nsites = 16\nrms = 0.3\n[block]\nthickness = 8\n"
                                        "[drive]\nvelocity = 60\ntimestep = 20\n")
    for wrong, says in ((["--parameters", "layer"], "this scene has cutoff"), (["--jobs", "0"], "is no number"),
                        (["--set", "drive.temperature=300"], "those of their noise")):
        command("cost", "tiny.toml", *wrong, "--out", "bad", expect=2, says=says)
    command("cost", "tiny.toml", "--out", "bad", expect=2, env={"OMPI_COMM_WORLD_SIZE": "2"})
    assert [p.name for p in tmp_path.iterdir()] == ["tiny.toml"]
    words = ["cost", "tiny.toml", "--parameters", "timestep,precision", "--progress", "off", "--out"]
    said = command(*words, "whole", "--jobs", "2")
    assert "Cheapest for the whole path" in said
    for name in ("cost.csv", "cost-state.svg", "cost-path.svg", "cost-path.png"):
        assert (tmp_path / "whole" / name).stat().st_size > 0
    # Killed after a while, it goes on with what is there, and nothing is run twice.
    result = tmp_path / "cut/scene/result.json"
    with started(*words, "cut"):
        wait_for(result.exists)
    before = result.stat().st_mtime_ns
    assert "are there already" in command(*words, "cut")
    assert result.stat().st_mtime_ns == before and settings(tmp_path / "whole") == settings(tmp_path / "cut")
