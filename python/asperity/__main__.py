# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The command line: `python3 -m asperity` is `asperity`.

theory, sweep, cost, estimate, adhesion, states, report, export and convert are carried out here; the program hands them over. Every other
command is handed to the program.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
import time
from pathlib import Path

from .errors import NEEDED, Error, InputOutputError, SceneError, to_install
from .running import program
from .running.scene import STANDARD_INPUT, scene_file
from .terminal import launched

EXIT = "Exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard, 4 files, 75 stopped early."


class _Parser(argparse.ArgumentParser):
    def error(self, message: str):
        raise SceneError("command line", message[0].lower() + message[1:], "",
                         "asperity --help, or asperity COMMAND --help")


def _many(text: str) -> int:
    if not text.strip().isdecimal() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"{text} is no number from 1 to 1024")
    return int(text)


def _sites(text: str) -> int:
    if not text.strip().isdecimal() or not 16 <= int(text) <= 32768:
        raise argparse.ArgumentTypeError(f"{text} is no number of sites from 16 to 32768")
    return int(text)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="asperity", epilog=EXIT)
    commands = parser.add_subparsers(dest="command", required=True)

    def add(name: str, purpose: str, epilog: str = "") -> argparse.ArgumentParser:
        return commands.add_parser(name, help=purpose, description=purpose, epilog=epilog,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)

    def scene(command: argparse.ArgumentParser, out: str) -> None:
        command.add_argument("words", nargs="*", metavar="SCENE", help="the scene file (TOML)")
        command.add_argument("--set", action="append", default=[], metavar="key=value", dest="sets",
                             help="override a key of the scene: section.key=value; repeatable")
        command.add_argument("--out", metavar="DIR", help=f"result directory (default: {out})")
        if command.prog.split()[-1] != "theory":
            command.add_argument("--progress", default="auto", metavar="MODE", help="auto, bar, lines or off")

    def varied(command: argparse.ArgumentParser) -> None:
        command.add_argument("--jobs", type=_many, default=1, metavar="N",
                             help="runs side by side; they share the processors")
        command.add_argument("--seeds", type=_many, metavar="N",
                             help="surfaces of a self-affine scene to average over (default: 8, or 4 with a path)")
        command.add_argument("--parts", default="", metavar="NAMES", help="only these parts of the error: tail,seeds,...")
        command.add_argument("--plan", action="store_true", help="say what would be run and how long it takes; run nothing")

    theory = add("theory", "the theories of a scene, without simulating it")
    scene(theory, "results/<scene>-theory")
    theory.add_argument("--points", help=argparse.SUPPRESS)
    theory.add_argument("--json", action="store_true", help="print the result as one line of JSON and write nothing")
    sweep = add("sweep", "a scene over several values of its keys: runs, theory, one table",
                "--set key=v1,v2,..., key=start:stop:step or key=start:stop:xFACTOR sweeps a key, beside those of\n"
                "the scene's [sweep]; with several, every combination. The same command goes on where a sweep stopped.\n"
                "Several scenes share one set of plots.")
    scene(sweep, "results/<scene>-sweep")
    sweep.add_argument("--jobs", type=_many, default=1, metavar="N",
                       help="points side by side; each takes an equal share of the processors, unless "
                            "OMP_NUM_THREADS or --launch chooses")
    workers = ("run them on workers instead: mpi (the ranks of `mpirun -n 3 asperity ... --executor mpi`, the first of which "
               "leads) or dask:tcp://HOST:PORT; one thread each, unless OMP_NUM_THREADS says more there")
    sweep.add_argument("--executor", metavar="WHERE", default="", help=workers)
    sweep.add_argument("--launch", default="", metavar="WORDS",
                       help='what to put before the program for every point: "mpirun -n 2"')
    sweep.add_argument("--wall-limit", default="", metavar="23h50m",
                       help="stop with checkpoints when this time has passed (exit 75)")
    sweep.add_argument("--theory-only", action="store_true", help="the theory alone, no simulation")
    cost = add("cost", "what accuracy costs in run time: a scene with each of its numerical settings varied",
               "The same command goes on where it stopped.")
    scene(cost, "results/<scene>-cost")
    cost.add_argument("--jobs", type=_many, default=1, metavar="N", help="runs side by side, one thread each")
    cost.add_argument("--executor", metavar="WHERE", default="", help=workers)
    cost.add_argument("--target", metavar="ERROR",
                      help="find the cheapest numerical settings that keep this error: 1%%, 0.01")
    cost.add_argument("--parameters", default="", metavar="NAMES", help="only these: timestep,cutoff,layers,...")
    estimate = add("estimate", "the numbers of a scene with their errors, from runs with one setting varied at a time",
                   "Parts of the error: convergence, tail, spacing, levels, timestep, thickness, width, edge (of a map), rate,\n"
                   "seeds, places (of a map). The same command goes on where it stopped.")
    scene(estimate, "results/<scene>-estimate")
    varied(estimate)
    adhesion = add("adhesion", "from a measured map of heights to its adhesion with an error",
                   "An elastic half-space on the rigid map, bound by an exponential attraction: run, path at a held mean\n"
                   "height, estimate, report. The same command goes on where it stopped.")
    adhesion.add_argument("map", metavar="MAP", help="HDF5, .npy, or any map that convert reads")
    adhesion.add_argument("--E", required=True, metavar="100GPa", help="Young's modulus of the half-space")
    adhesion.add_argument("--nu", required=True, type=float, metavar="0.25", help="its Poisson's ratio")
    adhesion.add_argument("--work", required=True, metavar="200mJ/m2", help="work of adhesion of flat surfaces")
    adhesion.add_argument("--range", metavar="3Å", help="of the attraction (default: 3 Å, or what the spacing resolves)")
    adhesion.add_argument("--size", metavar="100nm", help="the map's shorter edge; holds over what the file says")
    adhesion.add_argument("--unit", metavar="nm", help="of the heights; holds over what the file says")
    adhesion.add_argument("--channel", metavar="NAME", help="of a file with several maps: this one, by name or number")
    adhesion.add_argument("--line-noise", choices=["keep", "align-rows", "isotropic"], help="treatment of a scan's noise from line to line")
    adhesion.add_argument("--sites", type=_sites, metavar="N", help="along an edge (default: the map's points, 256 at most)")
    adhesion.add_argument("--out", metavar="DIR", help="result directory (default: results/<map>-adhesion)")
    adhesion.add_argument("--jobs", type=_many, default=1, metavar="N", help="runs side by side; they share the processors")
    adhesion.add_argument("--progress", default="auto", metavar="MODE", help="auto, bar, lines or off")
    states = add("states", "the stable states of a contact under its load",
                 "A path at a held mean height goes inwards and back; the states are told with the pressures between\n"
                 "them. The same command goes on where it was stopped.")
    scene(states, "results/<scene>-states")
    states.add_argument("--starts", type=_many, default=20, metavar="N",
                        help="states from so many layers laid on the substrate at random heights")
    report = add("report", "a run or a sweep as one self-contained HTML page")
    report.add_argument("directory", metavar="DIR", help="the result directory")
    export = add("export", "maps and trajectory of a run for OVITO, ParaView, or as PNG")
    export.add_argument("directory", metavar="DIR", help="the result directory")
    export.add_argument("--to", required=True, metavar="FORMAT", dest="format", help="xyz (OVITO, ASE), vtk (ParaView) or png")
    convert = add("convert", "a map of heights or a substrate's atoms as the HDF5 that a scene names",
                  "Maps: text with headers, ESRI grids, XYZ, and by SurfaceTopography Gwyddion and instruments' files.\n"
                  "Atoms: LAMMPS data, and by ASE extended XYZ.")
    convert.add_argument("source", metavar="FILE", help="the file to convert")
    convert.add_argument("target", metavar="OUT.h5", help="the file to write")
    convert.add_argument("--channel", metavar="NAME", help="of a file with several maps: this one, by name or number")
    return parser


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
                         "for example: asperity run scenes/first-contact.toml")
    return found


def _one_scene(given: argparse.Namespace) -> str:
    scenes = _scenes(given)
    if len(scenes) > 1:
        raise SceneError("command line", "more than one scene is given", f"{scenes[0]} and {scenes[1]}",
                         f"for example: asperity {given.command} scenes/first-contact.toml")
    return scenes[0]


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _pool_options(given: argparse.Namespace):
    from .running.pool import PoolOptions
    from .terminal import Progress

    Progress(given.progress)  # refuses what is no mode before anything is done
    return PoolOptions(given.jobs, progress=given.progress)


def _carry_out(given: argparse.Namespace) -> int:
    if given.command == "report":
        from .reports.sweep import write_page

        page = write_page(Path(given.directory))
        print(page.said)
        if page.unread:
            raise InputOutputError(given.directory, "the page shows only a part of the result", "\n".join(page.unread),
                                   "run the scene again, or take a copy of the file that is whole")
        return 0
    if given.command == "export":
        from .reports.export import export

        print(*export(Path(given.directory), given.format), sep="\n")
        return 0
    if given.command == "convert":
        from .maps.convert import convert

        print(convert(given.source, given.target, given.channel))
        return 0
    if given.command == "theory":
        from .commands.theory import theory_command

        if given.points is not None:
            raise SceneError("--points", "is no option of theory any more", "it is for programs",
                             "asperity theory-points SCENE --points FILE")
        return theory_command(_one_scene(given), given.sets, given.out, given.json)
    if given.command == "adhesion":
        from .commands.adhesion import adhesion_command

        return adhesion_command(given.map, given.E, given.nu, given.work, given.out, _pool_options(given),
                                reach=given.range, size=given.size, unit=given.unit, channel=given.channel, sites=given.sites,
                                line_noise=given.line_noise)
    if given.command == "states":
        from .studies.states import states_command

        return states_command(_one_scene(given), given.sets, given.out, given.starts, given.progress)
    from .running.pool import PoolOptions, executor_of
    if given.command == "estimate":
        from .commands.studies import estimate_command

        return estimate_command(_one_scene(given), given.sets, given.out, _pool_options(given), given.seeds,
                                _names(given.parts), given.plan)
    from .commands.studies import cost_command, sweep_command
    from .terminal import Progress, parse_duration

    Progress(given.progress)  # refuses what is no mode before anything is done
    cost = given.command == "cost"
    scenes = [_one_scene(given)] if cost else _scenes(given)
    options = PoolOptions(given.jobs, 1 if cost else 0, progress=given.progress)
    if not cost:
        options.launch = given.launch.split()
        options.wall_limit = parse_duration(given.wall_limit) if given.wall_limit else None
    with executor_of(given.executor) if given.executor else contextlib.nullcontext() as executor:
        if given.executor and executor is None:
            return 0  # a rank that has worked for the first one
        options.executor = executor
        if cost:
            return cost_command(scenes[0], given.sets, _names(given.parameters), given.out, options, given.target)
        return sweep_command(scenes, given.sets, given.out, given.theory_only, options)


def _after_the_first(code: int) -> int:
    """Waits for the first rank, which prints the error; a launcher ends all ranks with the first one that ends."""
    time.sleep(5)
    return code


def main(words: list[str]) -> int:
    """Carries out a command line. Returns the exit code."""
    parser = _parser()
    commands = next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction)).choices
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
        commands[words[0]].parse_intermixed_args(_spelt_out(words[1:]), given)  # options and scenes in any order
        with contextlib.ExitStack() as piped:  # what is piped in is read once: commands start the program several times
            if STANDARD_INPUT in getattr(given, "words", []):
                file = piped.enter_context(scene_file(STANDARD_INPUT))
                given.words = [file if word == STANDARD_INPUT else word for word in given.words]
            return _carry_out(given)
    except Error as error:
        if leads and rank != 0:
            return _after_the_first(error.code)
        print(error, file=sys.stderr)
        if error.code == SceneError.code:
            n = error.problems
            print(f"{n} problem{'' if n == 1 else 's'}; nothing was written", file=sys.stderr)
        return error.code
    except ImportError as error:
        fix = to_install(*NEEDED)
        print(f"asperity {words[0]}: a Python package is missing\n    why: {sys.executable}: {error}\n    fix: {fix}",
              file=sys.stderr)
        return 1


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # or Python complains again at its end
        sys.exit(0)
    except KeyboardInterrupt:
        sys.exit(130)
