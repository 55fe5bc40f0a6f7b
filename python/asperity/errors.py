# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Errors.

Each has the exit code of the command it ends, as in the program, and a message of one grammar:

    <where>: what is wrong
        why: the reason, with the values
        fix: what to do about it
"""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path

NEEDED = ("numpy", "scipy", "h5py", "matplotlib", "jinja2")
"""Packages of PyPI that this one imports."""


def to_install(*packages: str) -> str:
    """The commands that install packages of PyPI for this Python. Debian's own takes none by pip."""
    if not (Path(sysconfig.get_path("stdlib")) / "EXTERNALLY-MANAGED").exists() or sys.prefix != sys.base_prefix:
        return f"{sys.executable} -m pip install {' '.join(packages)}"
    debian = {name: "python3-" + name for name in (*NEEDED, "ase")}
    if all(name in debian for name in packages):
        return "apt-get install " + " ".join(debian[name] for name in packages)
    place = "~/asperity-python"
    return (f"{sys.executable} -m venv {place}; {place}/bin/pip install {' '.join((*NEEDED, *packages))}; "
            f"export ASPERITY_PYTHON={place}/bin/python3")


class Error(Exception):
    """Base class; `code` is the exit code, `problems` the number of things that are wrong."""

    code = 1

    def __init__(self, where: str, what: str = "", why: str = "", fix: str = ""):
        text = f"{where}: {what}" if where and what else where or what
        for head, line in (("why", why), ("fix", fix)):
            if line:
                text += f"\n    {head}: " + line.replace("\n", "\n         ")
        super().__init__(text)
        self.problems = 1


class SceneError(Error):
    """The scene, the command line or an input that the scene names is wrong (exit 2)."""

    code = 2

    @classmethod
    def of(cls, problems: list[dict]) -> SceneError:
        """All problems that the program listed: where, what, why, fix."""
        error = cls("\n".join(str(cls(**p)) for p in problems))
        error.problems = len(problems)
        return error


class SceneWarning(UserWarning):
    """Worth knowing of a scene, not wrong."""


class PhysicsError(Error):
    """A guard of the physics stopped the run (exit 3)."""

    code = 3


class InputOutputError(Error):
    """A file could not be read or written (exit 4)."""

    code = 4


class Stopped(Error):
    """The run stopped early and left a valid checkpoint (exit 75)."""

    code = 75


class InternalError(Error):
    """The program ended in a way that it should not (exit 1 or a signal)."""


BY_CODE = {cls.code: cls for cls in (SceneError, PhysicsError, InputOutputError, Stopped)}
