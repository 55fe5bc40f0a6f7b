# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How ranks are started: the launcher that Python finds, and the processors that ranks share."""

import json
import os
import re
import subprocess
import sys

import pytest

import asperity
import asperity.running.runs
from asperity.running import pool, program
from conftest import BOUND, SMALL


@pytest.mark.parametrize("named", ["", "no-such-launcher --option"])
def test_no_launcher(tmp_path, monkeypatch, named):
    mpi = program.mpi()
    monkeypatch.setenv("ASPERITY_MPIRUN", named)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(asperity.InputOutputError) as told:
        asperity.run(SMALL, out=tmp_path / "none", ranks=2)
    looked = "ASPERITY_MPIRUN names no-such-launcher" if named else r"looked in PATH for mpirun\.(openmpi|mpich), "
    assert re.search(rf"(?s)no launcher of {re.escape(mpi)}, .*{looked}.*fix: .*ASPERITY_MPIRUN=", str(told.value))
    assert asperity.running.runs.launcher(1) == [] and not any(tmp_path.iterdir())


def test_a_build_that_has_to_be_made_is_told(tmp_path, monkeypatch, capsys):
    """In a source tree the script `asperity` builds first, for minutes, and what it prints is not seen."""
    monkeypatch.delenv("ASPERITY_PROGRAM")
    monkeypatch.setattr(program, "__file__", str(tmp_path / "python/asperity/running/program.py"))
    for name, told in (("asperity", "there is no build"), ("build/release/engine/asperity", "")):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch(0o755)
        assert program.path.__wrapped__() == str(file)
        said = capsys.readouterr().err
        assert told in said and bool(told) == bool(said)


@pytest.mark.parametrize("ranks", [2, 3])
def test_ranks_share_the_processors_that_they_may_all_use(ranks):
    """Ranks bound to one socket have its processors together; one with others, or more, does not share with them."""
    processors = sorted(os.sched_getaffinity(0))
    free = {name: value for name, value in os.environ.items() if name != "OMP_NUM_THREADS"}
    words = [*asperity.running.runs.launcher(ranks), sys.executable, "-c", BOUND, os.environ["ASPERITY_PROGRAM"], "info"]
    for first, others, sharing in ((processors, processors, ranks), (processors, processors[:1], 1),
                                   (processors[:1], processors, 1), (processors[:1], processors[:1], ranks)):
        places = json.dumps([first] + [others] * (ranks - 1))
        said = subprocess.run(words, env={**free, "PROCESSORS": places}, capture_output=True, text=True, timeout=60)
        assert f"ranks      {ranks}\n  threads    {max(1, len(first) // sharing)} a rank" in said.stdout, (places, said)


@pytest.mark.parametrize("policy", ["", "active"])
def test_waiting_threads_of_runs_sleep(tmp_path, monkeypatch, policy):
    """Runs of a pool share the processors; one run alone spins as briefly as with the script. A policy of the user holds."""
    monkeypatch.delenv("OMP_WAIT_POLICY", raising=False)
    monkeypatch.setenv("GOMP_SPINCOUNT", "3000")
    if policy:
        monkeypatch.setenv("OMP_WAIT_POLICY", policy)
    going, place = tmp_path / "going", tmp_path / "point"
    going.touch()
    assert pool.run_task(["sh", "-c", "env"], str(tmp_path), str(place), "1", False, str(going)).code == 0
    told = (place / pool.LOG).read_text().splitlines()
    assert f"OMP_WAIT_POLICY={policy or 'passive'}" in told
    assert ("GOMP_SPINCOUNT=3000" in told) == bool(policy)

    monkeypatch.delenv("GOMP_SPINCOUNT")
    seen = tmp_path / "seen"
    shell = tmp_path / "program"
    shell.write_text(f"#!/bin/sh\nenv > {seen}\nexit 2\n")
    shell.chmod(0o755)
    monkeypatch.setattr(program, "path", lambda: str(shell))
    with pytest.raises(asperity.Error):
        asperity.run(SMALL, out=tmp_path / "run")
    assert ("GOMP_SPINCOUNT=3000" in seen.read_text().splitlines()) == (not policy)
