# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Maps of heights as arrays: read from any file, and made into the pieces by which `estimate` measures what a map's edges
and its place on the sample change."""

from __future__ import annotations

from typing import NamedTuple

import numpy

from ..units import conversion, is_length
from .channels import factor, length, refuse
from .convert import read_heights

FEWEST = 16
"""Points along an edge below which a map says nothing of a surface."""
PERIODIC = 2.0
"""A map whose opposite edges differ by less than so many times what neighbours inside differ by is periodic."""


class HeightMap(NamedTuple):
    """heights: Å, [y, x], NaN where one is missing; size: of its edges x and y, Å; None: the file does not tell."""

    heights: numpy.ndarray
    size: tuple[float, float] | None
    notes: list[str]


def read_map(file: str, unit: str | None = None, size: float | None = None, channel: str | None = None,
             assumed: str | None = None) -> HeightMap:
    """Reads a map from any file. What the arguments say holds over what the file says, and a note names both if they differ. Raises
    InputOutputError."""
    found = read_heights(file, channel, unit)
    heights, notes = found["heights"], list(found.get("notes", []))
    own = found.get("unit")
    told = unit or own or assumed
    if told is None:
        raise refuse(file, "does not tell the unit of its heights", "", "name it: --unit nm")
    one = length(file, told, "heights")
    if unit and own is not None and conversion(own, "Å") != one:
        notes.append(f"the file says that its heights are in {own}, and {unit} is taken (--unit)")
    heights = heights * (one * factor(file, found.get("scale")))
    across = found.get("size_unit") or (own if is_length(own) else told)
    edges = tuple(float(s) for s in found.get("size") or ())
    if is_length(across) or not size:
        edges = tuple(s * length(file, across, "size", "say how wide it is: --size 100nm") for s in edges)
    elif edges:  # in a unit that is none
        edges = ()
    if not size and any(not 0.0 < s < numpy.inf for s in edges):
        raise refuse(file, "is a map without a size", "it says " + " x ".join(f"{s:g} Å" for s in edges),
                     "say how wide it is: --size 100nm")
    if size:
        pixel = size / min(heights.shape)
        if edges and abs(edges[0] / heights.shape[1] / pixel - 1.0) > 1e-3:
            notes.append(f"the file says that the map is {min(edges):.6g} Å wide, and {size:.6g} Å are taken (--size)")
        edges = (pixel * heights.shape[1], pixel * heights.shape[0])
    return HeightMap(heights, (edges[0], edges[1]) if edges else None, notes)


def square(heights: numpy.ndarray) -> numpy.ndarray:
    """Returns the middle of a map that is not square."""
    n = min(heights.shape)
    y, x = ((length - n) // 2 for length in heights.shape)
    return heights[y:y + n, x:x + n]


def without_plane(heights: numpy.ndarray) -> numpy.ndarray:
    """Subtracts the plane of least squares through the heights that exist."""
    y, x = numpy.indices(heights.shape).reshape(2, -1)
    terms = numpy.stack([numpy.ones(x.size), x, y], axis=1)
    there = numpy.isfinite(heights.ravel())
    plane = numpy.linalg.lstsq(terms[there], heights.ravel()[there], rcond=None)[0]
    return heights - (terms @ plane).reshape(heights.shape)


def without_tilt(heights: numpy.ndarray) -> numpy.ndarray:
    """Subtracts the plane that makes opposite edges meet on the mean, as those of a periodic map do, and the mean."""
    found = heights
    for axis in (0, 1):
        first, second, before, last = (numpy.take(found, k, axis) for k in (0, 1, -2, -1))
        # A point past each edge, continued straight, is the first one beyond the other.
        rise = 0.5 * numpy.nanmean(3 * last - before + second - 3 * first)
        tilt = rise / found.shape[axis] * numpy.arange(found.shape[axis])
        found = found - (tilt[:, None] if axis == 0 else tilt)
    return found - numpy.nanmean(found)


def filled(heights: numpy.ndarray) -> numpy.ndarray:
    """Fills missing points with the mean of their neighbours, from the edges of a hole inwards. Returns a copy."""
    found = numpy.array(heights, float)
    while (missing := numpy.isnan(found)).any() and not missing.all():
        around = numpy.stack([numpy.roll(found, step, axis) for axis in (0, 1) for step in (1, -1)])
        known = ~numpy.isnan(around)
        mean = numpy.where(known, around, 0.0).sum(axis=0) / numpy.maximum(known.sum(axis=0), 1)
        found = numpy.where(missing & known.any(axis=0), mean, found)
    return found


def jump(heights: numpy.ndarray) -> float:
    """Returns the rms difference of opposite edges over that of neighbours inside; of a periodic map about 1."""
    across = numpy.concatenate([heights[0] - heights[-1], heights[:, 0] - heights[:, -1]])
    inside = numpy.concatenate([numpy.diff(heights, axis=axis).ravel() for axis in (0, 1)])
    rms = numpy.sqrt(numpy.nanmean(inside**2))
    return float(numpy.sqrt(numpy.nanmean(across**2)) / rms) if rms > 0.0 else 1.0


def quarters(heights: numpy.ndarray) -> list[numpy.ndarray]:
    """Returns the quarters of a map; with an odd number of points they share the middle row and column."""
    half = (len(heights) + 1) // 2
    return [heights[y, x] for y in (slice(half), slice(-half, None)) for x in (slice(half), slice(-half, None))]


def mirrored(heights: numpy.ndarray) -> numpy.ndarray:
    """Returns the map with its mirror images: four times the area, periodic without a jump."""
    wide = numpy.concatenate([heights, heights[:, ::-1]], axis=1)
    return numpy.concatenate([wide, wide[::-1]], axis=0)
