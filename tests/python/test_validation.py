# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The validations of scenes/validation in their small versions (docs/reports/validation.md)."""

import sys

import numpy as np
import pytest

import asperity
from conftest import ROOT, command

sys.path.insert(0, str(ROOT / "scenes/validation"))
import adhesion
import free_edges
import jumps
import kept
import rate
import rings
import stated_errors
import tables


def test_a_run_is_kept_if_it_is_whole(tmp_path):
    """One that was stopped, here by a limit of time, is refused and stays; one that its scene ends after some points is whole."""
    scene, stopped, place = ROOT / "scenes/first-contact.toml", tmp_path / "stopped", tmp_path / "run"
    keys = {"surface.sites": 16, "block.thickness": 16, "drive.max_steps": 20}
    command("run", scene, "--out", stopped, "--wall-limit", "1s", "--progress", "off", expect=75)
    with pytest.raises(asperity.SceneError, match="--resume auto"):
        kept.run(scene, keys, stopped)
    assert asperity.load(stopped).stopped == "wall_limit" and (stopped / "checkpoint.h5").exists()
    assert kept.run(scene, keys, place).stopped == "max_steps"
    made = (place / "result.json").stat().st_mtime_ns
    kept.run(scene, keys, place)
    assert (place / "result.json").stat().st_mtime_ns == made


def test_rings_without_adhesion_are_hertz():
    radius, depth = 300.0, 0.4
    around = rings.Rings(np.arange(0, 20, 0.1), adhesion.E)
    law = rings.Exponential(0.0, 1.0, 1e3)
    _, force, contact = rings.pulled(around, around.r**2 / (2 * radius), law, -depth, 0.1, -0.35)
    assert force[0] == pytest.approx(4 / 3 * adhesion.E * np.sqrt(radius * depth**3), rel=2e-3)
    assert contact[0] == pytest.approx(np.sqrt(radius * depth), abs=0.06)  # half a ring


def test_a_flat_punch_parts_like_the_rings(results):
    row, = adhesion.punch(adhesion.Runs(results / "punch", small=True))
    assert row["program"] == pytest.approx(row["rings"], abs=0.006)
    # Towards Kendall's force, and not beyond, as the range falls.
    assert 0.75 < row["rings"] < row["rings/2"] < 1


def test_a_sphere_parts_like_the_rings(results):
    row, = adhesion.sphere(adhesion.Runs(results / "sphere", small=True))
    assert row["lambda"] == pytest.approx(0.744, abs=1e-3)
    assert row["program"] == pytest.approx(row["rings"], abs=0.003)
    assert row["along"] < 0.005
    assert 0.75 < row["maugis"] < row["rings"] < 1


def test_free_edges_have_no_images(results):
    runs = free_edges.Runs(results / "free-edges", small=True)
    hertz, = free_edges.hertz(runs)
    assert hertz["depth/Hertz"] == pytest.approx(1, abs=0.001)
    assert hertz["radius/Hertz"] == pytest.approx(1, abs=0.007)  # of its sites
    punch, = free_edges.punch(runs)
    assert punch["force/2aE*d"] == pytest.approx(1, abs=0.006)
    jkr, = free_edges.jkr(runs)
    assert jkr["at the apex/F0"] == pytest.approx(jkr["rings at the apex/F0"], rel=0.006)
    assert jkr["largest/F0"] == pytest.approx(jkr["rings, largest/F0"], rel=0.003)


def test_the_loss_in_time_falls_to_that_without_time(results):
    flat, rough = jumps.losses(results / "jumps", (5, 2))
    assert rough[0] == pytest.approx(0, abs=0.05) and rough[5] > 2.5 * rough[2] > 0  # no snap
    assert flat[0] > 1
    # A fold that is passed at a velocity v is left later and loses v^(2/3) more.
    assert (flat[5] - flat[0]) / (flat[2] - flat[0]) == pytest.approx(2.5 ** (2 / 3), rel=0.05)


def test_strong_adhesion_makes_a_surface_sticky(results):
    strong, weak = adhesion.sticky(adhesion.Runs(results / "sticky", small=True))
    assert strong["kappa"] < 0 < weak["kappa"]
    # Without adhesion κ is about 2: adhesion always takes from 1/κ.
    assert weak["kappa"] < 0.5


def test_the_error_of_an_estimate_holds_other_surfaces(results):
    rows = stated_errors.compared(0, results / "stated", jobs=2, seeds=range(101, 105), sites=(32,))
    assert [row["quantity"] for row in rows] == ["binding_energy", "binding_energy_ratio", "contact_fraction"]
    for row in rows:
        assert row["error"] > 0 and abs(row["off"]) < 2.5, row


def test_a_steady_crack_has_the_limits_of_a_viscoelastic_solid():
    slow, *between, fast = (rate.steady(v, 300) for v in (1e-4, 0.1, 1, 10, 1e8))
    assert slow == pytest.approx(1, abs=1e-3) and fast == pytest.approx(1 + rate.RATIO, rel=1e-3)
    assert slow < between[0] < between[1] < between[2] < fast


def test_strips_come_to_the_infinite_solid():
    thin, thick = (rate.strip(8 * h, h, 1.5, 1.0) for h in (64, 128))
    assert rate.steady(2 * thick - thin, 300) == pytest.approx(1.5, rel=0.02)


@pytest.mark.parametrize("release", (0.85, 1.5))
def test_a_crack_moves_as_in_one_dimension(release):
    mine, other = rate.asperity_strip(256, 32, release, 2.0), rate.strip(256, 32, release, 0.5)
    assert mine * (release - 1) > 0  # opens above the work of adhesion, closes below
    assert mine == pytest.approx(other, rel=0.06)


def test_errors_of_tables_are_covered_by_what_is_stated(results):
    chosen = [tables.Case("lennard-jones", rows=24), tables.Case("lennard-jones", rows=96), tables.Case("morse", "ratios", 40),
              tables.Case("morse stiff", "uneven", 200), tables.Case("lennard-jones", rows=300, noise=2e-3),
              tables.Case("morse stiff", rows=150, noise=1e-7)]
    coarse, *fine, noisy, faint = tables.compared(results / "tables", 16, chosen)
    assert "do not determine a curve" in coarse["refused"] and "do not determine a curve" in noisy["refused"]
    for row in (*fine, faint):
        assert max(row["delta_gamma"], row["binding_energy"]) <= row["stated"] <= 0.01
