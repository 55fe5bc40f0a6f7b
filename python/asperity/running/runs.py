# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Runs of a scene from Python."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from numbers import Integral
from pathlib import Path

from ..arguments import checks_call
from ..errors import InputOutputError, SceneError, printable
from ..files import store
from ..results.result import Result
from ..terminal import progress_shown, sleep_soon
from . import program
from .scene import Overrides, SceneLike, scene_given


def launcher(ranks: int) -> list[str]:
    """Returns the launcher's command line for a number of ranks: $ASPERITY_MPIRUN ("srun --mpi=pmix"), or the mpirun of the
    program's MPI. Raises InputOutputError if there is none."""
    if ranks == 1:
        return []
    words = os.environ.get("ASPERITY_MPIRUN", "").split()
    names: tuple[str, ...] = ()
    if not words:
        open_mpi = "Open MPI" in program.mpi()
        names = ("mpirun.openmpi", "mpirun") if open_mpi else ("mpirun.mpich", "mpiexec.hydra", "mpirun")
        options = ["--oversubscribe"] + (["--allow-run-as-root"] if os.geteuid() == 0 else []) if open_mpi else []
        words = [next((name for name in names if shutil.which(name)), names[-1]), *options]
    if not shutil.which(words[0]):
        raise InputOutputError(f"ranks = {ranks}", f"no launcher of {program.mpi()}, which the program was built with",
                               "looked in PATH for " + ", ".join(names) if names else
                               f"ASPERITY_MPIRUN names {words[0]}, which is not there",
                               'put the mpirun of that MPI into PATH, or name it: ASPERITY_MPIRUN="srun --mpi=pmix"')
    return [*words, "-n", str(ranks)]


@checks_call
def run(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None,
        ranks: int = 1, progress: bool | None = None) -> Result:
    """Simulates a scene.

    An interruption (Ctrl-C) lets the run write a checkpoint first.

    Parameters
    ----------
    scene : str, Path or dict
        TOML file, or dictionary of the scene's sections: {"surface": {"sites": 64}}.
    overrides : dict, optional
        Values by key, {"surface.rms": 2.0, "drive.load": "100 MPa"}; numbers in the units of docs/reference/scene.md.
    out : str or Path, optional
        Result directory; by default results/<scene>, or the next free name.
    ranks : int
        Number of MPI ranks.
    progress : bool, optional
        Print lines of progress; by default on a terminal and in a notebook.

    Returns
    -------
    Result
        Result of the run.

    Raises
    ------
    SceneError, PhysicsError, InputOutputError, Stopped
        If the program fails or stops early; the exception has the program's message.
    """
    program.refuse_ranks()
    if isinstance(ranks, bool) or not isinstance(ranks, Integral) or ranks < 1:
        raise SceneError(f"ranks = {ranks!r}", "is no number of ranks", "a run has one or more", "leave it out for one")
    with scene_given(scene, overrides) as (file, sets):
        first = Path("results") / Path(file).stem
        place = store.numbered(first, Path.exists) if out is None else store.chosen(str(out), "")
        words = [*launcher(ranks), program.path(), "run", file, "--out", str(place), "--progress", "json",
                 *program.sets(sets)]
        environment = dict(os.environ)
        sleep_soon(environment)
        said, shown = [], progress_shown(progress)
        try:
            child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                     env=environment, start_new_session=True, text=True, encoding="utf-8", errors="replace")
        except OSError as error:
            raise InputOutputError(words[0], "cannot be started", error.strerror or str(error),
                                   "check that it is installed") from None
        try:
            for line in child.stderr:
                told = program.told(line)
                if "text" not in told or told["text"] == line:  # an error, or what a launcher says
                    said.append(line)
                elif shown:
                    print(printable(told["text"]), file=sys.stderr, flush=True)
            code = child.wait()
        except KeyboardInterrupt:
            child.send_signal(signal.SIGUSR1)  # mpirun passes it on
            child.communicate()
            raise
        text = "".join(said)
        if code == 75 and not text.strip():
            text = f"{place}: the run stopped early\n    why: a signal or a limit ended it\n" \
                   f"    fix: resume it: asperity run {file} --out {place} --resume auto"
        program.raise_for(code, text)
    return Result(place)
