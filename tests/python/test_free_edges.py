# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Boxes with free edges as a user meets them: the same bits on any ranks and threads and after a resume, with a spring, a
viscoelastic block and holes; maps of the box alone; forces in nN; a contact at an edge."""

import math
import sys

import numpy as np
import pytest

import asperity
from conftest import ROOT, command

sys.path.insert(0, str(ROOT / "tests"))
import bits

pytestmark = pytest.mark.usefixtures("light_module")

TIP = """[surface]
kind = "flat"
radius = "20 nm"
boundary = "free"
sites = 24
spacing = "1 nm"
[block]
young = "2 GPa"
[interface]
kind = "wall"
adhesion = "50 mJ/m^2"
range = "0.4 nm"
[drive]
mode = "quasistatic"
displacement_step = "0.2 nm"
load = "5 nN"
path = ["approach", "load 10 nN", "pull-off"]
[output]
fields = ["segments"]
"""
EFFECTS = {
    "plain": [],
    "spring": ["drive.stiffness=20 N/m"],
    "relaxing": ['block.prony=[[1.0, "1 ns"]]', "drive.velocity=1 m/s"],
    "layers": ['block.layers=[["2 nm", "20 GPa", 0.3], ["60 nm", "1 GPa", 0.4]]', "block.surface_stress=0.05"],  # thicker than the box is wide
    "holes": ["surface.kind=file", "surface.file=punch.npy", "surface.file_missing=hole", "surface.radius=none"],
}


@pytest.fixture()
def place(place):
    (place / "tip.toml").write_text(TIP)
    x = np.arange(24) - 11.5
    heights = np.where(np.hypot(x[:, None], x) < 7, 0.02 * (x[:, None] + x), np.nan)
    np.save(place / "punch.npy", heights)
    return place


def run(out, *sets, more=(), ranks=0, **keys):
    return command("run", "tip.toml", "--progress", "off", "--out", out, *more, *(["--set", *sets] if sets else []),
                   ranks=ranks, **keys)


@pytest.mark.parametrize("effect", EFFECTS)
def test_the_bits_are_the_same_on_ranks_and_threads_and_after_a_resume(place, effect):
    sets = [*EFFECTS[effect], 'drive.path=["load 2 nN"]', "drive.displacement_step=6 Å"]
    run("one", *sets)
    one = bits.results("one")
    for name, keys in {"ranks-2": {"ranks": 2}, "threads": {"env": {"OMP_NUM_THREADS": "2"}}}.items():
        run(name, *sets, **keys)
        assert not bits.differs(name, one, bits.results(name))
    run("resumed", *sets, "drive.max_steps=30")
    assert asperity.load("resumed").run.stopped == "max_steps"
    run("resumed", *sets, more=["--resume", "auto"])
    assert not bits.differs("resumed", one, bits.results("resumed"))


def test_a_tip_is_read_in_nanonewtons(place):
    said = run("tip")
    for text in ("24.00 nm wide, with free edges", "a sphere of R = 20 nm", "a half-space", "ends at, nN", "largest attraction, nN"):
        assert text in said
    assert "MPa" not in said and "free edge of the box" not in said
    tip = asperity.load("tip")
    at = tip.segments[1]
    assert at.name == "load 10 nN" and at.force == pytest.approx(10, rel=1e-3)
    assert at.pressure == pytest.approx(10e-9 / 24e-9**2 / 1e6, rel=1e-3)
    assert tip.instrument.pull_off_force == pytest.approx(tip.pull_off_force * 1.602176634, rel=1e-12)
    # Energies are those of the whole contact, and heights in nm, on the terminal and in the report.
    energies, heights = said[said.index("path  "):].split("How to read it")[0], [f"{0.1 * s.mean_height:.3f}" for s in tip.segments]
    assert all("meV" not in line or "JKR" in line for line in energies.splitlines()) and "mean height, nm" in energies
    assert all(text in energies for text in heights)
    for s in tip.segments:
        assert f"{s.work_of_drive * 1e-3 * tip.edge**2 * 0.1602176634:.4g}" in energies, energies
    assert tip.instrument.energy_lost == pytest.approx(tip.dissipated.energy * 0.1602176634, rel=1e-9)
    # A work of adhesion by JKR is one over an area.
    jkr = next(line for line in energies.splitlines() if "JKR" in line)
    assert "meV/Å² (mJ/m²)" in jkr and f"({tip.jkr.pull_off * 16.021766:.1f})" in jkr, jkr
    command("report", "tip")
    page = (place / "tip" / "report.html").read_text()
    table = page[page.rindex("Segments of the path"):].split("</table>")[0]
    assert "mean height, nm" in table and "work of the drive, aJ" in table and "MPa" not in table and "meV" not in table
    assert all(f"{s.force:.3f}" in table for s in tip.segments if s.force > 0)
    # The sphere is between DMT and JKR.
    pull = math.pi * 20 * 0.05
    assert 1.5 * pull < tip.instrument.pull_off_force < 2 * pull
    # The widest contact is that of 10 nN; the edge is as far from it as the box is wider.
    radius = 24 * math.sqrt(at.contact_fraction / math.pi)
    assert tip.instrument.edge_distance == pytest.approx(12 - radius, abs=1.0)
    # Maps are of the box, and the force is that of their pressures.
    there = tip.fields["segment-1"]
    assert there.pressure.shape == there.gap.shape == (24, 24)
    assert there.pressure.sum() * 1.0 == pytest.approx(10, rel=1e-3)  # GPa nm²
    assert there.contact.mean() == pytest.approx(at.contact_fraction)


def test_jumps_are_of_sites_of_the_box(place):
    run("soft", "drive.stiffness=5 N/m", "drive.path=height 0 nm", "surface.sites=20")
    jumps = asperity.load("soft").dissipated.jumps
    assert jumps
    for jump in jumps:
        assert all(abs(place - 9.5) < 8 for place in jump.site), jump.site
        assert 0 < jump.sites_moved <= 20**2


def test_a_contact_at_a_free_edge_is_said(place):
    said = run("wide", "drive.path=height -7.4 nm")
    wide = asperity.load("wide")
    assert 0 <= wide.instrument.edge_distance <= 1
    assert "The contact comes within" in said and "nm of a free edge of the box" in said
    said = command("check", "tip.toml", "--set", "drive.load=400 nN", expect=2)
    assert "needs a contact wider than the box" in said


def test_a_punch_touches_where_it_is_solid(place):
    said = run("punch", *EFFECTS["holes"], 'drive.path=["approach"]', "interface.adhesion=0")
    punch = asperity.load("punch")
    solid = np.isfinite(np.load("punch.npy"))
    there = punch.fields["segment-0"]
    assert (np.isnan(there.gap) == ~solid).all()
    assert (there.pressure[~solid] == 0).all() and not there.contact[~solid].any()
    assert there.pressure.sum() == pytest.approx(5, rel=1e-3)
    assert f"{(~solid).sum()} of 576 points have no height: holes" in said
    # A punch that is a part of a periodic surface.
    run("array", *EFFECTS["holes"], "surface.boundary=periodic", 'drive.path=["approach"]', "interface.adhesion=0")
    array = asperity.load("array")
    assert array.fields["segment-0"].pressure.sum() == pytest.approx(5, rel=1e-3)


def test_a_map_with_holes_is_taken_as_it_is(place):
    holes = EFFECTS["holes"]
    for sets in (["surface.detrend=plane"], ["surface.line_noise=align-rows"], ["surface.sites=20", "surface.resample=band-limited"]):
        command("check", "tip.toml", "--set", *holes, *sets, expect=2, says="a map with holes is taken as it is")
    np.save("punch.npy", np.full((24, 24), np.nan))
    command("check", "tip.toml", "--set", *holes, expect=2, says="no height at all")
