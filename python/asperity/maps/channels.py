# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The maps that a file holds, and which of them is meant: what every reader of maps shares."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy

from ..errors import InputOutputError
from ..units import conversion, is_length

NO_HEIGHT = 1e30
"""Numbers this large stand for points without a height: 1.7e38 of Surfer, the largest float or double (SDF)."""
LISTED = 20
"""Channels that a message names."""
MOST_POINTS = 2**28
"""Numbers of an array: 16384 x 16384, 2 GB. A compressed file of a few MB can claim any number."""
HEIGHTS = frozenset(("height", "heights", "topography", "topo", "z", "elevation", "höhe", "topographie", "topografie", "hauteur", "altura"))
"""Words by which programs call the height."""
BESIDE = frozenset(("trace", "retrace", "forward", "backward", "fwd", "bwd", "left", "right", "up", "down", "measured", "sensor", "capacitive",
                    "axis", "scan", "raw", "channel", "image", "map", "data", "signal", "corrected", "filtered", "flattened", "levelled", "leveled",
                    "kanal", "vorwärts", "rückwärts", "nm", "um", "µm"))
"""Words that may stand beside them without meaning another quantity."""
OTHERS = frozenset(("deflection", "error", "amplitude", "phase", "current", "friction", "lateral", "adhesion", "potential", "voltage", "bias",
                    "force", "deformation", "indentation", "dissipation", "stiffness", "modulus", "frequency", "excitation", "drive",
                    "separation", "oscillation", "setpoint", "mask", "slope", "gradient", "capacitance", "conductance", "temperature",
                    "intensity", "confidence", "quality", "noise", "uncertainty", "deviation", "residual", "x", "y", "auslenkung",
                    "verbiegung", "fehler", "strom", "reibung", "kraft", "steigung", "déflexion", "erreur", "courant"))
"""Words that mean another quantity, which may be in metres."""


def _words(name: str) -> set[str]:
    """Returns the words of a name: "measuredHeight_trace" has three."""
    return {word.lower() for word in re.findall(r"[^\W\d_]?[^\W\d_A-ZÄÖÜ]+|[A-ZÄÖÜ]+(?![a-zäöü])", name)}


@dataclass
class Channel:
    """One map of a file.

    name : how --channel names it
    load : reads it; returns heights ([y, x], NaN or NO_HEIGHT where one is missing) and what the file tells of unit, scale,
        size (x, y), size_unit and notes
    unit : of the heights; None if the file does not tell
    """

    name: str
    load: Callable[[], dict[str, Any]]
    unit: str | None = None

    @property
    def is_height(self) -> bool:
        """True if the map is called the height, and its unit does not say otherwise."""
        words = _words(self.name.rpartition("/")[2])
        return bool(words & HEIGHTS) and words <= HEIGHTS | BESIDE and (self.unit is None or is_length(self.unit))

    @property
    def is_other(self) -> bool:
        """True if the map is called another quantity than the height."""
        return bool(_words(self.name) & OTHERS) and not self.is_height


def refuse(where: object, what: str, why: object = "", fix: str = "correct it, or write it again") -> InputOutputError:
    """Makes the error of a file that cannot be read."""
    return InputOutputError(str(where), what, str(why), fix)


def first_line(error: BaseException) -> str:
    """Returns the kind of an error of a library, and the first line of what it says, at most 200 characters."""
    said = str(error).strip().splitlines()
    return f"{type(error).__name__}: {said[0][:200]}" if said else type(error).__name__


def require_size(where: object, shape: tuple[int, ...]) -> None:
    """Checks that an array is not too large to be read, before it is. Raises InputOutputError."""
    if (count := math.prod(shape)) > MOST_POINTS:
        raise refuse(where, "is too large", f"its shape {' x '.join(map(str, shape))} is {count} numbers, and {MOST_POINTS} are the limit",
                     "cut out the part that is needed")


def text_of(value: object) -> str | None:
    """Returns an attribute as text; None if there is none."""
    if value is None:
        return None
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def length(where: object, unit: object, what: str, fix: str = "name the unit: --unit nm") -> float:
    """Returns a unit of length in Å. Raises InputOutputError."""
    said = text_of(unit)
    if (found := conversion(said, "Å")) is None:
        raise refuse(where, f"the unit of its {what}, {said}, is none of length", "known: m with a prefix (nm, µm, um, mm), Å, A", fix)
    return found


def factor(where: object, scale: object) -> float:
    """Returns how many units a number of the map stands for. Raises InputOutputError."""
    value = 1.0 if scale is None else float(numpy.asarray(scale).reshape(()))
    if not 0.0 < value < numpy.inf:
        raise refuse(where, f"its attribute scale = {value:g} is no factor", "a number of the map stands for so many units",
                     "correct the attribute, or remove it")
    return value


def frames(name: str, heights: Any, told: dict[str, Any]) -> list[Channel]:
    """Returns the maps of an array."""
    unit = text_of(told.get("unit"))

    def frame(k: int | None) -> dict[str, Any]:
        require_size(name, heights.shape[-2:])
        return {"heights": heights[()] if k is None else heights[k], **told}

    if len(heights.shape) == 2:
        return [Channel(name, partial(frame, None), unit)]

    return [Channel(f"{name}[{k + 1}]", partial(frame, k), unit) for k in range(heights.shape[0])]


def select(path: Path, channels: list[Channel], wanted: str | None, first: int | None = None, unit: str | None = None) -> dict:
    """Reads one map of a file: the one wanted, else `first`, else the first that is called the height, else the only one in a unit of length. A map
    that is called another quantity, deflection for example, is read only if it is wanted. Raises InputOutputError."""
    names = [c.name + ("" if c.unit is None or is_length(c.unit) else f" (in {c.unit})") for c in channels]
    listed = ", ".join(f"{k} {name}" for k, name in enumerate(names[:LISTED], 1))
    listed = "its channels: " + listed + (f" and {len(names) - LISTED} more" if len(names) > LISTED else "")
    if not channels:
        raise refuse(path, "holds no map", "no array of numbers in it has two dimensions", "export the heights")
    called = [re.sub(r"\[\d+\]$", "", c.name) for c in channels]  # frames of one array have one name
    heights = [k for k, c in enumerate(channels) if c.is_height and called.count(called[k]) == 1]
    others = [k for k, c in enumerate(channels) if not c.is_other]
    lengths = [k for k in others if is_length(channels[k].unit)]
    alone = lengths if len(lengths) == 1 else others if len(channels) == 1 else []
    number = next((k for k in (first, *heights, *alone) if k is not None and not channels[k].is_other), None)
    if wanted is not None:
        plain = [c.name for c in channels]
        number = (plain.index(wanted.lstrip("/")) if wanted.lstrip("/") in plain else
                  int(wanted) - 1 if wanted.isdecimal() else -1)
        if not 0 <= number < len(channels):
            raise refuse(path, f"has no channel '{wanted}'", "it holds one map" if len(channels) == 1 else listed,
                         "leave --channel out" if len(channels) == 1 else
                         f"name one of them, or its number: --channel {min(2, len(channels))}")
    if number is None and len(channels) == 1:
        raise refuse(path, "holds one map, which is not called the height", f"it is called {names[0]}",
                     "take it all the same: --channel 1")
    if number is None:
        raise refuse(path, f"holds {len(channels)} maps", listed, f"name one, or its number: --channel {min(lengths or others or [0]) + 1}")
    taken = channels[number]
    if unit is None and taken.unit is not None and not is_length(taken.unit):
        raise refuse(path, f"holds no heights in channel {number + 1} ({taken.name})", f"it is in {taken.unit}, which is no length; {listed}",
                     "take another channel, or export the heights")
    found = taken.load()
    notes = list(found.get("notes", []))
    if len(channels) > 1:
        left = [f"{k} {name}" for k, name in enumerate(names, 1) if k != number + 1]
        more = f" and {len(left) - LISTED} more" if len(left) > LISTED else ""
        notes.insert(0, f"channel {number + 1} ({taken.name}) was taken; --channel takes another: " + ", ".join(left[:LISTED]) + more)
    return {**found, "notes": notes}
