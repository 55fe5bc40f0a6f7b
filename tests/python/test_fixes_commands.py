# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whoever follows the fix of a message of a command or of the Python interface comes to what he meant: every message of the
catalogue that is about neither the keys of a scene (test_fixes_scene.py) nor its files (test_fixes_files.py)."""

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

import asperity
import asperity.crack
import asperity.terminal
import test_curve
import test_fixes_files
import test_fixes_rubber
import test_fixes_scene
from asperity.commands import options
from asperity.files import store
from asperity.results import result
from asperity.running import program
from asperity.studies import grid, states, tip
from asperity.studies.stated_number import Number
from asperity.theories.tip_shape import TipShape
from conftest import unsealed, without_pictures
from following import ask, followed, not_followed

OTHERS = test_fixes_scene.SOURCES + test_fixes_files.SOURCES + test_fixes_rubber.SOURCES + test_curve.SOURCES
EXCUSED = {
    "take drive.tolerance =": "a slide whose energies do not balance",
    "it is a hard link": "a file with another name",
    "and a page is of one or of a sweep": "a folder of several results, in test_report.py",
    "the scenes were not found": "an installation that lacks them",
    "the path does not get on": "a path whose steps are halved without end",
    "this program was built without MPI": "a program without MPI",
    "the launcher is that of another MPI": "a launcher of another MPI",
    "MB of device memory": "a device that fails",
    "the path does not start from an equilibrium": "a relaxation that does not converge",
    "look at run.h5 whether the surfaces touch": "a relaxation that does not converge",
    "its numbers are not as many as their names": "a file of another version, or damage that its digest does not show",
    "has another checkpoint format": "a file of another version",
    "it lacks the attribute scene": "a file of another version",
    "has no number \"": "a file of another version",
    "has the number \"": "a file of another version",
    "it is one process, on all its threads": "ranks (test_simulation.py)",
    "was given values that are no numbers on another rank": "ranks (test_simulation.py)",
    "install an mpi4py of the same MPI": "a package to be installed",
    "apt-get install python3-": "a package to be installed",
    "needs a Python package": "a package to be installed",
    "start one: dask scheduler": "a scheduler (test_executors.py)",
    "files.hpp": "a machine's disk",
    "hdf5_file.cpp...check the space on its disk": "a machine's disk",
    "hdf5_file.cpp...check its directory and the space on its disk": "a machine's disk",
    "store.py...check its permissions and the space on its disk": "a machine's disk",
    "check that the file is whole": "a machine's disk",
    "hdf5_file.cpp...check that it is whole": "followed in test_fixes_files.py",
    "this is a mistake in the program": "a mistake in the program",
    "is not where it was when the run began": "a directory that is moved during a run (test_launch.py)",
    "wait for its end, or name another directory (--out)": "another machine that has the directory",
    "look for the result there": "a directory that is moved during a run",
    "the estimate stopped early": "followed in test_estimate.py",
    "the same call goes on from here": "followed in test_estimate.py",
    "has no data set": "a file of another program",
    "was the file written by another program?": "a file of another program",
    "check that it is installed": "a program that the system does not start",
    "put the mpirun of that MPI into PATH": "a launcher to be installed",
    "result.py...check the path and its permissions": "whoever tests may read all files",
    "only rank 0 would have it": "ranks (test_ranks.py)",
    "stress_below.cpp...name a state of a run over a wall without holes": "a command for programs",
    "this is no result": "damage that its digest does not show",
    "this is no JSON that can be read": "damage that its digest does not show",
}
MAP_OPTIONS = options.command("adhesion").options
GIVEN = {"map": "map.npy", "young": "1 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2"}
TINY = ('[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 8\n[drive]\nvelocity = 200\ntimestep = 20\npath = ["approach"]\n')
STILL = '[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 8\n[drive]\npath = ["relax"]\n'


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A finished run, one that was stopped, a sweep and one of two scenes."""
    place = tmp_path_factory.mktemp("made")
    (place / "s.toml").write_text(TINY)
    (place / "t.toml").write_text(STILL)
    assert ask("run", place / "s.toml", "--out", place / "done")[0] == 0
    assert ask("run", place / "t.toml", "--out", place / "still")[0] == 0
    assert ask("run", place / "s.toml", "--out", place / "part", "--set", "drive.max_steps=40")[0] == 0
    (place / "part/result.json").unlink()
    assert ask("run", place / "s.toml", "--out", place / "short", "--set", "drive.max_steps=40", "output.fields=[]")[0] == 0
    with without_pictures():
        for name in ("s", "t"):
            asperity.sweep(place / f"{name}.toml", {"surface.rms": [0.4, 0.5]}, out=place / "swept" / name)
    return place


@pytest.fixture(autouse=True)
def here(made, light, tmp_path, monkeypatch):
    work = tmp_path / "work"
    shutil.copytree(made, work)
    monkeypatch.chdir(work)
    return work


def bad(*words, code=None, **given):
    """The command fails; what it says."""
    found, said = ask(*words, **given)
    assert found != 0 and (code is None or found == code), said
    return said


def told(said):
    """The text of an error that is told to programs."""
    return json.loads(said.splitlines()[-1])["error"]["text"]


def good(*words, **given):
    found, said = ask(*words, **given)
    assert found == 0, f"{words}\n{said}"
    return said


def error(call):
    """The message of an error that a call of Python raises."""
    with pytest.raises(asperity.Error) as raised:
        call()
    return str(raised.value)


def a_tip(**more):
    """What `asperity tip` is given, with its defaults."""
    return asdict(options.command("tip").options(**{"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2",
                                                    "stiffness": "2 N/m", **more}))


def sim(**sets):
    return asperity.Simulation("s.toml", {key.replace("__", "."): value for key, value in sets.items()})


def statics(**sets):
    return asperity.Statics("t.toml", {key.replace("__", "."): value for key, value in sets.items()})


def run(*words, scene="s.toml"):
    return ("run", scene, *words)


def change(file, old, new):
    Path(file).write_text(Path(file).read_text().replace(old, new))


def cut(file, length=0.5):
    content = Path(file).read_bytes()
    Path(file).write_bytes(content[:int(length * len(content))])


def flip(file):
    content = bytearray(Path(file).read_bytes())
    content[len(content) // 2] ^= 255
    Path(file).write_bytes(content)


def blank(name):
    (Path(name)).write_text("mine\n")
    return name


# What is said (with groups that the fix gives), what goes wrong, and what follows the fix
COMMANDS = [
    ("no scene is given(?s:.*)for example: asperity run", lambda: bad("check", "surface.rms=1"), lambda: good("check", "s.toml", "surface.rms=1")),
    ("more than one scene(?s:.*)for example: asperity run", lambda: bad("check", "s.toml", "t.toml"), lambda: good("check", "s.toml")),
    ("give one of them", lambda: bad(*run("--restart", "--resume", "auto", "--out", "part")), lambda: good(*run("--restart", "--out", "part"))),
    ("for example 23h50m, (45m) or 90s", lambda: bad(*run("--wall-limit", "soon")), lambda limit: good(*run("--wall-limit", limit, "--out", "o"))),
    ("choices are auto, bar, (lines), json and off(?s:.*)give one", lambda: bad(*run("--progress", "loud")), lambda mode: good(*run("--progress", mode, "--out", "o"))),
    ("--resume (auto) takes the checkpoint", lambda: bad(*run("--resume", "gone.h5", "--out", "part")), lambda word: good(*run("--resume", word, "--out", "part", "--set", "drive.max_steps=none"))),
    ("did you mean `asperity (.*)`", lambda: bad("chekc", "s.toml"), lambda word: good(word, "s.toml")),
    ("asperity (--help)", lambda: bad("qqqqqqqqqqqq"), lambda word: good(word)),
    ("asperity (check) (--help)", lambda: bad("check", "s.toml", "--bogus"), lambda *words: good(*words)),
    ("did you mean (--quiet)", lambda: bad("check", "s.toml", "--qiet"), lambda word: good("check", "s.toml", word)),
    ("write the unit behind the number: (3nm)", lambda: bad("check", "s.toml", "--set", "surface.rms=3", "nm"), lambda value: good("check", "s.toml", "--set", f"surface.rms={value}")),
    ("OMP_NUM_THREADS=2 asperity (run)", lambda: bad("run", "t.toml", "-j", "2"), lambda word: good(word, "t.toml", "--out", "o", env={"OMP_NUM_THREADS": "2"})),
    ("or name the map in a scene .surface.file.", lambda: (Path("m.toml").write_bytes(b"\x89HDF\0"), bad("check", "m.toml"))[1], None),
    ("for example: asperity (run) scenes/first-contact.toml", lambda: bad("run"), lambda word: good(word, "t.toml", "--out", "o")),
    (r"did you mean (t\.toml)", lambda: bad("check", "t"), lambda file: good("check", file)),
    ("asperity (--help)", lambda: bad("--quiet"), lambda word: good(word)),
    ("name one: asperity init (NAME.toml)", lambda: bad("init", "x.toml", "-o", "y.toml"), lambda name: good("init", name)),
    ("name another: asperity init (NAME.toml)", lambda: bad("init", "s.toml"), lambda name: good("init", name)),
    ("name another place", lambda: bad("init", "gone/s.toml"), lambda: good("init", "x.toml")),
    (r"write one JSON array a line: (\[.*\])", lambda: told(bad("theory-points", "t.toml", "--points", blank("p"))), lambda line: (Path("p").write_text(line), good("theory-points", "t.toml", "--points", "p"))),
    ("start the command with one as its standard input", lambda: told(bad("hold", ".", given="")), lambda: in_use(lambda: True)),
    ("check the path and its permissions", lambda: told(bad("theory-points", "t.toml", "--points", "gone")), lambda: (Path("p").write_text("[]\n"), good("theory-points", "t.toml", "--points", "p"))),
    ("take a larger height", lambda: bad(*run("--out", "o", "--set", "drive.mode=quasistatic", "drive.control=mean-height", "drive.path=height -1", scene="t.toml")),
     lambda: good(*run("--out", "p", "--set", "drive.mode=quasistatic", "drive.control=mean-height", "drive.path=height 4", scene="t.toml"))),
    ("take a smaller pull", lambda: bad(*run("--out", "o", "--set", "drive.load=-8000", scene="t.toml")), lambda: good(*run("--out", "p", "--set", "drive.load=-1", scene="t.toml"))),
    ("take a smaller pull", lambda: bad(*run("--out", "o", "--set", "drive.path=approach, load -8 GPa", "drive.mode=quasistatic", scene="t.toml")),
     lambda: good(*run("--out", "p", "--set", "drive.path=approach, load -8 MPa", "drive.mode=quasistatic", scene="t.toml"))),
    ("take a larger drive.tolerance", lambda: bad(*run("--out", "o", "--set", "drive.tolerance=1e-18", scene="t.toml")), lambda: good(*run("--out", "p", scene="t.toml"))),
    ("a larger drive.tolerance, or", lambda: bad(*run("--out", "o", "--set", "drive.tolerance=1e-18", "drive.mode=quasistatic", "drive.path=height 3", scene="t.toml")), lambda: good(*run("--out", "p", "--set", "drive.mode=quasistatic", "drive.path=height 3", scene="t.toml"))),
    ("give the checkpoint.h5 of a run", lambda: bad(*run("--resume", "done/run.h5", "--out", "o")), lambda: good(*run("--resume", "part/checkpoint.h5", "--out", "part", "--set", "drive.max_steps=none"))),
    ("give the scene it was made with", lambda: bad(*run("--resume", "auto", "--out", "part", "--set", "surface.rms=0.7")), lambda: good(*run("--resume", "auto", "--out", "part", "--set", "drive.max_steps=none"))),
    ("start from the beginning: (--restart)", lambda: (cut("part/checkpoint.h5"), bad(*run("--resume", "auto", "--out", "part")))[1], lambda word: good(*run(word, "--out", "part"))),
    ("take a copy that is whole", lambda: (flip("part/checkpoint.h5"), bad(*run("--resume", "part/checkpoint.h5", "--out", "part")))[1], lambda: (shutil.copy(MADE[0] / "part/checkpoint.h5", "part"), good(*run("--resume", "auto", "--out", "part", "--set", "drive.max_steps=none")))),
    ("take a copy that is whole", lambda: (cut("part/checkpoint.h5"), bad(*run("--resume", "part/checkpoint.h5", "--out", "part")))[1], lambda: (shutil.copy(MADE[0] / "part/checkpoint.h5", "part"), good(*run("--resume", "auto", "--out", "part", "--set", "drive.max_steps=none")))),
    ("keep a checkpoint and its run.journal in one directory", lambda: (shutil.copy("part/checkpoint.h5", "c.h5"), bad(*run("--resume", "c.h5", "--out", "o")))[1], lambda: good(*run("--resume", "part/checkpoint.h5", "--out", "o", "--set", "drive.max_steps=none"))),
    ("take fewer sites", lambda: bad("run", "t.toml", "--out", "o", "--set", "surface.sites=32768", "surface.kind=flat", "block.thickness=1048576", "drive.path=approach"), lambda: good("run", "t.toml", "--out", "o")),
    ('block.model = "multiscale"', lambda: bad("run", "t.toml", "--out", "o", "--set", "surface.sites=4096", "surface.kind=flat", "block.thickness=16384", "drive.path=approach", "block.model=lattice"),
     lambda: good("check", "t.toml", "--set", "block.model=multiscale", "drive.path=approach")),
    ("move it away; the files that it named", lambda: (blank("still/.asperity-files.json"), (Path("still") / "result.json").unlink(), bad("run", "t.toml", "--out", "still"))[2],
     lambda: (Path("still").rename("away"), good("run", "t.toml", "--out", "still"))),
    ("name a directory you may write to: --out DIR", lambda: (blank("f"), bad("run", "t.toml", "--out", "f/x"))[1], lambda: good("run", "t.toml", "--out", "o")),
    ("name another directory", lambda: (blank("f"), bad("run", "t.toml", "--out", "f"))[1], lambda: good("run", "t.toml", "--out", "o")),
    ("name another directory", lambda: bad("run", "t.toml", "--out", "/"), lambda: good("run", "t.toml", "--out", "o")),
    ("for a new run give another --out", lambda: bad("run", "t.toml", "--out", "still", "--resume", "auto"), lambda: good("run", "t.toml", "--out", "o")),
    (r"name another directory \(--out\), or remove this one", lambda: bad("run", "t.toml", "--out", "still"), lambda: (shutil.rmtree("still"), good("run", "t.toml", "--out", "still"))),
    ("or go on with it: --resume (auto)", lambda: (shutil.copy("done/result.json", "part"), bad(*run("--out", "part")))[1], lambda word: good(*run("--resume", word, "--out", "part", "--set", "drive.max_steps=none"))),
    ("go on with it: --resume auto", lambda: bad(*run("--out", "part")), lambda: good(*run("--resume", "auto", "--out", "part", "--set", "drive.max_steps=none"))),
    ("or throw it away: (--restart)", lambda: bad(*run("--out", "part")), lambda word: good(*run(word, "--out", "part"))),
    ("it is not the lock of a run(?s:.*)move it away", lambda: (os.mkdir("o"), blank("o/run.lock"), bad("run", "t.toml", "--out", "o"))[2], lambda: (os.rename("o/run.lock", "o/mine"), good("run", "t.toml", "--out", "o"))),
    ("it is not the lock of a run(?s:.*)move it away", lambda: (os.mkdir("o"), blank("o/run.lock"), bad("sweep", "t.toml", "--out", "o", "--set", "surface.rms=0.1,0.2"))[2], lambda: (os.rename("o/run.lock", "o/mine"), swept("surface.rms=0.1,0.2", out="o"))),
    # Commands of Python
    ("asperity (sweep) (--help)", lambda: bad("sweep", "t.toml", "--bogus"), lambda *words: good(*words)),
    ("did you mean (--quiet)", lambda: bad("theory", "t.toml", "--qiet"), lambda word: good("theory", "t.toml", word)),
    ("for example: asperity (report) results/first-contact", lambda: bad("report"), lambda word: good(word, "done")),
    (r"--poisson, --adhesion are missing(?s:.*)for example: asperity (adhesion gone.npy --young 1GPa --poisson 0.25 --adhesion 200mJ/m2)",
     lambda: bad("adhesion", "gone.npy", "--young", "1GPa"), None),
    ("did you mean (done)", lambda: bad("report", "don"), lambda place: good("report", place)),
    ("did you mean (m.txt)", lambda: (np.savetxt("m.txt", np.eye(4)), bad("convert", "mm.txt"))[1], lambda file: good("convert", file)),
    (r"holds 5 results(?s:.*)name one of them:\s+asperity (report done)\s+asperity", lambda: (shutil.rmtree("part"), bad("report", "."))[1],
     lambda words: good(*words.split())),
    ("holds 2 results: a run and a sweep(?s:.*)move the others", lambda: (shutil.copy("swept/t/sweep.json", "done"), bad("report", "done"))[1],
     lambda: (os.rename("done/sweep.json", "sweep.json"), good("report", "done"))),
    (r"holds stable states(?s:.*)name one of its runs:\s+asperity (report still/run)",
     lambda: (os.mkdir("o"), blank("o/states.json"), os.rename("still", "o/run"), os.rename("o", "still"), bad("report", "still"))[-1],
     lambda words: good(*words.split())),
    ("holds stable states(?s:.*)look at these files", lambda: (os.mkdir("o"), blank("o/states.json"), bad("report", "o"))[2], None),
    ("holds a sweep, not(?s:.*)name one of its runs: (swept/t/rms=0.4)", lambda: bad("export", "swept/t", "--to", "png"),
     lambda place: good("export", place, "--to", "png")),
    ("holds no result of its own(?s:.*)name one of them: (done)", lambda: bad("export", ".", "--to", "png"), lambda place: good("report", place)),
    ("holds a sweep, not(?s:.*)run it again", lambda: (os.mkdir("o"), shutil.copy("swept/t/sweep.json", "o"), bad("export", "o", "--to", "png"))[2],
     None),
    ("write the unit behind the number, (100GPa)", lambda: bad("adhesion", "gone.npy", "--young", "100", "GPa", "--nu", "0.3", "--w", "1J/m2"), None),
    ("write the unit behind the number: (3nm)", lambda: bad("theory", "t.toml", "--set", "surface.rms=3", "nm"), lambda value: good("theory", "t.toml", "--set", f"surface.rms={value}")),
    ("name the map that the scene names", lambda: bad("convert", "t.toml", "x.h5"), None),
    ("asperity (adhesion) (--help)", lambda: bad("adhesion", "map.npy", "--E", "1GPa", "--nu", "x"), lambda *words: good(*words)),
    ("leave it out for 8", lambda: error(lambda: asperity.estimate("t.toml", seeds=1)), None),
    ("give a file, \"scene.toml\", or a dictionary: (.*)", lambda: error(lambda: asperity.check(None)), lambda scene: asperity.check(eval(scene))),
    ("name a directory that asperity estimate", lambda: error(lambda: asperity.load_estimate("done")), None),
    ("two files to write(?s:.*)leave one out", lambda: (np.savetxt("m.txt", np.eye(4)), bad("convert", "m.txt", "a.h5", "-o", "b.h5"))[1], lambda: good("convert", "m.txt", "-o", "b.h5")),
    ("give (adhesion) alone", lambda: error(lambda: asperity.adhesion("gone.npy", young="1 GPa", nu=0.3, work="1 J/m2", w="1 J/m2")), None),
    ("for example young=", lambda: error(lambda: asperity.adhesion("gone.npy", nu=0.3, work="1 J/m2")), None),
    ("no scene is given", lambda: bad("theory", "surface.rms=1"), lambda: good("theory", "t.toml", "surface.rms=1")),
    ("more than one scene(?s:.*)for example: asperity (theory)", lambda: bad("theory", "s.toml", "t.toml"), lambda word: good(word, "t.toml")),
    ("run the scene again, or take a copy", lambda: (cut("still/run.h5"), bad("report", "still"))[1], lambda: (shutil.copy(MADE[0] / "still/run.h5", "still"), good("report", "still"))),
    ("asperity (theory-points) SCENE --points FILE", lambda: bad("theory", "t.toml", "--points", "p"), lambda word: (Path("p").write_text("[]\n"), good(word, "t.toml", "--points", "p"))),
    ("for example --target 1%, or --target 0.01", lambda: bad("cost", "t.toml", "--target", "200%"), None),
    ("name some of these, or leave", lambda: bad("cost", "t.toml", "--parameters", "colour"), None),
    ("for example (256GB) or (62.5GiB)", lambda: bad("plan", "t.toml", "--memory-per-node", "256"), lambda *words: [good("plan", "t.toml", "--memory-per-node", word) for word in words]),
    ("name some of these", lambda: bad("estimate", "t.toml", "--parts", "colour"), lambda: good("estimate", "t.toml", "--parts", "convergence", "--seeds", "2", "--out", "o", "--plan")),
    ("--set (drive.path=relax)", lambda: bad("estimate", "t.toml", "--set", "drive.path=height 5", "drive.mode=quasistatic", "--plan"), lambda word: good("estimate", "t.toml", "--set", word, "--plan")),
    ("name the directory of a run that got past its start", lambda: (without("still/run.h5", "substrate"), bad("export", "still", "--to", "vtk"))[1], lambda: (good("run", "t.toml", "--out", "o"), good("export", "o", "--to", "vtk"))),
    ("asperity (export .*)", lambda: bad("export", "still", "--to", "lammps"), lambda words: good(*words.split())),
    ("asperity (export .*)", lambda: bad("export", "still", "--to", "xdmf"), lambda words: good(*words.split())),
    ("for example: asperity (export .*)", lambda: bad("export", "still", "--to", "bmp"), lambda words: good(*words.split())),
    ("a run that reaches its state at zero load has maps", lambda: bad("export", "short", "--to", "png"), lambda: good("export", "still", "--to", "vtk")),
    ("is empty(?s:.*)leave it out for", lambda: bad("sweep", "t.toml", "--out", "", "--set", "surface.rms=0.1,0.2", "--theory"), lambda: swept("surface.rms=1,2")),
    ("name another directory", lambda: (blank("f"), bad("theory", "t.toml", "--out", "f"))[1], lambda: good("theory", "t.toml", "--out", "o")),
    ("name another directory", lambda: bad("theory", "t.toml", "--out", "/"), lambda: good("theory", "t.toml", "--out", "o")),
    ("name another directory", lambda: (good("theory", "t.toml", "--out", "o"), bad("theory", "t.toml", "--out", "o"))[1], lambda: (shutil.rmtree("o"), good("theory", "t.toml", "--out", "o"))),
    ("it does not end in its digest(?s:.*)move it away", lambda: (os.mkdir("o"), blank("o/.asperity-files.json"), bad("theory", "t.toml", "--out", "o"))[2], lambda: (os.rename("o/.asperity-files.json", "o/x"), good("theory", "t.toml", "--out", "o"))),
    ("name another file, or move it away", lambda: (blank("m.txt"), blank("m.h5"), bad("convert", "m.txt", "m.h5"))[2], lambda: (Path("m.txt").write_text("# Width: 1 nm\n# Height: 1 nm\n# Value units: nm\n" + "1 2\n2 1\n"), good("convert", "m.txt", "n.h5"))),
    ("for example surface.rms=(.*)", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1:2"), lambda values: swept("surface.rms=" + values.replace("0.5:10", "0.5:1"))),
    ("give start:stop:step with a step towards stop", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1:2:-1"), lambda: swept("surface.rms=1:2:1")),
    ("take longer steps", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=0:1:1e-9"), lambda: swept("surface.rms=0.5:1:0.5")),
    ("for example --set (.*)=v1,v2", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1,,2"), lambda key: swept(key + "=1,2")),
    ("one run for each: asperity run SCENE --set '(.*)'", lambda: bad("sweep", "t.toml", "--set", 'output.fields=["relaxed"],["segments"]'), lambda words: good("run", "t.toml", "--out", "o", "--set", words)),
    ("write one scene for each", lambda: (Path("u.toml").write_text(STILL + '[sweep]\noutput.fields = ["relaxed"]\n'), bad("sweep", "u.toml"))[1], lambda: good("run", "t.toml", "--out", "o", "--set", "output.fields=relaxed")),
    ("put its values into one list: --set (.*)=v1,v2", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1,2", "--set", "surface.rms=3,4"), lambda key: swept(key + "=1,2,3,4")),
    ("sweep fewer values", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1:2000:1", "--set", "surface.seed=1:2000:1"), lambda: swept("surface.rms=1:2:1")),
    ("for a single run: asperity run", lambda: bad("sweep", "t.toml"), lambda: good("run", "t.toml", "--out", "o")),
    ("for example --set surface.rms=(1,2,3);", lambda: bad("sweep", "t.toml"), lambda values: swept("surface.rms=" + values)),
    ("for example --set (drive.load=.*)", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.kind=flat"), lambda words: swept("surface.kind=flat", words)),
    ("for example --set surface.rms=(1,2,3) or", lambda: bad("sweep", "t.toml", "--theory", "--set", "surface.rms=1"), lambda values: swept("surface.rms=" + values)),
    ("give every value once", lambda: bad("sweep", "t.toml", "--out", "o", "--set", "surface.rms=1,1.0"), lambda: swept("surface.rms=0.4,0.5")),
    (r"name another directory \(--out\), or remove", lambda: bad("sweep", "t.toml", "--out", "swept/t", "--set", "drive.load=1,2"), lambda: swept("drive.load=1,2", out="o")),
    (r"name another directory \(--out\), or remove", lambda: (shutil.copytree("still", "o/rms=0.4"), bad("sweep", "t.toml", "--out", "o", "--set", "surface.rms=0.4,0.5"))[1], lambda: swept("surface.rms=0.4,0.5", out="p")),
    ("name another directory, or remove this one", lambda: (swept("surface.rms=1,2", out="o"), bad("sweep", "t.toml", "--theory", "--out", "o", "--set", "surface.rms=1,2"))[1], lambda: swept("surface.rms=1,2", out="p")),
    ("rename one of the files", lambda: (os.mkdir("x"), shutil.copy("t.toml", "x/t.toml"), bad("sweep", "t.toml", "x/t.toml", "--theory", "--set", "surface.rms=1,2"))[2], lambda: (os.rename("x/t.toml", "x/u.toml"), good("sweep", "t.toml", "x/u.toml", "--theory", "--set", "surface.rms=1,2"))),
    ("for example --executor dask:", lambda: bad("sweep", "t.toml", "--executor", "slurm", "--set", "surface.rms=1,2"), lambda: swept("surface.rms=1,2")),
    ("for example 23h50m, (45m)", lambda: bad("sweep", "t.toml", "--wall-limit", "soon", "--set", "surface.rms=1,2"), lambda limit: asperity.terminal.parse_duration(limit)),
    ("start it alone", lambda: bad("theory", "t.toml", "--out", "o", env={"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0"}), lambda: good("theory", "t.toml", "--out", "o")),
    ("name one of its runs: ", lambda: error(lambda: asperity.load("swept/t")), lambda: asperity.load(next(Path("swept/t").glob("*/result.json")).parent)),
    ("remove it to begin anew", lambda: (None, unreadable(), bad("states", "t.toml", "--starts", "1", "--out", "o"))[2], lambda: (shutil.rmtree("o"), good("states", "t.toml", "--starts", "1", "--out", "o"))),
    ("name another directory, or remove", lambda: (good("states", "t.toml", "--starts", "1", "--out", "o"), bad("states", "t.toml", "--starts", "1", "--out", "o"))[1], lambda: good("states", "t.toml", "--starts", "1", "--out", "p")),
]
PYTHON = [
    ("give a length in Å or a load in MPa", lambda: error(lambda: setattr(statics(), "mean_height", float("nan"))), lambda: setattr(statics(), "mean_height", 5.0)),
    ("or go there in parts", lambda: error(lambda: setattr(statics(), "top", 1e300)), lambda: setattr(statics(), "top", 5.0)),
    ("go there in parts", lambda: error(lambda: setattr(statics(), "mean_height", -1e9)), lambda: setattr(statics(), "mean_height", 5.0)),
    ("take a load below", lambda: error(lambda: setattr(statics(), "load", 1e9)), lambda: setattr(statics(), "load", 10.0)),
    (r"give the block branches \(block.prony\)", lambda: error(lambda: statics().hold(1.0)), lambda: soft().hold(1.0)),
    (r'take drive.path = (\[.*\]) in the scene', lambda: error(lambda: statics(block__prony=[[1.0, "1 ns"]]).hold(1.0)), lambda path: statics(block__prony=[[1.0, "1 ns"]], drive__path=json.loads(path), drive__mode="quasistatic").hold(1.0)),
    ("a time is above 0 ps(?s:.*)give one", lambda: error(lambda: soft().hold(-1.0)), lambda: soft().hold(1.0)),
    ("give a state of this scene", lambda: error(lambda: statics().restore(statics(surface__sites=20).copy())), lambda: (lambda s: s.restore(s.copy()))(statics())),
    (r"or asperity.State\(u, top\)", lambda: error(lambda: soft().restore(soft([[2.0, "1 ns"], [1.0, "2 ns"]]).copy())), lambda: soft().restore(asperity.State(np.zeros((3, 16, 16)), 5.0))),
    ("no state follows from them(?s:.*)write numbers", lambda: error(lambda: statics().restore(asperity.State(np.full((3, 16, 16), np.nan), 5.0))), lambda: statics().restore(asperity.State(np.zeros((3, 16, 16)), 5.0))),
    ("begin another Statics", lambda: error(lambda: (lambda s: (setattr(s, "top", 9.0), setattr(s, "mean_height", 8.0)))(statics())), lambda: setattr(statics(), "mean_height", 8.0)),
    ("the top plane needs a number(?s:.*)give one", lambda: error(lambda: setattr(sim().top, "velocity", float("nan"))), lambda: setattr(sim().top, "velocity", 0.0)),
    ("only finite numbers can be stepped with(?s:.*)write numbers", lambda: error(lambda: (lambda s: (s.u.z.fill(np.nan), s.step(1)))(sim())), lambda: (lambda s: (s.u.z.fill(0.0), s.step(1)))(sim())),
    ("take asperity.Statics", lambda: error(lambda: asperity.Simulation("t.toml")), lambda: asperity.Statics("t.toml")),
    ("is for `asperity run --resume`", lambda: error(lambda: asperity.Simulation.resume("part/checkpoint.h5")), lambda: good(*run("--resume", "part/checkpoint.h5", "--out", "o", "--set", "drive.max_steps=none"))),
    ("name another file", lambda: error(lambda: sim().save(blank("x"))), lambda: sim().save("y")),
    ("give a number from 0 on", lambda: error(lambda: sim().step(-1)), lambda: sim().step(1)),
    ("step in the loop of the program", lambda: error(lambda: (lambda s: (s.every(1, lambda t: t.step(1)), s.step(2)))(sim())), lambda: sim().step(2)),
    ("a number from 1 on", lambda: error(lambda: sim().every(0, print)), lambda: sim().every(1, print)),
    ("give a force for each of them", lambda: error(lambda: setattr(sim(), "external", [np.zeros((2, 2))] * 3)), lambda: setattr(sim(), "external", [np.zeros((16, 16))] * 3)),
    ("take the field away before", lambda: error(lambda: (lambda s: (setattr(s, "external", np.zeros((16, 16, 3))), s.relax()))(sim())), lambda: (lambda s: (setattr(s, "external", None), s.relax()))(sim())),
    ("begin a new one, or resume", lambda: error(lambda: (lambda s: (s.step(10**6), s.top))(ended())), lambda: sim().step(1)),
    ('forces stay in its memory(?s:.*)take numerics.device = "none"', lambda: error(lambda: sim(numerics__device="emulated").f), lambda: sim().f),
    ("give a function of the simulation", lambda: error(lambda: sim().every(1, 5)), lambda: sim().every(1, print)),
    ("give it another name", lambda: error(lambda: (lambda s: (s.every(1, lambda t: 1.0, "force"), s.step(1)))(sim())), lambda: (lambda s: (s.every(1, lambda t: 1.0, "mine"), s.step(1)))(sim())),
    ("return a number, a dictionary", lambda: error(lambda: (lambda s: (s.every(1, lambda t: "x"), s.step(1)))(sim())), lambda: (lambda s: (s.every(1, lambda t: 1.0), s.step(1)))(sim())),
    ("name another directory, or remove", lambda: error(lambda: sim().write("done")), lambda: sim().write("o")),
    ("take one of these", lambda: error(lambda: asperity.estimate("t.toml", out="e", seeds=2, parts=["convergence"]).number("colour")), lambda: asperity.load_estimate("e").number(next(iter(asperity.load_estimate("e").numbers)))),
    ("take one of these", lambda: error(lambda: asperity.load("still").plot.gaps(state="pulled")), lambda: asperity.load("still").plot.gaps(state="relaxed")),
    ("take one of these", lambda: error(lambda: asperity.load("still").plot.map("colour")), lambda: asperity.load("still").plot.map("gap")),
    ("leave it out for one after the other", lambda: error(lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, jobs=0, out="o")), lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, out="o")),
    ("give one that is not shut down", lambda: error(lambda: (lambda e: (e.shutdown(), asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, executor=e, out="o")))(ThreadPoolExecutor(1))), lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, executor=ThreadPoolExecutor(1), out="p")),
    ('remove the member "digest"', lambda: (change("still/result.json", '"t"', '"u"'), error(lambda: asperity.load("still")))[1], lambda: (change("still/result.json", json.loads(Path("still/result.json").read_text())["digest"], ""), Path("still/result.json").write_text(re.sub(r',?\s*"digest": ?""', "", Path("still/result.json").read_text())), asperity.load("still"))),
    ("a run that was killed leaves no result.json before it is (resumed)", lambda: (Path("part/run.h5").unlink(missing_ok=True), error(lambda: asperity.load("part")))[1], lambda word: (good(*run("--resume", "auto", "--out", "part", "--set", "drive.max_steps=none")), asperity.load("part"))),
    ("name a directory that a run has written", lambda: error(lambda: asperity.load("nowhere at all")), lambda: asperity.load("still")),
    ("the theory alone and a run that failed early have none", lambda: (good("theory", "t.toml", "--out", "o"), error(lambda: result.RunFile(Path("o/run.h5")).array("x", 2)))[1], lambda: asperity.load("still").relaxed),
    ("run the scene again, or resume it", lambda: (cut("still/run.h5"), error(lambda: result.RunFile(Path("still/run.h5")).array("x", 2)))[1], lambda: (shutil.rmtree("still"), good("run", "t.toml", "--out", "still"), asperity.load("still").relaxed)),
    ("a run has one or more(?s:.*)leave it out for one", lambda: error(lambda: asperity.run("t.toml", ranks=0, out="o")), lambda: asperity.run("t.toml", out="o")),
    ("give a number, a text, true or false", lambda: error(lambda: asperity.run({"surface": {"rms": object()}})), lambda: asperity.run({"surface": {"rms": 0.5, "sites": 16}, "drive": {"path": ["relax"]}}, out="o")),
    (r'or (\["surface.rms=2.0"\])', lambda: error(lambda: asperity.run("t.toml", 5)), lambda words: asperity.run("t.toml", json.loads(words), out="o")),
    ("leave the key out, or give it a value", lambda: error(lambda: asperity.run("t.toml", {"surface.rms": None})), lambda: asperity.run("t.toml", {"surface.rms": 0.4}, out="o")),
    ("name another directory, or remove it", lambda: other_search(), lambda: asperity.states("t.toml", out="p", starts=1)),
    ("load one of them: (.*)", lambda: error(lambda: asperity.load_sweep("swept")), lambda place: asperity.load_sweep(place)),
    ("of a single run: asperity.load", lambda: error(lambda: asperity.load_sweep("still")), lambda: asperity.load("still")),
    ("run the sweep again into another directory", lambda: (os.mkdir("o"), Path("o/sweep.json").write_text("{}"), error(lambda: asperity.load_sweep("o")))[2], lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, theory_only=True, out="p")),
    ("for example mpi4py.futures", lambda: error(lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, executor=5)), lambda: asperity.sweep("t.toml", {"surface.rms": [0.4, 0.5]}, executor=ThreadPoolExecutor(1), out="p")),
    (r'for example (\{"surface.rms": .*\})', lambda: error(lambda: asperity.sweep("t.toml", 5)), lambda values: asperity.sweep("t.toml", json.loads(values), theory_only=True, out="p")),
    ("wait for its end", lambda: in_use(lambda: bad("run", "t.toml", "--out", "o")), lambda: good("run", "t.toml", "--out", "o")),
    ("wait for its end", lambda: in_use(lambda: bad("theory", "t.toml", "--out", "o")), lambda: good("theory", "t.toml", "--out", "o")),
    ("give what copy() returned, or asperity.State".replace("(", r"\(").replace(")", r"\)"), lambda: error(lambda: statics().restore(5)), lambda: (lambda s: s.restore(s.copy()))(statics())),
    ('or a text with a unit, for example "(.*)"', lambda: error(lambda: setattr(statics(), "top", [1])), lambda text: setattr(statics(), "top", text)),
    ('or one with a unit, for example "(.*)"', lambda: error(lambda: setattr(statics(), "top", "soon")), lambda text: setattr(statics(), "top", text)),
    (r"give an array \[y, x, 3\], or", lambda: error(lambda: setattr(sim(), "external", np.zeros(3))), lambda: setattr(sim(), "external", np.zeros((16, 16, 3)))),
    (r"give an array \[3, y, x\]", lambda: error(lambda: asperity.State(np.zeros(3))), lambda: asperity.State(np.zeros((3, 4, 4)))),
    ("name another file, or move it away", lambda: (blank("m.txt"), os.symlink("nowhere", "m.h5"), bad("convert", "m.txt", "m.h5"))[2], lambda: (Path("m.txt").write_text("# Width: 1 nm\n# Height: 1 nm\n# Value units: nm\n" + "1 2\n2 1\n"), good("convert", "m.txt", "n.h5"))),
    ("or set ASPERITY_PROGRAM to its path", lambda: no_program(), lambda: program.path()),
]
MADE: list[Path] = []


def swept(*sets, out=None, **options):
    """A sweep of the theory, without its pictures."""
    words = [word for word in sets if "=" in word]
    values = {word.partition("=")[0]: grid.axes_of([word], [])[0] for word in words}
    several = {key: axes[0].values for key, axes in values.items() if axes}
    fixed = [word for word in words if not values[word.partition("=")[0]]]
    return asperity.sweep({**tomllib.loads(STILL), "name": "t"}, several, theory_only=True, out=out or "swept-theory") if not fixed else good(
        "theory", "t.toml", "--set", *fixed)


def soft(branches=((1.0, "1 ns"),)):
    return statics(block__prony=[list(one) for one in branches], drive__path=["approach"], drive__mode="quasistatic")


def without(file, name):
    with unsealed(file) as opened:
        del opened[name]


def in_use(call):
    """What is said while another process has the directory o."""
    lines = "import pathlib, sys, asperity.running.lock as lock\nwith lock.in_use(pathlib.Path('o')):\n print('there', flush=True)\n sys.stdin.read()"
    with subprocess.Popen([sys.executable, "-c", lines], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}) as other:
        other.stdout.readline()
        return call()


def no_program():
    lines = "import pathlib, shutil, os, asperity.running.program as p\nos.path.isfile = lambda place: False\nshutil.which = lambda name: None\np.path()"
    done = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    return done.stderr.partition("InputOutputError: ")[2]


def unreadable():
    """Writes a file of a stopped search that is none."""
    Path("o").mkdir()
    Path("o", states.UNFINISHED).write_bytes(b"PK no such file")
    store._update(Path("o"), lambda _: {states.UNFINISHED: store.UNFINISHED})


def ended():
    """A simulation whose error of physics ended it."""
    found = sim(drive__timestep=28.0)
    found.v.z.fill(1.0)
    with contextlib.suppress(asperity.Error):
        found.step(10**6)
    return found


def stopped_search():
    """Leaves a search of another scene that was stopped in o."""
    told: list[str] = []

    def stop(text):
        told.append(text)
        if len(told) == 5:
            raise KeyboardInterrupt

    before, states.SAVE_EVERY = states.SAVE_EVERY, 0.0
    with contextlib.suppress(KeyboardInterrupt):
        asperity.states("t.toml", {"surface.rms": 0.7}, out="o", starts=1, report=stop)
    states.SAVE_EVERY = before


def other_search():
    stopped_search()
    return error(lambda: asperity.states("t.toml", out="o", starts=1))


@pytest.mark.parametrize("case", [*COMMANDS, *PYTHON], ids=range(len(COMMANDS + PYTHON)))
def test_a_fix(case, made):
    MADE[:] = [made]
    says, wrong, right = case
    said = wrong()
    found = re.search(says, said)
    assert found, said
    if right:
        right(*found.groups())
    followed(said)


def test_scenes_of_another_folder():
    assert ask("scenes", "here")[0] == 0
    code, said = ask("scenes", "here")
    assert code == 4 and "name another folder: asperity scenes FOLDER" in said, said
    assert ask("scenes", "there")[0] == 0
    followed(said)
    code, said = ask("scenes", "here", "-o", "there")
    assert code == 2 and "two folders to write are given" in said, said
    assert ask("scenes", "-o", "elsewhere")[0] == 0
    followed(said)


@pytest.mark.parametrize("bad, good", [
    ({"load": "5"}, {"load": "5 nN"}), ({"sites": 16}, {"sites": 24}), ({"load": "2 µN"}, {"load": "1 nN"}),
    ({"radius": "3 nm", "young": "0.5 GPa"}, {"radius": "3 nm", "young": "50 GPa"}), ({"range": "20 nm"}, {"range": "1 nm"}),
    ({"range": "0.01 nm"}, {"range": None}), ({"file": "map.npy", "size": "10 nm"}, {"file": "map.npy", "size": "60 nm"}),
    ({"error": "5%", "sites": 32}, {"error": "5%"}), ({"error": "3"}, {"error": "10%"}), ({"radius": None}, {"radius": "20 nm"}),
    ({"angle": 60.0}, {"shape": "cone", "angle": 60.0}), ({"shape": "cone", "angle": 65.0, "hardness": "1 GPa"}, {"hardness": "1 GPa"}), ({"shape": "cone"}, {"shape": "cone", "angle": 65.0}),
    ({"shape": "pyramid", "angle": 95.0}, {"shape": "pyramid", "angle": 65.0}),
    ({"tip_map": "tip.txt"}, {"tip_map": "tip.txt", "radius": None}),
    ({"tip_map": "tip.txt", "radius": None, "shape": "cone"}, {"tip_map": "tip.txt", "radius": None}),
    ({"tip_map": "map.npy", "radius": None}, {"tip_map": "tip.txt", "radius": None}),
    ({"tip_map": "slope.txt", "radius": None}, {"tip_map": "tip.txt", "radius": None})])
def test_a_fix_of_a_tip(bad, good):
    np.save("map.npy", np.random.default_rng(0).normal(size=(32, 32)))
    x, y = np.meshgrid(*[np.linspace(-20, 20, 41)] * 2)
    for name, heights in (("tip.txt", -(x * x + y * y) / 40), ("slope.txt", 0.1 * x)):
        np.savetxt(name, heights, header="Width: 41 nm\nHeight: 41 nm\nValue units: nm")
    given = a_tip(unit="Å")

    def plan(file=None, **more):
        return tip.plan_of(file, Path("tip"), {**given, **more})

    with pytest.raises(asperity.SceneError) as error:
        plan(**bad)
    assert plan(**good).scenes
    followed(str(error.value))


def test_an_error_that_the_memory_holds(monkeypatch):
    given = a_tip()
    monkeypatch.setattr("os.sysconf", {"SC_PHYS_PAGES": 2**14, "SC_PAGE_SIZE": 2**12}.get)
    with pytest.raises(asperity.SceneError) as error:
        tip.plan_of(None, Path("tip"), {**given, "error": "0.6%"})
    assert tip.plan_of(None, Path("tip"), {**given, "error": re.search(r"--error (\d+%)", str(error.value))[1]}).scenes
    followed(str(error.value))


def test_a_tip_is_loaded():
    with pytest.raises(asperity.InputOutputError) as error:
        asperity.load_tip("nowhere")
    given = {"radius": "20 nm", "E": "3 GPa", "nu": 0.3, "w": "50 mJ/m2", "stiffness": "2 N/m", "range": "0.3 nm", "sites": 24}
    asperity.tip(**given, out="made")
    assert asperity.load_tip("made").number("pull_off_force").estimate > 0
    followed(str(error.value))
    with pytest.raises(asperity.SceneError) as error:
        TipShape("measured", 20.0, half=30.0).rise(np.zeros(1), np.zeros(1))
    assert asperity.tip(**given, out="made").contact.radius == 20
    followed(str(error.value))


def test_what_cannot_be_simulated():
    height, force, way = test_curve.measured("jkr", count=300)
    Path("a.txt").write_text(test_curve.text_of(height, force, way))
    for given in ({"shape": "cone", "angle": 60.0, "model": "jkr"}, {"radius": "20 nm", "model": "hertz"}):
        with pytest.raises(asperity.SceneError) as error:
            asperity.curve("a.txt", stiffness="2 N/m", **given, simulate=True)
        assert asperity.curve("a.txt", stiffness="2 N/m", **given, out=given["model"]).curves
        followed(str(error.value))


def test_a_number_of_a_tip():
    numbers = [Number("lost", "W", "energy lost", "aJ", 1.0)]
    nothing = np.zeros(1)
    found = tip.Tip(numbers, nothing, nothing, nothing, nothing, tip.Contact(20, 3, 0.05, 0.3, 2), tip.Fit(), None, [], Path("tip"))
    with pytest.raises(asperity.SceneError, match=r"(?s)Tip: has no number 'losses'.*did you mean lost") as error:
        found.number("losses")
    assert found.number("lost").value == 1.0
    followed(str(error.value))


@pytest.mark.parametrize("name, make, says", [
    ("run.lock", os.mkfifo, "is no regular file\n    why: it is a pipe\n    fix: move it away, or name another file"),
    (store.RECORD, lambda name: (Path(name).touch(), os.truncate(name, 1 << 29)), "bytes, and 268435456 are the limit\n    fix: move it away")])
def test_an_object_in_the_way_is_moved_away(name, make, says):
    Path("t.toml").write_text(STILL)
    os.mkdir("o")
    make(f"o/{name}")
    said = bad("run", "t.toml", "--out", "o", code=4)
    assert says in said, said
    os.rename(f"o/{name}", "mine")
    good("run", "t.toml", "--out", "o")
    followed(said)


@pytest.mark.parametrize("wrong, right", [
    (lambda: asperity.states("t.toml", starts=-1), lambda: asperity.states("t.toml", starts=0)),
    (lambda: asperity.Simulation("d.toml", comm=3), lambda: asperity.Simulation("d.toml")),
    (lambda: asperity.crack.modulus([2.0], 1.0), lambda: asperity.crack.modulus([(2.0, "1 ns")], 1.0)),
    (lambda: MAP_OPTIONS.of_call({**GIVEN, "sites": 3}), lambda: MAP_OPTIONS.of_call(GIVEN)),
    (lambda: MAP_OPTIONS.of_call({**GIVEN, "line_noise": "none"}), lambda: MAP_OPTIONS.of_call({**GIVEN, "line_noise": "align-rows"}))],
    ids=["starts", "comm", "branches", "limits", "choices"])
def test_a_fix_of_an_argument(wrong, right):
    Path("t.toml").write_text(STILL)
    Path("d.toml").write_text(TINY)
    with pytest.raises(asperity.SceneError) as error:
        wrong()
    right()
    followed(str(error.value))


WALL = ('[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 8\n[interface]\nkind = "wall"\nadhesion = "0 mJ/m^2"\nrange = "2 Å"\n'
        '[drive]\nmode = "quasistatic"\npath = ["relax"]\nload = "100 MPa"\n')


def test_fixes_of_stresses():
    Path("w.toml").write_text(WALL)
    good("run", "w.toml", "--out", "pressed")
    for where, wrong in (("still", ()), ("a", ["--set", "block.model=lattice"]), ("b", ["--set", "output.fields=[]"])):
        if wrong:
            good("run", "w.toml", "--out", where, *wrong)
        followed(bad("stress", where))
    followed(bad("stress", "pressed", "--friction", "9"))
    good("stress", "pressed", "--friction", "0.3")
    said = error(lambda: asperity.stress(object()))
    asperity.stress("pressed", out="again")
    followed(said)
    followed(error(lambda: asperity.stress("pressed", solid="other")))
    followed(bad("stress", "pressed", "--solid", "counter"))
    good("stress", "pressed", "--solid", "block", "--out", "block")
    Path("flat.txt").write_text(("0 " * 16 + "\n") * 16)
    good("run", "w.toml", "--out", "slid", "--set", "surface.counter=flat.txt", 'drive.path=["approach", "slide x 1 Å"]', "output.fields=segments")
    followed(bad("stress", "slid"))
    good("stress", "slid", "--friction", "0.3")


def test_the_fix_of_a_surface_that_yields_as_a_whole():
    Path("w.toml").write_text(WALL.replace('load = "100 MPa"\n', "").replace('"relax"', '"height -2 Å"'))
    followed(bad("run", "w.toml", "--set", "interface.hardness=0.5 GPa", "--out", "o", code=3))
    good("run", "w.toml", "--set", "interface.hardness=900 GPa", "--out", "p")


def test_every_message_is_followed():
    left = not_followed(OTHERS, EXCUSED, others=True)
    assert not left, "\n".join(left)
