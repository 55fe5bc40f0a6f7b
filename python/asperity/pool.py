# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Many runs of one scene, each a process of its own, as many side by side as asked for.

Each run has its own threads, signals and memory; one that fails or is killed does not touch the others,
and it can be repeated by hand. A child is asked to stop with USR1, which mpirun passes on: it leaves a
checkpoint and exits with 75. That happens when the pool is interrupted (INT, TERM, USR1), at its wall
limit, and when its process dies. Started again, a run resumes from its checkpoint; one without a
checkpoint starts from the beginning; a result of the same scene is taken as it is.
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import files, program
from .errors import Error, InputOutputError, SceneError
from .result import Values, read_json
from .terminal import Progress, duration

WAITING, DONE, FAILED = "waiting", "done", "failed"
PHYSICS, STOPPED = 3, 75
RESULT = "result.json"
FILE_DIGESTS = {"surface.file_digest": "scene.surface.file", "interface.table_digest": "scene.interface.table"}
_libc = ctypes.CDLL(None, use_errno=True)
_PR_SET_PDEATHSIG = 1


@dataclass
class Job:
    name: str
    """"rms=3,seed=1"; the name of its directory."""
    directory: Path
    file: str
    """of the scene"""
    overrides: list[str]
    scene: dict[str, Any]
    """what these make of the file"""
    digests: dict[str, str] = field(default_factory=dict)
    """of the files that the scene reads, as they are now; "": it reads none of this kind"""

    @classmethod
    def of(cls, name: str, directory: Path, file: str, overrides: list[str], answer: dict[str, Any]) -> Job:
        """answer: of program.theory_points(runnable=True)."""
        return cls(name, directory, file, overrides, answer["scene"],
                   {key: Values(answer).text(key) for key in FILE_DIGESTS})


@dataclass
class Outcome:
    """What a job's directory holds: status, result.json, and of a failure its exit code and reason."""

    status: str = WAITING
    result: Values = field(default_factory=lambda: Values({}))
    exit_code: int = 0
    reason: str = ""
    damaged: str = ""
    """why result.json cannot be read"""


@dataclass
class PoolOptions:
    jobs: int = 1
    """side by side"""
    threads: int = 0
    """of each, whatever the environment says; 0: they share the processors unless OMP_NUM_THREADS is set"""
    launch: list[str] = field(default_factory=list)
    """words before the program, "mpirun -n 2" """
    wall_limit: float | None = None
    """s"""
    progress: str = "auto"


def look_at(job: Job) -> Outcome:
    """What is there of a job. Failed physics counts as an outcome; another failure, or a result that cannot be read, is
    tried again.

    Raises SceneError if there is a result of another scene, or of another content of surface.file.
    """
    path = job.directory / RESULT
    if not path.exists():
        return Outcome()
    try:
        result = Values(read_json(path))
    except InputOutputError as error:
        return Outcome(damaged=str(error).split("why: ")[-1].splitlines()[0])
    remedy = "name another directory (--out), or remove this one"
    if result.find("scene") != job.scene:
        raise SceneError(str(job.directory), "holds the result of another scene",
                         "results that are there are used again, and this one does not belong here", remedy)
    for key, file in FILE_DIGESTS.items():
        digest, now = result.text(key), job.digests.get(key, "")
        if digest != now:
            raise SceneError(str(job.directory), f"holds the result of another content of {result.text(file)}",
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


def look_at_all(jobs: list[Job], say: Callable[[str], None]) -> list[Outcome]:
    """What is there of each; a result that cannot be read is told."""
    outcomes = [look_at(job) for job in jobs]
    for job, outcome in zip(jobs, outcomes):
        if outcome.damaged:
            say(f"note: {job.directory / RESULT} cannot be read ({outcome.damaged}): this run is repeated")
    return outcomes


class _Signals:
    """Counts INT, TERM and USR1 while it is entered."""

    def __init__(self) -> None:
        self.count = 0

    def __enter__(self) -> _Signals:
        def note(*_: Any) -> None:
            self.count += 1

        self._main = threading.current_thread() is threading.main_thread()
        if self._main:
            self._before = {s: signal.signal(s, note) for s in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1)}
        return self

    def __exit__(self, *_: Any) -> None:
        if self._main:
            for number, handler in self._before.items():
                signal.signal(number, handler)


def _last_line(job: Job) -> str:
    try:
        with open(job.directory / "log.txt", "rb") as log:
            log.seek(max(0, log.seek(0, os.SEEK_END) - 400))
            lines = [line for line in log.read().decode("utf-8", "replace").splitlines() if line.strip()]
    except OSError:
        return ""
    return lines[-1].strip() if lines else ""


def _fraction(job: Job) -> float:
    """How far a run has come, by its last line (" 45 %  approach, ..."); 0: not known."""
    head = _last_line(job).split(" %")[0].strip()
    return min(1.0, int(head) / 100) if head.isdigit() else 0.0


class Pool:
    """Runs the jobs whose outcome is "waiting" and fills in what came of them."""

    def __init__(self, jobs: list[Job], outcomes: list[Outcome], options: PoolOptions):
        self.jobs, self.outcomes, self.options = jobs, outcomes, options
        self.progress = Progress(options.progress)
        self.waiting = [i for i, outcome in enumerate(outcomes) if outcome.status == WAITING]
        self.finished: dict[str, tuple[int, float]] = {}  # points of a scene and the seconds they took
        self.children: dict[int, tuple[subprocess.Popen, float]] = {}
        self.stopping = self.killed = False
        self.start_time = time.monotonic()

    def run(self, done: Callable[[int], None] = lambda i: None) -> bool:
        """done(i) is called after each. False: stopped before all of them had run."""
        with _Signals() as signals:
            try:
                while self.waiting or self.children:
                    while not self.stopping and self.waiting and len(self.children) < self.options.jobs:
                        self._start(self.waiting.pop(0))
                    if self.stopping and not self.children:
                        break
                    for i in [i for i, (child, _) in self.children.items() if child.poll() is not None]:
                        child, started = self.children.pop(i)
                        self._conclude(i, child.returncode, started)
                        done(i)
                    self._stop_if_told(signals.count)
                    if self.progress.due():
                        self.progress.update(self._state())
                    time.sleep(0.02)
            finally:
                for child, _ in self.children.values():  # an error of our own
                    child.send_signal(signal.SIGUSR1)
                self.progress.finish()
        return not self.stopping and all(o.status != WAITING for o in self.outcomes)

    def _start(self, i: int) -> None:
        job = self.jobs[i]
        try:
            files.directory(job.directory)
            if self.outcomes[i].damaged:  # a result that is there would be refused
                files.set_aside(job.directory / RESULT)
        except Error as error:
            self._fail(i, error.code, str(error).splitlines()[0])
            return
        words = [*self.options.launch, program.path(), "run", job.file, "--out", str(job.directory),
                 "--progress", "lines", "--resume", "auto", *program.sets(job.overrides)]
        environment = dict(os.environ)
        threads = self.options.threads
        if not threads and "OMP_NUM_THREADS" not in environment and not self.options.launch:
            threads = max(1, len(os.sched_getaffinity(0)) // self.options.jobs)
        if threads:
            environment["OMP_NUM_THREADS"] = str(threads)
        parent = os.getpid()

        def prepare() -> None:  # in the child
            if not self.options.launch:  # a signal that comes early waits until the run can catch it
                signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGUSR1, signal.SIGTERM, signal.SIGINT})
            _libc.prctl(_PR_SET_PDEATHSIG, signal.SIGUSR1)
            if os.getppid() != parent:
                os._exit(STOPPED)

        try:
            with open(job.directory / "log.txt", "ab") as log:
                # A session of its own: Ctrl-C goes to the pool, and from there on as USR1.
                child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=environment,
                                         start_new_session=True, preexec_fn=prepare)
        except FileNotFoundError:
            self._fail(i, 127, f"'{words[0]}' of --launch cannot be started")
            return
        except OSError as error:
            raise InputOutputError(str(job.directory), "cannot be run", error.strerror or str(error),
                                   "start fewer points at once: --jobs") from None
        self.children[i] = child, time.monotonic()

    def _conclude(self, i: int, code: int, started: float) -> None:
        outcome = self.outcomes[i] = look_at(self.jobs[i])
        died = code < 0
        if outcome.status == DONE:
            seconds = time.monotonic() - started
            points, before = self.finished.get(self.jobs[i].file, (0, 0.0))
            self.finished[self.jobs[i].file] = points + 1, before + seconds
            self._say(i, "done in " + duration(seconds))
        elif code == STOPPED or (self.stopping and died):
            saved = (self.jobs[i].directory / "checkpoint.h5").exists()
            self._say(i, "stopped, with a checkpoint" if saved else "stopped before its first checkpoint")
        else:
            self._fail(i, code if code > 0 else 1, outcome.reason or outcome.damaged or (
                f"ended by signal {-code} ({signal.strsignal(-code)})" if died else _last_line(self.jobs[i])))

    def _fail(self, i: int, code: int, reason: str) -> None:
        outcome = self.outcomes[i]
        outcome.status, outcome.exit_code, outcome.reason = FAILED, code, reason
        self._say(i, f"FAILED (exit {code}): {reason}")

    def _stop_if_told(self, interruptions: int) -> None:
        limit = self.options.wall_limit
        late = limit is not None and time.monotonic() - self.start_time >= limit
        if not self.stopping and (interruptions or late):
            self.stopping = True
            for child, _ in self.children.values():
                child.send_signal(signal.SIGUSR1)
            n = len(self.children)
            self.progress.say(f"stopping{' at the wall limit' if late else ''}: {n} point{'' if n == 1 else 's'} "
                              f"running, {len(self.waiting)} not started")
        if interruptions > 1 and not self.killed:  # told twice: without checkpoints
            self.killed = True
            for child, _ in self.children.values():
                os.killpg(child.pid, signal.SIGKILL)

    def _say(self, i: int, what: str) -> None:
        over = sum(o.status != WAITING for o in self.outcomes)
        self.progress.say(f"[{over}/{len(self.jobs)}] {self.jobs[i].name}: {what}")

    def _state(self) -> str:
        text = f"{len(self.jobs) - len(self.waiting) - len(self.children)} of {len(self.jobs)} points"
        fractions = {i: _fraction(self.jobs[i]) for i in self.children}
        for i, fraction in fractions.items():
            text += f" | {self.jobs[i].name} {100 * fraction:.0f} %"
        return text + self._left(fractions, time.monotonic())

    def _left(self, fractions: dict[int, float], now: float) -> str:
        """Points of a scene are taken to last alike; those of a scene that none is known of are not counted."""
        known = {file: (float(points), seconds) for file, (points, seconds) in self.finished.items()}
        work = longest = 0.0  # seconds that points have left
        counted = True
        for i, fraction in fractions.items():
            points, seconds = known.get(self.jobs[i].file, (0.0, 0.0))
            spent = now - self.children[i][1]
            if fraction > 0:
                known[self.jobs[i].file] = points + fraction, seconds + spent
                left = spent * (1 - fraction) / fraction
            elif points > 0.02:
                left = max(0.0, seconds / points - spent)
            else:
                left, counted = 0.0, False
            work += left
            longest = max(longest, left)
        for i in self.waiting:
            points, seconds = known.get(self.jobs[i].file, (0.0, 0.0))
            if points > 0.02:
                work += seconds / points
            else:
                counted = False
        if work == 0.0:
            return ""
        return f" | {'' if counted else 'at least '}{duration(max(work / self.options.jobs, longest))} left"
