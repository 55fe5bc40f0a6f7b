# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""File run.h5 of a result directory, whose arrays are read on demand."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..errors import InputOutputError, UnknownName
from ..files import store

LARGEST_ARRAY = 2**28
"""Largest number of values of a data set that is read."""


class RunFile:
    """File run.h5 of a directory. All reads raise InputOutputError on failure.

    The first read checks the digest at the end of the file, if the file has one.
    """

    def __init__(self, path: Path, unread: str = ""):
        """Stores the path. unread: reason why the file must not be read; "": none."""
        self.path, self.unread = path, unread

    def lacks(self, where: str, name: object, there: Iterable[str], what: str) -> UnknownName:
        """Returns the error for a part that the file lacks."""
        return UnknownName.among(where, name, there, self.unread or "it is empty", what)

    @functools.cached_property
    def _whole(self) -> bool | None:
        return store.hdf5_is_whole(self.path)

    @contextlib.contextmanager
    def _opened(self) -> Iterator[h5py.File]:
        if not self.path.exists():
            raise InputOutputError(str(self.path), "cannot be read", "there is no such file",
                                   "the theory alone and a run that failed early have none")
        try:
            if self._whole is False:
                raise ValueError("its content does not match its digest")
            with h5py.File(self.path, "r") as file:
                if self._whole is None and "asperity_digest" in file.attrs:
                    raise ValueError("the digest at its end is missing")
                yield file
        except Exception as error:  # h5py raises OSError, KeyError, RuntimeError, ValueError, TypeError
            why = str(error).splitlines()[0] if str(error) else type(error).__name__
            if self.path.is_file() and not h5py.is_hdf5(self.path):
                why = "it is not an HDF5 file"
            raise InputOutputError(str(self.path), "cannot be read", why,
                                   "run the scene again, or resume it from its checkpoint") from None

    def members(self, group: str) -> list[str]:
        """Returns the names in a group; [] if there is no such group."""
        if not self.path.exists():
            return []
        with self._opened() as file:
            found = file.get(group)
            return list(found) if isinstance(found, h5py.Group) else []

    def array(self, name: str, dimensions: int, frame: int | None = None) -> np.ndarray:
        """Reads a data set of numbers. Raises ValueError, InputOutputError."""
        with self._opened() as file:
            found = file[name]
            if not isinstance(found, h5py.Dataset) or found.dtype.kind not in "fiub":
                raise ValueError(f"{name} is no data set of numbers")
            shape = found.shape if frame is None else (found.shape or ())[1:]
            if shape is None or len(shape) != dimensions:
                raise ValueError(f"{name} has the shape {found.shape}, not {dimensions} dimensions")
            if math.prod(shape) > LARGEST_ARRAY:
                raise ValueError(f"{name} has {math.prod(shape)} values")
            return np.asarray(found[()] if frame is None else found[frame])

    def attribute(self, name: str, key: str) -> Any:
        """Reads an attribute of a data set or group."""
        with self._opened() as file:
            found = file[name].attrs.get(key)
            return found.decode() if isinstance(found, bytes) else found
