# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Values a million times too large or too small, as a wrong unit makes them: each is refused with reason and remedy, or is one
of those with which a run is bounded and means something."""

import os
import re
import subprocess

import pytest

import asperity.running.program

SCENES = {
    "dynamic": '[surface]\nsites = 32\nrms = 1.0\n[drive]\ntemperature = 10.0\n'
               'path = ["approach", "load 100 MPa", "hold 1 ps", "height 8 Å", "pull-off"]',
    "quasistatic": '[surface]\nsites = 32\nrms = 1.0\n[drive]\nmode = "quasistatic"\nload = 100',
    "wall": '[surface]\nsites = 32\nrms = 1.0\nradius = 300\n[block]\nprony = [[1.0, "1 ns"]]\n[interface]\nkind = "wall"\n'
            'range = 3.0\nstiffness = 1000\n[drive]\nmode = "quasistatic"\ncontrol = "mean-height"'}
VALUES = {"surface.q_max": 8.0, "surface.radius": 300.0, "surface.file_size": 83.2, "interface.cutoff": 13.12, "interface.stiffness": 1000.0,
          "interface.range": 3.0, "drive.ramp": 10.0, "drive.load": 100.0, "drive.temperature": 10.0, "theory.delta_gamma": 100.0,
          "surface.rms": 1.0}
"""Of keys without a number as their default, or with another one in these scenes."""
BOUNDED = {
    # key and direction: why a run with it is bounded and means what it says
    "surface.rms small": "flat", "surface.hurst small": "0 is allowed", "surface.q_max large": "Nyquist",
    "surface.radius large": "flat", "block.poisson small": "0 is allowed", "block.atom_mass large": "slower waves",
    "interface.epsilon small": "no attraction", "interface.adhesion small": "no attraction", "interface.stiffness large": "a hard wall",
    "interface.stiffness small": "a soft wall", "drive.damping small": "undamped", "drive.ramp small": "sudden",
    "drive.load small": "no load", "drive.temperature small": "0 K", "drive.tolerance small": "a longer relaxation",
    "theory.delta_gamma large": "the theory alone", "theory.delta_gamma small": "the theory alone", "theory.beta small": "the theory alone",
    "output.checkpoint large": "never", "output.checkpoint small": "always", "block.young small": "a soft block",
    "interface.epsilon large": "a strong attraction", "drive.velocity large": "branches that do not relax",
    "drive.velocity small": "viscoelastic branches", "drive.displacement_step large": "half the range at most",
    "drive.tolerance large": "relaxations of a dynamic path"}


def checked(kind, key, value):
    done = subprocess.run([os.environ["ASPERITY_PROGRAM"], "check", "-", "--set", f"{key}={value}"], input=SCENES[kind], text=True,
                          capture_output=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("kind", SCENES)
def test_values_out_of_proportion(kind):
    schema = asperity.running.program.schema()
    keys = {key: told["default"] for key, told in schema.items() if told["kind"] == "number" and isinstance(told["default"], float)
            and told["default"]} | VALUES | {"surface.sites": "83.2 Å", "block.thickness": "83.2 Å"}
    assert len(keys) > 30
    refused = 0
    for key, value in keys.items():
        for word, factor in (("large", 1e6), ("small", 1e-6)):
            given = (f"{float(value.split()[0]) * factor:g} Å" if isinstance(value, str) else f"{value * factor:g}")
            code, said = checked(kind, key, given)
            if code == 0:
                assert f"{key} has no effect" in said or f"{key} and" in said or f"{key}, " in said or f"{key} {word}" in BOUNDED, (
                    f"{key}={given} runs: {said}")
            else:
                assert code == 2 and "fix: " in said and "why: " in said, said
                refused += 1
    assert refused > 20


@pytest.mark.parametrize("kind, key, value, says", [
    ("dynamic", "surface.rms", "3 mm", "higher than the box is wide"),
    ("dynamic", "drive.velocity", "5 µm/s", "a path that cannot end"),
    ("dynamic", "drive.timestep", "1e-5", "take "),
    ("dynamic", "drive.ramp", "10 µs", "drive.ramp = "),
    ("dynamic", "drive.path", '["approach", "hold 1 ms", "pull-off"]', 'has a "hold" that cannot end'),
    ("dynamic", "drive.path", '["approach", "load 100 TPa", "pull-off"]', "strains the block"),
    ("dynamic", "drive.temperature", "300 MK", "moves an atom by"),
    ("dynamic", "drive.damping", "50 1/fs", "stops the atoms within a time step"),
    ("quasistatic", "drive.displacement_step", "1e-7", "take 0.25 Å"),
    ("quasistatic", "drive.tolerance", "250", "takes every state for balanced"),
    ("wall", "interface.range", "3 mm", "wider than the box")])
def test_a_wrong_unit_is_refused_and_its_remedy_followed_runs(kind, key, value, says):
    code, said = checked(kind, key, value)
    assert code == 2 and says in " ".join(said.split()), said
    if found := re.search(r"fix: take (\S+) (\S+?)[,;\s]", said):
        number, unit = found.groups()
        code, said = checked(kind, key, f"{number} {unit}" if unit not in ("or", "the") else number.rstrip(","))
        assert code == 0, said
    if kind == "dynamic" and "drive.max_steps" in said:  # a part of a path that is too long
        done = subprocess.run([os.environ["ASPERITY_PROGRAM"], "check", "-", "--set", f"{key}={value}", "drive.max_steps=100"],
                              input=SCENES[kind], text=True, capture_output=True)
        assert done.returncode == 0, done.stdout + done.stderr
