# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The package from this source tree, the program of $ASPERITY_PROGRAM, and a few small results."""

import contextlib
import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import h5py
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
os.environ.setdefault("ASPERITY_PROGRAM", str(ROOT / "build/release/engine/asperity"))
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("MPLBACKEND", "agg")

import asperity  # noqa: E402
import asperity.arguments  # noqa: E402
import asperity.running.runs  # noqa: E402
from asperity.commands.options import purposes  # noqa: E402

SMALL = {"name": "small", "surface": {"sites": 32, "rms": 0.5}, "drive": {"velocity": 100.0, "timestep": 20.0}}
# Starts the rest of the command line on the processors that the environment names for this rank.
BOUND = """
import json, os, sys
rank = int(os.environ.get("OMPI_COMM_WORLD_RANK") or os.environ.get("PMI_RANK", 0))
os.sched_setaffinity(0, json.loads(os.environ["PROCESSORS"])[rank])
os.execv(sys.argv[1], sys.argv[1:])
"""
STATE = {"name": "state", "surface": {"sites": 24}, "drive": {"path": ["relax"]}}


OF_PYTHON = tuple(purposes())
"""Commands of the package, which the program starts."""


def in_this_process(words, given="", cwd=None):
    """Carries out a command of the package without starting Python again: its exit code, and what it prints to either stream."""
    from asperity.__main__ import main

    streams, before = (io.StringIO(), io.StringIO()), sys.stdin
    with contextlib.chdir(cwd or "."), contextlib.redirect_stdout(streams[0]), contextlib.redirect_stderr(streams[1]):
        with warnings.catch_warnings():
            warnings.simplefilter("default")
            warnings.showwarning = lambda *a: print(warnings.formatwarning(*a[:4]), file=sys.stderr)
            sys.stdin = io.StringIO(given or "")
            try:
                code = main([str(word) for word in words])
            except SystemExit as ended:  # --help
                code = int(ended.code or 0)
            finally:
                sys.stdin = before
    return code, *(stream.getvalue() for stream in streams)


def command(*words, expect=0, says=(), ranks=0, cwd=None, env=None, given=None):
    """Runs the program, on `ranks` of the launcher or alone, with `given` as its standard input; the text that it
    prints. The exit code must be `expect`, and the text hold `says`. A command of the package runs in this process."""
    if words and words[0] in OF_PYTHON and not ranks and env is None:
        code, *streams = in_this_process(words, given, cwd)
        return as_expected(words, code, "".join(streams), expect, says)
    launcher = [*asperity.running.runs.launcher(2)[:-1], str(ranks)] if ranks else []
    done = subprocess.run([*launcher, os.environ["ASPERITY_PROGRAM"], *map(str, words)], cwd=cwd, input=given,
                          text=True, capture_output=True, timeout=120 if ranks else None,
                          env={**os.environ, **(env or {})})
    return as_expected(words, done.returncode, done.stdout + done.stderr, expect, says)


def unfolded(text):
    """The text whose lines, folded to 80 columns, are whole again: a line was cut where its next word had no place."""
    lines, columns = [], 0
    for line in text.split("\n"):
        words, table = line.split(), re.search(r"\S  +\S|──", line)
        first = " ".join(words[:1 + bool(words and re.fullmatch(r"[-+(.\de]+", words[0]))])
        indent = len(line) - len(line.lstrip()) if lines and not lines[-1].startswith(" ") else 0
        if lines and columns and words and not table and columns + 1 + len(first) > 80 - indent:
            lines[-1] += " " + " ".join(words)
        else:
            lines.append(line)
        columns = len(line)
    return "\n".join(lines)


def as_expected(words, code, said, expect, says):
    """Checks the end of a command. Returns the text."""
    assert code == expect, f"exit {code}: {words}\n{said}"
    for text in [says] if isinstance(says, str) else says:
        assert (text in said or " ".join(text.split()) in " ".join(said.split())), f"{words} did not say {text!r}:\n{said}"
    return unfolded(said)


def found(directory):
    """All that a run found: its result, but for what says where and how fast it was made."""
    result = json.loads((Path(directory) / "result.json").read_text())
    del result["digest"], result["scene"]["numerics"]["device"], result["units"]["run"]
    return {**result, "run": [result["run"].get(name) for name in ("steps", "iterations")]}


@contextlib.contextmanager
def started(*words):
    """The program while it goes on. It is killed at the end."""
    child = subprocess.Popen([os.environ["ASPERITY_PROGRAM"], *map(str, words)], stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL)
    try:
        yield child
    finally:
        child.kill()
        child.wait()


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not (found := condition()):
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)
    return found


def running(words):
    """Processes with these words in their command lines."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if words.encode() in (process / "cmdline").read_bytes().replace(b"\0", b" "):
                found.append(int(process.name))
    return found


def status(process, name):
    """What the kernel says of a process; nothing of one that is gone."""
    with contextlib.suppress(OSError):
        return re.findall(rf"^{name}:\s+(\w+)", Path(f"/proc/{process}/status").read_text(), re.M)
    return []


@contextlib.contextmanager
def held(words):
    """The processes with these words, which do not go on meanwhile, so that none ends before it is told to."""
    processes = running(words)
    for process in processes:
        os.kill(process, signal.SIGSTOP)
    wait_for(lambda: all(status(process, "State") in (["T"], ["Z"], []) for process in processes))
    processes = [process for process in processes if status(process, "State") == ["T"]]
    try:
        yield processes
    finally:
        for process in processes:
            os.kill(process, signal.SIGCONT)


def is_told(process):
    """Whether USR1 waits for a process that is held."""
    return any(int(mask, 16) >> (signal.SIGUSR1 - 1) & 1 for mask in status(process, "S(?:ig|hd)Pnd"))


def rows(table):
    """Of a sweep.csv or cost.csv, without what depends on time."""
    with open(table) as file:
        return [{k: v for k, v in row.items() if "seconds" not in k} for row in csv.DictReader(file)]


@contextlib.contextmanager
def unsealed(path):
    """A run.h5 to change: without its digest, it is read like that of another program."""
    with h5py.File(path, "r+") as file:
        del file.attrs["asperity_digest"]
        yield file


def pytest_configure(config):
    config.option.reportchars += "s"  # says why tests are skipped


def pytest_sessionfinish(session):
    """Exit code 77, which ctest knows as skipped, where every test was. (A module that skips itself leaves no test.)"""
    outcomes = session.config.pluginmanager.get_plugin("terminalreporter").stats
    if outcomes.get("skipped") and not outcomes.keys() & {"passed", "failed", "error"}:
        session.exitstatus = 77


@pytest.fixture(scope="session")
def mpi4py_launcher():
    """The launcher for ranks of Python. Skips where there is no mpi4py, or one of another MPI than the program: its
    ranks are not connected by the program's launcher."""
    pytest.importorskip("mpi4py", reason="no mpi4py: apt-get install python3-mpi4py")
    asked = "import mpi4py; mpi4py.rc.initialize = False; from mpi4py import MPI; print(MPI.Get_library_version())"
    theirs = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout
    ours = asperity.running.program.mpi()
    if theirs.split()[0] != ours.split()[0]:
        pytest.skip(f"mpi4py is of {theirs.split(',')[0]}, the program of {ours}")
    return asperity.running.runs.launcher


@pytest.fixture(autouse=True)
def as_sources_spell(request):
    """Messages whose fixes are followed name options as their sources do, also of calls of Python (test_functions.py has those)."""
    with asperity.arguments.command_line() if request.module.__name__.startswith("test_fixes_") else contextlib.nullcontext():
        yield


@pytest.fixture()
def place(tmp_path, monkeypatch):
    """An empty working directory, with a space in its name."""
    work = tmp_path / "a place"
    work.mkdir()
    monkeypatch.chdir(work)
    return work


@contextlib.contextmanager
def without_pictures():
    """Leaves the renormalised theory, the drawing of pictures and most points of the theories' curves out of the commands of this
    process, which would take most of the time of a test that looks at none of them. undo() puts them back."""
    from asperity.plots import run, style  # here: they load OpenMP, and ranks.py imports this file before it chooses threads
    from asperity.studies import sweeps
    from asperity.theories import combined

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(combined, "_known", {})
        patch.setattr(combined, "_renormalised", lambda rough, quick: {"note": "left out by a test"})
        patch.setattr(sweeps, "CURVE", 2)
        patch.setattr(run, "CURVE", 2)
        patch.setattr(style, "picture", lambda fig, kind: b"a picture")
        patch.setattr(style, "inline_svg", lambda fig: "<svg></svg>")
        yield patch


@pytest.fixture()
def light():
    with without_pictures() as patch:
        yield patch


@pytest.fixture(scope="module")
def light_module():
    """For all of a module: pytestmark = pytest.mark.usefixtures("light_module")."""
    with without_pictures():
        yield


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    return tmp_path_factory.mktemp("a place")  # with a space in its name


@pytest.fixture(scope="session")
def path_run(results):
    """Approach and pull-off with a trajectory."""
    return asperity.run(SMALL, {"output.trajectory": 300, "output.velocities": True}, out=results / "path")


@pytest.fixture(scope="session")
def state_run(results):
    return asperity.run(STATE, {"surface.rms": 0.5}, out=results / "state")


@pytest.fixture(scope="session")
def sphere_run(results):
    return asperity.run(SMALL, {"surface.radius": 100.0, "surface.rms": 0.2, "output.series": 10},
                        out=results / "sphere")
