# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Persson's theory of rubber friction: its closed integrals, its limits, and what the command, sweeps and reports show of it."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erf

import asperity
from asperity.theories import viscoelastic as theory
from asperity.units import GIGAPASCAL
from conftest import command

BRANCHES = [(3.0, 1e3), (2.0, 2e4), (1.0, 4e5)]
SELF_AFFINE = [[0.01, 0.03, 2e4, 0.0], [0.03, 0.6, 2e4, -3.6]]
SCENE = """[surface]
sites = 32
spacing = "1 nm"
rms = "0.5 nm"
rolloff = 4
q_max = 8
[block]
young = "20 MPa"
poisson = 0.49
prony = [[3.0, "1 ns"], [3.0, "20 ns"], [3.0, "400 ns"]]
[interface]
kind = "wall"
adhesion = "0 mJ/m^2"
[drive]
mode = "quasistatic"
control = "mean-height"
velocity = "0.1 m/s"
load = "4 MPa"
path = ["relax", "slide x 16 nm under load"]
[theory]
spectrum = "realised"
"""


def rubber(pieces=SELF_AFFINE, branches=BRANCHES, pressure=0.05, beta=0.5):
    return theory.Rubber(pieces, branches, 1.0, pressure, beta)


def spectrum(q):
    return 2e4 * min(1.0, (q / 0.03) ** -3.6)


def average(f):
    """Integral over φ, once round."""
    return quad(f, 0, 2 * math.pi, epsabs=0, epsrel=1e-9, limit=500)[0]


@pytest.mark.parametrize("y", [1e-8, 1e-5, 1e-3, 10.0])
def test_the_integrals_over_the_direction_are_closed(y):
    loss, square = theory._angles(BRANCHES, np.array([y]))
    assert 2 * math.pi * loss[0] == pytest.approx(average(lambda a: math.cos(a) * theory.modulus(BRANCHES, y * math.cos(a)).imag), rel=1e-9)
    assert 2 * math.pi * square[0] == pytest.approx(average(lambda a: abs(theory.modulus(BRANCHES, y * math.cos(a))) ** 2), rel=1e-9)


def test_friction_and_area_are_the_integrals_of_the_paper():
    v, x = 0.01, math.log
    given = rubber()

    def whole(f, last):
        ends = [(0.01, min(last, 0.03)), (0.03, last)]
        return sum(quad(lambda L: math.exp(L) * f(math.exp(L)), x(a), x(b), epsrel=1e-9)[0] for a, b in ends if b > a)

    def contact(q):
        g = whole(lambda k: k**3 * spectrum(k) * 2 * math.pi * theory._angles(BRANCHES, np.array([k * v]))[1][0], q) * 20**2 / 8
        return erf(1 / (2 * math.sqrt(g))) if g > 0 else 1.0

    def stress(q):
        p = contact(q)
        return q**3 * spectrum(q) * (0.5 + 0.5 * p**2) * p * 2 * math.pi * theory._angles(BRANCHES, np.array([q * v]))[0][0]

    found = theory.friction(given, v)
    assert found.area[0] == pytest.approx(contact(0.6), rel=1e-8)
    assert found.coefficient[0] == pytest.approx(20 / 2 * whole(stress, 0.6), rel=1e-6)


def test_one_wave_in_full_contact_has_its_closed_form():
    """A ring so narrow that its waves are one, over all directions: (1/4) h² q q_x Im E*(q_x v)."""
    q, h, p = 0.05, 2.0, 1e4
    height = h**2 / 2 / (math.pi * q**2 * (1.0001**2 - 1))
    given = rubber([[q, q * 1.0001, height, 0.0]], pressure=p)
    for v in np.geomspace(1e-6, 1e3, 10):
        wave = average(lambda a, v=v: 0.25 * h**2 * q**2 * math.cos(a) * theory.modulus(BRANCHES, q * v * math.cos(a)).imag) / 2 / math.pi
        found = theory.friction(given, v)
        assert found.coefficient[0] * p == pytest.approx(wave, rel=3e-4) and found.area[0] == 1


def test_slow_sliding_is_linear_fast_sliding_is_elastic():
    given = rubber()
    speeds = theory.velocities(given)
    found = theory.friction(given, speeds)
    slow = theory.friction(given, 1e-3 * speeds[0]).coefficient[0]
    assert slow == pytest.approx(theory.slope(given) * 1e-3 * speeds[0], rel=1e-5)
    full = rubber(pressure=1e6)  # ∫ q⁴ C dq of the two pieces
    moment = 2e4 * ((0.03**5 - 0.01**5) / 5 + 0.03**3.6 * (0.6**1.4 - 0.03**1.4) / 1.4)
    assert theory.slope(full) == pytest.approx(math.pi / 2 / 1e6 * sum(r * t for r, t in BRANCHES) * moment, rel=1e-9)
    fast = theory.friction(given, speeds[-1] * np.array([10.0, 100.0])).coefficient
    assert fast[0] == pytest.approx(10 * fast[1], rel=1e-2) and fast[1] < 1e-3 * found.coefficient.max()
    assert theory.friction(rubber(branches=[]), 0.1).coefficient[0] == 0
    most, at = theory.largest(given, speeds[np.argmax(found.coefficient)])
    assert most >= found.coefficient.max() and theory.friction(given, at).coefficient[0] == most


def test_the_contact_goes_from_the_relaxed_to_the_glassy_one():
    given = rubber()
    area = theory.friction(given, np.concatenate([[0.0], theory.velocities(given), [1e9]])).area
    assert (np.diff(area) <= 1e-15).all()
    slopes = 2 * math.pi * 2e4 * ((0.03**4 - 0.01**4) / 4 + 0.03**3.6 * (0.6**0.4 - 0.03**0.4) / 0.4)
    for found, stiff in ((area[0], 1.0), (area[-1], 1 + sum(r for r, _ in BRANCHES))):  # variance of the stress: E*² <|∇h|²>/4
        assert found == pytest.approx(erf(0.05 / math.sqrt(2 * stiff**2 * slopes / 4)), rel=1e-8)


def test_the_correction_factor_is_of_partial_contact():
    speeds = np.array([1e-4, 1e-2, 1.0])
    halves, one = (theory.friction(rubber(beta=beta), speeds).coefficient for beta in (0.5, 1.0))
    assert (halves > 0.5 * one).all() and (halves < 0.8 * one).all()
    assert theory.friction(rubber(pressure=1e4), speeds).coefficient == pytest.approx(
        theory.friction(rubber(pressure=1e4, beta=1.0), speeds).coefficient, rel=1e-9)


def test_the_scene_gives_its_own_spectrum_and_modulus(place):
    """In full contact: the sum over the waves of the map, each in its own direction."""
    Path("slide.toml").write_text(SCENE)
    full = {"drive.load": "1e5 MPa", "theory.beta": 1.0}
    found = asperity.theory("slide.toml", full).theory.sliding
    heights = asperity.surface("slide.toml").heights
    waves = np.abs(np.fft.fft2(heights) / heights.size) ** 2  # h²/4 of a cosine, at q and -q
    q = 2 * math.pi * np.fft.fftfreq(32, 10.0)
    qx, length = q[None, :] + 0 * q[:, None], np.hypot(q[None, :], q[:, None])
    branches = [(3.0, 1e3), (3.0, 2e4), (3.0, 4e5)]
    modulus = 0.02 * GIGAPASCAL / (1 - 0.49**2)

    def stress(part, v):  # MPa: (1/4) h² q q_x Im E* of each cosine, q_x = part q
        return (0.5 * waves * length**2 * part * theory.modulus(branches, part * length * v).imag).sum() * modulus / GIGAPASCAL * 1e3

    direction = np.divide(qx, length, where=length > 0, out=np.zeros(length.shape))
    around = np.mean([stress(math.cos(a), 1e-3) for a in (np.arange(32) + 0.5) * math.pi / 16])
    assert found.friction_stress == pytest.approx(around, rel=0.05)  # the theory knows rings of waves, not each
    assert found.friction_stress == pytest.approx(stress(direction, 1e-3), rel=0.1)
    assert found.contact_fraction == 1
    # Without adhesion the area of slow sliding is that of Persson's theory of the relaxed contact.
    slow = asperity.theory("slide.toml", {"drive.velocity": 1e-9}).theory
    assert slow.sliding.contact_fraction == pytest.approx(slow.persson.contact_fraction, abs=1e-3)


def test_what_the_command_says(place):
    Path("slide.toml").write_text(SCENE)
    command("theory", "slide.toml", "--out", "theory", says=["Rubber friction by Persson's theory", "S = β + (1-β) P² with β = 0.45",
                                                             "at 0.1 m/s", "maximum", "v, m/s"])
    result = asperity.load("theory")
    curve = result.theory.sliding.curve
    assert result.units.theory.sliding.curve.velocity == "m/s"
    assert result.theory.sliding.largest_friction_coefficient >= max(p["friction_coefficient"] for p in curve)
    command("report", "theory")
    assert Path("theory/report/sliding.svg").exists()
    command("theory", "slide.toml", "--set", "drive.load=0", says="give drive.load a value above 0")
    for other in ('drive.path=["relax"]', "block.prony=[]"):
        assert "sliding" not in asperity.theory("slide.toml", dict([other.split("=")])).theory


def test_a_sweep_over_velocity_has_theory_and_simulation_in_one_plot(place):
    Path("slide.toml").write_text(SCENE)
    command("sweep", "slide.toml", "--set", "drive.velocity=0.01,2", "--out", "sweep", "--progress", "off",
            says=["friction μ", "theory μ", "theory A/A0"])
    sweep = asperity.load_sweep("sweep")
    table, curves = sweep.table, sweep.curves
    assert (table["slide.friction_coefficient"] > 0).all() and table.units["slide.friction_stress"] == "MPa"
    assert table["theory.sliding.friction_coefficient"][0] == pytest.approx(table["slide.friction_coefficient"][0], rel=0.25)
    speeds = curves["drive.velocity"]
    assert np.allclose(speeds[1:] / speeds[:-1], 200 ** (1 / 30)) and curves.units["theory.sliding.slope"] == "s/m"
    axes = sweep.plot("friction")
    assert axes.get_xscale() == "log"
    assert {line.get_label() for line in axes.lines} >= {"Persson’s theory of rubber friction"} and len(axes.containers) == 1
    assert sweep.plot("sliding-area").get_xscale() == "log"
    assert Path("sweep/friction.svg").exists() and Path("sweep/sliding-area.svg").exists()
