# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Numbers with their errors: rules on made-up runs, the parts of a scene, estimates against runs of finer settings."""

import json

import numpy as np
import pytest

import asperity
from asperity.reports import estimate as report_estimate
from asperity.results.result import Values
from asperity.running import program
from asperity.running.pool import DONE, FAILED, Outcome
from asperity.running.scene import scene_file
from asperity.studies import estimate_parts
from asperity.studies.estimate import load_estimate
from asperity.studies.estimate_parts import coarser, finer, limit, mean, plan_of, solved, standard_error, widened
from asperity.studies.quantities import FLAT
from asperity.studies.stated_number import Found, Number, rounded
from asperity.studies.variations import Variation, Variations
from conftest import command

pytestmark = pytest.mark.usefixtures("light_module")

GAMMA, CONTACT = FLAT[0], FLAT[2]
TINY = {"name": "tiny", "surface": {"sites": 32, "rms": 0.6}, "block": {"thickness": 32}, "drive": {"path": ["relax"]}}


@pytest.mark.parametrize("order", [1, 2])
def test_a_known_order_leads_to_the_limit(order):
    def at(h):
        return 70.0 - 3.0 * h**order

    assert finer(2, order)(GAMMA, at(1), np.array([at(0.5)]), [])[0] == pytest.approx(3.0)
    assert coarser(2, order)(GAMMA, at(1), np.array([at(2)]), [])[0] == pytest.approx(3.0)
    # What lies beyond the runs is counted as the error, in full.
    assert finer(2, order)(GAMMA, at(1), np.array([at(0.5)]), []).error == pytest.approx(at(0) - at(0.5))
    assert coarser(2, order)(GAMMA, at(1), np.array([at(2)]), []).error == pytest.approx(3.0)


def test_the_order_of_a_spacing_is_that_of_the_quantity():
    assert finer(2)(GAMMA, 0.0, np.array([3.0]), []).shift == pytest.approx(4.0)
    assert finer(2)(CONTACT, 0.0, np.array([3.0]), []).shift == pytest.approx(6.0)


def test_what_a_better_setting_changes_is_a_shift():
    assert limit(GAMMA, 70.0, np.array([71.5, 71.4]), []) == (pytest.approx(1.4), pytest.approx(0.1))
    stated = [Values({"binding_energy_uncertainty": 0.2})]
    assert solved(GAMMA, 70.0, np.array([70.05]), stated) == (pytest.approx(0.05), pytest.approx(0.2))
    assert solved(CONTACT, 0.5, np.array([0.49]), stated) == (pytest.approx(-0.01), pytest.approx(0.01))


def test_twice_the_standard_error_of_few_surfaces_holds_their_mean():
    draw = np.random.default_rng(1)
    for n in (3, 8):
        samples = draw.normal(70.0, 2.0, (4000, n))
        held = np.mean([abs(s.mean() - 70.0) <= 1.96 * standard_error(s) for s in samples])
        assert held == pytest.approx(0.95, abs=0.012), n
    values = np.array([1.0, 3.0, 5.0])
    assert mean(GAMMA, 1.0, values[1:], []) == (2.0, standard_error(values))


def test_a_width_is_continued_and_carries_the_scatter():
    here, factor = [70.0, 70.2], 1 / (2**1.5 - 1)
    seen = widened(2, False)(GAMMA, 70.1, np.array(here + [60.0, 60.1, 60.2]), [])
    assert seen.shift == pytest.approx(10.0 * factor) and seen.error == pytest.approx(seen.shift)
    noisy = widened(2, False)(GAMMA, 70.1, np.array(here + [60.0, 75.0, 73.0]), [])
    assert noisy.shift == pytest.approx(0.7667 * factor, rel=1e-3) and noisy.error > 2 * factor
    wider = widened(2, True)(GAMMA, 70.1, np.array(here + [80.0, 80.1, 80.2]), [])
    assert wider.shift == pytest.approx(10.0 * (1 + factor)) and wider.error == pytest.approx(10.0 * factor)


def parts_of(**sections):
    with scene_file({"surface": {"sites": 32}, **sections}) as file:
        found = program.check(file)
    return {p.name: p for p in plan_of(Variations(found["scene"], found.get("longest_timestep", 0.0)), 4).parts}


def test_a_scene_has_the_parts_that_apply():
    def varied(**sections):
        return [name for name, part in parts_of(**sections).items() if part.rows]

    still = {"path": ["relax"]}
    assert varied(drive=still) == ["convergence", "tail", "thickness", "width", "seeds"]
    assert varied(drive=still, surface={"kind": "flat", "sites": 16}) == ["convergence", "tail", "thickness"]
    assert varied(drive=still, interface={"kind": "wall"}) == ["convergence", "spacing", "thickness", "width", "seeds"]
    assert varied(drive=still, numerics={"precision": "mixed"})[:2] == ["convergence", "precision"]
    assert varied() == ["convergence", "tail", "levels", "timestep", "thickness", "width", "rate", "seeds"]
    assert "levels" not in varied(block={"model": "lattice"})
    sliding = parts_of(drive={"path": ["approach", "slide x 5 Å"]})["tail"].rows  # no tail acts there
    assert [row.setting[-2:] for row in sliding] == [["interface.cutoff=26.24", "interface.tail=false"]]
    assert not parts_of(surface={"sites": 16}, interface={"cutoff": 20.5}, drive=still)["tail"].rows
    finite = parts_of(block={"strain": "finite"})
    assert finite["rate"].rows[0].setting == ["drive.velocity=10"] and finite["tail"].rows[0].setting[0] == "interface.cutoff=13.12"
    # In a path in time all but what belongs to time is varied without it.
    for name, part in parts_of().items():
        if part.rows:
            still = all("drive.mode=quasistatic" in row.setting for row in part.rows)
            assert still == (name not in ("levels", "timestep")), name
    for wrong in ({"drive": {"temperature": 300}}, {"drive": {"max_steps": 10}}):
        with pytest.raises(asperity.SceneError):
            parts_of(**wrong)


def test_a_wider_box_has_the_same_waves():
    rows = parts_of(drive={"path": ["relax"]})["width"].rows
    assert rows[-1].setting == ["surface.sites=16", "block.thickness=16", "surface.rolloff=1.5", "surface.q_max=8", "surface.seed=8"]
    wide = parts_of(drive={"path": ["relax"]}, surface={"sites": 32, "rolloff": 1})["width"].rows[-1].setting
    assert wide == ["surface.sites=64", "block.thickness=64", "surface.rolloff=2", "surface.q_max=32", "surface.seed=4"]


def test_a_part_whose_run_failed_is_named():
    def run(value, status=DONE):
        return Variation("tail", "a run", [], outcome=Outcome(status, Values({"binding_energy": value}), reason="too steep"))

    part = estimate_parts.Part("tail", "truncation", "tail", [run(71.0)], limit, run(70.0))
    assert part.found(GAMMA) == (1.0, 1.0) and part.failed == "" and part.found(CONTACT) is None
    part.rows.append(run(0.0, FAILED))
    assert part.found(GAMMA) is None and "too steep" in part.failed


def test_a_number_is_quoted_with_two_digits_of_its_error():
    for value, error, text in ((71.44, 1.94, ("71.4", "1.9")), (1163.4, 16.2, ("1163", "16")), (-0.00123, 0.0000456, ("-0.001230", "0.000046")),
                               (12345.0, 1234.0, ("12300", "1200")), (5.0, 0.0, ("5", "0"))):
        assert rounded(value, error) == text
    n = Number("binding_energy", "γ_eff", "", "meV/Å^2", 70.0, {"tail": Found(1.5, 0.01), "seeds": Found(0.0, 1.0)})
    assert report_estimate.quote(n) == ("γ_eff = 1146 ± 16 mJ/m² (71.5 ± 1.0 meV/Å²; one standard error), of which ± 16 seeds; "
                                        "corrected by +24 (tail)")


def test_an_estimate_runs_resumes_and_is_read(place):
    made = asperity.estimate(TINY, {"interface.cutoff": 8.2}, "found", seeds=3)
    assert list(made.numbers) == ["binding_energy", "binding_energy_ratio", "contact_fraction"]
    number = made.numbers["binding_energy"]
    assert list(number.parts) == ["convergence", "tail", "thickness", "width", "seeds"]
    assert number.estimate == pytest.approx(number.value + sum(f.shift for f in number.parts.values()))
    # The cutoff of 2.5 r0 against a run with a far larger one.
    fine = asperity.run(TINY, {"interface.cutoff": 41, "interface.tail": "true"}, "fine")
    tail = number.parts["tail"]
    assert tail.shift > 1.0 and abs(number.value + tail.shift - fine.binding_energy) <= 2 * tail.error < 0.2
    seeds = [asperity.load(f"found/{name}").binding_energy for name in ("scene", "seed=2", "seed=3")]
    assert number.parts["seeds"].shift == pytest.approx(np.mean(seeds) - number.value)
    before = {path: path.stat().st_mtime_ns for path in place.glob("found/*/result.json")}
    again = load_estimate("found")
    assert again.numbers == made.numbers and again.quote() == made.quote() and str(again) == str(made)
    asperity.estimate(TINY, {"interface.cutoff": 8.2}, "found", seeds=3)
    assert {path: path.stat().st_mtime_ns for path in place.glob("found/*/result.json")} == before and len(before) == 13
    assert "Budget" in made.report().read_text()


def test_half_of_the_spacing_of_a_wall_leads_to_its_limit(place):
    wall = {"interface.kind": "wall", "interface.range": 1.5, "surface.rms": 1.5, "surface.q_max": 8}
    found = asperity.estimate(TINY, wall, parts=["spacing"]).numbers["binding_energy"]
    fine = asperity.run(TINY, {**wall, "surface.sites": 256, "surface.spacing": 2.6 / 8, "block.thickness": 256})
    assert abs(found.value - fine.binding_energy) > 2 * found.error > 0  # the bias is seen
    assert abs(found.estimate - fine.binding_energy) <= 2 * found.error


def test_a_slide_states_friction_with_a_part_of_the_spacing(place):
    def slid(factor=1):
        return {"surface": {"sites": 16 * factor, "spacing": 40.0 / factor, "rms": 8.0, "q_max": 4, "seed": 3},
                "block": {"young": 0.02, "poisson": 0.48, "thickness": 32 * factor, "prony": [[30.0, "1 ns"]]},
                "interface": {"kind": "wall", "adhesion": 0, "range": 9.0},
                "drive": {"mode": "quasistatic", "control": "mean-height", "load": 2.0, "velocity": 1.0,
                          "path": ["relax", "slide x 64 nm under load until steady"]}}

    found = asperity.estimate(slid(), parts=["convergence", "spacing"], out=place / "slide")
    friction, stress = found.numbers["slide.friction_coefficient"], found.numbers["slide.friction_stress"]
    finer_run = asperity.run(slid(4), out=place / "finer")["segments"][-1]
    assert stress.unit == "MPa" and stress.estimate == pytest.approx(2.0 * friction.estimate, rel=1e-3)
    assert set(friction.parts) == {"convergence", "spacing"}
    assert abs(friction.parts["spacing"].shift) > 2 * friction.error  # the scene's own number is off
    assert abs(finer_run["friction_coefficient"] - friction.estimate) < 2 * friction.error
    area = found.numbers["slide.steady_contact_area"]
    assert abs(finer_run["steady_contact_area"] - area.estimate) < 2 * area.error


def test_the_command(place):
    words = ["estimate", write_tiny(place), "--parts", "tail,thickness", "--progress", "off"]
    assert "4 runs" in command(*words, "--plan", "--out", "planned") and not (place / "planned").exists()
    said = command(*words)
    for text in ("γ_eff = ", "one standard error", "left out: --parts", "plastic flow", "estimate.png"):
        assert text in said
    assert {p.name for p in (place / "results/tiny-estimate").iterdir()} >= {"estimate.json", "estimate.png", "report.html"}
    parts = json.loads((place / "results/tiny-estimate/estimate.json").read_text())["numbers"]["binding_energy"]["parts"]
    assert parts.keys() == {"tail", "thickness"}
    assert "4 are there already" in command(*words)
    command("report", "results/tiny-estimate", says="one page")
    for wrong, says in ((["--parts", "tails"], "this scene has convergence"), (["--seeds", "1"], "from 2 to 1000"),
                        (["--set", "drive.temperature=300", "drive.path=approach"], "those of their noise"),
                        (["--set", "drive.mode=quasistatic", "drive.path=[\"load 100 MPa\"]"], "has no number to estimate")):
        command("estimate", "tiny.toml", *wrong, "--out", "bad", expect=2, says=says)
    assert not (place / "bad").exists()


def test_what_a_solver_leaves_is_no_error_of_a_number(place):
    said = command("run", write_tiny(place), "--out", "run", "--progress", "off",
                   says=["convergence, meV/Å²", "are not included: asperity estimate"])
    assert "±" not in said and "uncertainty" not in said
    page = asperity.load("run").report().read_text()
    assert "convergence: " in page and "Cutoff, spacing, thickness" in page and "±" not in page


def test_what_cannot_be_asked_for_is_refused(place):
    for given in ({"jobs": 0}, {"jobs": True}, {"seeds": 1}, {"parts": "nothing"}):
        with pytest.raises(asperity.SceneError):
            asperity.estimate(TINY, **given)
    assert not list(place.iterdir())
    made = asperity.estimate(TINY, parts="tail", out="tail")
    assert list(made.numbers["binding_energy"].parts) == ["tail"]
    with pytest.raises(asperity.SceneError, match="it has binding_energy, "):
        made.quote("work_of_drive.approach")


def write_tiny(place):
    (place / "tiny.toml").write_text("[surface]\nsites = 32\nrms = 0.6\n[drive]\npath = [\"relax\"]\n")
    return "tiny.toml"


def test_a_path_in_time_is_led_to_the_one_without(place):
    quick = {"surface": {"sites": 16, "rms": 0.5}, "block": {"thickness": 16}, "drive": {"velocity": 40.0, "timestep": 20.0}}
    found = asperity.estimate(quick, parts=["levels", "timestep", "rate"], out="path")
    still = asperity.load("path/mode=quasistatic")
    work = found.numbers["work_of_drive.pull_off"]
    assert set(work.parts) == {"levels", "timestep", "rate"} and abs(work.value - work.estimate) > 1.0
    assert work.estimate == pytest.approx(still.work_of_drive.pull_off)
    assert {"lost.cycle", "pull_off_stress", "work_of_drive.approach"} < set(found.numbers)


def test_a_path_measures_its_lattice_on_a_coarser_one():
    """Which takes a quarter of the sites; the same waves fit on it."""
    wall = {"interface": {"kind": "wall"}, "drive": {"mode": "quasistatic"}, "block": {"thickness": 64}}
    parts = parts_of(surface={"sites": 64, "q_max": 16}, **wall)
    coarse, = parts["spacing"].rows
    assert coarse.setting == ["surface.spacing=5.2", "surface.sites=32", "block.thickness=32", "surface.q_max=16"]
    assert parts["thickness"].base is coarse and "block.thickness=64" in parts["thickness"].rows[0].setting
    assert parts["spacing"].found is not None and parts["seeds"].base is parts["spacing"].base is not coarse
    for more in ({"q_max": 17}, {"q_max": 16, "sites": 62}):
        fine, = parts_of(surface={"sites": 64, **more}, **wall)["spacing"].rows
        assert "surface.spacing=1.3" in fine.setting
