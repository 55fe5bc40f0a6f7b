# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The ways out that a message offers, read from its fix: values of keys, and keys to leave out."""

from __future__ import annotations

import re

UNIT = r"(?:Å|nm|fs|ps|K|MPa|GPa|N/m|nN|m/s|1/ps|Å\^2|meV/Å\^2|GPa/Å)"
VALUE = rf'"[^"]*"|\[[^\]]*\]+|true|false|-?\d[\d.]*(?:e[-+]?\d+)?(?: {UNIT}(?![\w/^]))?'
SETTING = re.compile(rf"(?<![\w.])((?:[a-z]+\.)?[a-z]\w*) = ({VALUE})")
NUMBER = re.compile(rf"^(?:take|give|use) (?:a [a-z]+ of |about )?({VALUE})(?= at most| at least| or less| or more|$|,|:)")
NEXT_WAY = re.compile(r",? or (?=(?:take|leave|give|use|put|write|set|let|a|an|another|more|fewer|thinner|in|over)\b|(?:[a-z]+\.)?[a-z]\w* = )")
VAGUE = re.compile(r"\b(with an?|no file|larger|smaller|another|take it out|put an?|in its place|over a wall|before it)\b")
"""Words of a way that says more than its settings."""


def ways_of(key: str, fix: str, keys: dict[str, dict]) -> list[dict[str, str | None]]:
    """Returns the ways out that this fix of a problem with a key offers; None: the key is left out. A way that is not said by keys alone
    is not among them."""
    def named(name: str) -> str | None:
        if name in ("it", *keys):
            return key if name == "it" else name
        found = [one for one in keys if one.partition(".")[2] == name]
        same = [one for one in found if one.partition(".")[0] == key.partition(".")[0]]
        return (same or found or [None])[0]

    text = re.split(r"; |: (?!\[)", re.sub(r" \([^()]*\)", "", fix))[0].strip()
    parts = [text]
    if (out := re.search(r"\bleave ([\w., ]+?) out\b", text)) and " or " in out[1]:
        parts = [text.replace(out[0], f"leave {name} out") for name in re.split(r", | or ", out[1])]
    ways: list[dict[str, str | None]] = []
    for clause in (one for part in parts for one in NEXT_WAY.split(part)):
        way: dict[str | None, str | None] = {named(name): value.strip('"') if value[0] == '"' else value for name, value in SETTING.findall(clause)}
        for names in re.findall(r"\bleave ([\w., ]+?) out\b", clause):
            way |= {named(name): None for name in re.split(r", | and ", names)}
        if not way and (number := NUMBER.search(clause)):
            way[key] = number[1].strip('"')
        if way and None not in way and not VAGUE.search(clause) and way not in ways:
            ways.append(way)
    return ways
