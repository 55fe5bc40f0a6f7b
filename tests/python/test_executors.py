# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Sweeps on the workers of executors: Dask, mpi4py.futures, and any other; workers that are killed, sweeps that are
stopped."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest

import asperity
from asperity.running import lock, pool
from asperity.studies.sweeps import load_sweep
from conftest import ROOT, command, held, is_told, rows, running, wait_for, without_pictures

distributed = pytest.importorskip("distributed", reason="no Dask: apt-get install python3-distributed")

SCENE = """
[surface]
sites = 32
rms = 0.5
[block]
thickness = 16
[drive]
timestep = 20
velocity = 30
[output]
checkpoint = 0.2
"""
FIVE = {"surface.seed": [1, 2, 3, 4, 5]}
SETS = ["--set", "surface.seed=1:5:1"]
SHORT = [*SETS, "drive.max_steps=100"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT / "python")}


@pytest.fixture()
def place(place, light):
    (place / "scene.toml").write_text(SCENE)
    return place


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """The five points by the pool of this machine."""
    work = tmp_path_factory.mktemp("whole")
    (work / "scene.toml").write_text(SCENE)
    with without_pictures():
        command("sweep", "scene.toml", *SETS, "--jobs", "2", "--progress", "off", "--out", "whole", cwd=work)
    return numbers(work / "whole")


def numbers(directory):
    """The table, without the renormalised theory: the table of `table` lacks it."""
    found = [{k: v for k, v in row.items() if "renormalised" not in k} for row in rows(Path(directory) / "sweep.csv")]
    assert len(found) == 5 and {row["status"] for row in found} == {"done"}
    return found


@contextlib.contextmanager
def started(*words):
    child = subprocess.Popen(list(map(str, words)), env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True)
    try:
        yield child
    finally:
        child.kill()
        child.wait()
        child.stdout.close()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Dask's scheduler and two workers: its address and their processes. The last test of them kills one."""
    tmp_path = tmp_path_factory.mktemp("cluster")
    file = tmp_path / "scheduler.json"
    with contextlib.ExitStack() as stack:
        def dask(what, *words):
            return stack.enter_context(started(sys.executable, "-m", f"distributed.cli.dask_{what}", "--scheduler-file",
                                               file, "--no-dashboard", *words))

        dask("scheduler", "--host", "127.0.0.1", "--port", "0")
        wait_for(lambda: file.exists() and file.read_text())  # which is there before it is written
        address = json.loads(file.read_text())["address"]
        workers = [dask("worker", "--nthreads", "1", "--no-nanny", "--local-directory", tmp_path / f"worker{i}")
                   for i in (1, 2)]
        with distributed.Client(address) as client:
            client.wait_for_workers(2)
        yield address, workers


def test_dask_stops_with_checkpoints_and_goes_on(place, cluster, table):
    words = [os.environ["ASPERITY_PROGRAM"], "sweep", "scene.toml", *SETS, "--executor", f"dask:{cluster[0]}", "--out",
             "cut"]
    with started(*words) as sweep:
        wait_for(lambda: list(place.glob("cut/*/checkpoint.h5")))
        with held("--out " + str(place / "cut")) as points:
            sweep.send_signal(signal.SIGINT)
            wait_for(lambda: all(map(is_told, points)))
        said = sweep.communicate()[0]
    assert sweep.returncode == 75 and "stopped, with a checkpoint" in said, said
    assert not running("--out " + str(place / "cut"))
    # One that is killed leaves its points to the workers; the next sweep makes them stop, and waits for them.
    with started(*words) as sweep:
        wait_for(lambda: running("--out " + str(place / "cut")))
        sweep.kill()
    assert running("--out " + str(place / "cut"))
    command(*words[1:])
    assert numbers("cut") == table


def test_dask_from_python(place, cluster):
    scene = {"name": "scene", "surface": {"sites": 32}, "block": {"thickness": 16},
             "drive": {"timestep": 20, "max_steps": 100}}
    with distributed.Client(cluster[0]) as client:
        sweep = asperity.sweep(scene, FIVE, out="py", executor=client.get_executor())
    assert sweep.table.status == ["done"] * 5
    assert not list(place.glob("asperity-*"))  # the file of the scene, where workers see it
    assert all(result.run.threads == 1 for result in sweep.results())


def test_dask_with_a_worker_that_is_killed(place, cluster, table):
    address, workers = cluster
    with started(os.environ["ASPERITY_PROGRAM"], "sweep", "scene.toml", *SETS, "--executor", f"dask:{address}", "--out",
                 "one") as sweep:
        wait_for(lambda: list(place.glob("one/*/checkpoint.h5")))
        workers[0].kill()
        said = sweep.communicate()[0]
    assert sweep.returncode == 0 and "5 of 5 points are done" in said, said  # Dask gives its points to the other
    assert numbers("one") == table
    assert not list(place.glob("one/going-*"))


def test_ranks_of_mpi(mpi4py_launcher, place, table):
    words = [*mpi4py_launcher(3), os.environ["ASPERITY_PROGRAM"], "sweep", "scene.toml", *SETS, "--executor", "mpi",
             "--out", "one"]
    with started(*words) as sweep:
        wait_for(lambda: list(place.glob("one/*/checkpoint.h5")))
        workers = [p for p in running("start() sweep scene.toml") if f"{p}".isdigit()
                   and b"OMPI_COMM_WORLD_RANK=2\0" in Path(f"/proc/{p}/environ").read_bytes()
                   or b"PMI_RANK=2\0" in Path(f"/proc/{p}/environ").read_bytes()]
        assert len(workers) == 1
        os.kill(workers[0], signal.SIGKILL)
        sweep.communicate()
    assert sweep.returncode != 0  # MPI ends all ranks with it; the runs leave checkpoints
    wait_for(lambda: not running("--out " + str(place / "one")))
    assert len(list(place.glob("one/*/result.json"))) < 5
    done = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0 and "5 of 5 points are done" in done.stdout, done.stdout + done.stderr
    assert numbers("one") == table
    # An error of the leading rank ends all of them, and is told once.
    done = subprocess.run([*words, "--wall-limit", "soon"], env=ENVIRONMENT, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and done.stderr.count("is no length of time") == 1, done.stderr


def test_mpi4py_futures_of_a_script(mpi4py_launcher, place):
    (place / "study.py").write_text("""
from mpi4py.futures import MPIPoolExecutor
import asperity
if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        values = {"drive.velocity": [50, 60], "surface.seed": [1, 2], "drive.max_steps": 100}
        sweep = asperity.sweep("scene.toml", values, out="script", executor=executor)
    print(sweep)
""")
    done = subprocess.run([*mpi4py_launcher(3), sys.executable, "-m", "mpi4py.futures", "study.py"], env=ENVIRONMENT,
                          capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and "4 points" in done.stdout and "4 done" in done.stdout, done.stdout + done.stderr


def test_a_point_waits_for_the_run_that_another_worker_left(place):
    """Which is writing its checkpoint, and has the directory until then."""
    (place / "going").touch()
    words = [os.environ["ASPERITY_PROGRAM"], "run", "scene.toml", "--out", "point", "--set", "drive.max_steps=20"]
    task = [words, str(place), str(place / "point"), "1", True, str(place / "going")]

    def hold():
        with lock.in_use(place / "point"):
            held.set()
            time.sleep(1.0)

    held = threading.Event()
    other = threading.Thread(target=hold)
    other.start()
    held.wait()
    pool.run_task(*task)
    other.join()
    assert (place / "point/result.json").exists()
    (place / "going").unlink()
    assert pool.run_task(*task) == pool.Ended(pool.STOPPED)


def leave(*_):
    os._exit(9)


def test_a_worker_that_is_lost_is_told(place):
    values = {"drive.velocity": [50, 60], "drive.max_steps": 50}
    with ProcessPoolExecutor(1) as executor:
        executor.submit(leave)
        sweep = asperity.sweep("scene.toml", values, out="lost", executor=executor)
    assert {p["status"] for p in sweep.points} == {"failed"}
    assert "its worker was lost: BrokenProcessPool" in sweep.points[0]["failure"]["reason"]
    with ProcessPoolExecutor(2) as executor:
        sweep = asperity.sweep("scene.toml", values, out="lost", executor=executor)
    assert {p["status"] for p in load_sweep("lost").points} == {"done"}


@pytest.mark.parametrize("given, says, code", [
    ("threads", "it is mpi, in a command started by mpirun, or", 2), ("dask:", "dask:ADDRESS of a scheduler", 2),
    ("dask:tcp://127.0.0.1:9", "start one: dask scheduler", 4)])
def test_what_is_no_executor(place, given, says, code):
    assert says in command("sweep", "scene.toml", *SHORT, "--executor", given, expect=code)
    assert not (place / "results").exists()
