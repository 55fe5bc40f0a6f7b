# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The maps that a file holds, and which of them is meant: what every reader of maps shares."""

from __future__ import annotations

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


def refuse(where: object, what: str, why: object = "", fix: str = "correct it, or write it again") -> InputOutputError:
    """Makes the error of a file that cannot be read.

    Parameters
    ----------
    where : object
        File, and the place in it.
    what : str
        Sentence on what is wrong.
    why : object
        Reason.
    fix : str
        Remedy.

    Returns
    -------
    InputOutputError
        The error, to be raised.
    """
    return InputOutputError(str(where), what, str(why), fix)


def text_of(value: object) -> str | None:
    """Returns an attribute as text; None if there is none."""
    if value is None:
        return None
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def length(where: object, unit: object, what: str, fix: str = "name the unit: --unit nm") -> float:
    """Returns a unit of length in Å.

    Parameters
    ----------
    where : object
        File, for the message.
    unit : object
        Unit as the file has it.
    what : str
        Subject of the message: what has the unit.
    fix : str
        Remedy.

    Returns
    -------
    float
        The length of the unit, Å.

    Raises
    ------
    InputOutputError
        The unit is no unit of length.
    """
    said = text_of(unit)
    if (found := conversion(said, "Å")) is None:
        raise refuse(where, f"the unit of its {what}, {said}, is none of length", "known: m with a prefix (nm, µm, um, mm), Å, A", fix)
    return found


def factor(where: object, scale: object) -> float:
    """Returns how many units a number of the map stands for.

    Parameters
    ----------
    where : object
        File, for the message.
    scale : object
        Scale as the file has it.

    Returns
    -------
    float
        The scale, above zero.

    Raises
    ------
    InputOutputError
        The factor is no number above zero.
    """
    value = 1.0 if scale is None else float(numpy.asarray(scale).reshape(()))
    if not 0.0 < value < numpy.inf:
        raise refuse(where, f"its attribute scale = {value:g} is no factor", "a number of the map stands for so many units",
                     "correct the attribute, or remove it")
    return value


def frames(name: str, heights: Any, told: dict[str, Any]) -> list[Channel]:
    """Returns the maps of an array.

    Parameters
    ----------
    name : str
        Name of the array.
    heights : Any
        Array of two dimensions, or of three, of which the first one counts the frames.
    told : dict[str, Any]
        Common metadata of the channels: unit, size, notes.

    Returns
    -------
    list[Channel]
        The maps.
    """
    unit = text_of(told.get("unit"))
    if len(heights.shape) == 2:
        return [Channel(name, lambda: {"heights": heights[()], **told}, unit)]
    def frame(k: int) -> dict[str, Any]:
        return {"heights": heights[k], **told}

    return [Channel(f"{name}[{k + 1}]", partial(frame, k), unit) for k in range(heights.shape[0])]


def select(path: Path, channels: list[Channel], wanted: str | None, first: int | None = None, unit: str | None = None) -> dict:
    """Reads one map of a file: the one wanted, else `first`, else the only one in a unit of length.

    Parameters
    ----------
    path : Path
        File, for the messages.
    channels : list[Channel]
        Maps of the file.
    wanted : str | None
        Name of the map, or its number from 1; None: nobody asks for one.
    first : int, optional
        Index of the file's own choice.
    unit : str, optional
        Unit that the user names.

    Returns
    -------
    dict
        The map, in the form of read_heights().

    Raises
    ------
    InputOutputError
        The name matches no channel or several; the error lists all channels.
    """
    names = [c.name + ("" if c.unit is None or is_length(c.unit) else f" (in {c.unit})") for c in channels]
    listed = ", ".join(f"{k} {name}" for k, name in enumerate(names[:LISTED], 1))
    listed = "its channels: " + listed + (f" and {len(names) - LISTED} more" if len(names) > LISTED else "")
    if not channels:
        raise refuse(path, "holds no map", "no array of numbers in it has two dimensions", "export the heights")
    number = first if first is not None else 0 if len(channels) == 1 else None
    if wanted is not None:
        plain = [c.name for c in channels]
        number = (plain.index(wanted.lstrip("/")) if wanted.lstrip("/") in plain else
                  int(wanted) - 1 if wanted.isdecimal() else -1)
        if not 0 <= number < len(channels):
            raise refuse(path, f"has no channel '{wanted}'", "it holds one map" if len(channels) == 1 else listed,
                         "leave --channel out" if len(channels) == 1 else
                         f"name one of them, or its number: --channel {min(2, len(channels))}")
    if number is None:
        heights = [k for k, c in enumerate(channels) if is_length(c.unit)]
        if len(heights) != 1:
            raise refuse(path, f"holds {len(channels)} maps", listed, f"name one, or its number: --channel {min(heights or [0]) + 1}")
        number = heights[0]
    taken = channels[number]
    if unit is None and taken.unit is not None and not is_length(taken.unit):
        raise refuse(path, f"holds no heights in channel {number + 1} ({taken.name})", f"it is in {taken.unit}, which is no length; {listed}",
                     "take another channel, or export the heights")
    found = taken.load()
    notes = list(found.get("notes", []))
    if len(channels) > 1:
        others = [f"{k} {name}" for k, name in enumerate(names, 1) if k != number + 1]
        more = f" and {len(others) - LISTED} more" if len(others) > LISTED else ""
        notes.insert(0, f"channel {number + 1} ({taken.name}) was taken; --channel takes another: " + ", ".join(others[:LISTED]) + more)
    return {**found, "notes": notes}
