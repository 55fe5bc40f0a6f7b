# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A tip on a cantilever: the smooth sphere's theory, the call and the command, and what is no tip."""

import json
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.reports import tip as report_tip
from asperity.results.result import Values
from asperity.studies.forecast import Forecast, Size
from asperity.studies.tip import Contact, _fitted, fold, plan_of
from asperity.theories.indentation import Indenter, path
from asperity.theories.sphere import jkr
from asperity.theories.tip_shape import TipShape, measured_tip
from conftest import ROOT, command, in_this_process

sys.path.insert(0, str(ROOT / "scenes/validation"))
import tips

pytestmark = pytest.mark.usefixtures("light_module")

GIVEN = {"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2", "stiffness": "2 N/m"}
OPTIONS = [word for name, value in GIVEN.items() for word in (f"--{name}", str(value))]
SITES = 28
NOT_GIVEN = {**dict.fromkeys(("radius", "angle", "tip_map", "load", "range", "size", "unit", "channel", "sites", "error",
                             "hardness")), "shape": "sphere"}
"""Arguments of plan_of() that have defaults in tip()."""


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
    page = (place / "smooth/report.html").read_text()
    for part in ("gap-", "Force curve", "The contact at zero load", "To quote", "sphere of 20 nm", "How to cite", "commit", "The scene",
                 "displacement_step", "largest attraction on the way out", "Tabor"):
        assert part.rstrip("-") in page, part
    assert {"force-drive.svg", "force-tip.svg", "pressure.svg", "gap.svg"} <= {one.name for one in (place / "smooth/report").iterdir()}
    assert "5." in str(found)
    assert str(pulled).startswith("F_pull-off = 5.") and "F_{pull-off}" not in report_tip.text_of(found)


def test_the_expected_error_is_that_of_the_runs(smooth, tmp_path):
    found, _ = smooth
    plan = plan_of(None, tmp_path / "plan", {**NOT_GIVEN, **GIVEN, "range": "0.3 nm", "sites": SITES})
    pulled = found.number("pull_off_force")
    assert 0.1 * plan.expected < pulled.error / pulled.estimate < 2 * plan.expected < 0.2


def test_errors_cover_what_rings_give(smooth, tmp_path):
    """Bodies of revolution on the same spring, which share nothing with the program; a soft contact, and a stiff one, whose
    attraction is far wider than the contact. All twelve of tips.py: docs/data/tables/tips.csv."""
    stiff = asperity.tip(**tips.TIPS["stiff"], sites=24, out=tmp_path / "stiff", jobs=2)
    for found, load in ((smooth[0], 4.7), (stiff, 14.0)):
        truth = tips.of_rings(found.contact, load, heights=150)
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


def test_a_time_that_is_not_known_is_said():
    lines = Forecast("scan", Path("out"), 4, 4, math.nan, sizes=[Size("the tip", 24, 20.0, math.nan)]).lines
    assert "not known" in lines[0] and "a time that is not known" in lines[1]


@pytest.mark.parametrize("name", tips.TIPS)
def test_a_box_holds_the_attraction(tmp_path, name):
    """A rigid sphere's attraction outside a square of the half width h is 2πRw less that inside, erf(h/√(2Rρ))² of it."""
    given = NOT_GIVEN | tips.TIPS[name]
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
    loaded = asperity.load_tip(place / "smooth")
    for n in found.numbers:
        assert loaded.number(n.path).cells == n.cells and str(loaded.number(n.path)) == str(n)
    assert np.allclose(loaded.force, found.force) and (loaded.retracting == found.retracting).all() and loaded.notes == found.notes
    assert loaded.fit.work == found.fit.work and loaded.contact == found.contact and loaded.result.edge == found.result.edge
    with pytest.raises(asperity.InputOutputError, match="holds no contact of a tip"):
        asperity.load_tip(place)
    for shape in (TipShape("cone", 5.0, 0.5), TipShape("measured", 7.0, half=20.0)):
        assert TipShape.loaded(json.loads(json.dumps(shape.saved()))) == shape
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


def test_the_sites_follow_the_error(tmp_path, monkeypatch):
    """Half the error takes twice the sites; an error that this computer cannot reach is refused with one that it can."""
    given = {**NOT_GIVEN, **GIVEN, "range": "0.3 nm"}
    plans = [plan_of(None, tmp_path / name, {**given, "error": name}) for name in ("1%", "0.8%")]
    assert all(plan.expected <= plan.asked_error for plan in plans) and plans[0].spacing > plans[1].spacing
    assert plans[0].expected > 0.4 * plans[0].asked_error
    smooth, rough = (plans[0].contact.expected_error(0.1, 0.3, curvature) for curvature in (0.0, 1.0))
    assert rough > 2 * smooth and plans[0].contact.expected_error(0.2, 0.3, 1.0) == pytest.approx(2 * rough, rel=0.05)
    monkeypatch.setattr("os.sysconf", {"SC_PHYS_PAGES": 2**14, "SC_PAGE_SIZE": 2**12}.get)
    with pytest.raises(asperity.SceneError, match="is not reached on this computer") as refused:
        plan_of(None, tmp_path / "none", {**given, "error": "0.6%"})
    reachable = re.search(r"--error (\d+%)", str(refused.value))[1]
    assert plan_of(None, tmp_path / "there", {**given, "error": reachable}).expected <= 0.01 * float(reachable[:-1])


def test_an_error_above_the_asked_one_says_what_to_do(smooth):
    from asperity.studies.tip import Plan, _missed

    found, place = smooth
    plan = Plan({"": place / "smooth/tip.toml"}, found.contact, 5.0, 0.3, [], "", 0.7, 0.0, 0.02, 1e-4)
    (note,) = _missed(plan, found.number("pull_off_force"))
    share = found.number("pull_off_force").error / found.number("pull_off_force").estimate
    assert "in place of 0.01 %" in note and int(re.search(r"--sites (\d+)", note)[1]) == pytest.approx(SITES * share / 1e-4, abs=2)
    plan.asked_error = None
    assert _missed(plan, found.number("pull_off_force")) == []


def brute_rise(slopes, radius, x, y):
    """The surface of a sharp tip with these slopes, rounded by a ball: the highest of its tangent planes."""
    return max(gx * x + gy * y - radius * (math.sqrt(1 + gx * gx + gy * gy) - 1) for gx, gy in slopes)


def test_tips_that_are_no_spheres():
    """Rounded pyramid and cone by all their tangent planes; the force on a sharp cone, and on a blunt one, by JKR's closed forms."""
    s, parts = 0.6, np.linspace(0, 1, 81)
    discs = [(s * a * math.cos(t), s * a * math.sin(t)) for a in parts for t in np.linspace(0, 2 * math.pi, 121)]
    squares = [(i * s * a * b, j * s * a * (1 - b)) for a in parts for b in parts for i in (1, -1) for j in (1, -1)]
    for kind, slopes in (("cone", discs), ("pyramid", squares)):
        tip = TipShape(kind, 2.0, s)
        for x, y in ((0.3, 0.2), (1.5, 0.1), (1.1, -1.4), (-4.0, 1.0), (3.0, 3.0), (0.0, -5.0)):
            assert float(tip.rise(np.array(x), np.array(y))) == pytest.approx(brute_rise(slopes, 2.0, x, y), abs=2e-3), (kind, x, y)
    sharp = TipShape("cone", 0.01, 1 / math.tan(math.radians(70)))
    a, depth, force = sharp.contact(3.0, 0.05, 5.0)
    by_jkr = path(Indenter("cone", 70), "jkr", 3.0, 0.05, 5.0)
    assert force.min() == pytest.approx(by_jkr.force.min(), rel=2e-3)
    some = np.linspace(0.2, 0.9, 5) * by_jkr.radius[-1]
    assert np.allclose(np.interp(some, a, force), np.interp(some, by_jkr.radius, by_jkr.force), atol=0.01)
    assert np.allclose(np.interp(some, a, depth), np.interp(some, by_jkr.radius, by_jkr.depth), atol=0.02)
    round_end = Contact(20.0, 3.3, 0.05, 0.3, 0.2, TipShape("pyramid", 20.0, 0.7))
    assert round_end.pull_off_by_jkr() == pytest.approx(1.5 * round_end.unit, rel=0.02)
    assert round_end.radius_at(0.0) == pytest.approx(round_end._replace(shape=None).radius_at(0.0), rel=0.02)
    blunt = Contact(2.0, 3.3, 0.05, 0.3, 0.2, TipShape("cone", 2.0, 0.3))
    assert blunt.radius_at(1.0) > 1.5 * blunt._replace(shape=None).radius_at(1.0) and blunt.widest == math.inf


def test_a_measured_tip(tmp_path):
    """Its apex is found between the pixels, the way up does not matter, and noise of a pixel does not move it."""
    pixel, (x, y) = 0.5, np.meshgrid((np.arange(101) - 47.3) * 0.5, (np.arange(101) - 52.6) * 0.5)
    tip = TipShape("cone", 20.0, 0.6)
    heights = 7.0 - tip.rise(x, y) + 0.005 * np.random.default_rng(0).normal(size=x.shape)
    for sign in (1.0, -1.0):
        found, notes = measured_tip(sign * heights, pixel)
        assert found.radius == pytest.approx(20, rel=0.05) and bool(notes) == (sign < 0) and found.half == pytest.approx(23.65, abs=0.3)
        at = np.linspace(-8, 8, 9)
        assert np.allclose(found.rise(at, 0.5 * at), tip.rise(at, 0.5 * at), atol=0.05)
    np.save(tmp_path / "tip.npy", heights)
    with pytest.raises(asperity.SceneError, match="export it in a format"):
        plan_of(None, tmp_path / "out", {**NOT_GIVEN, **GIVEN, "radius": None, "tip_map": str(tmp_path / "tip.npy")})
    assert not (tmp_path / "out").exists()


def test_a_map_of_a_sphere_is_a_sphere(smooth, tmp_path):
    """A measured tip runs as what it is: of a sphere's map, with the force of the sphere; a cone's end alone as the sphere."""
    at = (np.arange(161) - 80) * 0.25
    x, y = np.meshgrid(at, at)
    np.savetxt(tmp_path / "sphere.txt", np.sqrt(400.0 - np.minimum(x * x + y * y, 399.0)),
               header="Width: 40.25 nm\nHeight: 40.25 nm\nValue units: nm")
    given = {**NOT_GIVEN, **GIVEN, "range": "0.3 nm", "sites": SITES}
    files = [plan_of(None, tmp_path / "map", {**given, "radius": None, "tip_map": str(tmp_path / "sphere.txt")}).scenes["spacing"],
             plan_of(None, tmp_path / "pyramid", {**given, "shape": "pyramid", "angle": 5.0}).scenes["spacing"],
             smooth[1] / "smooth/coarse.toml"]
    forces = [asperity.run(file, {"drive.path": ["height -0.2 nm"]}, tmp_path / f"run{k}").series["force"][-1] for k, file in enumerate(files)]
    assert forces[0] == pytest.approx(forces[2], rel=0.02) and forces[1] == pytest.approx(forces[2], rel=0.02)


@pytest.mark.parametrize("name, value, words", [
    ("radius", "20", "has no unit"), ("radius", "-3 nm", "radius"), ("radius", "0 nm", "out of range"), ("radius", "none", "above zero"),
    ("stiffness", "0 N/m", "stiffness"), ("stiffness", "none", "above zero"),
    ("stiffness", "-1 N/m", "stiffness"), ("stiffness", "0.2", "has no unit"), ("adhesion", "0 mJ/m2", "above zero"), ("young", "3 nm", "young"),
    ("poisson", 0.7, "poisson"), ("load", "5", "no force"), ("load", "-5 nN", "no force"), ("load", "5 GPa", "no force"),
    ("load", "2 µN", "gently sloped"), ("radius", "1 nm", "gently sloped"), ("range", "0.01 nm", "not resolved"),
    ("range", "20 nm", "reaches around"), ("sites", 16, "too few"), ("radius", None, "is missing"), ("shape", "cone", "is missing"),
    ("angle", 60.0, "does not describe a sphere"), ("error", "3", "no share"), ("error", "-1%", "no share"),
    ("tip_map", "tip.npy", "beside a measured tip")])
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
    given = {**NOT_GIVEN, **GIVEN, "range": "0.3 nm", "size": "40 nm", "unit": "nm", "sites": SITES}
    plan = plan_of(str(tmp_path / "map.npy"), tmp_path / "flat", given)
    assert abs(np.load(tmp_path / "flat/tip.npy")).max() < 1e-12
    run = asperity.run(plan.scenes["spacing"], {"drive.path": ["height -0.2 nm"]}, tmp_path / "run")
    same = asperity.run(smooth[1] / "smooth/coarse.toml", {"drive.path": ["height -0.2 nm"]}, tmp_path / "same")
    assert run.series["force"][-1] == pytest.approx(same.series["force"][-1], rel=1e-3)
