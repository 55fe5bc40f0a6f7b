# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The C++ program: where it is, how it is called, and what is asked of it (schema, checks, theory)."""

from __future__ import annotations

import contextlib
import functools
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..errors import BY_CODE, Error, InputOutputError, InternalError, SceneError
from ..terminal import environment_alone, launched


@functools.cache
def version() -> str:
    """Returns the version of the program that the package calls."""
    return info()["version"]


def _leads_nowhere(place: str | Path, package: Path) -> bool:
    """Returns true for the script of a wheel, which calls the compiled module (__main__.entry), if the package has no such module."""
    with open(place, "rb") as file:
        script = b"asperity.__main__" in file.read(1000)
    return script and not any(package.glob("_engine*.so"))


@functools.cache
def path() -> str:
    """Returns the program: $ASPERITY_PROGRAM, the build of this source tree, an installation, or the one in PATH.

    In a source tree without a build it is the script `asperity`, which makes one. Raises InputOutputError if there is none.
    """
    package = Path(__file__).resolve().parents[1]
    places: list[str | Path] = [os.environ.get("ASPERITY_PROGRAM", "")]
    for root in package.parents[1:4]:
        places += [root / "build/release/engine/asperity", root / "asperity", root / "bin/asperity"]
    for place in places:
        if place and os.path.isfile(place) and os.access(place, os.X_OK) and not _leads_nowhere(place, package):
            if place in {root / "asperity" for root in package.parents[1:4]}:
                print(f"asperity: there is no build; {place} makes one first, which takes minutes", file=sys.stderr)
            return str(place)
    found = shutil.which("asperity")
    if not found or _leads_nowhere(found, package):
        raise InputOutputError("asperity", "the program was not found",
                               "neither beside this package nor in PATH",
                               "build it, or set ASPERITY_PROGRAM to its path")
    return found


def told(line: str) -> dict[str, Any]:
    """Returns what a line of the program tells a program: an object of JSON, {"text": line} of any other line."""
    if line.startswith("{"):
        with contextlib.suppress(ValueError):
            found = json.loads(line)
            if isinstance(found, dict):
                return found
    return {"text": line}


def error_of(text: str, code: int) -> Error | None:
    """Returns the error that the program told in a text.

    Parameters
    ----------
    text : str
        What the program wrote to its standard error.
    code : int
        Its exit code.

    Returns
    -------
    Error | None
        The error; None if it told none.
    """
    kind = BY_CODE.get(code, InternalError)
    for line in text.splitlines():
        error = told(line).get("error")
        if error:
            return kind.of(error["problems"]) if error["problems"] else kind(error["text"])
    return None


def raise_for(code: int, text: str) -> None:
    """Throws the exception of an exit code, with the program's own message, or else with what its launcher says.

    Parameters
    ----------
    code : int
        Exit code; negative: the number of a signal.
    text : str
        What the program wrote to its standard error.

    Raises
    ------
    Error
        The exit code is not 0.
    """
    if code == 0:
        return
    error = error_of(text, code)
    if error is None:
        by_signal = f"\nasperity was ended by signal {-code} ({signal.strsignal(-code)})" if code < 0 else ""
        said = (text.strip() + by_signal).strip()
        error = BY_CODE.get(code, InternalError)(said or f"asperity ended with exit code {code}")
    raise error


def refuse_ranks() -> None:
    """Refuses a call in one of several ranks, each of which would do the same. Raises SceneError."""
    if launched()[1]:
        raise SceneError("asperity", "this command is one process, not one of several ranks of mpirun or srun",
                         "it starts its runs itself, each as a program of its own",
                         "start it alone (srun -n 1); for ranks of each point: asperity sweep SCENE --launch "
                         '"mpirun -n 2"; for points on the ranks: --executor mpi')


def call(arguments: Iterable[str], *, text: str | None = None, given: socket.socket | None = None, refusal: bool = False) -> str:
    """Runs the program to its end.

    Parameters
    ----------
    arguments : Iterable[str]
        Words of its command line.
    text : str, optional
        Its standard input.
    given : socket.socket, optional
        Socket as its standard input.
    refusal : bool
        True: what it prints of a scene that it refuses (exit code 2) is an answer.

    Returns
    -------
    str
        Its standard output.

    Raises
    ------
    InputOutputError
        The program cannot be started.
    Error
        The program failed: the exception of its exit code.
    """
    words = [path(), *arguments]
    try:
        source: dict[str, Any] = {"input": text} if given is None else {"stdin": given}
        done = subprocess.run(words, **source, capture_output=True, text=True, encoding="utf-8", env=environment_alone())
    except OSError as error:
        raise InputOutputError(words[0], "cannot be started", error.strerror or str(error),
                               "check that it is installed") from None
    if not (refusal and done.returncode == SceneError.code and done.stdout):
        raise_for(done.returncode, done.stderr)
    return done.stdout


def sets(overrides: Iterable[str]) -> list[str]:
    """Returns ["a.b=1", ...] as the words of a command line."""
    return [word for one in overrides for word in ("--set", one)]


@functools.cache
def info() -> dict[str, Any]:
    """Returns what the program was built from and runs on: version, git, compiler, flags, mpi, hdf5, fftw, ranks, threads, cuda,
    processor."""
    return json.loads(call(["info", "--json"]))


def mpi() -> str:
    """Returns the MPI that the program was built with: "Open MPI v4.1.4"."""
    return info()["mpi"]


@functools.cache
def schema() -> dict[str, dict[str, Any]]:
    """Returns every key of a scene: kind, unit, default, doc, choices."""
    return json.loads(call(["defaults", "--json"]))


@functools.cache
def quantities() -> dict[str, dict[str, str]]:
    """Returns every value of result.json: unit, per and meaning. "*" in a name stands for any, "[]" for each of a list."""
    return json.loads(call(["defaults", "--results", "--json"]))


def quantity(path: str) -> dict[str, str]:
    """Returns unit ("" for a pure number), divisor (per) and meaning of a value; empty for a value that the program does not
    know."""
    found = quantities().get(path)
    if found is None:
        found = next((q for name, q in quantities().items() if "*" in name and
                      re.fullmatch(re.escape(name).replace(r"\*", "[^.]+"), path)), {"unit": "", "per": "", "meaning": ""})
    return {**found, "unit": "" if found["unit"] == "1" else found["unit"]}


def check(scene: str, overrides: Iterable[str] = ()) -> dict[str, Any]:
    """Checks a scene without running it.

    Parameters
    ----------
    scene : str
        Scene file.
    overrides : Iterable[str]
        Overrides, each "section.key=value".

    Returns
    -------
    dict[str, Any]
        The scene as it would be used: name, scene, sweep, effects, notes, problems, longest_timestep (fs), edge_pinning (the factor by
        which a coarse spacing increases the pull-off force of a sphere).

    Raises
    ------
    Error
        The file cannot be read.
    """
    return json.loads(call(["check", scene, *sets(overrides), "--json"], refusal=True))


def plan(scene: str, overrides: Iterable[str] = ()) -> dict[str, Any]:
    """Rehearses a run.

    Parameters
    ----------
    scene : str
        Scene file.
    overrides : Iterable[str]
        Overrides, each "section.key=value".

    Returns
    -------
    dict[str, Any]
        Memory ("bytes") and time ("seconds", s) that a run takes, by part, and its effects.

    Raises
    ------
    Error
        The scene is refused.
    """
    return json.loads(call(["plan", scene, *sets(overrides), "--json"]))


def surface(scene: str, overrides: Iterable[str] = (), out: str = "") -> dict[str, Any]:
    """Makes the surface of a scene.

    Parameters
    ----------
    scene : str
        Scene file.
    overrides : Iterable[str]
        Overrides, each "section.key=value".
    out : str
        Directory for heights.h5; "": none is written.

    Returns
    -------
    dict[str, Any]
        rms (Å), slope_of_neighbours, notes, and doubts: the notes on the file of a map.

    Raises
    ------
    Error
        The scene is refused.
    """
    return json.loads(call(["surface", scene, *sets(overrides), "--json", *(["--out", out] if out else [])]))


def theory_points(scene: str, points: list[list[str]], runnable: bool = False, profile: bool = False) -> list[dict]:
    """Computes Persson's theory of many variations of a scene, and the input of the other theories (`rough`, `flat`).

    Parameters
    ----------
    scene : str
        Scene file.
    points : list[list[str]]
        Overrides of each variation.
    runnable : bool
        True: with the problems that would stop a run.
    profile : bool
        True: with everything over the magnification, and theory.persson.critical_rms.

    Returns
    -------
    list[dict]
        An object for each variation; its `problems` are the mistakes of the variation.

    Raises
    ------
    Error
        The scene file cannot be read.
    InternalError
        The program gave another number of answers.
    """
    text = "".join(json.dumps(point) + "\n" for point in points)
    words = ["theory-points", scene, "--points", "-"] + ["--runnable"] * runnable + ["--profile"] * profile
    lines = call(words, text=text).splitlines()
    if len(lines) != len(points):
        raise InternalError("asperity theory-points", f"answered {len(lines)} of {len(points)} points")
    return [json.loads(line) for line in lines]


def complaints(points: list[dict[str, Any]], where: dict[str, str] | None = None) -> None:
    """Refuses points with problems, each problem once.

    Parameters
    ----------
    points : list[dict[str, Any]]
        Answers of theory_points().
    where : dict[str, str], optional
        Places of swept keys, for the messages.

    Raises
    ------
    SceneError
        A point has a problem.
    """
    found: dict[tuple[str, str], dict] = {}
    for point in points:
        for problem in point.get("problems", []):
            for key, place in (where or {}).items():
                if problem["where"].startswith(f"--set {key}="):
                    problem["where"] = place
            found.setdefault((problem["where"], problem["what"]), problem)
    if found:
        raise SceneError.of(list(found.values()))
