# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Maps of heights as arrays: read from any file, and made into the pieces by which `estimate` measures what a map's edges
and its place on the sample change."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import h5py
import numpy

from .convert import LENGTHS, read_heights
from .errors import Error, InputOutputError

FEWEST = 16
"""Points along an edge below which a map says nothing of a surface."""
PERIODIC = 2.0
"""A map whose opposite edges differ by less than so many times what neighbours inside differ by is periodic."""


class HeightMap(NamedTuple):
    """heights: Å, [y, x], NaN where one is missing; size: of its edges x and y, Å; None: the file does not tell."""

    heights: numpy.ndarray
    size: tuple[float, float] | None
    notes: list[str]


def _refuse(where: object, what: str, why: str, fix: str) -> InputOutputError:
    return InputOutputError(str(where), what, why, fix)


def _length(where: object, unit: object, what: str) -> float:
    """Å of a unit of length."""
    unit = unit.decode() if isinstance(unit, bytes) else str(unit)
    if unit not in LENGTHS:
        raise _refuse(where, f"the unit of its {what}, {unit}, is none of length", "known: " + ", ".join(LENGTHS),
                      "name the unit: --unit nm")
    return 10.0 ** LENGTHS[unit]


def _hdf5(file: str) -> dict:
    """The data set NAME of "file.h5:/NAME", or /heights, or the only one of two dimensions."""
    path, _, name = file.partition(":/")
    with h5py.File(path, "r") as opened:
        flat: list[str] = []
        opened.visititems(lambda at, found: flat.append(at) if getattr(found, "ndim", 0) == 2 else None)
        name = name or ("heights" if "heights" in flat else flat[0] if len(flat) == 1 else "")
        if name not in flat:
            raise _refuse(file, "holds no map", f"no data set of two dimensions is {name or 'the only one'}: "
                          + (", ".join(flat) or "there is none"), "name one: map.h5:/NAME")
        told = opened[name].attrs
        return {"heights": opened[name][()], "unit": told.get("unit", told.get("units")), "scale": told.get("scale"),
                "size": tuple(told[k] for k in ("size_x", "size_y") if k in told), "size_unit": told.get("size_unit")}


def read_map(file: str, unit: str | None = None, size: float | None = None, channel: str | None = None) -> HeightMap:
    """unit: of heights where the file does not tell; size: of the edge along x where it does not, Å. Raises
    InputOutputError."""
    path = Path(file.partition(":/")[0])
    try:
        head = path.read_bytes()[:8]
        found = (_hdf5(file) if head.startswith(b"\x89HDF\r\n\x1a\n") else
                 {"heights": numpy.load(path, allow_pickle=False)} if head.startswith(b"\x93NUMPY") else
                 read_heights(file, channel))
    except Error:
        raise
    except FileNotFoundError:
        raise _refuse(file, "cannot be read", "there is no such file", "check the path") from None
    except Exception as error:  # every library has its own
        raise _refuse(file, "cannot be read", f"{type(error).__name__}: {error}", "export it again") from None
    heights = numpy.asarray(found["heights"])
    if heights.ndim != 2 or heights.dtype.kind not in "fiu":
        colours = heights.ndim == 3 and heights.shape[2] in (3, 4)
        raise _refuse(file, "is a picture of colours, not a map of heights" if colours else "is no map of heights",
                      f"its numbers are {heights.dtype} of shape {heights.shape}", "export heights, [y, x]")
    told = found.get("unit") or unit
    if told is None:
        raise _refuse(file, "does not tell the unit of its heights", "", "name it: --unit nm")
    heights = heights.astype(float) * (float(found.get("scale") or 1.0) * _length(file, told, "heights"))
    heights[~numpy.isfinite(heights)] = numpy.nan
    edges = tuple(float(s) * _length(file, found.get("size_unit") or told, "size") for s in found.get("size") or ())
    if len(edges) == 1:
        edges *= 2
    if not edges and size:
        edges = (size, size * heights.shape[0] / heights.shape[1])
    return HeightMap(heights, edges or None, list(found.get("notes", [])))


def square(heights: numpy.ndarray) -> numpy.ndarray:
    """Its middle."""
    n = min(heights.shape)
    y, x = ((length - n) // 2 for length in heights.shape)
    return heights[y:y + n, x:x + n]


def without_plane(heights: numpy.ndarray) -> numpy.ndarray:
    """Less the plane of least squares through what is there."""
    y, x = numpy.indices(heights.shape).reshape(2, -1)
    terms = numpy.stack([numpy.ones(x.size), x, y], axis=1)
    there = numpy.isfinite(heights.ravel())
    plane = numpy.linalg.lstsq(terms[there], heights.ravel()[there], rcond=None)[0]
    return heights - (terms @ plane).reshape(heights.shape)


def without_tilt(heights: numpy.ndarray) -> numpy.ndarray:
    """Less the plane that makes opposite edges meet on the mean, as those of a periodic map do; and less its mean."""
    found = heights
    for axis in (0, 1):
        first, second, before, last = (numpy.take(found, k, axis) for k in (0, 1, -2, -1))
        # A point past each edge, continued straight, is the first one beyond the other.
        rise = 0.5 * numpy.nanmean(3 * last - before + second - 3 * first)
        tilt = rise / found.shape[axis] * numpy.arange(found.shape[axis])
        found = found - (tilt[:, None] if axis == 0 else tilt)
    return found - numpy.nanmean(found)


def filled(heights: numpy.ndarray) -> numpy.ndarray:
    """With the mean of their neighbours at missing points, from the edges of a hole inwards."""
    found = numpy.array(heights, float)
    while (missing := numpy.isnan(found)).any() and not missing.all():
        around = numpy.stack([numpy.roll(found, step, axis) for axis in (0, 1) for step in (1, -1)])
        known = ~numpy.isnan(around)
        mean = numpy.where(known, around, 0.0).sum(axis=0) / numpy.maximum(known.sum(axis=0), 1)
        found = numpy.where(missing & known.any(axis=0), mean, found)
    return found


def jump(heights: numpy.ndarray) -> float:
    """The rms difference of opposite edges over that of neighbours inside; of a periodic map about 1."""
    across = numpy.concatenate([heights[0] - heights[-1], heights[:, 0] - heights[:, -1]])
    inside = numpy.concatenate([numpy.diff(heights, axis=axis).ravel() for axis in (0, 1)])
    rms = numpy.sqrt(numpy.nanmean(inside**2))
    return float(numpy.sqrt(numpy.nanmean(across**2)) / rms) if rms > 0.0 else 1.0


def quarters(heights: numpy.ndarray) -> list[numpy.ndarray]:
    """Of an odd number of points they share the middle row and column."""
    half = (len(heights) + 1) // 2
    return [heights[y, x] for y in (slice(half), slice(-half, None)) for x in (slice(half), slice(-half, None))]


def mirrored(heights: numpy.ndarray) -> numpy.ndarray:
    """Four times the area, periodic without a jump."""
    wide = numpy.concatenate([heights, heights[:, ::-1]], axis=1)
    return numpy.concatenate([wide, wide[::-1]], axis=0)
