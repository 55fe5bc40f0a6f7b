# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A tip on a cantilever: the smooth sphere's theory, the call and the command, and what is no tip."""

import json
import math
import re
import sys

import numpy as np
import pytest

import asperity
from asperity.reports import tip as report_tip
from asperity.results.result import Values
from asperity.studies.tip import Contact, _fitted, fold, plan_of
from asperity.theories.sphere import jkr
from conftest import ROOT, command, in_this_process

sys.path.insert(0, str(ROOT / "scenes/validation"))
import tips

GIVEN = {"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2", "stiffness": "2 N/m"}
OPTIONS = [word for name, value in GIVEN.items() for word in (f"--{name}", str(value))]
SITES = 28


@pytest.fixture(scope="module")
def smooth(tmp_path_factory):
    place = tmp_path_factory.mktemp("tip")
    return asperity.tip(**GIVEN, sites=SITES, range="0.3 nm", out=place / "smooth", jobs=2), place


def test_a_smooth_tip(smooth):
    found, place = smooth
    pulled, radius = found.number("pull_off_force"), found.number("contact_radius")
    assert found.contact.model == "Maugis"
    # The exponential attraction is not Dugdale's: between JKR and DMT, near Maugis.
    assert 1.5 * found.contact.unit < pulled.estimate < 2 * found.contact.unit
    assert pulled.estimate == pytest.approx(found.contact.pull_off(), rel=0.05)
    hertz = found.contact.radius_at(0.0)
    assert 0.5 * hertz < radius.estimate < hertz
    # What an experimentalist would have found: E* of the sample, and the work that JKR needs for this pull-off.
    assert found.fit.modulus == pytest.approx(found.contact.modulus, rel=0.02)
    assert found.fit.work == pytest.approx(pulled.estimate / (1.5 * math.pi * found.contact.radius), rel=0.01)
    # A spring: the drive is ahead of the tip by the force over the stiffness.
    np.testing.assert_allclose(found.drive - found.tip, -found.force / found.contact.stiffness, atol=2e-3)
    # The loop of the force over the drive is the energy lost: nN nm = aJ.
    inwards, out = ~found.retracting, found.retracting
    loop = sum(np.trapezoid(found.force[part], -found.drive[part]) if hasattr(np, "trapezoid") else
               np.trapz(found.force[part], -found.drive[part]) for part in (inwards, out))
    assert loop == pytest.approx(found.number("lost").value, rel=0.03)
    assert (place / "smooth/report.html").exists() and "5." in str(found)
    assert str(pulled).startswith("F_pull-off = 5.") and "F_{pull-off}" not in report_tip.text_of(found)


def test_errors_cover_what_rings_give(smooth, tmp_path):
    """Bodies of revolution on the same spring, which share nothing with the program; a soft contact, and a stiff one, whose
    attraction is far wider than the contact. All ten of tips.py: docs/data/tables/tips.csv."""
    stiff = asperity.tip(**tips.TIPS["stiff"], sites=24, out=tmp_path / "stiff", jobs=2)
    for found, load in ((smooth[0], 4.7), (stiff, 14.0)):
        truth = tips.of_rings(found.contact, load)
        for number in found.numbers:
            assert abs(number.estimate - truth[number.path]) < 2 * number.error, (number, truth)
        assert found.number("jump_in_distance").error < 0.01 * truth["jump_in_distance"]
    assert stiff.number("pull_off_force").error < 0.05 * truth["pull_off_force"]


def test_a_plan_runs_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, said, _ = in_this_process(["tip", *OPTIONS, "--plan", "--json"])
    plan = json.loads(said)
    assert code == 0 and plan["runs"] == plan["left"] == len(plan["sizes"]) == 4 and not list(tmp_path.rglob("*"))
    assert all(run["sites"] >= 24 and 19 < run["width"] < 30 and run["seconds"] > 0 for run in plan["sizes"])
    assert plan["unstated"] == [] and plan["seconds"] == pytest.approx(sum(run["seconds"] for run in plan["sizes"]))
    soft = ["--radius", "20um", "--young", "1MPa", "--poisson", "0.49", "--adhesion", "20mJ/m2", "--stiffness", "2N/m", "--plan"]
    code, said, _ = in_this_process(["tip", *soft])
    assert code == 0 and "d jump-in, W lost will not be stated" in " ".join(said.split()) and "times as many sites" in said
    assert not list(tmp_path.rglob("*"))


@pytest.mark.parametrize("name", tips.TIPS)
def test_a_box_holds_the_attraction(tmp_path, name):
    """A rigid sphere's attraction outside a square of the half width h is 2πRw less that inside, erf(h/√(2Rρ))² of it."""
    given = dict.fromkeys(("load", "range", "size", "unit", "channel", "sites")) | tips.TIPS[name]
    plan = plan_of(None, tmp_path / name, given)
    for part, file in plan.scenes.items():
        answer = Values(asperity.running.program.check(str(file)))
        assert not answer["problems"] and answer.number("beyond_edges.part", 1.0) < 1.1e-3, part
    keys = Values(asperity.running.program.check(str(plan.scenes[""]))["scene"])
    half = 0.05 * keys.needed("surface.sites") * keys.needed("surface.spacing")
    reach = math.sqrt(2 * plan.contact.radius * plan.contact.range)
    assert half > 1.25 * plan.contact.radius_at(plan.load)
    if plan.contact.parameter < 1:
        assert 2 * (1 - math.erf(half / reach)**2) < 2e-3 * 1.5


def test_a_fold_is_that_of_a_rigid_sphere():
    """F = -2πRw exp(-z/ρ) jumps in at z = ρ ln(2πRw/(kρ)), wherever the last points are."""
    radius, work, rho, stiffness = 30.0, 0.08, 0.3, 0.5
    exact = rho * math.log(2 * math.pi * radius * work / (stiffness * rho))
    for nearest in (0.01, 0.1, 0.3):
        place = exact + np.array([2.0, 1.2, 0.6, 0.0]) + nearest
        force = -2 * math.pi * radius * work * np.exp(-place / rho)
        for degree in (1, 2):
            assert fold(place, force, stiffness, degree) == pytest.approx(exact, abs=2e-3 * rho)
    assert math.isnan(fold(place[:1], force[:1], stiffness, 1)) and math.isnan(fold(place, -force, stiffness, 2))


def test_the_command_says_the_same(smooth):
    found, place = smooth
    code, said, _ = in_this_process(["tip", *OPTIONS, "--sites", str(SITES), "--range", "0.3 nm", "-o", str(place / "smooth"), "--json"])
    assert code == 0
    answer = json.loads(said)
    for n in found.numbers:
        assert answer["numbers"][n.path]["value"] == n.estimate and answer["numbers"][n.path]["error"] == n.error
    assert answer["fit"]["modulus"] == pytest.approx(found.fit.modulus)
    # An alias is the same argument, and nothing runs again.
    again = asperity.tip(radius="20 nm", E="3 GPa", nu=0.3, w="50 mJ/m2", stiffness="2 N/m", sites=SITES, range="0.3 nm", out=place / "smooth")
    assert again.number("lost").value == found.number("lost").value


def test_the_fit_finds_what_jkr_was_made_of():
    contact = Contact(20.0, 4.0, 0.03, 0.3, 1.0)
    a = np.linspace(0.9, 3.0, 60)[::-1]
    force, _, approach = jkr(a)
    for work, modulus, zero in ((0.03, 4.0, 0.0), (0.06, 2.5, 0.4)):
        unit = math.pi * work * contact.radius
        length = (unit * contact.radius / (4 / 3 * modulus)) ** (1 / 3)
        fit = _fitted(contact, zero - approach * length**2 / contact.radius, unit * force)
        assert fit.work == pytest.approx(work, rel=1e-3) and fit.modulus == pytest.approx(modulus, rel=1e-3)
        assert fit.zero == pytest.approx(zero, abs=1e-3) and fit.misfit < 1e-3 * unit


@pytest.mark.parametrize("name, value, words", [
    ("radius", "20", "has no unit"), ("radius", "-3 nm", "radius"), ("radius", "0 nm", "out of range"), ("radius", "none", "above zero"),
    ("stiffness", "0 N/m", "stiffness"), ("stiffness", "none", "above zero"),
    ("stiffness", "-1 N/m", "stiffness"), ("stiffness", "0.2", "has no unit"), ("adhesion", "0 mJ/m2", "above zero"), ("young", "3 nm", "young"),
    ("poisson", 0.7, "poisson"), ("load", "5", "no force"), ("load", "-5 nN", "no force"), ("load", "5 GPa", "no force"),
    ("load", "2 µN", "gently sloped"), ("radius", "1 nm", "gently sloped"), ("range", "0.01 nm", "not resolved"),
    ("range", "20 nm", "reaches around"), ("sites", 16, "too few")])
def test_nonsense_is_refused(tmp_path, monkeypatch, name, value, words):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(asperity.SceneError) as refused:
        asperity.tip(**{**GIVEN, name: value})
    assert words in str(refused.value) and "fix:" in str(refused.value)
    assert not re.search(r"surface\.|drive\.|interface\.|block\.", str(refused.value)), "words of a scene that the user has not written"
    assert not list(tmp_path.rglob("*.toml"))


def test_a_map_is_refused_that_cannot_hold_the_contact(tmp_path):
    np.save(tmp_path / "map.npy", np.random.default_rng(0).normal(size=(32, 32)))
    said = command("tip", "map.npy", *OPTIONS, "--unit", "Å", "--size", "10 nm", cwd=tmp_path, expect=2)
    assert "too small for this contact" in said and "press less" in said
    said = command("tip", "map.npy", *OPTIONS, "--unit", "Å", cwd=tmp_path, expect=2)
    assert "how wide it is" in said and "--size" in said
    assert [path.name for path in tmp_path.iterdir()] == ["map.npy"]


def test_a_flat_map_is_a_smooth_sample(smooth, tmp_path):
    np.save(tmp_path / "map.npy", np.full((64, 64), 3.0))
    given = {**GIVEN, "load": None, "range": "0.3 nm", "size": "40 nm", "unit": "nm", "channel": None, "sites": SITES}
    plan = plan_of(str(tmp_path / "map.npy"), tmp_path / "flat", given)
    assert abs(np.load(tmp_path / "flat/tip.npy")).max() < 1e-12
    run = asperity.run(plan.scenes["spacing"], {"drive.path": ["height -0.2 nm"]}, tmp_path / "run")
    same = asperity.run(smooth[1] / "smooth/coarse.toml", {"drive.path": ["height -0.2 nm"]}, tmp_path / "same")
    assert run.series["force"][-1] == pytest.approx(same.series["force"][-1], rel=1e-3)
