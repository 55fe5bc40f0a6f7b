# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Every command of the README and the docs runs, one after another in one place. Runs are made small and short by
overrides put behind the command's own; a comment "# exit N" behind a command says with which code it is to end."""

import os
import re
import shlex
import subprocess

import pytest

import asperity
from conftest import OF_PYTHON, ROOT, command

PAGES = [ROOT / "ARCHITECTURE.md", ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINES = [line for page in PAGES for line in re.findall(r"^    ((?:mpirun .*)?\./asperity .*)", page.read_text(), re.M)
         if not re.search(r"\./asperity (test|bench)", line)]  # which would call this test
SMALL = " --set surface.sites=32 block.thickness=32 --progress off"
SHORT = " --set drive.max_steps=30"
FEW = " --set surface.rms=1,3 surface.seed=1,2"  # in place of all points of a figure
WHOLE = "sweep scenes/paper/small/fig2-equilibrium.toml --jobs 2"
"""Sweep with all theories and pictures, which take most of the time of the others and are left out there."""
PLANNED = () if os.environ.get("ASPERITY_LONG") else (
    "--stiffness 0.2N/m -j 2", "--out results/metal-tip", "-j 2 --line-noise isotropic", "--counter-poisson 0.26 --adhesion 50mJ/m2 --sites 128")
"""Commands that are planned and not carried out: test_tip.py, test_yielding.py, test_adhesion.py and test_pair.py run their like."""


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    place = tmp_path_factory.mktemp("all commands")
    command("surface", ROOT / "scenes/first-contact.toml", "--out", "map", cwd=place)
    (place / "map/heights.h5").rename(place / "heights.h5")  # "your own surface"
    (place / "scenes").symlink_to(ROOT / "scenes")
    return place


def test_there_are_commands():
    assert len(LINES) >= 10


@pytest.mark.parametrize("line", LINES)
def test_commands(work, line, request):
    given = re.search(r"# exit (\d+)", line)
    wanted = int(given[1]) if given else 0
    # Devices are refused where the kernels do not fuse multiplications and additions.
    if "numerics.device=" in line and re.search(r"kernels for (portable|v2)\b", command("info")):
        wanted = 2
    words = line.partition("#")[0]
    if not words.strip().endswith(WHOLE):
        request.getfixturevalue("light")
    if words.strip().endswith(PLANNED):
        words += " --plan"
    if " run scenes/atoms/" in words:  # as wide as its atoms
        words += SHORT + " --progress off"
    elif " adhesion " in words:
        words = words.replace("--sites 128", "--sites 16") + " --progress off"
    elif " tip " in words:
        words += " --sites 24 --progress off"
    elif " estimate " in words:
        words += " --parts tail --progress off --set surface.sites=16 block.thickness=4 drive.path=relax"
    elif " cost " in words:
        words += (" --parameters precision --progress off --set surface.sites=16 block.thickness=4 drive.velocity=40"
                  " drive.timestep=40")
    elif re.search(" (run|sweep) ", words) and "--theory-only" not in words:
        if " sweep " in words:  # of several values the first and the last
            words = re.sub(r"([\w.]+=[\w.+-]+),[\w.,+-]+,([\w.+-]+)(?=\s|$)", r"\1,\2", words)
        scene = re.search(r" (scenes/\S+\.toml)", words)
        is_half_space = bool(scene) and 'boundary = "free"' in (ROOT / scene[1]).read_text()
        words += SMALL.replace(" block.thickness=32", "") if is_half_space else SMALL
        words += SHORT if wanted == 0 else ""  # what is meant to fail has to get there
        if " sweep scenes/paper/" in words and "surface.rms=" not in words:
            words += FEW
    if words.split()[1] in OF_PYTHON and words.startswith("./"):
        command(*shlex.split(words)[1:], expect=wanted, cwd=work)
        return
    words = words.replace("./asperity", '"$ASPERITY_PROGRAM"')
    if words.startswith("mpirun "):
        words = " ".join(asperity.running.runs.launcher(2)[:-2]) + words.removeprefix("mpirun")
    done = subprocess.run(["bash", "-c", f"timeout 400 {words}"], cwd=work, stdin=subprocess.DEVNULL, text=True,
                          capture_output=True)
    assert done.returncode == wanted, f"exit {done.returncode}, not {wanted}: {words}\n{done.stdout}{done.stderr}"
