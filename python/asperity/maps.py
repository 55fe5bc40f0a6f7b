# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Maps of heights in the formats of microscopes, as HDF5 that a scene's surface.file names.

    python3 -m asperity.maps map.gwy heights.h5

The formats are those of SurfaceTopography (PyPI), 1.25 or newer: Gwyddion (.gwy), Surface Data File
(.sdf), X3P, contact.engineering's netCDF, and those of many instruments.
"""

import sys
from pathlib import Path

from .errors import InputOutputError


def convert(source, target) -> dict:
    """Write the default channel of `source` to `target` (HDF5: /heights, [y, x], with unit, size_x and
    size_y). Points without a height become NaN. Returns what was found: points, size, unit, missing."""
    try:
        from SurfaceTopography import open_topography
    except ImportError as error:
        raise InputOutputError(
            "asperity.maps", "needs SurfaceTopography", str(error),
            "python3 -m pip install SurfaceTopography, or export the map as text, HDF5 or .npy") from None
    import h5py
    import numpy

    target = Path(target)
    if target.exists():
        raise InputOutputError(str(target), "is there already", "", "name another file, or remove it")
    try:
        topography = open_topography(str(source)).topography()
    except Exception as error:  # every reader has its own
        raise InputOutputError(str(source), "cannot be read", f"{type(error).__name__}: {error}") from None
    if topography.dim != 2 or topography.unit is None:
        raise InputOutputError(
            str(source), "is no map of heights",
            f"it has {topography.dim} dimensions and the unit {topography.unit}", "export it as text with a header")
    # heights() is [x, y]; masked where there is no height.
    heights = numpy.ma.filled(numpy.ma.asarray(topography.heights(), dtype=float), numpy.nan).T
    with h5py.File(target, "x") as file:
        data = file.create_dataset("heights", data=heights)
        data.attrs["unit"] = topography.unit
        data.attrs["size_x"], data.attrs["size_y"] = (float(x) for x in topography.physical_sizes)
        file.attrs["origin"] = Path(source).name
    return {"points": heights.shape[::-1], "size": topography.physical_sizes, "unit": topography.unit,
            "missing": int(numpy.isnan(heights).sum())}


def main(arguments) -> int:
    if len(arguments) != 2:
        print("usage: python3 -m asperity.maps MAP HEIGHTS.h5", file=sys.stderr)
        return 2
    try:
        found = convert(*arguments)
    except InputOutputError as error:
        print(error, file=sys.stderr)
        return 4
    print("{points[0]} x {points[1]} points, {size[0]:g} x {size[1]:g} {unit}, {missing} without a height"
          .format(**found))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
