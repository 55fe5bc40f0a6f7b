# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The command line. The program starts Python with start() (engine/commands/python_commands.cpp), without the current folder in
the search path; `python3 -m asperity` looks there for modules.

theory, sweep, cost, estimate, adhesion, tip, states, stress, report, export, convert and scenes are carried out here; the program hands them over.
Every other command is handed to the program. In a wheel the program is entry(): the compiled module carries out the others.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import signal
import sys
import time
import warnings
from pathlib import Path

from .arguments import command_line
from .commands.command_line import parsers
from .errors import NEEDED, Error, InputOutputError, SceneError, to_install
from .running import program
from .running.scene import STANDARD_INPUT, scene_file
from .terminal import Voice, folded, launched, sleep_soon
from .units import is_unit


def _is_override(word: str) -> bool:
    """Returns True for an override: `--set a.b=1 c.d=2 scene.toml` means what it looks like."""
    before, equals, _ = word.partition("=")
    return bool(equals) and "." in before and "/" not in before and not os.path.exists(word)


def _spelt_out(words: list[str]) -> list[str]:
    """Spells `--set a.b=1 c.d=2` as `--set a.b=1 --set c.d=2`, so that the last value of a key counts."""
    out: list[str] = []
    for word in words:
        if _is_override(word) and len(out) > 1 and out[-2] == "--set":
            out.append("--set")
        out.append(word)
    return out


def _scenes(given: argparse.Namespace) -> list[str]:
    given.sets += [word for word in given.words if _is_override(word)]
    found = [word for word in given.words if not _is_override(word)]
    if not found:
        raise SceneError("command line", "no scene is given", "the command needs one",
                         f"for example: asperity {given.command} scenes/first-contact.toml")
    return found


def _one_scene(given: argparse.Namespace) -> str:
    scenes = _scenes(given)
    if len(scenes) > 1 and not os.path.exists(scenes[1]) and is_unit(scenes[1]):
        raise SceneError("command line", f"'{scenes[1]}' stands alone", "a blank ends a word of the command line",
                         "write the unit behind the number: 3nm")
    if len(scenes) > 1:
        raise SceneError("command line", "more than one scene is given", f"{scenes[0]} and {scenes[1]}",
                         f"for example: asperity {given.command} scenes/first-contact.toml")
    return scenes[0]


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _carry_out(given: argparse.Namespace) -> int:
    voice = Voice(given.quiet, given.json, getattr(given, "progress", None))
    if given.quiet or given.json:
        warnings.simplefilter("ignore")  # they are notes
    if given.command == "report":
        from .reports.sweep import write_page

        page = write_page(Path(given.directory), out=given.out)
        voice.show(page.said)
        voice.tell({"file": page.path, "unread": page.unread})
        if page.unread:
            raise InputOutputError(given.directory, "the page shows only a part of the result", "\n".join(page.unread),
                                   "run the scene again, or take a copy of the file that is whole")
        return 0
    if given.command == "stress":
        from .commands.stress import stress_command

        return stress_command(given.directory, given.state, given.friction, given.depth, given.volume, given.out, voice)
    if given.command == "export":
        from .reports.export import export

        files = export(Path(given.directory), given.format, given.out)
        voice.show("\n".join(map(str, files)))
        voice.tell({"files": files})
        return 0
    if given.command == "scenes":
        from .commands.scenes import scenes_command

        if given.target and given.out:
            raise SceneError("command line", f"two folders to write are given, {given.target} and {given.out}", "", "leave one out")
        return scenes_command(given.target or given.out or ".", voice)
    if given.command == "convert":
        from .maps.convert import convert

        if given.target and given.out:
            raise SceneError("command line", f"two files to write are given, {given.target} and {given.out}", "", "leave one out")
        target = given.target or given.out or Path(given.source.partition(":/")[0]).with_suffix(".h5")
        said, *notes = convert(given.source, target, given.channel).split("\n")
        voice.show(said)
        for note in notes:
            voice.say(note)
        voice.tell({"file": target, "text": said, "notes": [note.removeprefix("note: ") for note in notes]})
        return 0
    if given.command == "prony":
        from .commands.prony import prony_command

        if given.target and given.out:
            raise SceneError("command line", f"two files to write are given, {given.target} and {given.out}", "", "leave one out")
        target = given.target or given.out or str(Path(given.source).with_suffix(".toml"))
        return prony_command(given.source, target, given.branches, given.poisson, given.frequency_unit, given.modulus_unit, given.modulus,
                             given.relaxed, voice)
    if given.command == "theory":
        from .commands.theory import theory_command

        if given.points is not None:
            raise SceneError("--points", "is no option of theory any more", "it is for programs",
                             "asperity theory-points SCENE --points FILE")
        return theory_command(_one_scene(given), given.sets, given.out, voice)
    if given.command == "states":
        from .studies.states import states_command

        return states_command(_one_scene(given), given.sets, given.out, given.starts, voice)
    from .running.pool import PoolOptions, executor_of
    from .terminal import parse_duration

    cost = given.command == "cost"
    options = PoolOptions(given.jobs, 1 if cost else 0, progress=voice.progress)
    if given.command == "adhesion":
        from .commands.adhesion import adhesion_command

        return adhesion_command(given.map, given.young, given.poisson, given.adhesion, given.out, options, given.plan, voice,
                                reach=given.range, size=given.size, unit=given.unit, channel=given.channel, sites=given.sites,
                                line_noise=given.line_noise)
    if given.command == "tip":
        from .commands.tip import tip_command

        return tip_command(given.map, given.out, options, given.plan, voice, **{name: getattr(given, name) for name in (
            "radius", "young", "poisson", "adhesion", "stiffness", "load", "range", "size", "unit", "channel", "sites")})
    from .commands.studies import cost_command, estimate_command, sweep_command

    if given.command == "estimate":
        return estimate_command(_one_scene(given), given.sets, given.out, options, given.seeds, _names(given.parts), given.plan, voice)
    scenes = [_one_scene(given)] if cost else _scenes(given)
    if not cost:
        options.launch = given.launch.split()
        options.wall_limit = parse_duration(given.wall_limit) if given.wall_limit else None
    with executor_of(given.executor) if given.executor else contextlib.nullcontext() as executor:
        if given.executor and executor is None:
            return 0  # a rank that has worked for the first one
        options.executor = executor
        if cost:
            return cost_command(scenes[0], given.sets, _names(given.parameters), given.out, options, given.target, given.plan, voice)
        return sweep_command(scenes, given.sets, given.out, given.theory_only, options, given.plan, voice)


def _after_the_first(code: int) -> int:
    """Waits for the first rank, which prints the error; a launcher ends all ranks with the first one that ends."""
    time.sleep(5)
    return code


def _print_error(error: Error, as_json: bool) -> None:
    """Prints an error as the program does (engine/commands/exit_code.hpp)."""
    text = str(error)
    if as_json:
        print(json.dumps({"error": {"code": error.code, "problems": error.listed, "text": text}}, ensure_ascii=False).encode("utf-8", "replace").decode(), file=sys.stderr)
        return
    print(folded(text, 2), file=sys.stderr)
    if error.code == SceneError.code:
        n = error.problems
        print(f"{n} problem{'' if n == 1 else 's'}; nothing was written", file=sys.stderr)


def main(words: list[str]) -> int:
    """Carries out a command line. Returns the exit code."""
    commands = parsers()
    if not words or words[0] not in commands:
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
        given = argparse.Namespace(command=words[0])
        commands[words[0]].refuse_unknown(words[1:])
        commands[words[0]].parse_intermixed_args(_spelt_out(words[1:]), given)  # options and scenes in any order
        with contextlib.ExitStack() as piped:  # what is piped in is read once: commands start the program several times
            if STANDARD_INPUT in getattr(given, "words", []):
                file = piped.enter_context(scene_file(STANDARD_INPUT))
                given.words = [file if word == STANDARD_INPUT else word for word in given.words]
            with command_line():
                return _carry_out(given)
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
    if words and words[0] in parsers():
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
