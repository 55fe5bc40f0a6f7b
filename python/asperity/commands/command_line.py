# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The commands of this package with their options, and the form of their help, which is that of the program
(engine/commands/help.hpp): usage, what the command does, arguments, options, exit codes, in 80 columns.
"""

from __future__ import annotations

import argparse
import difflib
import re
import textwrap

from ..arguments import options
from ..errors import SceneError
from ..terminal import WIDTH
from ..units import is_unit

EXIT = "exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard,\n            4 files, 75 stopped early"
INDENT = 26
"""Column of the help in which explanations begin."""
EXAMPLES = {"DIR": "results/first-contact", "MAP": "scan.gwy", "FILE": "measured.csv", "FORMAT": "vtk"}
"""What may stand for a word of the help."""


class Parser(argparse.ArgumentParser):
    """Command line of a command: its mistakes are SceneErrors, its help has the form of the program's."""

    words: tuple[str, ...] = ()
    """Words of the call behind the command, for messages."""

    def _given(self, action: argparse.Action) -> str | None:
        """Returns the word of the call that gives an option or, of what stands without one, the first such word; None: none does."""
        takes_value = {name for one in self._actions if one.nargs != 0 for name in one.option_strings}
        alone = [word for word, before in zip(self.words, ("", *self.words)) if not word.startswith("-") and before not in takes_value]
        names = [word for word in self.words if word.partition("=")[0] in action.option_strings]
        return next(iter(names if action.option_strings else alone), None)

    def error(self, message: str):
        """Throws SceneError, with the option that was meant."""
        fix, why = f"{self.prog} --help", ""
        if unknown := re.match(r"unrecognized arguments: (--[^\s=]+)", message):
            names = [name for action in self._actions for name in action.option_strings if name.startswith("--")]
            near = difflib.get_close_matches(unknown[1].strip("-"), [name.strip("-") for name in names], 1, 0.7)
            message = f"{unknown[1]} is no option of {self.prog.split()[-1]}"
            why, fix = "its options are " + ", ".join(names), f"did you mean --{near[0]}?" if near else fix
        elif alone := re.match(r"unrecognized arguments: ([^\s-]\S*)", message):
            message, why = f"'{alone[1]}' stands alone", "a blank ends a word of the command line"
            fix = "write the unit behind the number, 100GPa, or put both into quotation marks" if is_unit(alone[1]) else fix
        elif message.startswith("the following arguments are required"):
            lacking = [action for action in self._actions if action.required and self._given(action) is None]
            message = ", ".join(map(_name_of, lacking)) + (" is" if len(lacking) == 1 else " are") + " missing"
            why = "; ".join(f"{_name_of(action)}: {action.help}" for action in lacking)
            fix = "for example: " + " ".join([self.prog, *self.words, *(_example(action) for action in lacking)])
        raise SceneError("command line", message if message[:2].isupper() else message[0].lower() + message[1:], why, fix)

    def usage_line(self) -> str:
        """Returns what the command needs, as the help has it: "usage: asperity report DIR [options]"."""
        words = [action for action in self._actions if not action.option_strings]
        needed = [action for action in self._actions if action.option_strings and action.required]
        usage = " ".join([self.prog, *(f"[{a.metavar}]" if a.nargs == "?" else str(a.metavar) for a in words),
                          *(f"{a.option_strings[0]} {a.metavar}" for a in needed), "[options]"])
        return textwrap.fill(f"usage: {usage}", WIDTH, subsequent_indent=" " * 7, break_on_hyphens=False, break_long_words=False)

    def refuse_unknown(self, words: list[str]) -> None:
        """Checks the options of a call before argparse does, which names those that are missing first. Raises SceneError."""
        self.words = tuple(words)
        takes_value = {name for action in self._actions if action.nargs != 0 for name in action.option_strings}
        for word, before in zip(words, ["", *words]):
            name = word.partition("=")[0]
            if word.startswith("--") and len(word) > 2 and before not in takes_value and \
                    not any(known.startswith(name) for known in self._option_string_actions):
                self.error(f"unrecognized arguments: {name}")

    def format_help(self) -> str:
        """Returns the help."""
        of_command = [action for action in self._actions if action.help is not argparse.SUPPRESS]
        words = [action for action in of_command if not action.option_strings]
        parts = [self.usage_line(), textwrap.fill(self.description or "", WIDTH)]
        parts += [textwrap.fill(part, WIDTH, break_on_hyphens=False) for part in (self.epilog or "").split("\n") if part]
        parts += [_listed("arguments", [(str(a.metavar), a) for a in words])] * bool(words)
        parts.append(_listed("options", [(_spelt(a), a) for a in of_command if a.option_strings]))
        return "\n\n".join([*parts, EXIT]) + "\n"


def _name_of(action: argparse.Action) -> str:
    return action.option_strings[0] if action.option_strings else str(action.metavar)


def _example(action: argparse.Action) -> str:
    """Spells an option with a value, or what stands without one, as it may be written."""
    value = EXAMPLES.get(str(action.metavar), str(action.metavar))
    return f"{action.option_strings[0]} {value}" if action.option_strings else value


def _spelt(action: argparse.Action) -> str:
    """Returns an option as the help has it: "-o, --out DIR"; a long one stands where it would behind a short one."""
    short = len(action.option_strings[0]) == 2
    return "    " * (not short) + ", ".join(action.option_strings) + (f" {action.metavar}" if action.nargs != 0 else "")


def _listed(head: str, entries: list[tuple[str, argparse.Action]]) -> str:
    lines = [f"{head}:"]
    for name, action in entries:
        text = textwrap.wrap((action.help or "").replace("%%", "%"), WIDTH - INDENT, break_on_hyphens=False)
        first = f"  {name}"
        lines += [first] * (len(first) > INDENT - 2)
        start = " " * INDENT if len(first) > INDENT - 2 else first.ljust(INDENT)
        lines += [start + text[0], *(" " * INDENT + line for line in text[1:])]
    return "\n".join(lines)


def _many(text: str) -> int:
    if not text.strip().isdecimal() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"{text} is no number from 1 to 1024")
    return int(text)


def _sites(text: str) -> int:
    if not text.strip().isdecimal() or not 16 <= int(text) <= 32768:
        raise argparse.ArgumentTypeError(f"{text} is no number of sites from 16 to 32768")
    return int(text)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no number") from None


def _out(command: argparse.ArgumentParser, otherwise: str, what: str = "result directory", value: str = "DIR") -> None:
    command.add_argument("-o", "--out", metavar=value, help=f"{what} (default: {otherwise})")


def _voice(command: argparse.ArgumentParser, progress: bool = True, writes: str = "") -> None:
    if progress:
        command.add_argument("--progress", metavar="MODE", help="auto, bar, lines or off (default: auto)")
    command.add_argument("-q", "--quiet", action="store_true", help="print results and errors only")
    command.add_argument("--json", action="store_true", help=f"print the result as one line of JSON, for programs{writes}")


def _scene(command: argparse.ArgumentParser, out: str, several: str = "") -> None:
    command.add_argument("words", nargs="*", metavar="SCENE", help="the scene file (TOML); - is the standard input" + several)
    command.add_argument("--set", action="append", default=[], metavar="key=value", dest="sets",
                         help="override a key of the scene: section.key=value; repeatable")
    _out(command, out)


def _jobs(command: argparse.ArgumentParser, what: str = "runs side by side; they share the processors (default: 1)") -> None:
    command.add_argument("-j", "--jobs", type=_many, default=1, metavar="N", help=what)


def _plan(command: argparse.ArgumentParser) -> None:
    command.add_argument("--plan", action="store_true", help="say what would be run, how long it takes and what it will not state; run nothing")


WORKERS = ("run them on workers instead: mpi (the ranks of `mpirun -n 3 asperity ... --executor mpi`, the first of which "
           "leads) or dask:tcp://HOST:PORT; one thread each, unless OMP_NUM_THREADS says more there")


def parsers() -> dict[str, Parser]:
    """Returns the parser of each command, in the order of --help."""
    found: dict[str, Parser] = {}

    def add(name: str, purpose: str, more: str = "") -> Parser:
        found[name] = Parser(prog=f"asperity {name}", description=purpose[0].upper() + purpose[1:] + ".", epilog=more, add_help=False)
        return found[name]

    theory = add("theory", "the theories of a scene, without simulating it")
    _scene(theory, "results/<scene>-theory")
    theory.add_argument("--points", help=argparse.SUPPRESS)
    _voice(theory, progress=False, writes="; writes files only with --out")
    sweep = add("sweep", "a scene over several values of its keys: runs, theory, one table",
                "--set key=v1,v2,..., key=start:stop:step or key=start:stop:xFACTOR sweeps a key, beside those of the scene's "
                "[sweep]; with several, every combination. The same command goes on where a sweep stopped. Several scenes share "
                "one set of plots.")
    _scene(sweep, "results/<scene>-sweep", "; several share the plots")
    _jobs(sweep, "points side by side; each takes an equal share of the processors, unless OMP_NUM_THREADS or --launch chooses "
          "(default: 1)")
    sweep.add_argument("--executor", metavar="WHERE", default="", help=WORKERS)
    sweep.add_argument("--launch", default="", metavar="WORDS",
                       help='what to put before the program for every point: "mpirun -n 2"')
    sweep.add_argument("--wall-limit", default="", metavar="23h50m",
                       help="stop with checkpoints when this time has passed (exit 75)")
    sweep.add_argument("--theory-only", action="store_true", help="the theory alone, no simulation")
    _plan(sweep)
    _voice(sweep)
    cost = add("cost", "what accuracy costs in run time: a scene with each of its numerical settings varied",
               "The same command goes on where it stopped.")
    _scene(cost, "results/<scene>-cost")
    _jobs(cost, "runs side by side, one thread each (default: 1)")
    cost.add_argument("--executor", metavar="WHERE", default="", help=WORKERS)
    cost.add_argument("--target", metavar="ERROR",
                      help="find the cheapest numerical settings that keep this error: 1%%, 0.01")
    cost.add_argument("--parameters", default="", metavar="NAMES", help="only these: timestep,cutoff,layers,...")
    _plan(cost)
    _voice(cost)
    estimate = add("estimate", "the numbers of a scene with their errors, from runs with one setting varied at a time",
                   "Parts of the error: convergence, tail, spacing, levels, timestep, thickness, width, edge (of a map), rate, "
                   "seeds, places (of a map). The same command goes on where it stopped.")
    _scene(estimate, "results/<scene>-estimate")
    _jobs(estimate)
    estimate.add_argument("--seeds", type=_many, metavar="N",
                          help="surfaces of a self-affine scene to average over (default: 8, or 4 with a path)")
    estimate.add_argument("--parts", default="", metavar="NAMES", help="only these parts of the error: tail,seeds,...")
    _plan(estimate)
    _voice(estimate)
    adhesion = add("adhesion", "from a measured map of heights to its adhesion with an error",
                   "An elastic half-space on the rigid map, bound by an exponential attraction: run, path at a held mean height, "
                   "estimate, report. The same command goes on where it stopped.")
    adhesion.add_argument("map", metavar="MAP", help="HDF5, .npy, or any map that convert reads")
    adhesion.add_argument(*options("young"), required=True, metavar="100GPa", help="Young's modulus of the half-space")
    adhesion.add_argument(*options("poisson"), required=True, type=_number, metavar="0.25", help="its Poisson's ratio")
    adhesion.add_argument(*options("adhesion"), required=True, metavar="200mJ/m2", help="work of adhesion of flat surfaces")
    adhesion.add_argument(*options("range"), metavar="3Å", help="of the attraction (default: 3 Å, or what the spacing resolves)")
    adhesion.add_argument(*options("size"), metavar="100nm", help="the map's shorter edge; holds over what the file says")
    adhesion.add_argument(*options("unit"), metavar="nm", help="of the heights; holds over what the file says")
    adhesion.add_argument(*options("channel"), metavar="NAME", help="of a file with several maps: this one, by name or number")
    adhesion.add_argument(*options("line_noise"), choices=["keep", "align-rows", "isotropic"], metavar="HOW",
                          help="treatment of a scan's noise from line to line: keep, align-rows or isotropic")
    adhesion.add_argument(*options("sites"), type=_sites, metavar="N", help="along an edge (default: the map's points, 256 at most)")
    _out(adhesion, "results/<map>-adhesion")
    _jobs(adhesion)
    _plan(adhesion)
    _voice(adhesion)
    tip = add("tip", "the force curve of a tip on a sample, with an error",
              "A rigid sphere on a cantilever is pressed onto an elastic sample, smooth or of a measured map, and pulled off, without "
              "periodic images: force curve, pull-off and jump-in with their errors, JKR's fit. The same command goes on where it stopped.")
    tip.add_argument("map", nargs="?", metavar="MAP", help="heights of the sample, any map that convert reads (default: smooth)")
    tip.add_argument(*options("radius"), required=True, metavar="20nm", help="of the tip")
    tip.add_argument(*options("young"), required=True, metavar="3GPa", help="Young's modulus of the sample")
    tip.add_argument(*options("poisson"), required=True, type=_number, metavar="0.3", help="its Poisson's ratio")
    tip.add_argument(*options("adhesion"), required=True, metavar="50mJ/m2", help="work of adhesion of flat surfaces")
    tip.add_argument(*options("stiffness"), required=True, metavar="0.2N/m", help="of the cantilever")
    tip.add_argument(*options("load"), metavar="5nN", help="the largest force (default: 1.5πwR)")
    tip.add_argument(*options("range"), metavar="3Å", help="of the attraction (default: 3 Å, or what the spacing resolves)")
    tip.add_argument(*options("size"), metavar="100nm", help="the map's shorter edge; holds over what the file says")
    tip.add_argument(*options("unit"), metavar="nm", help="of the heights; holds over what the file says")
    tip.add_argument(*options("channel"), metavar="NAME", help="of a file with several maps: this one, by name or number")
    tip.add_argument(*options("sites"), type=_sites, metavar="N", help="along an edge of the box (default: 64 to 256, as needed)")
    tip.add_argument("--plan", action="store_true", help="say what would be run, how long it takes and what will not be stated; run nothing")
    _out(tip, "results/<map>-tip")
    _jobs(tip)
    _voice(tip)
    states = add("states", "the stable states of a contact under its load",
                 "A path at a held mean height goes inwards and back; the states are told with the pressures between them. The same "
                 "command goes on where it was stopped.")
    _scene(states, "results/<scene>-states")
    states.add_argument("--starts", type=_many, default=20, metavar="N",
                        help="states from so many layers laid on the substrate at random heights (default: 20)")
    _voice(states)
    stress = add("stress", "the stresses below the surface of a run, and the largest with an error",
                 "Of a quasi-static run over a wall: von Mises, Tresca and the largest tension in each layer with their places, a section, and "
                 "stress.vti for ParaView.")
    stress.add_argument("directory", metavar="DIR", help="the result directory")
    stress.add_argument("--state", metavar="NAME", help="the state (default: relaxed, or the last one)")
    stress.add_argument("--friction", type=_number, metavar="0.3",
                        help="coefficient of a friction in phase with the pressure (default: that of a slide)")
    stress.add_argument("--depth", metavar="5nm", help="largest depth of the section (default: three times that of the largest stress)")
    stress.add_argument("--volume", action="store_true", help="all points at all depths of the section too")
    _out(stress, "DIR/stress", "directory of the files")
    _voice(stress, progress=False)
    report = add("report", "a run or a sweep as one self-contained HTML page")
    report.add_argument("directory", metavar="DIR", help="the result directory")
    _out(report, "DIR", "directory of report.html and its figures")
    _voice(report, progress=False)
    export = add("export", "maps and trajectory of a run for OVITO, ParaView, or as PNG")
    export.add_argument("directory", metavar="DIR", help="the result directory")
    export.add_argument("--to", required=True, metavar="FORMAT", dest="format", help="xyz (OVITO, ASE), vtk (ParaView) or png")
    _out(export, "DIR/export", "directory of the files")
    _voice(export, progress=False)
    convert = add("convert", "a map of heights or a substrate's atoms as the HDF5 that a scene names",
                  "Maps: text with headers, ESRI grids, XYZ, and by SurfaceTopography Gwyddion and instruments' files. Atoms: LAMMPS "
                  "data, and by ASE extended XYZ.")
    convert.add_argument("source", metavar="FILE", help="the file to convert")
    convert.add_argument("target", nargs="?", metavar="OUT.h5", help="the file to write (default: FILE with .h5 for its ending)")
    convert.add_argument("-o", "--out", metavar="OUT.h5", help="the same as an option")
    convert.add_argument("--channel", metavar="NAME", help="of a file with several maps: this one, by name or number")
    _voice(convert, progress=False)
    scenes = add("scenes", "copy the scenes and examples that come with the program, and list them", "Nothing is replaced.")
    scenes.add_argument("target", nargs="?", metavar="FOLDER", help="where scenes/ and examples/ are made (default: here)")
    scenes.add_argument("-o", "--out", metavar="FOLDER", help="the same as an option")
    _voice(scenes, progress=False)
    prony = add("prony", "branches of a viscoelastic block from a master curve of a rubber",
                "Text of columns: frequency, storage and loss modulus (or tan δ), maybe a shift factor aT; names and units stand above. "
                "OUT.toml is what block.prony of a scene names; OUT.svg shows the fit.")
    prony.add_argument("source", metavar="FILE", help="the master curve")
    prony.add_argument("target", nargs="?", metavar="OUT.toml", help="the file to write (default: FILE with .toml for its ending)")
    prony.add_argument("-o", "--out", metavar="OUT.toml", help="the same as an option")
    prony.add_argument("--branches", type=_many, metavar="N", help="at most (default: one a decade of frequency)")
    prony.add_argument(*options("poisson"), type=_number, metavar="0.49", help="Poisson's ratio, which shear moduli need")
    prony.add_argument("--relaxed", default="", metavar="60MPa",
                       help="the relaxed Young's modulus, where the curve does not determine it")
    prony.add_argument("--frequency-unit", default="", metavar="UNIT", help="Hz or rad/s; holds over what the file says")
    prony.add_argument("--modulus-unit", default="", metavar="UNIT", help="for example MPa; holds over what the file says")
    prony.add_argument("--modulus", default="", metavar="KIND", help="E (Young's) or G (of shear); holds over what the file says")
    _voice(prony, progress=False)
    for parser in found.values():
        parser.add_argument("-h", "--help", action="help", help="print this help")
    return found
