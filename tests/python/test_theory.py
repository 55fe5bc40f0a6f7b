# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The command theory, and the theory of a run. The numbers: tests/theory, test_renormalised.py."""

import os
from pathlib import Path

import h5py
import pytest

import asperity
from conftest import ROOT, command

PAPER = ROOT / "scenes/paper/fig2.toml"


@pytest.fixture()
def place(place):
    (place / "rough.toml").write_text("[surface]\nsites = 64\nrms = 12\n")
    return place


def test_the_numbers_of_the_paper(place):
    """More of them: tests/engine/theory_case_test.cpp."""
    command("theory", PAPER, "--set", "surface.rms=5", "--out", "paper",
            says=["critical rms   6.972", "the surfaces adhere without load"])
    result = asperity.load("paper")
    assert result.theory.persson.gamma_eff == pytest.approx(15.159, abs=result.theory.persson.gamma_eff_error + 5e-4)
    assert result.theory.persson.contact_fraction == pytest.approx(0.66628, abs=result.theory.persson.contact_fraction_error)
    assert result.units.theory.renormalised.gamma_eff == "meV/Å^2"
    assert result.theory.persson.gamma_full_contact == pytest.approx(11.353, abs=0.002)
    with h5py.File("paper/theory.h5") as file:
        assert file["profile/A"][-1] == pytest.approx(result.theory.persson.contact_fraction, abs=1e-12)
        assert file["profile/gamma_eff"].attrs["unit"] == "meV/Å^2" and file["profile/U_el"][-1] == 0
    assert not {"energy", "binding_energy"} & set(result) and "steps" not in result.run  # no simulation


@pytest.mark.parametrize("given, says", [
    ("surface.rms=0.5 surface.q_max=512", "ends at Nyquist"), ("theory.spectrum=realised surface.rms=1", "the surface itself"),
    ("drive.load=3000", "only the load"),
    ("surface.rms=1", ["renormalised   γ_eff/Δγ 0.7", " ± ", "19 of 20 simulated surfaces"]),
    ("surface.rms=0 surface.radius=4410 theory.delta_gamma=100", ["JKR pull-off   2078.", "Maugis' λ 3.2"])])
def test_what_it_says(place, given, says, request):
    if "renormalised" not in says[0]:
        request.getfixturevalue("light")
    command("theory", "rough.toml", "--set", *given.split(), says=says)
    assert asperity.load("results/rough-theory").theory


def test_limits_without_numbers(place, light):
    command("theory", "rough.toml", "--out", "rough", says="the theory has no adhesive solution")
    assert asperity.load("rough").theory.persson.gamma_eff == asperity.load("rough").theory.persson.contact_fraction == 0
    command("theory", "rough.toml", "--out", "rough", expect=2, says="already holds a result")
    command("theory", "rough.toml", "--set", "surface.kind=flat", "--out", "flat")
    assert asperity.load("flat").theory.persson.contact_fraction == 1


@pytest.mark.parametrize("words, expect, says", [
    ("rough.toml --set theory.delta_gamma=-1", 2, "theory.delta_gamma = -1"),
    ("rough.toml --set theory.spectrum=exact", 2, "theory.spectrum"),
    ("rough.toml --set surface.q_max=1 surface.rolloff=1", 2, "no roughness"),
    ("gone.toml", 2, "there is no such file"), ("rough.toml --out rough.toml/x", 4, "rough.toml/x")])
def test_what_is_wrong_is_said(place, words, expect, says):
    command("theory", *words.split(), expect=expect, says=says)
    assert os.listdir() == ["rough.toml"]


def test_a_run_carries_the_theory_of_its_scene(place, light):
    Path("small.toml").write_text("[surface]\nsites = 32\nrms = 0.5\n[drive]\nmax_steps = 2\n")
    command("run", "small.toml", "--progress", "off", "--out", "run")
    command("theory", "small.toml", "--out", "theory")
    run, theory = (asperity.load(name).theory.persson for name in ("run", "theory"))
    for key in ("gamma_full_contact", "gamma_eff"):
        assert run[key] == pytest.approx(theory[key], abs=1e-9)
    assert "renormalised" not in run and "sphere" not in run
    # Only one rank looks for the directory; both end.
    assert command("surface", "small.toml", "--out", "theory", ranks=2, expect=2).count("already holds a result") == 1
    assert command("theory", "small.toml", "--out", "theory", ranks=2, expect=2).count("not one of several ranks") == 1
    Path("old.toml").write_text("[theory]\nrenormalised = false\n")
    command("check", "old.toml", expect=2, says=["no part of a run", "`asperity theory`, sweeps and reports compute it"])


def test_a_wall_without_adhesion(place, light):
    """There is no θ, and all else of the theory; a sweep runs whether its theory can be computed or not."""
    Path("wall.toml").write_text("[surface]\nsites = 32\nrms = 0.5\n[block]\nthickness = 32\n"
                                 "[interface]\nkind = 'wall'\nlaw = 'exponential'\nadhesion = 0\n"
                                 "[drive]\npath = ['relax']\nload = 50\n")
    command("theory", "wall.toml", "--out", "theory")
    assert asperity.load("theory").theory.persson.contact_fraction > 0
    for number, given in enumerate([["drive.load=50,100"], ["surface.rolloff=1", "surface.q_max=1,2"]]):
        command("sweep", "wall.toml", "--set", *given, "--out", f"sweep-{number}", "--progress", "off")
