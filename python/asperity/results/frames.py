# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Arrays for pandas and xarray, which need not be there, and the frames of a trajectory."""

from __future__ import annotations

import functools
import importlib
from collections.abc import Mapping, Sequence
from typing import Any, overload

import numpy as np

from ..errors import Named, SceneError, UnknownName, to_install
from ..terminal import html_table
from .run_file import RunFile

TRAJECTORY = "/particles/trajectory"


def _package(name: str, call: str) -> Any:
    """Returns a package that Asperity itself does not need. Raises SceneError if it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise SceneError(call, f"needs a Python package, {name}", str(error), to_install(name)) from None


def data_frame(columns: Mapping[str, Any], units: Mapping[str, str]) -> Any:
    """Makes a pandas DataFrame; its attrs["units"] has the unit of each column. Raises SceneError."""
    found = _package("pandas", "frame()").DataFrame(dict(columns))
    found.attrs["units"] = dict(units)
    return found


def data_set(arrays: Mapping[str, tuple[Sequence[str], Any]], units: Mapping[str, str], edges: Mapping[str, float] | None = None,
             coordinates: Mapping[str, Any] | None = None) -> Any:
    """Makes an xarray Dataset; attrs["units"] of each array has its unit. Raises SceneError."""
    xarray = _package("xarray", "to_xarray()")
    places = dict(coordinates or {})
    for name, edge in (edges or {}).items():
        n = next((np.shape(values)[list(dims).index(name)] for dims, values in arrays.values() if name in dims), 0)
        if n and edge:
            places[name] = (name, edge / n * (np.arange(n) + 0.5), {"units": "Å"})
    return xarray.Dataset({name: (list(dims), values, {"units": units.get(name, "")}) for name, (dims, values) in arrays.items()},
                          coords=places)


class Frames(Named, Sequence):
    """Frames of the lowest layer along a path (output.trajectory): frames[i] has the positions, Å, [site, xyz]."""

    def __init__(self, file: RunFile):
        """Keeps the file, which is read when a frame is asked for."""
        self._file = file

    def _along(self, name: str) -> np.ndarray:
        there = "position" in self._file.members(TRAJECTORY)
        return self._file.array(f"{TRAJECTORY}/position/{name}", 1) if there else np.empty(0)

    @functools.cached_property
    def steps(self) -> np.ndarray:
        """Number of the step or point of each frame."""
        return self._along("step").astype(int)

    @functools.cached_property
    def times(self) -> np.ndarray:
        """Time of each frame, ps."""
        return self._along("time")

    def __len__(self) -> int:
        return len(self.steps)

    @overload
    def __getitem__(self, i: int) -> np.ndarray: ...
    @overload
    def __getitem__(self, i: slice) -> list[np.ndarray]: ...
    def __getitem__(self, i: int | slice) -> np.ndarray | list[np.ndarray]:
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"there are {len(self)} frames (output.trajectory)")
        return self._read("position", i % len(self))

    def velocity(self, i: int) -> np.ndarray:
        """Returns the velocities of a frame, Å/ps, [site, xyz]. Raises UnknownName unless output.velocities was on."""
        if not self._moves:
            raise UnknownName.among(TRAJECTORY, "velocity", self._file.members(TRAJECTORY), "output.velocities was off", "array")
        return self._read("velocity", i % len(self))

    def _read(self, name: str, i: int) -> np.ndarray:
        return self._file.array(f"{TRAJECTORY}/{name}/value", 2, i).astype(float)

    @property
    def _moves(self) -> bool:
        return "velocity" in self._file.members(TRAJECTORY)

    def to_xarray(self):
        """Returns all frames as an xarray Dataset over frame, site and component, with step and time (ps); attrs["units"] of each
        has its unit."""
        dims = ("frame", "site", "component")
        arrays = {"position": (dims, np.array([self[i] for i in range(len(self))]).reshape(len(self), -1, 3))}
        if self._moves:
            arrays["velocity"] = (dims, np.array([self.velocity(i) for i in range(len(self))]).reshape(len(self), -1, 3))
        return data_set(arrays, {"position": "Å", "velocity": "Å/ps"}, None, {
            "component": ["x", "y", "z"], "step": ("frame", self.steps), "time": ("frame", self.times, {"units": "ps"})})

    def _repr_html_(self) -> str:
        return html_table(repr(self).strip("<>"), ("step", "time, ps"), [(str(a), f"{b:.6g}") for a, b in zip(self.steps[:12], self.times)])

    def __repr__(self) -> str:
        return f"<Frames: {len(self)} of the lowest layer>"
