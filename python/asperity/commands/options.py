# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A command of the package is one object. The fields of a dataclass are its options; its parser, help, page of the reference and
completion, and the checks of the arguments of its function in Python follow from them.

    @dataclass(kw_only=True)
    class Options(OfScene):
        out: str | None = out("results/<scene>-states")
        starts: int = option("N", "states from so many layers ... (default: 20)", 20, limits=COUNT)

    COMMAND = Command(Options, _carry_out, more="A path at a held mean height goes inwards and back ...")

The command's name is that of its module, and its purpose stands in table.txt. Modules of commands import what needs numpy inside
their functions, so that --help needs none.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, field, fields
from numbers import Integral
from pathlib import Path
from types import NoneType
from typing import Any, NamedTuple, Self, get_args, get_origin, get_type_hints

from ..arguments import ALIASES, chosen, options
from ..errors import SceneError
from ..terminal import Voice
from ..units import is_unit
from .command_line import Parser


class Limits(NamedTuple):
    """Limits of a whole number, inclusive, and a noun for what it counts."""

    what: str
    least: int
    most: int


COUNT, SITES = Limits("number", 1, 1024), Limits("number of sites", 16, 32768)


class About(NamedTuple):
    """Spelling of an option, its help, and the values that it takes."""

    value: str
    help: str
    name: str = ""
    short: str = ""
    word: bool = False
    commas: bool = False
    limits: Limits | None = None
    choices: tuple[str, ...] | None = None
    own: bool = False
    """The option stands for no key of the scene that the command makes."""
    terminal: bool = False
    """The function of Python has no such argument."""


def option(value: str, help: str, default: Any = MISSING, **more: Any) -> Any:
    """Returns the field of an option."""
    about = {"about": About(value, help, **more)}
    return field(default_factory=list, metadata=about) if default == [] else field(default=default, metadata=about)


def word(value: str, help: str, default: Any = MISSING, **more: Any) -> Any:
    """Returns the field of what stands without an option."""
    return option(value, help, default, word=True, **more)


def out(otherwise: str, what: str = "result directory", **more: Any) -> Any:
    """Returns the field of --out. otherwise: the default, in words; what: what is named."""
    return option("DIR", f"{what} (default: {otherwise})", None, short="-o", own=True, **more)


def jobs(what: str = "runs side by side; they share the processors (default: 1)") -> Any:
    """Returns the field of --jobs."""
    return option("N", what, 1, short="-j", limits=COUNT, own=True)


def plan() -> Any:
    """Returns the field of --plan."""
    return option("", "say what would be run, how long it takes and what it will not state; run nothing", False, own=True, terminal=True)


def executor() -> Any:
    """Returns the field of --executor."""
    return option("WHERE", "run them on workers instead: mpi (the ranks of `mpirun -n 3 asperity ... --executor mpi`, the first of which "
                  "leads) or dask:tcp://HOST:PORT; one thread each, unless OMP_NUM_THREADS says more there", "", terminal=True)


def _kind(hint: Any) -> Any:
    """Returns the type of a field: None stands for an option that is not given."""
    return next((one for one in get_args(hint) if one is not NoneType), hint) if NoneType in get_args(hint) else hint


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no number") from None


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def _whole(limits: Limits) -> Callable[[str], int]:
    def read(text: str) -> int:
        if not text.strip().isdecimal() or not limits.least <= int(text) <= limits.most:
            raise argparse.ArgumentTypeError(f"{text} is no {limits.what} from {limits.least} to {limits.most}")
        return int(text)

    return read


@dataclass(kw_only=True)
class Options:
    """Options of a command."""

    @classmethod
    def about(cls) -> dict[str, tuple[About, Any, bool]]:
        """Returns how each option is spelt, its type, and whether it must be given."""
        hints = get_type_hints(cls)
        return {one.name: (one.metadata["about"], _kind(hints[one.name]), one.default is MISSING and one.default_factory is MISSING)
                for one in fields(cls)}

    @classmethod
    def parser(cls, command: str, purpose: str, more: str) -> Parser:
        """Returns the parser of a command with these options."""
        parser = Parser(prog=f"asperity {command}", description=purpose[0].upper() + purpose[1:] + ".", epilog=more, add_help=False)
        defaults = {one.name: [] if one.default_factory is list else one.default for one in fields(cls)}
        for name, (about, kind, needed) in cls.about().items():
            takes: dict[str, Any] = {"help": about.help.replace("%", "%%") if about.help is not argparse.SUPPRESS else about.help}
            if not needed:
                takes["default"] = defaults[name]
            if kind is bool:
                takes["action"] = "store_true"
            else:
                takes["metavar"] = about.value
                read = _names if about.commas else _number if kind is float else _whole(about.limits) if about.limits else None
                takes |= {"type": read} if read else {"choices": about.choices} if about.choices else {}
            many = get_origin(kind) is list and not about.commas
            if about.word:
                parser.add_argument(name, **takes, **({"nargs": "*"} if many else {} if needed else {"nargs": "?"}))
                continue
            names = [about.short] * bool(about.short) + options(about.name or name)
            parser.add_argument(*names, dest=name, **takes, **({"action": "append"} if many else {}), **({"required": True} if needed else {}))
        return parser

    @classmethod
    def of_call(cls, given: Mapping[str, Any]) -> Self:
        """Returns the options of a call from Python, checked. Raises SceneError."""
        found = {}
        for name, (about, kind, needed) in cls.about().items():
            names = [one for one in (name, *ALIASES.get(name, ())) if one in given]
            example = f"{name}={about.value}" if kind is float else f'{name}="{about.value}"'
            value = chosen(name, example if needed else "", **{one: given[one] for one in names})
            if value is None:
                continue
            if limits := about.limits:
                if isinstance(value, bool) or not isinstance(value, Integral) or not limits.least <= int(value) <= limits.most:
                    raise SceneError(f"{name} = {value!r}", f"is no {limits.what} from {limits.least} to {limits.most}", "",
                                     "leave it out for the default")
            elif about.choices and value not in about.choices:
                raise SceneError(f"{name} = {value!r:.60}", "is no choice", "they are " + ", ".join(about.choices), "name one of them")
            found[name] = os.fspath(value) if isinstance(value, os.PathLike) else value
        return cls(**found)

    @property
    def command(self) -> str:
        """Name of the command."""
        return type(self).__module__.rpartition(".")[2]


def _is_override(text: str) -> bool:
    """Returns True for an override: `--set a.b=1 c.d=2 scene.toml` means what it looks like."""
    before, equals, _ = text.partition("=")
    return bool(equals) and "." in before and "/" not in before and not os.path.exists(text)


def spelt_out(words: list[str]) -> list[str]:
    """Spells `--set a.b=1 c.d=2` as `--set a.b=1 --set c.d=2`, so that the last value of a key counts."""
    found: list[str] = []
    for one in words:
        if _is_override(one) and len(found) > 1 and found[-2] == "--set":
            found.append("--set")
        found.append(one)
    return found


SCENE = "the scene file (TOML); - is the standard input"


@dataclass(kw_only=True)
class OfScene(Options):
    """Options of a command that takes a scene, or several."""

    words: list[str] = word("SCENE", SCENE, [])
    sets: list[str] = option("key=value", "override a key of the scene: section.key=value; repeatable", [], name="set")

    def __post_init__(self) -> None:
        self.sets = self.sets + [one for one in self.words if _is_override(one)]
        self.words = [one for one in self.words if not _is_override(one)]

    def scenes(self) -> list[str]:
        """Returns the scenes. Raises SceneError if there is none."""
        if not self.words:
            raise SceneError("command line", "no scene is given", "the command needs one",
                             f"for example: asperity {self.command} scenes/first-contact.toml")
        return self.words

    def scene(self) -> str:
        """Returns the scene. Raises SceneError if there is none, or more than one."""
        first, *more = self.scenes()
        if more and not os.path.exists(more[0]) and is_unit(more[0]):
            raise SceneError("command line", f"'{more[0]}' stands alone", "a blank ends a word of the command line",
                             "write the unit behind the number: 3nm")
        if more:
            raise SceneError("command line", "more than one scene is given", f"{first} and {more[0]}",
                             f"for example: asperity {self.command} scenes/first-contact.toml")
        return first


class WithTarget(Options):
    """Options of a command that writes what its last word or --out names. Classes declare both fields, target and out."""

    target: str | None
    out: str | None

    def place(self, what: str = "files") -> str | None:
        """Returns what is written to; None: neither is given. Raises SceneError if both are. what: files or folders."""
        if self.target and self.out:
            raise SceneError("command line", f"two {what} to write are given, {self.target} and {self.out}", "", "leave one out")
        return self.target or self.out


def same_as_option(value: str) -> Any:
    """Returns the field of --out of a command whose last word names the same."""
    return option(value, "the same as an option", None, short="-o")


TABLE = Path(__file__).with_name("table.txt")


def purposes() -> dict[str, str]:
    """Returns the purpose of each command of the package by its name, in the order of --help."""
    rows = [[cell.strip() for cell in line.split("|")] for line in TABLE.read_text("utf-8").splitlines() if line[:1] not in ("", "#")]
    return {name: purpose for name, by, _, purpose in rows if by == "package"}


@dataclass
class Command:
    """A command: its options, the function that carries it out and returns the exit code, and what its help says beside its purpose.
    progress: it has --progress; writes: what --json does beside printing."""

    options: type[Options]
    act: Callable[[Any, Voice], int]
    more: str = ""
    progress: bool = True
    writes: str = ""

    @property
    def name(self) -> str:
        """Name of the command."""
        return self.options.__module__.rpartition(".")[2]

    def parser(self) -> Parser:
        """Returns the parser, with the options of all commands at the end."""
        parser = self.options.parser(self.name, purposes()[self.name], self.more)
        if self.progress:
            parser.add_argument("--progress", metavar="MODE", help="auto, bar, lines or off (default: auto)")
        parser.add_argument("-q", "--quiet", action="store_true", help="print results and errors only")
        parser.add_argument("--json", action="store_true", help=f"print the result as one line of JSON, for programs{self.writes}")
        parser.add_argument("-h", "--help", action="help", help="print this help")
        return parser

    def given(self, words: list[str]) -> tuple[Options, Voice]:
        """Returns the options and the voice of a call. Raises SceneError; SystemExit after --help."""
        parser = self.parser()
        parser.refuse_unknown(words)
        if {"-h", "--help"} & {*words}:  # argparse leaves out what stands without an option while it reads options
            parser.print_help()
            parser.exit()
        found = vars(parser.parse_intermixed_args(spelt_out(words)))  # options and scenes in any order
        voice = Voice(found.pop("quiet"), found.pop("json"), found.pop("progress", None))
        return self.options(**found), voice


def command(name: str) -> Command:
    """Returns a command of the package by its name."""
    from importlib import import_module

    return import_module(f".{name}", __package__).COMMAND
