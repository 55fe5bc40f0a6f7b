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

SITES, YOUNG, POISSON, RATIO, TIME = 48, 20.0, 0.49, 9.0, 1.0  # a nanometre apart; MPa, nanoseconds
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


ROUGH = """
[surface]
sites = 32
spacing = "1 nm"
rms = "0.4 nm"
rolloff = 2
q_max = 8
[block]
young = "20 MPa"
poisson = 0.49
prony = [[3.0, "1 ns"], [3.0, "20 ns"], [3.0, "400 ns"]]
[interface]
kind = "wall"
range = "0.9 nm"
[drive]
mode = "quasistatic"
control = "mean-height"
load = "40 MPa"
velocity = 1.0
path = ["relax", "slide x 512 nm under load until steady"]
"""


def steady_slide(place, name, **keys):
    (place / "rough.toml").write_text(ROUGH)
    sets = [word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]
    done = subprocess.run([program.path(), "run", "rough.toml", "--out", name, *sets], cwd=place, capture_output=True, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    slide = json.loads((place / name / "result.json").read_text())["segments"][-1]
    assert slide["steady"]
    return slide, done.stdout


def test_friction_in_full_contact_is_that_of_the_loss_modulus_of_each_wave(tmp_path):
    velocity = 1e-4  # nanometres in a nanosecond: far below all waves' loss
    slide, text = steady_slide(tmp_path, "full", drive__velocity=velocity, interface__adhesion=0, surface__q_max=4)
    assert slide["steady_contact_fraction"] == 1.0
    with h5py.File(tmp_path / "full/run.h5") as file:
        height = file["substrate/height"][:] / 10
    n, modulus = len(height), 20.0 / (1 - 0.49**2)
    q = 2 * np.pi * np.fft.fftfreq(n)
    qx, size = q[None, :], np.hypot(q[:, None], q[None, :])
    loss = sum(r * qx * velocity * t / (1 + (qx * velocity * t) ** 2) for r, t in ((3, 1), (3, 20), (3, 400)))
    stress = 0.5 * modulus * np.sum(size * qx * loss * np.abs(np.fft.fft2(height) / n**2) ** 2)
    assert slide["friction_stress"] == pytest.approx(stress, rel=0.02)  # waves of twelve sites and more, of the lattice's stiffness
    # A table of a page's width, and numbers that end where their errors do.
    table = [line for line in text.splitlines() if "meV/Å² (mJ/m²)" in line or line.strip().startswith("segment")]
    assert table and max(map(len, table)) <= 100
    assert "1 slide x 512 nm: friction" in text and " ± " in text


def test_friction_of_a_rough_wall_has_one_maximum(tmp_path):
    for adhesion in (0, 10):
        slides = [steady_slide(tmp_path, f"{adhesion}-{v}", drive__velocity=v, drive__load='"4 MPa"',
                               interface__adhesion=f'"{adhesion} mJ/m^2"')[0]
                  for v in (1e-4, 2e-4, 0.02, 1.0, 100.0)]
        first, second, most, after, last = (s["friction_coefficient"] for s in slides)
        assert second == pytest.approx(2 * first, rel=0.1)  # linear at low velocity
        assert second < 0.5 * most and most > 1.2 * after > 5 * last > 0
        area = [s["steady_contact_fraction"] for s in slides]
        assert all(a >= b - 1e-3 for a, b in zip(area, area[1:]))
        for s in slides:  # also if the longest time is that of a thousand boxes
            spent = s["stored"] + s["dissipated_in_block"] + s["lost"]
            assert s["work_of_drive"] == pytest.approx(spent, abs=1e-2 * s["work_of_drive"] + 2e-3)
            assert s["work_of_settling"] != 0.0


@pytest.mark.parametrize("velocity", [1e-5, 1e-4])
def test_work_is_what_is_dissipated_and_lost(tmp_path, velocity):
    rough = {"drive__velocity": velocity, "drive__load": '"4 MPa"', "interface__adhesion": 0}
    fine, _ = steady_slide(tmp_path, "fine", drive__tolerance=1e-6, **rough)
    spent = fine["stored"] + fine["dissipated_in_block"] + fine["lost"]
    assert fine["work_of_drive"] == pytest.approx(spent, rel=1e-3)
    # With the default tolerance and longer steps the friction is the same, within its error.
    coarse, _ = steady_slide(tmp_path, "coarse", **rough)
    assert coarse["friction_coefficient"] == pytest.approx(fine["friction_coefficient"], rel=0.015)
    assert abs(coarse["friction_coefficient"] - fine["friction_coefficient"]) < \
        coarse["friction_coefficient_error"] + fine["friction_coefficient_error"]


@pytest.mark.parametrize("steps", [1, 2, 3, 5, 40])
def test_a_steady_start_goes_on_with_the_same_bits(tmp_path, steps):
    velocity = {"drive__velocity": 0.02}
    whole, _ = steady_slide(tmp_path, "whole", **velocity)
    sets = ["--set", f"drive.velocity={velocity['drive__velocity']}"]
    run = [program.path(), "run", "rough.toml", "--out", "parts", *sets]
    subprocess.run([*run, "--set", f"drive.max_steps={steps}"], cwd=tmp_path, capture_output=True, check=False)
    assert json.loads((tmp_path / "parts/result.json").read_text())["run"]["stopped"] == "max_steps"
    done = subprocess.run([*run, "--resume", "auto"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    resumed = json.loads((tmp_path / "parts/result.json").read_text())["segments"][-1]
    assert resumed == whole and resumed["work_of_settling"] != 0.0
