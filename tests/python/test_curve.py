# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force curves: indenters against closed forms and limits, reading, fits of synthetic curves, and `asperity curve`."""

import functools
import json
import math
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.maps.force_curves import read_force_curves
from asperity.studies.curve_fit import Unfit, compared, correlated, fit, regions
from asperity.studies.curves import Question, curves_of, missed, question_of
from asperity.theories.indentation import Indenter, path
from conftest import command
from following import followed, not_followed

pytestmark = pytest.mark.usefixtures("light_module")

SOURCES = ("maps/force_curves.py", "studies/curves.py")
EXCUSED = {"is in no format that is read without afmformats": "a package to be installed",
           "holds no force curve": "a map without any", "of the cantilever...export it as text": "a file that lacks more"}
RADIUS, MODULUS, WORK, STIFFNESS, CONTACT = 20.0, 3.0, 0.05, 2.0, 123.0
TIP = Indenter("paraboloid", RADIUS)


def by_jkr(stiffness=STIFFNESS):
    """JKR's sphere on a cantilever by its equations: heights of the drive over the point of contact, and forces, up to the jump."""
    a = np.linspace(1e-3, 20, 400000)[::-1]
    force = 4 * MODULUS * a**3 / (3 * RADIUS) - np.sqrt(8 * math.pi * WORK * MODULUS * a**3)
    height = -(a * a / RADIUS - np.sqrt(2 * math.pi * WORK * a / MODULUS)) - force / stiffness
    jump = int(np.argmax(height))
    return height[:jump], force[:jump]


@functools.cache
def measured(model, noise=0.01, count=1000, seed=1, most=10.0, lam=1.0):
    """Height, force and direction of a synthetic curve with offset and tilt; noise over the pull-off force."""
    draw, parts = np.random.default_rng(seed), []
    for retracting in (False, True):
        at, held = by_jkr() if model == "jkr" else path(TIP, model, MODULUS, WORK, 2 * most, lam).on_drive(STIFFNESS)
        height = np.linspace(30, np.interp(-most, -held, at), count)
        force = np.where(height < (at[-1] if retracting else 0.0), np.interp(height, at, held), 0.0)
        force = force + 0.3 + 0.004 * height + noise * 1.5 * math.pi * WORK * RADIUS * draw.normal(size=count)
        parts.append((height + CONTACT, force, np.full(count, retracting)))
    (h, f, _), (hr, fr, _) = parts
    return np.r_[h, hr[::-1]], np.r_[f, fr[::-1]], np.r_[np.zeros(count), np.ones(count)]


def text_of(height, force, way, head="height (nm), force (nN), retraction"):
    return head + "\n" + "".join(f"{h:.8g}, {f:.8g}, {w:g}\n" for h, f, w in zip(height, force, way))


def test_closed_forms():
    """Pull-off forces of JKR, DMT and Kendall; Sneddon's sphere, cone and pyramid; all by their formulas."""
    assert path(TIP, "jkr", MODULUS, WORK, 5).force.min() == pytest.approx(-1.5 * math.pi * WORK * RADIUS, rel=1e-5)
    assert path(TIP, "dmt", MODULUS, WORK, 5).force.min() == pytest.approx(-2 * math.pi * WORK * RADIUS, rel=1e-12)
    punch = path(Indenter("punch", 10), "jkr", MODULUS, WORK, 5)
    assert punch.force.min() == pytest.approx(-math.sqrt(8 * math.pi * WORK * MODULUS * 1000), rel=1e-12)
    assert np.allclose(punch.force, 2 * MODULUS * 10 * punch.depth)
    for shape, angle, factor in (("cone", 60, 2 / math.pi), ("pyramid", 35, 0.7453)):
        one = path(Indenter(shape, angle), "hertz", MODULUS, 0, 5)
        assert np.allclose(one.force, factor * MODULUS * math.tan(math.radians(angle)) * one.depth**2)
    sphere = path(Indenter("sphere", RADIUS), "hertz", MODULUS, 0, 300)
    a, R = sphere.radius[1:], RADIUS
    assert np.allclose(sphere.depth[1:], a / 2 * np.log((R + a) / (R - a)))
    exact = MODULUS * ((a * a + R * R) / 2 * np.log((R + a) / (R - a)) - a * R)
    assert np.allclose(sphere.force[1:][a > 1], exact[a > 1], rtol=1e-6) and sphere.force[-1] > 300
    assert sphere.force[1] == pytest.approx(4 / 3 * MODULUS * a[0] ** 3 / R, rel=1e-6)
    cone = path(Indenter("cone", 60), "jkr", MODULUS, WORK, 5)  # dF/da = 0: (π E*/tan α) a = 1.5 √(8πwE* a)
    a = 9 / 4 * 8 * WORK * math.tan(math.radians(60)) ** 2 / (math.pi * MODULUS)
    least = math.pi / 2 * MODULUS * a * a / math.tan(math.radians(60)) - math.sqrt(8 * math.pi * WORK * MODULUS * a**3)
    assert cone.force.min() == pytest.approx(least, rel=1e-4)


def test_maugis_between_dmt_and_jkr():
    at = np.linspace(0.1, 0.5, 9)

    def force(one):
        begin = int(np.argmin(one.depth))
        return np.interp(at, one.depth[begin:], one.force[begin:])

    jkr, dmt = (force(path(TIP, model, MODULUS, WORK, 15)) for model in ("jkr", "dmt"))
    assert np.allclose(force(path(TIP, "maugis", MODULUS, WORK, 15, 50.0)), jkr, atol=2e-3)
    near = [np.abs(force(path(TIP, "maugis", MODULUS, WORK, 15, lam)) - dmt).max() for lam in (1e-2, 1e-4, 1e-6)]
    assert near[0] > 6 * near[1] > 36 * near[2] and near[2] < 0.01  # as √λ
    for low, high in ((0.1, 0.5), (0.5, 2.0)):
        pulls = [path(TIP, "maugis", MODULUS, WORK, 1, lam).force.min() for lam in (low, high)]
        assert -2 < pulls[0] / (math.pi * WORK * RADIUS) < pulls[1] / (math.pi * WORK * RADIUS) < -1.5


def test_the_cantilever_holds_what_is_stable():
    """A soft cantilever holds the force down to the pull-off force, a stiff one the depth down to the least."""
    one = path(TIP, "jkr", MODULUS, WORK, 5)
    height, force = one.on_drive(1e-3)
    assert np.all(np.diff(height) > 0) and force[-1] == pytest.approx(one.force.min(), rel=1e-4)
    height, force = one.on_drive(1e4)
    assert -height[-1] - force[-1] / 1e4 == pytest.approx(one.depth.min(), rel=1e-3)


@pytest.mark.parametrize("model, lam", [("jkr", None), ("dmt", None), ("maugis", 1.0)])
def test_synthetic_curves_give_their_numbers_back(model, lam):
    """JKR's curve is made by its own equations; deviations over errors have no bias and a spread of about one."""
    found = []
    for seed in range(4):
        height, force, way = measured(model, seed=seed)
        one = compared(TIP, regions(height[way == 1][::-1], force[way == 1][::-1]), STIFFNESS, model, parameter=lam)
        found.append([math.log(one.work / WORK) / one.of_fit[0], math.log(one.modulus / MODULUS) / one.of_fit[1]])
        assert one.of_fit[0] < 0.15 and one.of_fit[1] < 0.1 and one.stated.values["contact"] == pytest.approx(CONTACT, abs=0.15)
    found = np.array(found)
    assert np.abs(found).max() < 3.5 and np.all(np.abs(found.mean(0)) < 3 / math.sqrt(len(found))), found


def test_an_unknown_range_is_in_the_error():
    """The shape of a curve in contact hardly tells JKR from DMT, whose works differ by a third: the error covers both."""
    height, force, way = measured("jkr", count=800)
    found = regions(height[way == 1][::-1], force[way == 1][::-1])
    free, known = compared(TIP, found, STIFFNESS), compared(TIP, found, STIFFNESS, "jkr")
    assert free.of_model[0] > 0.05 > known.of_model[0] == 0.0
    assert abs(math.log(free.work / WORK)) < 2 * math.hypot(free.of_fit[0], free.of_model[0])
    assert free.parameter[1] < 0.1 and free.parameter[2] > 3


@pytest.mark.parametrize("model, lam, wrong, right", [("jkr", 1.0, {"dmt", "maugis 0.05", "maugis 0.1"}, {"jkr", "maugis 6.4"}),
                                                      ("maugis", 0.1, {"jkr", "maugis 0.8", "maugis 3.2"}, {"maugis 0.1"}),
                                                      ("dmt", 1.0, {"jkr", "maugis 0.4", "maugis 6.4"}, {"dmt"})])
def test_a_wrong_model_is_recognised(model, lam, wrong, right):
    """With a noise of 0.2 % the data exclude models whose λ is far from that of the curve, and none that is near; with 5 % they exclude none."""
    height, force, way = measured(model, noise=0.002, count=2000, lam=lam)
    told = compared(TIP, regions(height[way == 1][::-1], force[way == 1][::-1]), STIFFNESS)
    assert set(told.excluded) >= wrong and not set(told.excluded) & right, told.worse_by
    assert abs(math.log(told.work / WORK)) < 2 * math.hypot(told.of_fit[0], told.of_model[0]) and told.modulus == pytest.approx(MODULUS, rel=0.03)
    height, force, way = measured(model, noise=0.05, lam=lam)
    assert not compared(TIP, regions(height[way == 1][::-1], force[way == 1][::-1]), STIFFNESS).excluded


def test_the_jump_off_contact_is_a_datum():
    """With a noise of 5 % the height at which the tip jumps off contact tells the work to 3 %; into contact, the tip may jump later."""
    height, force, way = measured("jkr", noise=0.05)
    found = [regions(height[way == 1][::-1], force[way == 1][::-1], retracting) for retracting in (True, False)]
    out = fit(TIP, "jkr", found[0], STIFFNESS)
    assert found[0].jump.seen and not found[1].jump.seen and found[1].jump.missed(np.inf) == 0 > found[1].jump.missed(0)
    place, error, _ = found[0].jump
    step = (height[way == 1].max() - height[way == 1].min()) / 999
    assert error == pytest.approx(0.34 * step, rel=0.01) and abs(place - CONTACT - by_jkr()[0][-1]) < 0.51 * step
    assert out.errors["work"] < 0.03 * WORK and abs(out.values["work"] - WORK) < 3 * out.errors["work"] and abs(out.jump) < 3


def test_hertz_and_the_point_of_contact():
    """Without attraction the point of contact and a tilt do not decide the modulus; the wrong shape is told apart by its residuals."""
    place, held = path(TIP, "hertz", MODULUS, 0, 20).on_drive(STIFFNESS)
    height = np.linspace(40, np.interp(-15, -held, place), 1500)
    clean = np.where(height < 0, np.interp(height, place, held), 0.0)
    force = clean - 0.7 + 0.02 * height + 0.02 * np.random.default_rng(2).normal(size=1500)
    one = compared(TIP, regions(height + 50, force), STIFFNESS)
    assert one.stated.model == "hertz" and one.modulus == pytest.approx(MODULUS, abs=3 * MODULUS * one.of_fit[1]) and one.of_fit[1] < 0.01
    assert one.stated.values["tilt"] == pytest.approx(0.02, abs=1e-3) and one.stated.values["contact"] == pytest.approx(50, abs=0.05)
    wrong = compared(Indenter("cone", 80.0), regions(height + 50, force), STIFFNESS)
    assert wrong.stated.misfit > one.stated.misfit + 100 and wrong.stated.slack > 5
    waves = force + 0.1 * np.sin(2 * np.pi * height / 12)
    with_wave = compared(TIP, regions(height + 50, waves), STIFFNESS, "hertz", period=12.5)
    assert with_wave.stated.values["period"] == pytest.approx(12, rel=0.01)
    assert with_wave.modulus == pytest.approx(MODULUS, abs=4 * MODULUS * with_wave.of_fit[1])
    with warnings.catch_warnings(), pytest.raises(Unfit, match="stands still"):
        warnings.simplefilter("error")
        regions(np.full(500, 100.0), np.linspace(0, 5, 500))
    for nothing in (np.zeros(500), np.linspace(0, 5, 500)):
        with pytest.raises(Unfit):
            regions(np.linspace(100, 0, 500), nothing + 0.01 * np.random.default_rng(0).normal(size=500))


def test_correlated_residuals_count_less():
    draw = np.random.default_rng(0).normal(size=4000)
    assert 1 <= correlated(draw) < 1.2
    assert 7 < correlated(np.convolve(draw, np.ones(10) / 10, "valid")) < 12


HEIGHT, FORCE, WAY = measured("dmt", count=60)


@pytest.mark.parametrize("text, given", [
    (text_of(HEIGHT, FORCE, WAY), {"stiffness": "2 N/m"}),
    (text_of(1e-3 * HEIGHT, 1e-3 * FORCE, WAY, "Z [µm],F [µN],segment"), {"stiffness": "2 N/m"}),
    (text_of(-HEIGHT, FORCE, WAY, "# piezo (nm), force (nN), segment"), {"stiffness": "2000 pN/nm"}),
    (text_of(HEIGHT, FORCE / STIFFNESS, WAY, "drive (nm), deflection (nm), segment"), {"stiffness": "2 N/m"}),
    (text_of(HEIGHT, FORCE / STIFFNESS / 50, WAY, "drive (nm), deflection (V), segment"), {"stiffness": "2 N/m", "sensitivity": "50 nm/V"}),
    (text_of(HEIGHT + FORCE / STIFFNESS, FORCE, WAY, "tip-sample separation (nm), force (nN), segment"), {"stiffness": "2 N/m"}),
    (text_of(HEIGHT, FORCE, WAY).replace(", ", ";").replace(".", ","), {"stiffness": "2 N/m"})],
    ids=["plain", "units", "sign", "deflection", "volts", "separation", "commas"])
def test_a_text_is_read(tmp_path, text, given):
    file = tmp_path / "curve.txt"
    file.write_text(text)
    (one,), refused = read_force_curves(str(file), **given)
    assert not refused and one.stiffness == 2 and np.allclose(np.abs(one.height), np.abs(HEIGHT), rtol=1e-6)
    assert np.allclose(one.force, FORCE, atol=1e-6) and one.retracting.sum() == 60
    near, far = one.height[one.force > 8].mean(), one.height[:20].mean()
    assert near < far


@pytest.fixture()
def formats(monkeypatch):
    """A stand-in for afmformats: what it returns for a file is what the file says."""
    class Missing(Exception):
        pass

    class Curve(dict):
        metadata = {"spring constant": 2.0, "position x": 1e-6, "position y": 2e-6}

        @property
        def columns(self):
            return list(self)

    def load_data(file, meta_override=None):
        kind = Path(file).read_text()
        if kind == "damaged":
            raise ValueError("what is\n this?")
        if kind == "unsaid" and not meta_override:
            raise Missing("Please specify sensitivity and spring constant!")
        curves = []
        for k in range(3):
            height, force, way = measured("dmt", seed=k)
            curves.append(Curve({"height (measured)": 1e-9 * height, "force": 1e-9 * force, "segment": way}))
            curves[-1].metadata = {**Curve.metadata, "position x": 1e-6 * k, "position y": 1e-6 * k * k}
        return curves[:1] if kind == "one" else [*curves[:2], Curve({"time": np.zeros(3)}), curves[2]]

    module = types.ModuleType("afmformats")
    module.errors = types.SimpleNamespace(MissingMetaDataError=Missing)
    module.load_data = load_data
    monkeypatch.setitem(sys.modules, "afmformats", module)
    monkeypatch.setitem(sys.modules, "afmformats.errors", module.errors)
    return module


def test_a_map_of_curves(tmp_path, formats, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("map.jpk-force-map").write_text("many")
    found = asperity.curve("map.jpk-force-map", radius="20 nm", model="dmt", nu=0.3)
    assert len(found.curves) == 3 and "has no height or no force" in found.refused[0] and len(found.values("work")) == 3
    work = found.number("work")
    assert work.estimate == pytest.approx(found.values("work").mean()) and work.estimate == pytest.approx(50, rel=0.2)
    assert "mean of 3 curves" in str(work) and found.curves[1].measured.place == (1.0, 1.0)
    assert found.number("young").estimate == pytest.approx(0.91 * found.number("modulus").estimate)
    table = Path("results/map-curve/curves.csv").read_text().splitlines()
    assert len(table) == 4 and "work, mJ/m²" in table[0]
    page = Path("results/map-curve/report.html").read_text()
    assert "histogram-work" in page and "map-modulus" in page
    assert "Errors are one standard error" in page and "cantilever 2 N/m" in page and "Not taken" in page

    class Frame(dict):
        attrs: dict = {}

    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=Frame))
    frame = found.frame()
    assert frame.attrs["units"]["work.error"] == "mJ/m²" and list(frame["x"]) == [0.0, 1.0, 2.0]
    assert list(frame["work"]) == list(found.values("work")) and {len(column) for column in frame.values()} == {3}
    fit, points = found.curves[0].fits["retraction"].stated, found.curves[0].frame()
    back = points["retraction"]
    assert list(points["force"][back]) == list(fit.force) and np.allclose(points["residual"][back], fit.force - fit.fitted, equal_nan=True)


def test_a_fit_that_misses_the_curve_is_noted(tmp_path):
    """A paraboloid's curve is none of a cone; with the right shape nothing is noted."""
    place, held = path(TIP, "hertz", MODULUS, 0, 20).on_drive(STIFFNESS)
    height = np.linspace(40, np.interp(-15, -held, place), 600)
    force = np.where(height < 0, np.interp(height, place, held), 0.0) + 0.002 * np.random.default_rng(2).normal(size=600)
    (tmp_path / "a.txt").write_text(text_of(np.r_[height, height[::-1]], np.r_[force, force[::-1]], np.repeat([0, 1], 600)))
    for shape, size, missed_it in (("cone", 80.0, True), ("paraboloid", RADIUS, False)):
        question = Question(Indenter(shape, size), model="hertz")
        found = curves_of(str(tmp_path / "a.txt"), question, "2 N/m", None)
        assert any("times the noise" in note for note in found.notes) == missed_it, (shape, found.notes)


def one_fit(told):
    return told["curves"][0]["fits"]["retraction"]["models"]["jkr"]


def test_the_fitted_tip_is_simulated(tmp_path, monkeypatch):
    """The curve that `tip` computes, fitted for its range, gives numbers whose simulation is that curve again."""
    monkeypatch.chdir(tmp_path)
    given = {"radius": "20 nm", "stiffness": "2 N/m", "range": "0.3 nm"}
    made = asperity.tip(**given, E="3 GPa", nu=0.3, w="50 mJ/m2", sites=24, out="made", load="8 nN", jobs=2)
    draw = np.random.default_rng(0)
    file = Path("tip.csv")
    far = made.drive < 8
    file.write_text(text_of(made.drive[far], made.force[far] + 0.005 * draw.normal(size=far.sum()), made.retracting[far]))
    found = asperity.curve(file, **given, nu=0.3, simulate=True, sites=24, jobs=2)
    for name, truth in (("work", 50), ("modulus", 3 / 0.91)):
        number = found.number(name)
        assert abs(number.estimate - truth) < 2 * number.error + 0.05 * truth, str(number)
    simulated, measured = found.simulated.number("pull_off_force"), found.number("pull_off_force")
    assert simulated.estimate == pytest.approx(measured.estimate, rel=0.1) and found.simulated.contact.stiffness == 2
    own, model = missed(found.curves[0], found.simulated)
    assert own < 0.3 and model < 0.3
    page = Path("results/tip-curve/report.html").read_text()
    assert "The fitted tip, simulated" in page and "In contact it misses the curve by" in page
    assert Path("results/tip-curve/simulated/tip.json").exists() and Path("results/tip-curve/report/simulated.png").exists()
    for shape, more, words in (("cone", {"angle": 60.0, "model": "jkr", "radius": None}, "has no round end"),
                               ("paraboloid", {"model": "hertz"}, "needs a work")):
        with pytest.raises(asperity.SceneError, match=words):
            asperity.curve(file, **{**given, "range": None, "shape": shape, **more}, simulate=True, out=shape)


def test_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("force.csv").write_text(text_of(*measured("jkr")))
    told = json.loads(command("curve", "force.csv", "--radius", "20nm", "--stiffness", "2N/m", "--model", "jkr", "--json"))
    numbers = told["numbers"]
    for name, truth in (("work", 50), ("modulus", 3), ("pull_off_force", 1.5 * math.pi * WORK * RADIUS)):
        assert abs(numbers[name]["value"] - truth) < 3 * numbers[name]["error"] < 0.3 * truth, (name, numbers[name])
    assert numbers["lost"]["value"] > 5 * numbers["lost"]["error"]
    one = told["curves"][0]["fits"]["retraction"]["models"]["jkr"]
    assert np.array(one["covariance"]).shape == (2, 2) and one["points"] > 500
    assert {file.name for file in Path("results/force-curve").iterdir()} >= {"report.html", "curve.json", "curves.csv", "fit.csv"}
    again = asperity.load_curve("results/force-curve")
    for name, number in numbers.items():
        one = again.number(name)
        assert (one.estimate, one.error, one.unit) == (number["value"], number["error"], number["unit"]) and one.name == number["meaning"]
    back = again.curves[0].fits["retraction"]
    assert back.stated.values == one_fit(told)["values"] and 1e3 * back.work == pytest.approx(numbers["work"]["value"])
    assert len(back.stated.height) > 500 and again.question.indenter == TIP and again.curves[0].main is back
    assert len(again.columns()["work"]) == 1
    with pytest.raises(asperity.InputOutputError, match="holds no fitted curves") as error:
        asperity.load_curve("nowhere")
    followed(str(error.value))
    said = command("curve", "force.csv", "--radius", "20nm", "--stiffness", "2N/m", "-o", "again")
    assert "The data allow JKR, Maugis and Dugdale, and exclude DMT" in said and "errors of radius and stiffness" in said


def good_and_bad():
    """What is said, and the call that leads to it and the one that follows the fix: content of the file and arguments."""
    text, two = text_of(HEIGHT, FORCE, WAY), {"stiffness": "2 N/m"}
    tip = {"radius": "20 nm", "model": "dmt", **two}
    return [
        ("--stiffness 0.2N/m", text, {"radius": "20 nm"}, text, tip),
        ("for example --stiffness", text, {**tip, "stiffness": "2"}, text, tip),
        ("for example --sensitivity", text, {**tip, "sensitivity": "2"}, text, {**tip, "sensitivity": "60nm/V"}),
        ("--sensitivity 60nm/V", text_of(HEIGHT, FORCE / 120, WAY, "z (nm), deflection (V), segment"), tip,
         text_of(HEIGHT, FORCE / 120, WAY, "z (nm), deflection (V), segment"), {**tip, "sensitivity": "60nm/V"}),
        ("write it behind the name", text.replace("height (nm)", "height"), tip, text, tip),
        ("measure it again", "\n".join(text.splitlines()[:12]), tip, text, tip),
        ("for example radius", text, {**tip, "radius": "20"}, text, tip),
        ("for example --radius", text, {**two}, text, tip),
        ("for example --angle 35", text, {"shape": "cone", "model": "hertz", **two}, text,
         {"shape": "cone", "angle": 35.0, "model": "hertz", **two}),
        ("leave it out, or choose another --shape", text, {**tip, "angle": 35.0}, text, tip),
        ("for example --angle", text, {"shape": "pyramid", "angle": 95.0, **two}, text, {"shape": "pyramid", "angle": 35.0, "model": "hertz", **two}),
        ("take --model", text, {**tip, "shape": "cone", "radius": None, "angle": 35.0}, text, tip),
        ("for example --poisson", text, {**tip, "poisson": 0.7}, text, {**tip, "poisson": 0.3}),
        ("leave it out, or take --model", text, {**tip, "range": "1 nm"}, text, {**tip, "model": "maugis", "range": "1 nm"}),
        ("look at the curve", text_of(HEIGHT, 0 * FORCE, WAY), tip, text, tip)]


@pytest.mark.parametrize("case", good_and_bad(), ids=lambda case: case[0][:30])
def test_a_fix_of_a_force_curve(tmp_path, monkeypatch, case):
    says, text, given, right, better = case
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "afmformats", None)
    Path("a.txt").write_text(text)
    Path("b.txt").write_text(right)

    def fit(file, **options):
        defaults = {"shape": "paraboloid", "model": "auto", **dict.fromkeys(("radius", "angle", "poisson", "range", "interference"))}
        cantilever = {name: options.pop(name, None) for name in ("stiffness", "sensitivity")}
        return curves_of(file, question_of({**defaults, **options}), **cantilever)

    with pytest.raises(asperity.Error) as error:
        fit("a.txt", **given)
    said = str(error.value)
    assert says in said, said
    assert fit("b.txt", **better).curves
    followed(said)


def test_foreign_files_are_refused_in_a_line(tmp_path, monkeypatch, formats):
    monkeypatch.chdir(tmp_path)
    for name, content in (("a.jpk-force", "damaged"), ("b.jpk-force", "unsaid"), ("c.nid", "x"), ("d.ibw", "one")):
        Path(name).write_text(content)
    for name in ("a.jpk-force", "b.jpk-force", "c.nid"):
        with pytest.raises(asperity.InputOutputError) as error:
            asperity.curve(name, radius="20 nm")
        assert str(error.value).count("\n") == 2 and name in str(error.value)
        followed(str(error.value))
    assert asperity.curve("d.ibw", radius="20 nm", model="dmt").curves
    assert asperity.curve("b.jpk-force", radius="20 nm", model="dmt", stiffness="2 N/m", sensitivity="60 nm/V").curves
    with pytest.raises(asperity.SceneError, match="Curves: has no number .nothing."):
        asperity.curve("d.ibw", radius="20 nm", model="dmt", out="again").number("nothing")
    monkeypatch.setitem(sys.modules, "afmformats", None)
    with pytest.raises(asperity.InputOutputError, match="afmformats"):
        asperity.curve("d.ibw", radius="20 nm", out="third")
    with pytest.raises(asperity.InputOutputError, match="no such file|No such file|cannot be read"):
        asperity.curve("nowhere.ibw", radius="20 nm")


def test_every_message_is_followed():
    left = not_followed(SOURCES, EXCUSED)
    assert not left, "\n".join(left)
