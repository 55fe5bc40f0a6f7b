# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""asperity scenes: the scenes and examples that come with the package."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputOutputError
from ..terminal import Voice
from .options import Command, WithTarget, same_as_option, word

KINDS = ("scenes", "examples")


def folder() -> Path:
    """Returns the folder that holds scenes/ of this package: of a wheel, of an installation, or of the source tree.

    Raises InputOutputError if there is none.
    """
    package = Path(__file__).resolve().parents[1]
    for place in (package / "share", package.parents[1]):
        if (place / "scenes" / "first-contact.toml").is_file():
            return place
    raise InputOutputError("asperity scenes", "the scenes were not found", "this installation has none beside its package",
                           "install Asperity again, or take scenes/ of its source tree")


def title(scene: Path) -> str:
    """Returns the first sentence of the comment at the head of a scene, or of a script."""
    lines = [line[1:].strip() for line in scene.read_text().split("\n\n")[0].splitlines() if line.startswith("#")]
    text = "\n".join(line for line in lines if not line.startswith(("SPDX", "!"))).strip().partition("\n\n")[0].replace("\n", " ")
    ends = (end.start() for end in re.finditer(r"(?<!Fig)\.\s", text) if text.count("(", 0, end.start()) == text.count(")", 0, end.start()))
    return text[:next(ends, len(text))].strip().rstrip(".:")


@dataclass(kw_only=True)
class Options(WithTarget):
    """Options of `asperity scenes`."""

    target: str | None = word("FOLDER", "where scenes/ and examples/ are made (default: here)", None)
    out: str | None = same_as_option("FOLDER")


def _carry_out(given: Options, voice: Voice) -> int:
    """Copies the scenes and examples into a folder and prints a list of the scenes. Returns the exit code. Raises InputOutputError if
    the folder has a scenes/ or examples/ already."""
    source, target = folder(), Path(given.place("folders") or ".")
    for kind in KINDS:
        if (target / kind).exists():
            raise InputOutputError("asperity scenes", f"{target / kind} is there already", "nothing is replaced",
                                   "name another folder: asperity scenes FOLDER")
    for kind in KINDS:
        if (source / kind).is_dir():
            shutil.copytree(source / kind, target / kind, ignore=shutil.ignore_patterns("results", "__pycache__"))
    titles = {str(scene): title(scene) for scene in sorted((target / "scenes").rglob("*.toml"))}
    voice.show("\n".join(f"{scene}\n    {text}" for scene, text in titles.items()))
    voice.tell({"scenes": titles})
    return 0


COMMAND = Command(Options, _carry_out, more="Nothing is replaced.", progress=False)
