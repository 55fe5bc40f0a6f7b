# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""asperity.Simulation on ranks of mpi4py (ranks.py): the bits of a run, and of one rank; an error of one rank."""

import json
import os
import subprocess
import sys

import numpy
import pytest

import asperity
from conftest import BOUND, ROOT


def test_ranks_have_the_bits_of_a_run(mpi4py_launcher, path_run, tmp_path):
    found, processors = [], sorted(os.sched_getaffinity(0))
    for ranks in (1, 2):
        place = tmp_path / str(ranks)
        place.mkdir()
        words = [*mpi4py_launcher(ranks), sys.executable, "-c", BOUND, sys.executable, ROOT / "tests/python/ranks.py",
                 place]
        env = {"PYTHONPATH": str(ROOT / "python"), "PROCESSORS": json.dumps([processors] * ranks)}
        done = subprocess.run(words, capture_output=True, text=True, timeout=200, env={**os.environ, **env})
        assert done.returncode == 0, done.stdout + done.stderr
        found.append((json.loads((place / "found.json").read_text()), numpy.load(place / "fields.npy")))
    one, two = found
    written = [asperity.load(tmp_path / ranks / "written").fields["now"] for ranks in "12"]
    for name in ("gap", "contact", "pressure"):
        assert (getattr(written[0], name) == getattr(written[1], name)).all(), name
    assert not one[0]["written_twice"] and not two[0]["written_twice"]
    gaps = [numbers.pop("gap") for numbers, _ in found]
    threads = [numbers.pop("threads") for numbers, _ in found]
    assert threads == [len(processors), max(1, len(processors) // 2)]
    assert one[0] == two[0] and (one[1] == two[1]).all()
    assert gaps[0] == pytest.approx(gaps[1], rel=1e-12) == path_run.fields["relaxed"].gap.sum()
    assert one[0]["refused"] and one[0]["work"] > 0 and abs(one[0]["balance"]) < 1e-3
    assert one[0]["binding_energy"] == path_run.binding_energy
    assert one[0]["contact_fraction"] == path_run.contact_fraction
    assert one[0]["pull_off"] == path_run.work_of_interface.pull_off
    series = one[0]["series"]
    of_run = numpy.isin(path_run.series["step"], series["step"])
    # The balance is over the largest energy of the steps that were observed so far; these are others.
    for name in set(series) - {"count", "balance_error"}:
        assert (path_run.series[name][of_run] == series[name]).all(), name


def test_an_error_of_one_rank_ends_all(mpi4py_launcher):
    script = """if True:
        from mpi4py import MPI
        import asperity
        sim = asperity.Simulation({"surface": {"sites": 16}}, comm=MPI.COMM_WORLD)
        if sim.tile[0].start + sim.tile[1].start > 0:
            raise ValueError("of the second rank alone")
        sim.step(100)
        """
    done = subprocess.run([*mpi4py_launcher(2), sys.executable, "-c", script], capture_output=True, text=True,
                          timeout=100, env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    assert done.returncode == 1 and "of the second rank alone" in done.stderr, done.stdout + done.stderr
