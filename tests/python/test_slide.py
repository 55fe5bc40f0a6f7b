# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A viscoelastic block slides over a rough line, against a program of one dimension that shares no code with it: the
half-plane's pressure as a dense matrix, contact by an active set, branches by exact steps in time."""

import json
import os
import subprocess

import h5py
import numpy as np
import pytest
from asperity.running import program

SITES, YOUNG, POISSON, RATIO, TIME = 64, 20.0, 0.49, 9.0, 1.0  # a nanometre apart; MPa, nanoseconds
MODULUS = YOUNG / (1 - POISSON**2)
SCENE = f"""
[surface]
kind = "file"
file = "line.txt"
file_size = "{SITES} nm"
file_unit = "nm"
sites = {SITES}
spacing = "1 nm"
[block]
young = "{YOUNG} MPa"
poisson = {POISSON}
prony = [[{RATIO}, "{TIME} ns"]]
thickness = {4 * SITES}
[interface]
kind = "wall"
adhesion = "0 mJ/m^2"
[drive]
mode = "quasistatic"
control = "mean-height"
load = "{0.05 * MODULUS} MPa"
path = ["relax", "slide x {2 * SITES} nm under load"]
"""


def heights(x):
    return sum(h * np.cos(2 * np.pi * k * x / SITES + phase) for h, k, phase in ((0.5, 1, 0.0), (0.2, 3, 1.0), (0.1, 5, 2.0)))


def half_plane(velocity, load, distance, step):
    """Returns place and friction per area of each step."""
    x = np.arange(SITES) + 0.5
    q = 2 * np.pi * np.fft.fftfreq(SITES)
    row = np.fft.ifft(0.5 * MODULUS * np.abs(q)).real
    stiffness = row[(np.arange(SITES)[:, None] - np.arange(SITES)) % SITES]
    dt = step / velocity
    decay = np.exp(-dt / TIME)
    share = (1 - decay) * TIME / dt
    active, u, spring, found = np.ones(SITES, bool), None, np.zeros(SITES), []
    for i in range(round(distance / step) + 1):
        h = heights(x + i * step)
        factor, known = (1 + RATIO * share, RATIO * (decay * spring - share * u)) if i else (1.0, np.zeros(SITES))
        given = stiffness @ known + load
        for _ in range(200):
            held, free = np.flatnonzero(active), np.flatnonzero(~active)
            m = len(free)
            matrix, right = np.zeros((m + 1, m + 1)), np.zeros(m + 1)  # displacements of free sites, and the level
            across = factor * stiffness[np.ix_(free, held)]
            matrix[:m, :m], matrix[:m, m] = factor * stiffness[np.ix_(free, free)], -across.sum(1)
            right[:m] = -given[free] - across @ h[held]
            matrix[m, :m], matrix[m, m], right[m] = 1.0, -len(held), -h[held].sum()
            solved = np.linalg.solve(matrix, right)
            w = h - solved[m]
            w[free] = solved[:m]
            pressure = factor * (stiffness @ w) + given
            now = np.where(active, pressure > 0, w < h - solved[m])
            if (now == active).all():
                break
            active = now
        if i:
            spring = decay * spring + share * (w - u)
        u = w
        found.append((i * step, np.mean(pressure * np.fft.ifft(1j * q * np.fft.fft(h)).real)))
    return np.array(found).T


def mean_behind(start, place, force):
    at = np.linspace(start, place[-1], 4001)
    return np.mean(np.interp(at, place, force))


@pytest.mark.parametrize("velocity", [0.3, 3.0, 30.0])  # m/s, nanometres in a nanosecond
def test_friction_over_a_line_is_that_of_a_program_of_one_dimension(tmp_path, velocity):
    np.savetxt(tmp_path / "line.txt", np.tile(heights(np.arange(SITES)), (SITES, 1)), fmt="%.17g")
    (tmp_path / "line.toml").write_text(SCENE)
    done = subprocess.run([program.path(), "run", "line.toml", "--out", "run", "--set", f"drive.velocity={velocity}"],
                          cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    with h5py.File(tmp_path / "run/run.h5") as file:
        place, force = file["series/slide_x"][:] / 10, -file["series/lateral_force_x"][:] / (10 * SITES) ** 2 * 160217.6634
    expected = mean_behind(SITES, *half_plane(velocity, 0.05 * MODULUS, 2.0 * SITES, 0.25))
    assert mean_behind(SITES, place, force) == pytest.approx(expected, rel=0.02)
    slide = json.loads((tmp_path / "run/result.json").read_text())["segments"][-1]
    assert slide["friction"] * 160217.6634 / (10 * SITES) ** 2 == pytest.approx(
        mean_behind(0.0, place, force), rel=0.02)
    spent = slide["dissipated_in_block"] + slide["lost"]
    assert slide["work_of_drive"] == pytest.approx(slide["stored"] + spent, abs=0.02 * spent)
