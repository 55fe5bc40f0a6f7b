# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A walk over all commands: the form of their help, exit codes, -o, --json, --quiet, tables of at most 100 columns."""

import argparse
import importlib
import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
import test_curve
from asperity.arguments import ALIASES
from asperity.commands.options import command as of_package
from conftest import OF_PYTHON, ROOT, in_this_process

sys.path.insert(0, str(ROOT / "packaging"))
from generate import commands_of, completion, options_of, say, zsh_completion

PROGRAM = os.environ["ASPERITY_PROGRAM"]
PURPOSES = dict(commands_of(say(PROGRAM, "--help")))
COMMANDS = list(PURPOSES)
HELPS = {name: say(PROGRAM, name, "--help") for name in COMMANDS}
FOR_PROGRAMS = {name for name, purpose in PURPOSES.items() if purpose.startswith("for programs:")}
RUNS_SEVERAL = {name for name in OF_PYTHON if "jobs" in of_package(name).options.about()}
LONGEST = {"adhesion", "tip"}
EXIT = "exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard,\n            4 files, 75 stopped early\n"
SCENE = '[surface]\nsites = 16\nrms = 0.3\n[block]\nthickness = 16\n[drive]\npath = ["relax"]\n'
PATH = SCENE.replace('["relax"]', '["approach", "pull-off"]\nmode = "quasistatic"')
GIVEN = ["--young", "5 GPa", "--poisson", "0.3", "--adhesion", "200 mJ/m2", "--unit", "nm", "--size", "16 nm"]


TIP = ["--radius", "20 nm", "--young", "3 GPa", "--poisson", "0.3", "--adhesion", "50 mJ/m2", "--stiffness", "20 N/m"]


def words_of(name):
    """Words of a call that succeeds, and its output: where it is written, and the file to look for."""
    return {"run": (["s.toml"], "out", "result.json"), "init": ([], "new.toml", ""), "check": (["s.toml"], "", ""),
            "plan": (["s.toml"], "", ""), "surface": (["s.toml"], "out", "heights.h5"), "theory": (["s.toml"], "out", "theory.h5"),
            "sweep": (["s.toml", "--set", "surface.rms=0.2,0.4"], "out", "sweep.json"),
            "cost": (["s.toml", "--parameters", "tolerance"], "out", "cost.csv"),
            "estimate": (["s.toml", "--parts", "convergence", "--seeds", "2"], "out", "estimate.json"),
            "adhesion": (["map.npy", *GIVEN, "--sites", "16"], "out", "estimate.json"),
            "states": (["s.toml", "--starts", "2"], "out", "states.json"), "report": (["done"], "out", "report.html"),
            "stress": (["pressed"], "out", "stress.json"),
            "export": (["done", "--to", "vtk"], "out", "relaxed.vti"), "convert": (["map.txt"], "out.h5", ""),
            "prony": (["curve.csv"], "out.toml", ""), "scenes": ([], "out", "scenes/first-contact.toml"),
            "defaults": ([], "", ""), "info": ([], "", ""),
            "tip": ([*TIP, "--sites", "24"], "out", "tip.json"),
            "curve": (["force.csv", "--radius", "20nm", "--stiffness", "2N/m"], "out", "curve.json")}[name]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    place = tmp_path_factory.mktemp("walk")
    (place / "s.toml").write_text(SCENE)
    asperity.run(place / "s.toml", out=place / "done")
    asperity.run(place / "s.toml", {"interface.kind": "wall", "interface.adhesion": "50 mJ/m2"}, out=place / "pressed")
    draw = np.random.default_rng(1).normal(size=(16, 16))
    np.save(place / "map.npy", draw)
    np.savetxt(place / "map.txt", draw)
    (place / "curve.csv").symlink_to(ROOT / "scenes/rubber-master-curve.csv")
    (place / "force.csv").write_text(test_curve.text_of(*test_curve.measured("jkr")))
    return place


@pytest.fixture()
def work(results, tmp_path, monkeypatch):
    for name in ("s.toml", "map.npy", "map.txt", "curve.csv", "force.csv", "done", "pressed"):
        (tmp_path / name).symlink_to(results / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def called(*words):
    """Exit code, standard output and error of a call."""
    if words[0] in OF_PYTHON:
        return in_this_process(words)
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def test_the_list_of_commands():
    text = say(PROGRAM, "--help")
    assert text.startswith("usage: asperity COMMAND [options]\n\n") and text.endswith(EXIT)
    assert max(map(len, text.splitlines())) <= 80 and len(COMMANDS) >= 18


@pytest.mark.parametrize("name", COMMANDS)
def test_help_has_one_form(name):
    """Usage, what the command does, arguments, options, exit codes; 80 columns; the options in one order."""
    text = HELPS[name]
    arguments = r"(arguments:\n(  [A-Z].*\n( {26}.*\n)*)+\n)?"
    assert re.fullmatch(rf"usage: asperity {name}[^\n]*\n(?: {{7}}[^\n]*\n)?\n[A-Z][^\0]*?\.\n\n(?:[^\0]*?\n\n)?{arguments}"
                        r"options:\n(?: {2,6}-.*\n(?: {26}\S.*\n)*)+\n" + re.escape(EXIT), text), text
    assert max(map(len, text.splitlines())) <= 80
    options = {one: value for names, value, _ in options_of(text) for one in names}
    assert {"-h", "--help"} <= options.keys() and list(options)[-1] == "--help"
    if name in FOR_PROGRAMS:
        return
    assert {"-q", "--quiet", "--json"} <= options.keys()
    assert ("-o" in options) == ("--out" in options) == bool(words_of(name)[1])
    assert ("-j" in options and "--jobs" in options) == (name in RUNS_SEVERAL)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_misspelt_option_is_refused_with_the_right_one(name):
    code, out, said = called(name, "--hepl")
    assert code == 2 and out == "" and "--hepl is no option of" in said and "did you mean --help?" in said, said
    if name not in FOR_PROGRAMS:
        code, out, said = called(name, "--hepl", "--json")
        assert code == 2 and json.loads(said)["error"]["problems"][0]["fix"] == "did you mean --help?"


@pytest.mark.parametrize("name", [name for name in COMMANDS if name not in FOR_PROGRAMS])
def test_json_quiet_and_out(work, light, name):
    words, out, file = words_of(name)
    made = ["-o", out] if out else []
    code, said, other = called(name, *words, *made, "--json")
    assert code == 0 and other == "", other
    assert isinstance(json.loads(said), dict) and said.count("\n") == 1
    wanted = work / out / file
    if name == "surface":
        assert (work / out / file).exists()
    assert wanted.exists()
    before = {path for path in work.rglob("*") if not {"done", "pressed"} & set(path.parts)}
    if out:
        inputs = ("s.toml", "map.npy", "map.txt", "curve.csv", "force.csv", ".asperity-files", "run.lock")
        assert all(path == work / out or work / out in path.parents or path.stem == Path(out).stem or path.name in inputs
                   for path in before), before
    # Of the studies that take longest the second call goes on where the first has ended.
    code, said, other = called(name, *words, *(["-o", out if name in LONGEST else "q-" + out] if out else []), "--quiet")
    assert code == 0 and other == "" and "note:" not in said, said + other
    assert not re.search("written:|going on|begins|points in|runs, (about|of which)", said), said


def rows(text):
    """Lines of the tables: those above and below a rule."""
    lines = text.splitlines()
    found = []
    for i, line in enumerate(lines):
        if "──" in line:
            found += [lines[i - 1], line]
            for below in lines[i + 1:]:
                if not below.startswith("  ") or not below.strip():
                    break
                found.append(below)
    return found


@pytest.mark.parametrize("words", [
    ["run", "p.toml", "--quiet"], ["run", "p.toml", "--quiet", "--set", "surface.radius=100"],
    ["plan", "p.toml"], ["check", "p.toml"], ["surface", "p.toml"], ["info"], ["theory", "s.toml"],
    ["theory", "s.toml", "--set", "surface.radius=100"],
    ["sweep", "p.toml", "--set", "surface.rms=0.2,0.4", "surface.seed=1,2"],
    ["sweep", "p.toml", "--set", "surface.radius=100,150"],
    ["sweep", "s.toml", "--theory-only", "--set", "surface.rms=0.2,0.4"],
    ["cost", "p.toml", "--parameters", "tolerance,step"], ["estimate", "p.toml", "--parts", "convergence,thickness", "--seeds", "2"],
    ["states", "s.toml", "--starts", "2"]], ids=lambda words: " ".join(words)[:50])
def test_tables_fit_a_hundred_columns(work, light, words):
    (work / "p.toml").write_text(PATH)
    code, said, other = called(*words)
    assert code == 0, said + other
    found = rows(said)
    assert found or words[0] in ("check", "plan", "info"), said
    wide = [line for line in found if len(line) > 100]
    assert not wide, "\n".join(wide)


@pytest.mark.parametrize("keys", [[], ["surface.radius=100"], ["interface.kind=wall", "interface.adhesion=50 mJ/m2"],
                                  ["drive.path=[\"approach\",\"load 100 MPa\",\"slide x 5 Å\",\"pull-off\"]"],
                                  ["drive.mode=dynamic", "drive.velocity=100", "drive.displacement_step=0.1"]], ids=str)
def test_the_text_of_a_run_fits_eighty_columns(work, light, keys):
    """Opening, notes and summary; a number stays on the line of its unit. Tables are wider, and quiet runs print nothing else."""
    (work / "p.toml").write_text(PATH)
    code, said, other = called("run", "p.toml", "-o", "loud", "--set", *keys) if keys else called("run", "p.toml", "-o", "loud")
    assert code == 0, other
    tables = rows(said)
    text = [line for line in said.splitlines() if line not in tables]
    assert max(map(len, text)) <= 80 and max(map(len, tables)) <= 100, max(text, key=len)
    assert "of the pairs across the interface" in " ".join(said.split())
    assert not [line for line in text if re.match(r" +(%|mJ/m²|meV)", line)], said
    code, quiet, other = called("run", "p.toml", "-o", "silent", "--quiet", *(["--set", *keys] if keys else []))
    assert code == 0 and other == "" and rows(quiet) and not [line for line in quiet.splitlines() if line.strip() and line not in rows(quiet)
                                                               and "──" not in line], quiet


def test_completions_have_every_command_and_option():
    schema = json.loads(say(PROGRAM, "defaults", "--json"))
    listed = commands_of(say(PROGRAM, "--help"))
    for text in (completion(listed, HELPS, schema), zsh_completion(listed, HELPS, schema)):
        for name in COMMANDS:
            for names, _, _ in options_of(HELPS[name]):
                assert names[-1] in text
        assert "keep align-rows isotropic" in text and "xyz vtk png" in text and "(auto)" in text.replace("'auto'", "(auto)")
        assert all(name in text for name in COMMANDS) and "surface.rms" in text and "quasistatic" in text


def test_every_command_of_the_package_has_a_module():
    """The table lists what is there: the program hands these over, and each is an object of its module."""
    modules = {file.stem for file in (ROOT / "python/asperity/commands").glob("*.py")} - {"__init__", "command_line", "options", "studies"}
    assert modules == set(OF_PYTHON) <= set(COMMANDS)
    for name in OF_PYTHON:
        assert of_package(name).name == name


@pytest.mark.parametrize("name", OF_PYTHON)
def test_an_option_is_in_the_help_and_in_the_function(name):
    """The arguments of a function that stands beside its command are the options and their aliases, without those of a terminal alone."""
    text, about = " ".join(HELPS[name].split()), of_package(name).options.about()
    for field, (one, kind, needed) in about.items():
        if one.help != argparse.SUPPRESS:
            assert " ".join(one.help.split()) in text and (one.word or "--" + (one.name or field).replace("_", "-") in text), field
    if (function := getattr(importlib.import_module(of_package(name).options.__module__), name, None)):
        of_scene = {"words": "scene", "sets": "overrides"}
        fields = [of_scene.get(field, field) for field, (one, _, _) in about.items() if not one.terminal and one.help != argparse.SUPPRESS]
        assert set(inspect.signature(function).parameters) == {word for field in fields for word in (field, *ALIASES.get(field, ()))}
        assert getattr(asperity, name) is function


def test_a_page_elsewhere_writes_nothing_into_the_result(work, light, results):
    before = sorted(path.name for path in Path("done").iterdir())
    asperity.load("done").report("elsewhere")
    assert (work / "elsewhere/report.html").exists() and sorted(path.name for path in Path("done").iterdir()) == before
