# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The theories in Python: the renormalised one against its limits, recorded numbers and simulated states, spheres against
published numbers; and Persson's theory of the program against an integral equation that shares nothing with it."""

import math

import numpy as np
import pytest
from scipy.special import ndtr

from asperity.running import program
from asperity.theories import combined, renormalised as theory
from asperity.theories.sphere import RATIOS, Sphere, jkr, maugis
from asperity.units import GIGAPASCAL
from conftest import ROOT

SCENE = str(ROOT / "scenes/validation/parameters.toml")
SMALL = ["surface.sites=64", "block.thickness=64"]


def rough_of(*overrides):
    return program.theory_points(SCENE, [list(overrides)])[0]["rough"]


@pytest.fixture(scope="module")
def smeared():
    """Over a wall, without pressure: only the potential of the gap."""
    return rough_of(*SMALL, "surface.rms=1", "interface.kind=wall", "interface.law=smeared")


# Numbers of an implementation in C++ that this one replaced: ratio, contact, separation (Å), tension (GPa).
RECORDED = (
    ("surface.rms=1", 0.760830, 0.964465, 3.27499, 4.25052),
    ("surface.rms=2 interface.frictionless=true", 0.307651, 0.550001, 4.54351, 1.31847),
    ("surface.rms=1.5 surface.lattice_ratio=1.5", 0.718272, 0.978756, 3.48816, 6.21999),
    ("surface.rms=1 interface.tail=true theory.spectrum=target", 0.764464, 0.963431, 3.27095, 4.29257),
    ("surface.rms=1.5 interface.kind=wall interface.law=smeared", 0.583619, 0.717198, 3.68417, 2.41614),
    ("surface.rms=1 interface.potential=morse drive.load=300", 0.719764, 0.972117, 3.25560, 3.82601),
    ("surface.rms=1.5 theory.spectrum=target drive.load=-200", 0.532004, 0.789659, 3.69133, 2.53638))


def test_recorded_numbers():
    points = program.theory_points(SCENE, [[*SMALL, *keys.split()] for keys, *_ in RECORDED])
    for (keys, ratio, contact, separation, tension), point in zip(RECORDED, points):
        found = theory.state(point["rough"])
        assert found.ratio == pytest.approx(ratio, abs=1e-4), keys
        assert found.contact == pytest.approx(contact, abs=3e-4), keys
        assert found.separation == pytest.approx(separation, abs=1e-3), keys
        assert found.tension / GIGAPASCAL == pytest.approx(tension, abs=1e-3), keys
        assert found.ratio_error < 1e-4 and found.contact_error < 3e-4
        quick = theory.state(point["rough"], quick=True)
        assert quick.ratio == pytest.approx(ratio, abs=2e-3), keys


def final(rough, level=1):
    """φ on the grid after all roughness, and before."""
    spectrum, flat = theory.Spectrum(rough["spectrum"], rough["q_L"]), theory.Flat(rough["flat"])
    flow = theory.Flow(rough, spectrum, flat, level)
    before = flow.phi.copy()
    flow.run()
    return flow, before, spectrum, flat


def test_a_rigid_block_averages_over_gaussian_heights(smeared):
    stiff = [[row[0], *(1e4 * s for s in row[1:])] for row in smeared["stiffness"]]
    flow, before, spectrum, flat = final({**smeared, "stiffness": stiff}, 2)
    heights = np.linspace(-3, 3, 1201) * spectrum.rms
    weight = np.exp(-heights**2 / (2 * spectrum.rms**2))
    inside = np.array([4.5, 5.0, 6.0, 8.0]) + 3 * spectrum.rms  # where no height comes closer than the grid
    mean = [(flat.derivative(u + heights, 0) * weight).sum() / weight.sum() for u in inside]
    assert np.interp(inside, flow.u, flow.phi) == pytest.approx(mean, rel=2e-2)


def test_a_soft_block_pays_the_elastic_energy_of_full_contact(smeared):
    soft = {**smeared, "stiffness": [[row[0], *(1e-4 * s for s in row[1:])] for row in smeared["stiffness"]]}
    found = theory.state(soft)
    spectrum, table = theory.Spectrum(soft["spectrum"], soft["q_L"]), np.array(soft["stiffness"])
    q = np.geomspace(spectrum.smallest, spectrum.largest, 4001)
    S = q * np.interp(q, table[:, 0], table[:, 4] / table[:, 0])
    above = spectrum.variance_above(q)
    energy = 0.5 * (0.5 * (S[1:] + S[:-1]) * -np.diff(above)).sum()  # ½ ∫ S dh²
    assert (1 - found.ratio) * found.depth == pytest.approx(energy, rel=1e-2)
    assert found.contact == pytest.approx(1.0, abs=1e-3)


def test_a_smooth_surface_is_the_flat_one():
    point = program.theory_points(SCENE, [[*SMALL, "surface.kind=flat"]])[0]
    found = theory.state(point["rough"])
    assert found.ratio == found.contact == 1 and theory.expected_error(found, point["rough"]) == (0, 0)
    assert 1e3 * found.depth == pytest.approx(point["delta_gamma"], rel=1e-6)
    assert found.separation == pytest.approx(point["flat"]["separation"], abs=1e-5)
    assert found.tension / GIGAPASCAL == pytest.approx(point["flat"]["tension"], rel=1e-4)


@pytest.mark.parametrize("given, says", [
    ("surface.rms=2 drive.load=-5000", "exceeds the largest tension"),
    ("surface.rms=8 interface.epsilon=10", "choose"),
    ("surface.rms=1 interface.kind=wall", "exponential wall"),
    ("surface.rms=1 drive.load=1e9", "press less")])
def test_no_number_without_a_reason(given, says):
    found = combined.renormalised(rough_of(*SMALL, *given.split()))
    assert "gamma_eff" not in found and says in found["note"]


def test_steep_roughness_is_said():
    found = combined.renormalised(rough_of(*SMALL, "surface.rms=4"))
    assert "gamma_eff" in found and "calibrated up to an rms slope of 0.6" in found["note"]


# States at zero load of docs/data/drawn.csv: sites, H, q0/q_L, E, ν, ε, r0, rms, seed, wall; γ_eff/Δγ and contact simulated.
SIMULATED = ((128, 0.40, 2.1, 44, 0.18, 0.198, 2.32, 1.93, 118610, False, 0.6496, 0.9941),
             (96, 0.55, 4.2, 127, -0.09, 0.234, 2.8, 0.92, 608408, False, 0.7561, 0.9894))
# The contact of these lay outside of what was stated before it included the error of the binding.
MISSED = ((160, 0.5, 4.9, 33, 0.08, 0.073, 3.0, 1.69, 391533, True, 0.6148, 0.8080),
          (192, 0.92, 5.2, 51, -0.15, 0.135, 2.26, 3.91, 961921, False, 0.0013, 0.0022))


def drawn(sites, hurst, rolloff, young, poisson, epsilon, r0, rms, seed, wall, *_):
    keys = {"surface.sites": sites, "block.thickness": sites, "surface.hurst": hurst, "surface.rolloff": rolloff,
            "block.young": young, "block.poisson": poisson, "interface.epsilon": epsilon, "interface.r0": r0,
            "interface.cutoff": round(4 * r0, 2), "surface.rms": rms, "surface.seed": seed,
            **({"interface.kind": "wall", "interface.law": "smeared"} if wall else {})}
    return [f"{key}={value}" for key, value in keys.items()]


def test_expected_errors_cover_simulated_states():
    for row in SIMULATED:
        rough = rough_of(*drawn(*row))
        found = theory.state(rough)
        ratio, contact = theory.expected_error(found, rough)
        assert abs(found.ratio - row[-2]) < ratio and abs(found.contact - row[-1]) < contact, row
    for row in MISSED:  # for the spectrum of the ensemble
        rough = rough_of(*drawn(*row), "theory.spectrum=target")
        found = theory.state(rough)
        ratio, contact = theory.expected_error(found, rough)
        assert abs(found.ratio - row[-2]) < ratio and abs(found.contact - row[-1]) < contact, row


# Spheres

def test_maugis_between_dmt_and_jkr():
    for parameter, force in ((0.1, 1.9506), (0.5, 1.7182), (1, 1.6007), (2, 1.5346), (5, 1.5063), (1e-6, 2), (1e4, 1.5)):
        assert -maugis(parameter, RATIOS)[0].min() == pytest.approx(force, abs=0.6e-4)
    assert jkr(1.5 ** (1 / 3))[0] == pytest.approx(-1.5) and jkr(1.5 ** (1 / 3))[2] == pytest.approx(-0.4368, abs=0.5e-4)
    # As printed: the opening at c is w/σ0.
    for parameter in (0.1, 5.0):
        m = np.array([1.0001, 1.02, 1.5, 10.0])
        s = np.sqrt(m * m - 1)
        F, a, d = maugis(parameter, s)
        opening = parameter * a**2 / 2 * (s + (m * m - 2) * np.arctan(s)) + \
            4 * parameter**2 * a / 3 * (s * np.arctan(s) - m + 1)
        assert opening == pytest.approx(np.ones(4), abs=1e-6)


PAPER = Sphere(4410, 77.2 / 160.21766 / (1 - 0.42**2), 0.1)


def test_spheres_with_and_without_images():
    assert 1.5 * math.pi * 4410 * PAPER.pull_off() == pytest.approx(2078.16, abs=0.01)
    assert PAPER.pull_off(100.0) == pytest.approx(0.1, rel=1e-4)  # a stress without bound is JKR's
    height, force, radius = PAPER.curve(np.array([360.87]))
    assert force == pytest.approx(0, abs=0.5) and -height == pytest.approx(9.84, abs=0.01)
    # F = -(3/2)πw / (1/R + kF), k by the sum of 1/r³ over the images.
    box = PAPER._replace(period=1331.2, separation=3.11)
    x, y = np.meshgrid(np.arange(-400, 401), np.arange(-400, 401))
    r = np.hypot(x, y)[(x != 0) | (y != 0)]
    k = ((r**-3).sum() + 8 * math.sin(math.pi / 4) / 400.5) / (2 * math.pi * PAPER.modulus * 1331.2**3)
    b, c = 1 / 4410, 1.5 * math.pi * 0.1
    assert 1.5 * math.pi * 4410 * box.pull_off() == pytest.approx((b - math.sqrt(b * b - 4 * k * c)) / (2 * k), rel=1e-5)
    assert math.isnan(Sphere(4410, PAPER.modulus, 10.0, 100.0).pull_off())


def test_a_curved_scene_has_its_sphere():
    point, = combined.points(SCENE, [[*SMALL, "surface.rms=0.5", "surface.radius=200"]])
    flat, found = point["delta_gamma"], point["theory"]["sphere"]
    assert flat < found["jkr_images"] < 1.1 * flat and found["maugis_images"] > found["jkr_images"]
    assert found["renormalised"] < found["maugis_images"] and found["renormalised_parameter"] < found["maugis_parameter"]


# Persson's theory by another way

def survivors(p, q, T, energy, stretch, modulus, g0, beta=0.45):
    """What Eq. (2) leaves of the area, by the equation of first passage: Brownian paths from p are absorbed at -b(T), so
    Φ(-(b_i + p)/√T_i) = Σ_j Φ((b_j - b_i)/√(T_i - T_j)) ΔF_j. Of the area and γ_eff at the end."""
    area, gamma = np.ones(len(q)), np.empty(len(q))
    u = energy[0]
    gamma[0] = (g0 + u) / stretch[0]
    b = np.zeros(len(q))
    b[0] = math.sqrt(max(gamma[0], 0) * modulus * q[0])
    for i in range(1, len(q)):
        def state(a):
            w = 0.5 * (area[i - 1] * (beta + (1 - beta) * area[i - 1]**2) + a * (beta + (1 - beta) * a * a))
            here = u + (energy[i] - energy[i - 1]) * w
            return here, (g0 + here) / (a * stretch[i])

        def excess(a):
            b[i] = math.sqrt(max(state(a)[1], 0) * modulus * q[i])
            middle, between = 0.5 * (b[1:i + 1] + b[:i]), 0.5 * (T[1:i + 1] + T[:i])
            lost = area[:i] - np.append(area[1:i], a)
            return ndtr(-(b[i] + p) / math.sqrt(T[i])) - (ndtr((middle - b[i]) / np.sqrt(T[i] - between)) * lost).sum()

        low, high = 0.5 * area[i - 1], area[i - 1]
        if excess(high) > 0:
            for _ in range(40):
                a = 0.5 * (low + high)
                low, high = (a, high) if excess(a) < 0 else (low, a)
        area[i] = high
        excess(high)
        u, gamma[i] = state(high)
    return area[-1], gamma[-1]


@pytest.mark.parametrize("h, load", [(4.0, 0.0), (6.0, 0.0), (5.0, -300.0), (6.0, 1000.0)])
def test_persson_by_the_equation_of_first_passage(h, load):
    given = [f"surface.rms={h}", f"drive.load={load}", "theory.area_factor=none"]
    found = program.theory_points(str(ROOT / "scenes/paper/fig2.toml"), [given], profile=True)[0]
    profile = {c["name"]: np.array(c["values"]) for c in found["profile"]}
    gpa, modulus = 1 / 160.21766208, 77.2 / 160.21766208 / (1 - 0.42**2)
    spectrum = theory.Spectrum(found["rough"]["spectrum"], found["rough"]["q_L"])
    start = np.argmax(profile["A"] < 1 - 1e-9)  # of the profile only where the boundary comes into reach
    first = max(profile["q"][max(start - 3, 1)], 1.0001 * spectrum.smallest)
    q = spectrum.smallest + np.geomspace(first - spectrum.smallest, spectrum.largest - spectrum.smallest, 300)
    fine = np.append(spectrum.smallest, spectrum.smallest + np.geomspace(
        1e-3 * (first - spectrum.smallest), spectrum.largest - spectrum.smallest, 100001))

    def moment(k):
        values = np.zeros_like(fine)
        for qa, qb, c, n in found["rough"]["spectrum"]:
            here = (fine >= qa) & (fine <= qb * (1 + 1e-12))
            values[here] = fine[here]**k * c * (fine[here] / qa)**n
        return np.interp(q, fine, np.append(0, np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(fine))))

    T, energy = math.pi / 2 * modulus**2 * moment(3), math.pi / 2 * modulus * moment(2)
    given_gamma, ratio = found["theory"]["persson"]["delta_gamma"] / 1e3, found["theory"]["persson"]["gamma_eff_ratio"]
    area, gamma = survivors(load * gpa / 1e3, q, T, energy, np.ones(len(q)), modulus, ratio * given_gamma)
    assert area == pytest.approx(found["theory"]["persson"]["contact_fraction"], abs=3e-3)
    assert (gamma / given_gamma - 1) * area == pytest.approx(0, abs=3e-3)
