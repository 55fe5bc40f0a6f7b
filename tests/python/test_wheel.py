# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a wheel is made of, without building one (that is tests/cli/wheel.sh): the module as the program, the one rank of a build
without MPI, and the scenes that come along."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT

PROGRAM = Path(os.environ["ASPERITY_PROGRAM"])
ONE_RANK = PROGRAM.parents[1] / "tests" / "asperity_one_rank"
MODULE = [sys.executable, "-c", "import sys; from asperity.running.engine import load; load(); from asperity.__main__ import entry; "
                                "sys.exit(entry())"]
STATE = ["run", "small.toml", "--progress", "off"]


def call(words, folder, **environment):
    return subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, timeout=120,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python"), **environment})


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "small.toml").write_text('surface = { sites = 24, rms = 0.8 }\ndrive = { path = ["relax"] }\n')
    return tmp_path


def numbers(folder):
    result = json.loads((folder / "result.json").read_text())
    return {key: value for key, value in result.items() if key not in ("run", "digest")}


@pytest.mark.parametrize("name, start", [("module", MODULE), ("one rank", [ONE_RANK])])
def test_it_is_the_program(folder, name, start):
    for words, out in (([PROGRAM], "program"), (start, name)):
        done = call([*words, *STATE, "--out", out], folder)
        assert done.returncode == 0, done.stderr
    assert numbers(folder / name) == numbers(folder / "program") and numbers(folder / name)
    for words, code in ((["run", "none.toml"], 4), (["check", "small.toml", "--set", "surface.rsm=1"], 2), (["--version"], 0), ([], 2)):
        theirs, ours = (call([*begin, *words], folder) for begin in ([PROGRAM], start))
        assert (ours.returncode, ours.stdout, ours.stderr) == (theirs.returncode, theirs.stdout, theirs.stderr), words


def test_one_rank_refuses_a_launcher(folder):
    done = call([ONE_RANK, *STATE], folder, OMPI_COMM_WORLD_SIZE="2", OMPI_COMM_WORLD_RANK="0")
    assert done.returncode == 2 and "built without MPI" in done.stderr and "fix: start it alone" in done.stderr
    assert not (folder / "results").exists()
    assert "none (one process)" in call([ONE_RANK, "info"], folder).stdout


def test_a_closed_pipe_ends_the_module_as_it_ends_the_program(tmp_path):
    for start in ([PROGRAM], MODULE):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([*map(str, start), "defaults"], stdout=writer, stderr=subprocess.PIPE, text=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
        os.close(writer)
        assert (done.returncode, done.stderr) == (-signal.SIGPIPE, "")


def test_scenes_come_along(tmp_path):
    done = call([sys.executable, "-m", "asperity", "scenes"], tmp_path)
    assert done.returncode == 0, done.stdout
    assert "scenes/first-contact.toml\n    First contact: two rough solids meet, stick and part\n" in done.stdout
    assert (tmp_path / "examples" / "slide.py").exists()
    done = call([PROGRAM, "check", "scenes/first-contact.toml"], tmp_path)
    assert done.returncode == 0
    again = call([sys.executable, "-m", "asperity", "scenes"], tmp_path)
    assert again.returncode == 4 and "fix: name another folder" in again.stderr
    assert call([sys.executable, "-m", "asperity", "scenes", "other"], tmp_path).returncode == 0


def test_every_file_names_one_version():
    """The version is in CMakeLists.txt; copies are written by packaging/version.py."""
    done = subprocess.run([sys.executable, ROOT / "packaging/version.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    version = done.stdout.strip()
    assert call([PROGRAM, "--version"], ROOT).stdout.split()[1] == version
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text()
