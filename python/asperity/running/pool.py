# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Many runs on an executor of concurrent.futures. Each run is a separate process, for which a worker waits.

Each run has its own threads, signals and memory, so that a failed or killed run does not affect the others. Workers may be on other
machines that share the file system. A run is asked to stop with USR1, which mpirun passes on: it leaves a checkpoint and exits with
75. That happens when the pool is interrupted (INT, TERM, USR1), at its wall limit, and when its worker dies. Started again, a run
resumes from its checkpoint, or starts from the beginning without one; a result of the same scene is reused.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import re
import signal
import subprocess
import threading
import time
import uuid
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from numbers import Integral
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import Error, InputOutputError, SceneError
from ..files import store
from ..results.result import Values, read_json
from ..terminal import Progress, duration, environment_alone
from . import lock, program
from .scene import inputs_of

WAITING, DONE, FAILED = "waiting", "done", "failed"
PHYSICS, STOPPED = 3, 75
RESULT, LOG = "result.json", "log.txt"
_libc = ctypes.CDLL(None, use_errno=True)
_PR_SET_PDEATHSIG = 1


@dataclass
class Job:
    """A run to make."""

    name: str
    """"rms=3,seed=1"; the name of its directory."""
    directory: Path
    file: str
    """of the scene"""
    overrides: list[str]
    answer: dict[str, Any]
    """of program.theory_points(runnable=True): the scene that they make of the file, digests of the files it reads"""


@dataclass
class Outcome:
    """Outcome of a job: status, result.json, and exit code and reason of a failure."""

    status: str = WAITING
    result: Values = field(default_factory=lambda: Values({}))
    exit_code: int = 0
    reason: str = ""
    damaged: str = ""
    """why result.json cannot be read"""


@dataclass
class PoolOptions:
    """Options of many runs."""

    jobs: int = 1
    """side by side on this machine, where no executor is given"""
    threads: int = 0
    """of each, whatever the environment says; 0: those of OMP_NUM_THREADS, or else an equal share of the processors
    of this machine, or one on the workers of an executor"""
    launch: list[str] = field(default_factory=list)
    """words before the program, "mpirun -n 2" """
    wall_limit: float | None = None
    """s"""
    progress: str = "auto"
    executor: Executor | None = None
    """whose workers run them"""


def refuse_jobs(jobs: object) -> None:
    """Raises SceneError for an impossible number of simultaneous runs."""
    if isinstance(jobs, bool) or not isinstance(jobs, Integral) or not 1 <= int(jobs) <= 1024:
        raise SceneError(f"jobs = {jobs!r}", "is no number of points side by side", "it is a whole number from 1 to 1024",
                         "leave it out for one after the other")


def digests_of_inputs() -> list[str]:
    """Returns the digests in a result of the files that its scene names: "surface.file_digest", "surface.counter.file_digest", ..."""
    return [name for name in program.quantities() if name.endswith("_digest") and not name.startswith("run.")]


def look_at(job: Job) -> Outcome:
    """Returns the outcome of a job. A physics error counts as an outcome; a run with another error, or with an unreadable result,
    is repeated.

    Raises SceneError if there is a result of another scene, or of another content of surface.file.
    """
    path = job.directory / RESULT
    if not path.exists():
        return Outcome()
    try:
        result = read_json(path)
    except InputOutputError as error:
        return Outcome(damaged=error.listed[0]["why"])
    remedy = "name another directory (--out), or remove this one"
    if result.find("scene") != job.answer["scene"]:
        raise SceneError(str(job.directory), "holds the result of another scene",
                         "results that are there are used again, and this one does not belong here", remedy)
    for key in digests_of_inputs():
        digest, now = result.text(key), Values(job.answer).text(key)
        if digest != now:
            key = "scene." + key.removesuffix("_digest")
            file = result.text(key) or result.text(key.rpartition(".")[0])  # surface.counter.file is the file of surface.counter
            raise SceneError(str(job.directory), f"holds the result of another content of {file}",
                             f"the file's digest is {now} now, and was {digest} then" if digest else
                             "it does not tell the file's digest, as results of earlier versions do not", remedy)
    outcome = Outcome(result=result)
    code = result.number("failure.exit_code")
    if code is not None:
        outcome.exit_code = int(code)
        outcome.reason = result.text("failure.reason").split("\n")[0]
        outcome.status = FAILED if outcome.exit_code == PHYSICS else WAITING
    elif result.text("run.stopped") in ("", "max_steps"):
        outcome.status = DONE
    return outcome


def in_the_way_of_run(directory: Path, inputs: Iterable[str] = (), damaged: bool = False) -> list[dict[str, str]]:
    """Returns the files that prevent a run in a directory, because it would replace them."""
    aside = (RESULT, "run.h5") if damaged and store.is_named(directory, RESULT) else ()
    names = [name for name in (*store.RUN_FILES, store.LOCK) if name not in aside]
    return store.in_the_way(directory, names, renew=False, inputs=inputs) + store.in_the_way(directory, [LOG], inputs=inputs)


def require_free_runs(place: Path, names: re.Pattern[str]) -> None:
    """Checks that the runs of a study would replace no file. Called before the first file is written. Raises SceneError."""
    folders = [one for one in sorted(place.glob("*/")) if names.fullmatch(one.name) and not (one / RESULT).exists()]
    if problems := [problem for one in folders for problem in in_the_way_of_run(one)]:
        raise SceneError.of(problems)


def look_at_all(jobs: list[Job], say: Callable[[str], None]) -> list[Outcome]:
    """Returns the outcome of each job; reports a result that cannot be read. Raises SceneError."""
    outcomes = [look_at(job) for job in jobs]
    problems = []
    for job, outcome in zip(jobs, outcomes):
        if outcome.status == WAITING:
            problems += in_the_way_of_run(job.directory, inputs_of(job.file, job.answer["scene"]), bool(outcome.damaged))
    if problems:
        raise SceneError.of(problems)
    for job, outcome in zip(jobs, outcomes):
        if outcome.damaged:
            say(f"note: {job.directory / RESULT} cannot be read ({outcome.damaged}): this run is repeated")
    return outcomes


# What a worker does.

class Ended(NamedTuple):
    """End of a run: exit code, time (s), and the reason of a failure."""

    code: int
    seconds: float = 0.0
    reason: str = ""


def _told(going: str) -> str:
    """Returns "stop", "kill" or nothing."""
    try:
        return Path(going).read_text()
    except FileNotFoundError:
        return "stop"
    except OSError:  # of a network's disk
        return ""


def run_task(words: list[str], folder: str, directory: str, threads: str, overrule: bool, going: str) -> Ended:
    """Runs a job to its end, or until `going` tells it to stop. All arguments can be pickled."""
    place, start = Path(directory), time.monotonic()
    # A run whose worker was killed writes its checkpoint meanwhile.
    while not (told := _told(going)) and time.monotonic() - start < 60 and lock.is_used(place):
        time.sleep(0.1)
    if told:
        return Ended(STOPPED)
    try:
        with store.outputs(place, [LOG]) as out:
            return _run(words, folder, out, threads, overrule, going)
    except Error as error:
        return Ended(error.code, 0.0, str(error).splitlines()[0])


def _run(words: list[str], folder: str, out: store.Outputs, threads: str, overrule: bool, going: str) -> Ended:
    """Runs the program for run_task(), once the directory is free."""
    told = ""
    environment = environment_alone()
    if threads and (overrule or "OMP_NUM_THREADS" not in environment):
        environment["OMP_NUM_THREADS"] = threads
    # Runs share the processors: a thread that spins while it waits takes them from the threads of the other runs.
    if "OMP_WAIT_POLICY" not in environment:
        environment["OMP_WAIT_POLICY"] = "passive"
        environment.pop("GOMP_SPINCOUNT", None)  # of the script `asperity`; it would hold over the policy
    parent, is_run = os.getpid(), words[1] == "run"  # else a launcher

    def prepare() -> None:  # in the child: a signal that comes early waits until the run can catch it
        if is_run:
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGUSR1, signal.SIGTERM, signal.SIGINT})
        _libc.prctl(_PR_SET_PDEATHSIG, signal.SIGUSR1)
        if os.getppid() != parent:
            os._exit(STOPPED)

    start = time.monotonic()
    try:
        with out.append(LOG) as log:
            # A session of its own: Ctrl-C goes to the pool, and from there on as USR1.
            child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd=folder,
                                     env=environment, start_new_session=True, preexec_fn=prepare)
    except FileNotFoundError:
        return Ended(127, 0.0, f"'{words[0]}'{'' if is_run else ' of --launch'} cannot be started")
    except OSError as error:
        return Ended(InputOutputError.code, 0.0, f"cannot be run: {error.strerror}; start fewer points at once")
    try:
        while child.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                child.wait(0.2)
                break
            last, told = told, _told(going)
            if told == "kill":
                os.killpg(child.pid, signal.SIGKILL)
            elif told and not last:
                child.send_signal(signal.SIGUSR1)
    except KeyboardInterrupt:  # in a worker that has the terminal
        child.send_signal(signal.SIGUSR1)
        child.wait()
    return Ended(child.returncode, time.monotonic() - start)


@contextlib.contextmanager
def executor_of(text: str) -> Iterator[Executor | None]:
    """Yields the executor of --executor: "mpi" or "dask:ADDRESS"; None in MPI ranks that were workers of the first one. Raises
    SceneError for another text or a missing package, InputOutputError for a scheduler that does not answer."""
    kind, _, address = text.partition(":")
    try:
        if text == "mpi":
            from mpi4py.futures import MPICommExecutor

            with MPICommExecutor() as executor:
                yield executor
            return
        if kind != "dask" or not address:
            raise SceneError(f"--executor {text}", "is no executor", "it is mpi, in a command started by mpirun, or "
                             "dask:ADDRESS of a scheduler", "for example --executor dask:tcp://localhost:8786")
        from distributed import Client
    except ImportError as error:
        raise SceneError(f"--executor {text}", "needs a Python package", str(error), "apt-get install python3-"
                         + ("mpi4py" if text == "mpi" else "distributed")) from None
    try:
        client = Client(address, timeout=5)
    except (OSError, ValueError) as error:
        raise InputOutputError(f"--executor {text}", "has no scheduler at this address", str(error).splitlines()[0],
                               "start one: dask scheduler, and workers: dask worker ADDRESS") from None
    with client:
        yield client.get_executor(pure=False)


# What the sweep does.

@contextlib.contextmanager
def _signals() -> Iterator[list[int]]:
    """Catches INT, TERM and USR1 within the context; yields the list of received signals."""
    came: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield came
        return
    before = {number: signal.signal(number, lambda caught, _: came.append(caught))
              for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1)}
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _log(job: Job) -> str:
    """Returns the output of a job's run."""
    try:
        return store.contents(job.directory / LOG).decode("utf-8", "replace").strip()
    except OSError:
        return ""


def _reason(job: Job, code: int) -> str:
    """Returns the reason why a run failed: its error, or its last line of output."""
    text = _log(job)
    error = program.error_of(text, code)
    return str(error).splitlines()[0] if error else program.told(text.rpartition("\n")[2].strip()).get("text", "")


def _fraction(job: Job) -> float:
    """Returns the completed part of a run's path, the largest of its lines of progress; 0 if unknown."""
    return max((program.told(line).get("fraction") or 0.0 for line in _log(job).splitlines()), default=0.0)


class Pool:
    """Runs the jobs whose outcome is "waiting" and fills in their outcomes. place: directory that contains all jobs."""

    def __init__(self, jobs: list[Job], outcomes: list[Outcome], options: PoolOptions, place: Path):
        self.jobs, self.outcomes, self.options = jobs, outcomes, options
        self.progress = Progress(options.progress)
        self.waiting = [i for i, outcome in enumerate(outcomes) if outcome.status == WAITING]
        self.running: dict[int, float] = {}  # since when
        # Of each scene, the points that were done and the seconds that they took.
        self.done: Counter[str] = Counter()
        self.seconds: dict[str, float] = defaultdict(float)
        self.stopping = self.killed = False
        self.start_time = time.monotonic()
        self.place = place.resolve()
        self.going = self.place / f"going-{uuid.uuid4().hex}"

    def run(self, done: Callable[[], None] = lambda: None) -> bool:
        """Runs the jobs and calls done() after each. Returns False if stopped before all of them had run."""
        for old in self.place.glob("going-" + 32 * "[0-9a-f]"):  # of one that was killed, whose workers may live
            if not old.is_symlink() and old.stat().st_size <= len("kill"):
                old.unlink()
        with contextlib.ExitStack() as stack:
            signals = stack.enter_context(_signals())
            executor = self.options.executor or stack.enter_context(ThreadPoolExecutor(self.options.jobs))
            self.going.touch()
            stack.callback(self.going.unlink, missing_ok=True)  # also tells workers, if an error of our own ends this
            stack.callback(self.progress.finish)
            futures = {self._submitted(executor, i): i for i in self.waiting}
            left = set(futures)
            while left:
                ended, left = wait(left, timeout=0.05, return_when=FIRST_COMPLETED)
                for i, future in sorted((futures[f], f) for f in ended):
                    self._conclude(i, future)
                    done()
                left -= self._stop_if_told(len(signals), {f: futures[f] for f in left})
                if self.progress.due():
                    self._look_for_running()
                    self.progress.update(self._state())
        return not self.stopping and all(o.status != WAITING for o in self.outcomes)

    def _submitted(self, executor: Executor, i: int) -> Future:
        job, options = self.jobs[i], self.options
        directory = str(job.directory.resolve())
        words = [*options.launch, program.path(), "run", job.file, "--out", directory, "--progress", "json",
                 "--resume", "auto", *program.sets(job.overrides)]
        equal = 1 if options.executor else max(1, len(os.sched_getaffinity(0)) // options.jobs)
        threads = options.threads or (0 if options.launch else equal)
        try:
            if self.outcomes[i].damaged:  # moved away, or its run would be refused
                store.set_aside(job.directory, (RESULT, "run.h5"))
            return executor.submit(run_task, words, os.getcwd(), directory, str(threads or ""), options.threads > 0,
                                   str(self.going))
        except (Error, BrokenExecutor) as error:  # of the latter all workers were lost
            future: Future = Future()
            future.set_exception(error)
            return future
        except Exception as error:  # every executor has its own
            raise SceneError("executor", "takes no points", f"{type(error).__name__}: {error}",
                             "give one that is not shut down") from None

    def _conclude(self, i: int, future: Future) -> None:
        job = self.jobs[i]
        self.running.pop(i, None)
        if i in self.waiting:
            self.waiting.remove(i)
        if future.cancelled():
            return
        try:
            ended = future.result()
        except Error as error:
            ended = Ended(error.code, 0.0, str(error).splitlines()[0])
        except Exception as error:
            ended = Ended(1, 0.0, f"its worker was lost: {type(error).__name__}: {error}".splitlines()[0])
        code, died = ended.code, ended.code < 0
        outcome = self.outcomes[i] = look_at(job)
        if outcome.status == DONE:
            self.done[job.file] += 1
            self.seconds[job.file] += ended.seconds
            self._say(job, "done in " + duration(ended.seconds))
        elif code == STOPPED or (self.stopping and died):
            if ended.seconds:
                saved = (job.directory / "checkpoint.h5").exists()
                self._say(job, "stopped, with a checkpoint" if saved else "stopped before its first checkpoint")
        else:
            outcome.status, outcome.exit_code = FAILED, max(code, 1)
            outcome.reason = ended.reason or outcome.reason or outcome.damaged or (
                f"ended by signal {-code} ({signal.strsignal(-code)})" if died else _reason(job, code))
            self._say(job, f"FAILED (exit {outcome.exit_code}): {outcome.reason}")

    def _stop_if_told(self, interruptions: int, left: dict[Future, int]) -> set[Future]:
        """Returns the jobs that were cancelled."""
        limit = self.options.wall_limit
        late = limit is not None and time.monotonic() - self.start_time >= limit
        if not self.stopping and (interruptions or late):
            self.stopping = True
            self.going.unlink(missing_ok=True)
            self._look_for_running()
            n = len(self.running)
            self.progress.say(f"stopping{' at the wall limit' if late else ''}: {n} point{'' if n == 1 else 's'} "
                              f"running, {len(left) - n} not started")
            # What a worker has taken meanwhile stops too: the file is gone.
            return {future for future, i in left.items() if i not in self.running and future.cancel()}
        if interruptions > 1 and not self.killed:  # told twice: without checkpoints; lost workers are not waited for
            self.killed = True
            self.going.write_text("kill")
            return {future for future in left if future.cancel()}
        return set()

    def _say(self, job: Job, what: str) -> None:
        over = sum(o.status != WAITING for o in self.outcomes)
        self.progress.say(f"[{over}/{len(self.jobs)}] {job.name}: {what}")

    def _look_for_running(self) -> None:
        """Looks for running jobs: executors start in order and do not all report a start, but runs lock their directories."""
        idle = 0
        for i in list(self.waiting):
            if (self.jobs[i].directory / store.LOCK).exists():
                self.waiting.remove(i)
                self.running[i], idle = time.monotonic(), 0
            elif (idle := idle + 1) > 64:
                break

    def _state(self) -> str:
        text = f"{len(self.jobs) - len(self.waiting) - len(self.running)} of {len(self.jobs)} points"
        fractions = {i: _fraction(self.jobs[i]) for i in self.running}
        for i, fraction in fractions.items():
            text += f" | {self.jobs[i].name} {100 * fraction:.0f} %"
        return text + self._left(fractions, time.monotonic())

    def _left(self, fractions: dict[int, float], now: float) -> str:
        """Estimates the time left, assuming equal times for all points of a scene; ignores scenes without a finished point."""
        points: dict[str, float] = defaultdict(float, self.done)
        seconds: dict[str, float] = defaultdict(float, self.seconds)

        def one_takes(i: int) -> float:
            """Returns the seconds of a point of this scene; NaN if unknown."""
            file = self.jobs[i].file
            return seconds[file] / points[file] if points[file] > 0.02 else math.nan

        left = []  # seconds that points have left
        for i, fraction in fractions.items():
            spent = now - self.running[i]
            if fraction > 0:
                points[self.jobs[i].file] += fraction
                seconds[self.jobs[i].file] += spent
            # max() keeps NaN where it stands first.
            left.append(spent * (1 - fraction) / fraction if fraction > 0 else max(one_takes(i) - spent, 0.0))
        several = [*left, *map(one_takes, self.waiting)]
        counted = [one for one in several if one == one]
        if not sum(counted):
            return ""
        side = len(fractions) or 1 if self.options.executor else self.options.jobs
        longest = max((one for one in left if one == one), default=0.0)
        least = "at least " * (len(counted) < len(several))
        return f" | {least}{duration(max(sum(counted) / side, longest))} left"
