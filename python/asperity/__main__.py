# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The command line. The program starts Python with start() (engine/commands/python_commands.cpp), without the current folder in
the search path; `python3 -m asperity` looks there for modules.

The commands of the package (commands/table.txt) are carried out here; the program hands them over. Every other command is handed to the
program. In a wheel the program is entry(): the compiled module carries out the others.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import time
import warnings

from .arguments import command_line
from .commands.options import OfScene, command, purposes
from .errors import NEEDED, Error, SceneError, to_install
from .running import program
from .running.scene import STANDARD_INPUT, scene_file
from .terminal import folded, launched, sleep_soon


def _after_the_first(code: int) -> int:
    """Waits for the first rank, which prints the error; a launcher ends all ranks with the first one that ends."""
    time.sleep(5)
    return code


def _print_error(error: Error, as_json: bool) -> None:
    """Prints an error as the program does (engine/commands/exit_code.hpp)."""
    text = str(error)
    if as_json:
        said = json.dumps({"error": {"code": error.code, "problems": error.listed, "text": text}}, ensure_ascii=False)
        print(said.encode("utf-8", "replace").decode(), file=sys.stderr)
        return
    print(folded(text, 2), file=sys.stderr)
    if error.code == SceneError.code:
        n = error.problems
        print(f"{n} problem{'' if n == 1 else 's'}; nothing was written", file=sys.stderr)


def main(words: list[str]) -> int:
    """Carries out a command line. Returns the exit code."""
    if not words or words[0] not in purposes():
        os.execv(program.path(), [program.path(), *words])
    rank, several = launched()
    leads = several and "mpi" in " ".join(words).replace("=", " ").partition("--executor ")[2].split()[:1]
    if several and rank != 0:
        if not leads:
            return _after_the_first(SceneError.code)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):  # it tells the others when to stop
            signal.signal(number, signal.SIG_IGN)
    try:
        if not leads:
            program.refuse_ranks()
        called = command(words[0])
        given, voice = called.given(words[1:])
        if voice.quiet or voice.json:
            warnings.simplefilter("ignore")  # they are notes
        with contextlib.ExitStack() as piped:  # what is piped in is read once: commands start the program several times
            if isinstance(given, OfScene) and STANDARD_INPUT in given.words:
                file = piped.enter_context(scene_file(STANDARD_INPUT))
                given.words = [file if word == STANDARD_INPUT else word for word in given.words]
            with command_line():
                return called.act(given, voice)
    except Error as error:
        if leads and rank != 0:
            return _after_the_first(error.code)
        _print_error(error, "--json" in words)
        return error.code
    except ImportError as error:
        fix = to_install(*NEEDED)
        print(folded(f"asperity {words[0]}: a Python package is missing\n    why: {sys.executable}: {error}\n    fix: {fix}", 2),
              file=sys.stderr)
        return 1


def entry() -> int:
    """Runs the program `asperity` of a wheel: study commands here, the others in the compiled module. Returns the exit code."""
    words = sys.argv[1:]
    sleep_soon(os.environ)
    try:
        from . import _engine
    except ImportError:  # the package alone, beside a program that is elsewhere
        return main(words)
    if words and words[0] in purposes():
        return main(words)
    return _engine.program(words)


def start() -> None:
    """Carries out the command line of this process and ends it."""
    try:
        sys.exit(main(sys.argv[1:]))
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # or Python complains again at its end
        sys.exit(0)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    start()
