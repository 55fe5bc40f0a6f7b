# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Errors.

Each error has the exit code of the command that it ends, as in the program, and a message of one grammar:

    <where>: what is wrong
        why: the reason, with the values
        fix: what to do about it
"""

from __future__ import annotations

import difflib
import re
import sys
import sysconfig
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Self

NEEDED = ("numpy", "scipy", "h5py", "matplotlib", "jinja2")
"""Packages of PyPI that this package imports."""


def to_install(*packages: str) -> str:
    """Returns the commands that install packages of PyPI for this Python. Debian's own Python takes none by pip."""
    if not (Path(sysconfig.get_path("stdlib")) / "EXTERNALLY-MANAGED").exists() or sys.prefix != sys.base_prefix:
        return f"{sys.executable} -m pip install {' '.join(packages)}"
    debian = {name: "python3-" + name for name in (*NEEDED, "ase", "pandas", "xarray")}
    if all(name in debian for name in packages):
        return "apt-get install " + " ".join(debian[name] for name in packages)
    place = "~/asperity-python"
    return (f"{sys.executable} -m venv {place}; {place}/bin/pip install {' '.join((*NEEDED, *packages))}; "
            f"export ASPERITY_PYTHON={place}/bin/python3")


def printable(text: str) -> str:
    """Returns a text without characters that control a terminal, as io/terminal.cpp does: names of scenes and files are anyone's. A newline
    stays; another such character is written as "\\x1b"."""
    return re.sub(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\ud800-\udfff]", lambda found: f"\\x{ord(found[0]) & 0xff:02x}", text)


def _text_of(where: str, what: str = "", why: str = "", fix: str = "") -> str:
    """Returns the message of a problem."""
    text = f"{where}: {what}" if where and what else where or what
    for head, line in (("why", why), ("fix", fix)):
        if line:
            text += f"\n    {head}: " + line.replace("\n", "\n         ")
    return printable(text)


class Error(Exception):
    """Base class: `code` is the exit code, `problems` the number of mistakes, `listed` each of them as a dictionary with the
    members where, what, why and fix."""

    code = 1

    def __init__(self, where: str, what: str = "", why: str = "", fix: str = ""):
        super().__init__(_text_of(where, what, why, fix))
        self.listed = [{"where": where, "what": what, "why": why, "fix": fix}]

    @property
    def problems(self) -> int:
        """Number of mistakes."""
        return len(self.listed)

    @classmethod
    def of(cls, problems: list[dict[str, str]]) -> Self:
        """Returns one error with all problems that the program listed."""
        error = cls("")
        error.listed = problems
        error.args = ("\n".join(_text_of(**problem) for problem in problems),)
        return error

    def rewrite(self, change: Callable[[str], str]) -> None:
        """Replaces the texts of all problems, and with them the message."""
        self.listed = [{name: change(text) for name, text in problem.items()} for problem in self.listed]
        self.args = ("\n".join(_text_of(**problem) for problem in self.listed),)


class SceneError(Error):
    """Error in the scene, in the command line or in an input that the scene names (exit 2)."""

    code = 2


class UnknownName(SceneError, AttributeError, KeyError):
    """Error of a name that does not exist: of a number, map, state, column or plot. It is an AttributeError and a KeyError too, as
    Python expects of attributes and mappings."""

    __str__ = Exception.__str__  # that of KeyError would put it in quotation marks

    @classmethod
    def among(cls, where: str, name: object, names: Iterable[str], why: str = "", what: str = "") -> Self:
        """Returns the error of a name that is none of some."""
        there = list(names)
        near = difflib.get_close_matches(str(name), there, 1)
        fix = f"did you mean {near[0]}?" if near else "take one of these" * bool(there)
        return cls(where, f"has no {what} {name!r}".replace("  ", " "), ("it has " + ", ".join(there)) if there else why, fix)


class WrongCall(SceneError, TypeError):
    """Error of a call with an argument that the function does not have, or without one that it needs. It is a TypeError too, as
    Python expects of calls."""


def meant(path: str | Path) -> str:
    """Returns the fix for a file or directory that is not there: "did you mean results/first-contact?"; "" if none is spelt alike."""
    path = Path(path)
    names = {one.name: one for one in path.parent.iterdir()} if path.parent.is_dir() else {}
    near = [name for name in names if name.partition(".")[0] == path.name] or difflib.get_close_matches(path.name, names, 1, 0.7)
    return f"did you mean {path.parent / near[0]}?" if near else ""


class WrongValue(SceneError, ValueError):
    """Error of an argument whose value has no meaning. It is a ValueError too, as Python expects of values."""


class Named:
    """Base class of results whose wrong attributes raise UnknownName with the existing names."""

    if not TYPE_CHECKING:  # type checkers know the names
        def __getattr__(self, name: str):
            if name.startswith("_"):
                raise AttributeError(name)
            there = [one for one in dir(self) if not one.startswith("_")]
            raise UnknownName.among(type(self).__name__, name, there)


class SceneWarning(UserWarning):
    """Warning about a scene that is worth knowing and no mistake."""


class PhysicsError(Error):
    """Error of the physics: a guard stopped the run (exit 3)."""

    code = 3


class InputOutputError(Error):
    """Error of a file that could not be read or written (exit 4)."""

    code = 4


class Stopped(Error):
    """End of a run that stopped early and left a valid checkpoint (exit 75)."""

    code = 75


class InternalError(Error):
    """Error of the program itself: it ended in an unexpected way (exit 1 or a signal)."""


BY_CODE = {cls.code: cls for cls in (SceneError, PhysicsError, InputOutputError, Stopped)}
