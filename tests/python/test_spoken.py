# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Python reads what the program says to programs (JSON) and no sentence or table: with every other line garbled nothing
changes. Constants of units stand in one module."""

import json
import os
import re
import subprocess
import sys

from conftest import ROOT

GARBLED = """#!{python}
import codecs, json, subprocess, sys

def told(line):
    try:
        return isinstance(json.loads(line), dict)
    except ValueError:
        return False

done = subprocess.run([{program!r}, *sys.argv[1:]], capture_output=True, text=True)
for text, to in ((done.stdout, sys.stdout), (done.stderr, sys.stderr)):
    to.write("".join(line if told(line) else codecs.encode(line, "rot13") for line in text.splitlines(True)))
sys.exit(done.returncode)
"""
ASKED = """
import json, sys, asperity
from asperity.running import program
from asperity.studies import forecast, variations

TINY = {"name": "tiny", "surface": {"sites": 16, "rms": 0.5}, "drive": {"velocity": 100.0, "timestep": 20.0}}
said = [program.version(), program.mpi(), {name: program.info()[name] for name in ("git", "compiler", "flags")}]
run = asperity.run(TINY, out="run", progress=True)
said.append(run.binding_energy)
for overrides in ({"surface.sites": -3, "block.poisson": 2.0}, {"drive.timestep": 900.0}):
    try:
        asperity.run(TINY, overrides, out="refused")
    except asperity.Error as error:
        said += [type(error).__name__, str(error), error.listed]
swept = asperity.sweep(TINY, {"drive.max_steps": [5, 7]}, out="swept", jobs=1)
said += [[point["status"] for point in swept.points], swept.table["steps"].tolist() if "steps" in swept.table else None]
said.append(forecast.seconds_of("tiny.toml", []) > 0.0)
with open("said.json", "w") as file:
    json.dump(said, file)
"""


def asked_with(program, place):
    place.mkdir()
    (place / "tiny.toml").write_text("[surface]\nsites = 16\nrms = 0.5\n[drive]\ntimestep = 20.0\nvelocity = 100.0\n")
    done = subprocess.run([sys.executable, "-c", ASKED], cwd=place, capture_output=True, text=True, env={
        **os.environ, "ASPERITY_PROGRAM": str(program), "PYTHONPATH": str(ROOT / "python")})
    assert done.returncode == 0, done.stderr
    return json.loads((place / "said.json").read_text()), done.stderr


def test_sentences_may_change(tmp_path):
    program = os.environ["ASPERITY_PROGRAM"]
    garbled = tmp_path / "asperity"
    garbled.write_text(GARBLED.format(python=sys.executable, program=program))
    garbled.chmod(0o755)
    assert "irefvba" in subprocess.run([garbled, "info"], capture_output=True, text=True).stdout
    said, progress = asked_with(program, tmp_path / "plain")
    assert said[4] == "SceneError" and len(said[6]) == 2 and said[6][0]["fix"] and said[-1] is True, said
    again, progress_again = asked_with(garbled, tmp_path / "garbled")
    assert again == said
    names = [[line.split(",")[0].split("|")[0] for line in text.splitlines()] for text in (progress, progress_again)]
    assert names[0] and names[0][0] == names[1][0], names


def test_units_have_one_module():
    constants = re.compile(r"1\.602\d|6\.2415|160\.21|1\.3806|8\.617")
    found = [str(file) for file in sorted((ROOT / "python/asperity").rglob("*.py")) if constants.search(file.read_text())]
    assert [os.path.basename(file) for file in found] == ["units.py"], found
