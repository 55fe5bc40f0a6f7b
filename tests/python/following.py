# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Following the fixes of messages: what was said by a bad input is kept once the fix has led to a good one."""

from __future__ import annotations

import os
import re
import subprocess

from catalogue import Message, catalogue
from conftest import OF_PYTHON, in_this_process, unfolded

heard: list[str] = []
"""Messages whose fix was followed to its good end, each from its first line to its fix."""


def messages_in(text: str) -> list[str]:
    """Returns the messages of a text: each starts at a line that is not indented, and has a fix below."""
    return re.findall(r"^\S.*(?:\n +.*)*", text, re.M)


def followed(text: str) -> None:
    """Notes that the fixes of the messages in this text were followed."""
    heard.extend(messages_in(text))


def ask(*words: object, given: str = "", env: dict[str, str] | None = None) -> tuple[int, str]:
    """Runs the program; its exit code, and what it prints. A command of the package runs in this process."""
    if words[0] in OF_PYTHON and env is None:
        code, *streams = in_this_process(words, given)
        return code, unfolded("".join(streams))
    done = subprocess.run([os.environ["ASPERITY_PROGRAM"], *map(str, words)], input=given, text=True, capture_output=True,
                          timeout=60, env={**os.environ, **(env or {})})
    return done.returncode, unfolded(done.stdout + done.stderr)


def not_followed(places: tuple[str, ...], excused: dict[str, str], others: bool = False) -> list[str]:
    """Returns the messages of these sources (of all others) whose fix nobody followed and nothing excuses.

    Parameters
    ----------
    places : tuple of str
        Parts of the sources' paths.
    excused : dict of str
        Part of a message in the catalogue ("..." stands for anything), and why no user can follow it here.
    """
    def is_part(part: str, message: object) -> bool:
        return re.search(".*".join(map(re.escape, part.split("..."))), str(message)) is not None

    mine = [m for m in catalogue() if any(place in m.place for place in places) != others]
    unused = [part for part in excused if not any(is_part(part, m) for m in mine)]
    assert not unused, f"excuses for messages that do not exist: {unused}"
    return [str(m) for m in mine if not any(is_part(part, m) for part in excused) and not any(map(m.is_said, heard))]


__all__ = ["Message", "ask", "followed", "heard", "messages_in", "not_followed"]
