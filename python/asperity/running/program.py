# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Calls of the C++ program: its path, its command line, and its answers (schema, checks, plans, theories)."""

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
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..errors import BY_CODE, Error, InputOutputError, InternalError, SceneError
from ..terminal import environment_alone, launched


@functools.cache
def version() -> str:
    """Returns the version of the program."""
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
    """Returns the object of a line of JSON from the program; {"text": line} for any other line."""
    if line.startswith("{"):
        with contextlib.suppress(ValueError):
            found = json.loads(line)
            if isinstance(found, dict):
                return found
    return {"text": line}


def error_of(text: str, code: int) -> Error | None:
    """Returns the error that the program has printed as JSON."""
    kind = BY_CODE.get(code, InternalError)
    for line in text.splitlines():
        error = told(line).get("error")
        if error:
            return kind.of(error["problems"]) if error["problems"] else kind(error["text"])
    return None


def raise_for(code: int, text: str) -> None:
    """Raises the exception of an exit code, with the program's message, or with the launcher's message if the program has printed none. Raises
    Error."""
    if code == 0:
        return
    error = error_of(text, code)
    if error is None:
        by_signal = f"\nasperity was ended by signal {-code} ({signal.strsignal(-code)})" if code < 0 else ""
        said = (text.strip() + by_signal).strip()
        error = BY_CODE.get(code, InternalError)(said or f"asperity ended with exit code {code}")
    raise error


def refuse_ranks() -> None:
    """Raises SceneError in one of several MPI ranks, because each would do the same work."""
    if launched()[1]:
        raise SceneError("asperity", "this command is one process, not one of several ranks of mpirun or srun",
                         "it starts its runs itself, each as a program of its own",
                         "start it alone (srun -n 1); for ranks of each point: asperity sweep SCENE --launch "
                         '"mpirun -n 2"; for points on the ranks: --executor mpi')


def call(arguments: Iterable[str], *, text: str | None = None, given: socket.socket | None = None, refusal: bool = False) -> str:
    """Runs the program and waits for its end. Raises InputOutputError, Error."""
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
    """Returns overrides ["a.b=1", ...] as arguments of a command line."""
    return [word for one in overrides for word in ("--set", one)]


@functools.cache
def info() -> dict[str, Any]:
    """Returns the build and the machine of the program: version, git, compiler, flags, mpi, hdf5, fftw, ranks, threads, cuda,
    processor."""
    return json.loads(call(["info", "--json"]))


def mpi() -> str:
    """Returns the MPI that the program was built with: "Open MPI v4.1.4"."""
    return info()["mpi"]


@functools.cache
def schema() -> dict[str, dict[str, Any]]:
    """Returns all keys of a scene by name, each with kind, unit, default, doc and choices."""
    return json.loads(call(["defaults", "--json"]))


@functools.cache
def quantities() -> dict[str, dict[str, str]]:
    """Returns all values of result.json by name, each with unit, per and meaning. "*" stands for any name, "[]" for each element of
    a list."""
    return json.loads(call(["defaults", "--results", "--json"]))


def quantity(path: str) -> dict[str, str]:
    """Returns unit ("" for a pure number), divisor (per) and meaning of a value; empty texts for an unknown value."""
    found = quantities().get(path)
    if found is None:
        found = next((q for name, q in quantities().items() if "*" in name and
                      re.fullmatch(re.escape(name).replace(r"\*", "[^.]+"), path)), {"unit": "", "per": "", "meaning": ""})
    return {**found, "unit": "" if found["unit"] == "1" else found["unit"]}


def check(scene: str, overrides: Iterable[str] = ()) -> dict[str, Any]:
    """Checks a scene without running it. Raises Error."""
    return json.loads(call(["check", scene, *sets(overrides), "--json"], refusal=True))


def plan(scene: str, overrides: Iterable[str] = ()) -> dict[str, Any]:
    """Estimates memory and time of a run. Raises Error."""
    return json.loads(call(["plan", scene, *sets(overrides), "--json"]))


def surface(scene: str, overrides: Iterable[str] = (), out: str = "") -> dict[str, Any]:
    """Makes the surface of a scene. Raises Error."""
    return json.loads(call(["surface", scene, *sets(overrides), "--json", *(["--out", out] if out else [])]))


def theory_points(scene: str, points: list[list[str]], runnable: bool = False, profile: bool = False) -> list[dict]:
    """Computes Persson's theory of many variations of a scene, and the input of the other theories (`rough`, `flat`). Raises Error, InternalError."""
    text = "".join(json.dumps(point) + "\n" for point in points)
    words = ["theory-points", scene, "--points", "-"] + ["--runnable"] * runnable + ["--profile"] * profile
    lines = call(words, text=text).splitlines()
    if len(lines) != len(points):
        raise InternalError("asperity theory-points", f"answered {len(lines)} of {len(points)} points")
    return [json.loads(line) for line in lines]


def stress_below(scene: str, overrides: Iterable[str], file: str, state: str, slid: bool, out: str) -> dict[str, Any]:
    """Computes the stresses below a state. Raises Error."""
    with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as points:
        json.dump({"file": file, "state": state, "slid": slid}, points)
        points.flush()
        return json.loads(call(["stress-below", scene, *sets(overrides), "--points", points.name, "--out", out]))


def complaints(points: list[dict[str, Any]], where: dict[str, str] | None = None) -> None:
    """Raises SceneError for points with problems, with each problem once."""
    found: dict[tuple[str, str], dict] = {}
    for point in points:
        for problem in point.get("problems", []):
            for key, place in (where or {}).items():
                if problem["where"].startswith(f"--set {key}="):
                    problem["where"] = place
            found.setdefault((problem["where"], problem["what"]), problem)
    if found:
        raise SceneError.of(list(found.values()))
