# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Maps in files of arrays: HDF5 of any program (.h5-jpk and .topostats of instruments among them), .npy and .npz."""

from __future__ import annotations

import math
import zipfile
from pathlib import Path
from typing import Any

import h5py
import numpy

from .channels import MOST_POINTS, Channel, frames, refuse, require_size, text_of

MAGIC = {"HDF5": b"\x89HDF\r\n\x1a\n", ".npy": b"\x93NUMPY"}
JPK_HEIGHTS = ("height", "measuredheight")
"""Channels of .h5-jpk that are in metres."""


def _is_map(array: Any) -> bool:
    return getattr(array, "ndim", 0) in (2, 3) and array.dtype.kind in "fiu" and 0 not in array.shape


def _told(array: h5py.Dataset, file: h5py.File) -> dict[str, Any]:
    """Returns what the attributes say of a data set; the file may say once what holds for all that is in it."""
    def said(*names: str) -> Any:
        return next((of[name] for of in (array.attrs, file.attrs) for name in names if name in of), None)

    size = [said("size_x"), said("size_y")]
    return {"unit": text_of(said("unit", "units")), "scale": said("scale"), "origin": text_of(said("origin")),
            "size_unit": text_of(said("size_unit")), "size": None if size[0] is None else (size[0], size[0] if size[1] is None else size[1])}


def _jpk(file: h5py.File) -> list[Channel]:
    """Returns the maps of .h5-jpk: Measurement_*/Channel_*/<name>, [pixel][frame], which a multiplier and an offset make heights."""
    found = []
    for measurement in (file[name] for name in file if name.startswith("Measurement")):
        grid = {key.rpartition(".")[2]: value for key, value in measurement.attrs.items() if key.startswith("position-pattern.grid.")}
        for group in (measurement[name] for name in measurement if name.startswith("Channel")):
            attributes = group.attrs
            name = str(text_of(attributes.get("channel.name", group.name.rpartition("/")[2]))).strip()
            back = str(text_of(attributes.get("retrace", False))).strip().lower() in ("true", "1")
            unit = text_of(attributes.get("net-encoder.unit.unit")) or ("m" if name.lower() in JPK_HEIGHTS else "an unknown unit")
            shape = int(grid.get("jlength", grid.get("ilength", 0))), int(grid.get("ilength", 0))
            for array in (a for a in group.values() if isinstance(a, h5py.Dataset) and a.ndim in (1, 2) and a.shape[0] == shape[0] * shape[1] > 0):
                count = array.shape[1] if array.ndim == 2 else 1
                for k in range(count):
                    def load(array=array, k=k, group=group, shape=shape, grid=grid, unit=unit) -> dict[str, Any]:
                        values = numpy.asarray(array[:, k] if array.ndim == 2 else array[()], dtype=float).reshape(shape)
                        of = group.attrs
                        values = values * float(of.get("net-encoder.scaling.multiplier", 1.0)) + float(of.get("net-encoder.scaling.offset", 0.0))
                        size = tuple(float(grid[key]) for key in ("ulength", "vlength") if key in grid)
                        return {"heights": values, "unit": unit} | ({"size": size, "size_unit": "m"} if len(size) == 2 else {})

                    label = f"{name}_{'retrace' if back else 'trace'}"
                    found.append(Channel(label + (f"[{k + 1}]" if count > 1 else ""), load, unit))
    return found


def _topostats(file: h5py.File) -> tuple[list[Channel], int | None]:
    """Returns the maps of .topostats; those called image are heights in nm."""
    pixel = float(file["pixel_to_nm_scaling"][()])
    found = []
    for name, array in _arrays(file):
        unit = "nm" if name.rpartition("/")[2].startswith("image") else "an unknown unit"
        size = tuple(pixel * n for n in array.shape[:-3:-1])
        found += frames(name, array, {"unit": unit, "size": size, "size_unit": "nm"})
    return found, next((k for k, channel in enumerate(found) if channel.name == "image"), None)


def _arrays(file: h5py.File) -> list[tuple[str, h5py.Dataset]]:
    arrays: list[tuple[str, h5py.Dataset]] = []
    file.visititems(lambda name, found: arrays.append((name, found)) if isinstance(found, h5py.Dataset) and _is_map(found) else None)
    return arrays


def of_hdf5(file: h5py.File) -> tuple[list[Channel], int | None, bool]:
    """Returns the maps of an open HDF5 file."""
    if any(name.startswith("Measurement_") for name in file):
        return _jpk(file), None, False
    if "pixel_to_nm_scaling" in file:
        return *_topostats(file), False
    channels = [channel for name, array in _arrays(file) for channel in frames(name, array, _told(array, file))]
    flat = [name for name, array in _arrays(file) if array.ndim == 2]
    first = "heights" if "heights" in flat else flat[0] if len(flat) == 1 else None
    return channels, next((k for k, channel in enumerate(channels) if channel.name == first), None), first is not None


def _headers(path: Path) -> list[tuple[int, ...]]:
    """Returns the shapes that the headers of the arrays of .npy or .npz tell. Raises ValueError for a file without them."""
    def shape(file: Any) -> tuple[int, ...]:
        version = numpy.lib.format.read_magic(file)
        read = numpy.lib.format.read_array_header_1_0 if version == (1, 0) else numpy.lib.format.read_array_header_2_0
        return read(file)[0]

    if not zipfile.is_zipfile(path):
        with path.open("rb") as file:
            return [shape(file)]
    found = []
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            with archive.open(name) as file:
                found.append(shape(file))
    if sum(map(math.prod, found)) > MOST_POINTS:
        raise refuse(path, "is too large", f"its {len(found)} arrays are {sum(map(math.prod, found))} numbers, and {MOST_POINTS} are the limit",
                     "save the map alone")
    return found


def of_numpy(path: Path) -> tuple[list[Channel], bool]:
    """Returns the maps of a file of numpy."""
    shapes = _headers(path)
    for shape in shapes:
        require_size(path, shape)
    found = numpy.load(path, allow_pickle=False)
    arrays = {name: found[name] for name in found.files} if hasattr(found, "files") else {"map": found}
    channels = []
    for name, array in arrays.items():
        if array.ndim == 3 and array.shape[2] in (3, 4):
            if len(arrays) == 1:
                raise refuse(path, "is a picture of colours, not a map of heights",
                             f"its numbers are {array.dtype} of shape {array.shape}", "export heights, [y, x]")
        elif _is_map(array):
            channels += frames(name, array, {})
        elif len(arrays) == 1:
            raise refuse(path, "is no map of heights", f"its numbers are {array.dtype} of shape {array.shape}",
                         "export heights, [y, x]")
    return channels, not hasattr(found, "files") and found.ndim == 2
