# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Every line that a command prints, of a result or of an error, fits 80 columns; and every command that resolves a scene prints the
notes of `check`."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from asperity import terminal
from conftest import OF_PYTHON, ROOT, in_this_process, unfolded

sys.path.append(str(ROOT / "packaging"))
from generate import commands_of, say

pytestmark = pytest.mark.usefixtures("light_module")

PROGRAM = os.environ["ASPERITY_PROGRAM"]
FAR = "a_name_that_is_somewhat_longer_than_names_are"
TINY = """[surface]
sites = 16
rms = 0.5
[block]
thickness = 8
[drive]
mode = "quasistatic"
path = ["relax"]
[interface]
kind = "wall"
adhesion = "50 mJ/m2"
range = "6 Å"
"""
MODULI = ["--young", "100GPa", "--poisson", "0.3", "--adhesion", "50mJ/m2"]
BAD_KEYS = ["--set", "surface.sites=-3", "block.poisson=0.7", "interface.range=-1", "drive.path=[\"aproach\"]"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A scene, a map, a master curve and a run, under names as long as names get."""
    place = tmp_path_factory.mktemp("made")
    (place / f"{FAR}.toml").write_text(TINY)
    height = 2 * np.random.default_rng(1).standard_normal((32, 32))
    np.savetxt(place / "scan.txt", height, header="Width: 100 nm\nHeight: 100 nm\nValue units: Å")
    omega = np.geomspace(1e-5, 1e6, 34)
    modulus = 2 * (1 + 30 * sum(1 / (1 + 1 / (1j * omega * t)) for t in 10.0 ** np.arange(-5, 1)))
    np.savetxt(place / "curve.csv", np.c_[omega, modulus.real, modulus.imag], header="frequency (rad/s), E' (MPa), E'' (MPa)", delimiter=", ",
               comments="")
    assert printed(place, "run", f"{FAR}.toml", "--out", "done")[0] == 0
    return place


def printed(place, *words):
    if words[0] in OF_PYTHON:
        code, out, error = in_this_process(words, cwd=place)
        return code, out + error
    done = subprocess.run([PROGRAM, *words], cwd=place, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


SCENE = f"{FAR}.toml"
CALLS = {  # of each command what it is called with, and what is refused
    "run": ([SCENE, "--out", "ran"], [SCENE, *BAD_KEYS]), "check": ([SCENE], [SCENE, *BAD_KEYS]), "plan": ([SCENE], [FAR]),
    "surface": ([SCENE, "--out", "made"], [SCENE, *BAD_KEYS]), "theory": ([SCENE], [SCENE, *BAD_KEYS]),
    "sweep": ([SCENE, "--set", "surface.rms=0.3,0.4", "--out", "swept"], [SCENE, "--bogus"]),
    "cost": ([SCENE, "--plan"], [SCENE, "--parameters", FAR]), "estimate": ([SCENE, "--parts", "convergence"], [SCENE, "--parts", FAR]),
    "adhesion": (["scan.txt", "--plan", *MODULI, "--size", "100nm", "--unit", "Å", "--sites", "16"], ["scan.txt"]),
    "tip": (None, ["--radius", "20e-9"]), "states": ([SCENE, "--starts", "1", "--out", "states"], [SCENE, *BAD_KEYS]),
    "report": (["done"], ["."]), "stress": (["done"], ["done", "--friction", "9"]), "export": (["done", "--to", "png"], ["done", "--to", FAR]),
    "convert": (["scan.txt", "scan.h5", "--channel", "1"], [FAR]), "prony": (["curve.csv", "rubber.toml"], ["curve.csv", "--relaxed", "3"]),
    "scenes": (["copied"], ["copied", "--bogus"]), "defaults": ([], ["--bogus"]), "info": ([], ["--bogus"]),
    "init": ([f"{FAR}_more.toml"], [f"{FAR}_more.toml"])}
OF_PROGRAMS = ("theory-points", "stress-below", "hold")
CALLS |= {name: (None, ["--bogus"]) for name, _ in commands_of(say(PROGRAM, "--help")) if name not in (*CALLS, *OF_PROGRAMS)}


def too_wide(text):
    """Lines beyond 80 columns that could have been broken: a word may be longer than a line."""
    wide = [line for line in text.replace("\r", "\n").split("\n") if len(line) > 80]
    return [line for line in wide if max(map(len, line.split())) < 80 - (len(line) - len(line.lstrip()))]


@pytest.mark.parametrize("name", CALLS)
def test_lines_fit_a_terminal(made, name):
    for words, wanted in zip(CALLS[name], (True, False)):
        if words is None:
            continue
        code, text = printed(made, name, *words)
        assert (code == 0) == wanted, text
        assert not too_wide(text), f"{name}: {too_wide(text)}"


def test_folding():
    """A fold adds no word and loses none, and is taken back by the tests of messages."""
    for text in ("why " * 40, "    why: " + "because 17 nm of it " * 9, "scene.toml:3:5: " + "words of the message " * 8, "x" * 100 + " y z"):
        folded = terminal.folded(text.rstrip(), 2)
        assert not too_wide(folded) and folded.split() == text.split()
        assert unfolded(folded).split("\n")[0].split() == text.split() or text.startswith("why")
    table = terminal.table(["name", *"abcdefgh", "because"], [["one", *8 * ["1234.56"], "of a reason that has a good many words"]] * 2, (0, 9))
    assert not too_wide(table) and "1234.56" in table and all(word in table for word in "of a reason that has a good many words".split())


NOTED = {"surface": [], "theory": [], "plan": [], "run": ["--out", "r"], "sweep": ["--set", "surface.seed=1,2", "--out", "s"],
         "cost": ["--plan"], "estimate": ["--plan"], "states": ["--starts", "1", "--out", "t"], "theory-points": ["--points", "points"]}


@pytest.mark.parametrize("name", NOTED)
def test_every_command_prints_the_notes_of_check(made, tmp_path, name):
    """The note of a modulus that holds over that of the file of branches is one of those that change numbers."""
    (tmp_path / "rubber.toml").write_text('[block]\nyoung = 0.002\nprony = [[1.0, 10.0]]\n')
    (tmp_path / "scene.toml").write_text(TINY.replace("[block]", '[block]\nprony = "rubber.toml"\nyoung = "20 MPa"'))
    (tmp_path / "points").write_text("[]\n")
    done = subprocess.run([PROGRAM, "check", "scene.toml", "--json"], cwd=tmp_path, capture_output=True, text=True)
    notes = json.loads(done.stdout)["notes"]
    assert any("block.young = 0.02 GPa holds over the 0.002 GPa" in note for note in notes)
    code, text = printed(tmp_path, name, "scene.toml", *NOTED[name])
    assert code == 0, text
    said = re.sub(r"\s+", " ", text)
    assert [note for note in notes if note not in said and json.dumps(note, ensure_ascii=False)[1:-1] not in said] == []


def test_python_has_the_notes_of_check(tmp_path, monkeypatch):
    import asperity

    monkeypatch.chdir(tmp_path)
    Path("rubber.toml").write_text('[block]\nyoung = 0.002\nprony = [[1.0, 10.0]]\n')
    Path("scene.toml").write_text(TINY.replace("[block]", '[block]\nprony = "rubber.toml"\nyoung = "20 MPa"'))
    notes = set(asperity.check("scene.toml").notes)
    assert notes <= set(asperity.plan("scene.toml").notes) and notes <= set(asperity.theory("scene.toml").notes)
    assert notes <= set(asperity.sweep("scene.toml", {"surface.seed": [1, 2]}, out="s").notes)
