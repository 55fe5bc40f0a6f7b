# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A number that is stated is possible and its error covers it; otherwise there is a reason."""

import json
import math
import re

import numpy as np
import pytest
from scipy.integrate import quad

import asperity
from asperity.maps import missing_waves
from asperity.reports import estimate as report_estimate
from asperity.results.result import Values
from asperity.running.pool import PoolOptions
from asperity.studies.estimate_parts import coarser, finer, stated
from asperity.studies.estimates import Estimate, Estimating, surface_made
from asperity.studies.map_scene import scene_of
from asperity.studies.quantities import CURVED, FLAT
from asperity.studies.stated_number import Found, Number, with_error

SCENE = {"surface": {"sites": 128, "spacing": 10.0, "radius": None}, "interface": {"kind": "wall", "law": "exponential", "range": 3.0},
         "drive": {"load": 0.0, "path": ["approach", "pull-off"]}}


def result(**keys):
    return Values(json.loads(json.dumps({"delta_gamma": 3.12, "scene": {**SCENE, **keys}}), object_hook=Values))


def self_affine(n, edge, hurst, slope, seed, longest=3, largest=None):
    """Heights of a periodic map with waves from `longest` to `largest` periods along the edge."""
    k = n * np.fft.fftfreq(n)
    q = np.hypot(*np.meshgrid(k, k))
    amplitude = np.where((q > 0) & (q <= (largest or n / 2)), np.maximum(q, longest) ** (-1 - hurst), 0)
    power = np.fft.fft2(np.random.default_rng(seed).normal(size=(n, n))) * amplitude
    return np.fft.ifft2(power).real * slope / math.sqrt(((2 * np.pi * q / edge) ** 2 * abs(power / n**2) ** 2).sum())


def test_no_number_leaves_its_range_and_none_is_less_covered():
    """All quantities, whatever their parts add up to."""
    draw = np.random.default_rng(1)
    seen = set()
    for quantity in FLAT + CURVED:
        for _ in range(300):
            n = stated(quantity, "", 0.0, result())
            scale = 1.0 if math.isinf(n.most - n.least) else n.most - n.least
            n.value = float(np.clip(scale * draw.normal(0.0, 0.7), n.least, n.most))
            n.parts = {"spacing": Found(scale * draw.normal(), scale * abs(draw.normal())), "waves": Found(0.0, scale * abs(draw.normal()))}
            truth = float(np.clip(n.corrected + draw.normal() * n.sum_of_errors, n.least, n.most))
            if n.reason:
                assert "not possible" in n.reason and math.isnan(n.estimate) and math.isnan(n.error)
                assert not n.least - 2 * n.sum_of_errors <= n.corrected <= n.most + 2 * n.sum_of_errors
                continue
            up, down = n.sides
            tiny = 1e-9 * scale
            assert n.least - tiny <= n.estimate - down <= n.estimate <= n.estimate + up <= n.most + tiny
            assert abs(n.estimate - truth) <= abs(n.corrected - truth) + 1e-12
            seen.add((n.below == n.below, up < n.error))
    assert len(seen) >= 3
    pressed = stated(FLAT[3], "", 0.0, result(drive={"load": 10.0, "path": ["approach"]}))  # a load may have pressed
    assert pressed.least == -math.inf and pressed.most == math.inf


def test_a_counted_fraction_is_known_to_a_site():
    whole = stated(FLAT[2], "", 1.0, result())
    whole.parts = {"spacing": Found(0.0, 0.0)}
    assert whole.error == 1 / 128**2 and whole.sides == (0.0, 1 / 128**2)
    assert report_estimate.quote(whole) == "A/A₀ = 1.000000 (+0, -0.000061) (one standard error)"
    assert with_error(0.985, 0.015, 0.031) == "0.985 (+0.015, -0.031)" and with_error(70.0, 1.5, 1.5) == "70.0 ± 1.5"


def test_what_does_not_stick_is_said_in_words():
    gamma, contact = (stated(q, u, v, result()) for q, u, v in ((FLAT[0], "meV/Å^2", -2e-5), (FLAT[2], "", 2 / 128**2)))
    gamma.parts, contact.parts = {"places": Found(0.0, 4.4e-4)}, {"spacing": Found(-2.1e-4, 2.1e-4)}
    gamma.unresolved = "no adhesion without load"
    assert report_estimate.quote(gamma) == "γ_eff below 0.015 mJ/m² (0.00088 meV/Å²): no adhesion without load, not resolved"
    assert report_estimate.quote(contact) == "A/A₀ below 0.00042: contact of 2 of 16384 sites, not resolved"
    work = stated(FLAT[3], "meV/Å^2", -1e-5, result())
    work.parts = {"places": Found(0.0, 4.4e-4)}
    assert "w_in above −0.015 mJ/m²" in report_estimate.quote(work) and work.cells == ("> -0.00089", "")


def test_every_form_says_the_same(place):
    numbers = {}
    for i, (value, parts, more) in enumerate(((0.5, {"a": Found(0.6, 0.2)}, {}), (0.1, {"a": Found(-0.2, 0.2)}, {}),
                                              (0.2, {"a": Found(9.0, 0.1)}, {}),
                                              (0.1, {"a": Found(0.0, 0.1)}, {"withheld": "no reason"}),
                                              (0.1, {"a": Found(0.0, 0.01)}, {"bounded": "above all"}))):
        numbers[str(i)] = Number(str(i), f"n{i}", "", "", value, parts, 0.0, 1.0, 1e-4, condition="here", **more)
    made = Estimate("made", numbers, [{"name": "a", "group": "geometry", "what": "", "failed": ""}], [], {}, {}, place)
    (place / "estimate.json").write_text(json.dumps(made.json(), allow_nan=False))
    again = asperity.load_estimate(place)
    texts = [report_estimate.quote(n) for n in again.numbers.values()]
    assert texts == [report_estimate.quote(n) for n in numbers.values()] and "(+0, -0.20)" in texts[0] and str(again.first) in repr(again)
    assert [text.split(" ")[1] for text in texts] == ["=", "below", "is", "is", "below"]
    whole, page = str(again), again.report().read_text()
    for text in [*texts[:2], "n2 is not stated: its parts correct it to 9.2", "n3 is not stated: no reason", "n4 below 0.12 here: above all"]:
        assert text in whole and text in page


def test_a_number_that_changes_its_sign_on_the_way_is_not_extrapolated():
    assert finer(2, 1)(FLAT[2], 0.053, np.array([0.013]), []) == (pytest.approx(-0.04), pytest.approx(0.04))
    assert coarser(2, 1)(FLAT[2], 0.053, np.array([0.2]), []) == (0.0, pytest.approx(0.147))


@pytest.mark.parametrize("hurst", [0.55, 0.7, 0.8, 0.95, 1.2])
def test_the_energy_of_missing_waves_is_its_integral(hurst):
    q1, c1 = 0.07, 400.0
    exact = 0.5 * math.pi * quad(lambda x: q1**3 * c1 * x**2 * x ** (-2 - 2 * hurst), 1, math.inf, epsabs=0, epsrel=1e-10, limit=500)[0]
    assert missing_waves.energy_beyond(hurst, q1, c1) == pytest.approx(exact, rel=1e-4)
    if hurst < 1:  # the same by the slope of the law up to q1
        s2 = 2 * math.pi * c1 * q1**4 * quad(lambda x: x ** (1 - 2 * hurst), 0, 1)[0]
        assert missing_waves.energy_beyond(hurst, q1, c1) == pytest.approx(0.25 * s2 * (2 - 2 * hurst) / ((2 * hurst - 1) * q1), rel=1e-6)


@pytest.mark.parametrize("hurst", [0.3, 0.5])
def test_below_one_half_the_energy_is_counted_to_the_atoms(hurst):
    q1, c1, last = 0.07, 400.0, 2 * math.pi / missing_waves.ATOMS
    exact = 0.5 * math.pi * quad(lambda q: c1 * q**2 * (q / q1) ** (-2 - 2 * hurst), q1, last)[0]
    assert missing_waves.energy_beyond(hurst, q1, c1) == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize("hurst", [0.3, 0.6, 0.8])
def test_the_law_of_a_map_is_found_with_its_error(hurst):
    for n in (64, 128):
        laws = [missing_waves.law_of(self_affine(n, 1000.0, hurst, 0.3, seed), 1000.0, 1000.0 / n) for seed in range(4)]
        off = [(law.hurst - hurst) / law.hurst_error for law in laws]
        assert max(map(abs, off)) < 3.5 and all(law.shortest == pytest.approx(4000.0 / n) for law in laws)
    cut = missing_waves.law_of(self_affine(256, 2000.0, hurst, 0.3, 9, longest=6)[:128, :128], 1000.0, 1000.0 / 128)  # not periodic
    assert abs(cut.hurst - hurst) < 3.5 * cut.hurst_error


def test_waves_that_a_coarse_spacing_leaves_out_are_summed():
    heights = self_affine(128, 1000.0, 0.8, 0.3, 1)
    fine, coarse = (missing_waves.law_of(heights, 1000.0, 1000.0 / n) for n in (128, 64))
    q, c, count, _ = missing_waves.spectrum_of(heights, 1000.0)
    assert (c * count).sum() * (2 * math.pi / 1000) ** 2 == pytest.approx(np.var(heights), rel=0.01)
    assert fine.left_out == 0.0 and fine.beyond == coarse.beyond
    law = missing_waves.energy_beyond(0.8, fine.q1 / 2, fine.c1 * 2**3.6) - missing_waves.energy_beyond(0.8, fine.q1, fine.c1)
    assert coarse.left_out == pytest.approx(law, rel=0.2)
    assert missing_waves.law_of(self_affine(64, 1000.0, 0.8, 0.3, 1, largest=16), 1000.0, 1000.0 / 64) is None  # rolled off
    assert missing_waves.law_of(np.zeros((32, 32)), 100.0, 100.0 / 32) is None


def test_what_missing_waves_could_do_decides_what_is_said():
    law = missing_waves.Law(0.8, 0.05, 100.0, 10.0, 0.6, 1.0, 0.5, 1.5)
    for modulus, relative, says in ((1e-6, 0.002, "negligible"), (1e-4, 0.2, "uncertain by 20 %, and likely too high"), (1e-3, 0.0, "")):
        found = missing_waves.verdict(law, modulus, 4e-3)
        assert found.relative == pytest.approx(relative) and says in found.note and bool(found.withheld) == (not says)
    assert "no limit" in missing_waves.verdict(law._replace(hurst=0.45), 1e-4, 4e-3).withheld
    assert not missing_waves.verdict(law._replace(hurst=0.45), 1e-6, 4e-3).withheld  # as far as atoms it is no matter


def planned(made, place, only=()):
    return Estimating(str(made.file), [], str(place), PoolOptions(progress="off"), None, only, made.also, made.notes, lambda _: None,
                      made.withheld, made.condition)


@pytest.mark.parametrize("points, sites", [(32, 32), (64, 40)])
def test_half_of_the_spacing_has_the_same_waves(place, points, sites):
    np.save("map.npy", self_affine(points, 320.0, 0.8, 0.3, 2))
    made = scene_of("map.npy", "5 GPa", 0.3, "100 mJ/m2", place / "made", size="320 Å", unit="Å", sites=sites)
    part, = (p for p in planned(made, place / "made").plan.parts if p.name == "spacing")
    row, = part.rows
    base, fine = (surface_made(str(file)).heights for file in (made.file, row.scene))
    assert part.rule(FLAT[0], 4.0, np.array([1.0]), []).error == pytest.approx(1.0) and fine.shape == (2 * sites, 2 * sites)
    here, there = (np.fft.fft2(h) / h.size for h in (base, fine))
    k = np.arange(-sites // 2 + 1, sites // 2)
    waves = np.ix_(k, k)
    np.testing.assert_allclose(abs(there[waves]), abs(here[waves]), atol=1e-6 * np.std(base))
    k = abs(2 * sites * np.fft.fftfreq(2 * sites))
    assert abs(there[np.maximum(k[:, None], k) > sites / 2]).max() < 1e-6 * np.std(base)  # and no other ones


def test_a_range_is_kept_or_refused_and_the_fix_works(place):
    np.save("map.npy", self_affine(48, 480.0, 0.8, 0.5, 2))
    given = dict(size="480 Å", unit="Å", sites=24)
    stuff = ("0.3 GPa", 0.3, "30 mJ/m2")
    with pytest.raises(asperity.SceneError, match="range = 3 Å: is not resolved by a spacing of 20 Å") as raised:
        scene_of("map.npy", *stuff, place / "no", reach="3 Å", **given)
    assert not (place / "no").exists()
    fixes = re.search("fix: (.*)", str(raised.value))[1]
    longer = re.search('--range "(.*?)"', fixes)[1]
    made = scene_of("map.npy", *stuff, place / "longer", reach=longer, **given)
    assert not made.withheld and "for a range of" in made.condition
    without = scene_of("map.npy", *stuff, place / "without", **given)
    assert "the range of the attraction decides" in without.withheld and longer in without.withheld
    with pytest.raises(asperity.SceneError) as raised:
        scene_of("map.npy", *stuff, place / "no", reach="5 Å", **given)
    sites = int(re.search(r"--sites (\d+)", str(raised.value))[1])
    assert sites > 24 and not scene_of("map.npy", *stuff, place / "sites", reach="5 Å", **{**given, "sites": sites}).withheld


def test_roughness_that_the_range_would_smear_is_refused(place):
    np.save("map.npy", self_affine(32, 320.0, 0.8, 0.2, 2))
    given = dict(size="320 Å", unit="Å")
    with pytest.raises(asperity.SceneError, match="too smooth for so soft a solid.*\n.*pressed flat, the map stores") as raised:
        scene_of("map.npy", "10 MPa", 0.49, "37 mJ/m2", place / "no", **given)
    longer = re.search('--range "(.*?)"', str(raised.value))[1]
    assert not scene_of("map.npy", "10 MPa", 0.49, "37 mJ/m2", place / "longer", reach=longer, **given).withheld


def test_numbers_of_an_estimate_are_withheld_with_their_reason(place):
    """Of a map: missing waves, a range in place of the one asked for; of a sphere: the edge that rows of sites hold."""
    np.save("map.npy", self_affine(32, 320.0, 0.8, 0.5, 2, longest=1))

    def found_of(name, young, work):
        made = scene_of("map.npy", young, 0.3, work, place / name, size="320 Å", unit="Å")
        return planned(made, place / name, ["waves"]).carry_out()[0]

    stiff = found_of("stiff", "20 GPa", "50 mJ/m^2")
    assert all(n.bounded and n.below > 0 for n in stiff.numbers.values())
    assert "no adhesion without load" in report_estimate.quote(stiff.first) and str(stiff.first) in repr(stiff)
    hard = found_of("hard", "3 GPa", "100 mJ/m^2")
    for path, n in hard.numbers.items():
        assert "roughness that the map does not show decides" in n.reason and math.isnan(n.estimate), path
    assert "not stated" in report_estimate.quote(hard.first) and "not stated" in repr(hard)
    soft = found_of("soft", "0.3 GPa", "100 mJ/m^2")
    for path, n in soft.numbers.items():
        of_range = path.startswith("work") or path in ("lost.cycle", "pull_off_stress")
        assert bool(n.reason) == of_range and (not of_range or "range of the attraction" in n.reason), path
    gamma = soft.first
    assert gamma.parts["waves"].error > 0 and 0 <= gamma.estimate <= gamma.most and any("likely too high" in note for note in soft.notes)
    sphere = {"surface": {"kind": "flat", "sites": 32, "spacing": "40 nm", "radius": "5 µm"},
              "block": {"young": "3 GPa", "poisson": 0.33, "thickness": 32},
              "interface": {"kind": "wall", "adhesion": "70 mJ/m²", "range": "0.3 nm", "edge_pinning": "allow"}, "drive": {"mode": "quasistatic"}}
    found = asperity.estimate(sphere, out="sphere", parts="spacing")
    assert [bool(n.reason) for n in found.numbers.values()] == [True, True, False]
    assert "rows of sites hold the edge" in found.numbers["pull_off_force"].reason
