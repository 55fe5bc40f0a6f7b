# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Types of the compiled module (binding/); Final: to be read. What each name means: help(asperity.Simulation).
import os
from collections.abc import Callable
from typing import Any, Final, NamedTuple, overload

import numpy
from numpy.typing import ArrayLike, NDArray

_Array = NDArray[numpy.float64]

class _Components(NamedTuple):
    x: _Array
    y: _Array
    z: _Array

version: str

def quantity(where: str, given: float | str, unit: str) -> float: ...

class Energies:
    elastic: Final[float]
    interface: Final[float]
    kinetic: Final[float]
    work: Final[float]
    damped: Final[float]
    balance_error: Final[float]

class BothWays:
    approach: Final[float | None]
    pull_off: Final[float | None]

class SiteMaps:
    gap: Final[_Array]
    contact: Final[NDArray[numpy.bool_]]
    pressure: Final[_Array]

class RestState:
    binding_energy: Final[float]
    elastic_energy: Final[float]
    contact_fraction: Final[float]
    repulsive_fraction: Final[float]
    mean_height: Final[float]
    residual: Final[float]
    iterations: Final[int]
    maps: Final[SiteMaps]

class Simulation:
    @overload
    def __init__(self, file: str, overrides: list[str], comm: int | None) -> None: ...
    @overload
    def __init__(self, saved: str, comm: int | None) -> None: ...
    def _step(self, n: int, look: Callable[[], Any] | None) -> int: ...
    def _every(self, n: int, observer: Callable[[], Any]) -> None: ...
    def relax(self) -> RestState: ...
    def save(self, file: str | os.PathLike[str]) -> None: ...
    def maps(self) -> SiteMaps: ...
    done: Final[bool]
    steps: Final[int]
    time: Final[float]
    force: Final[float]
    top_force: Final[float]
    mean_height: Final[float]
    energy: Final[Energies]
    contact: Final[float]
    repulsive_fraction: Final[float]
    segment: Final[str]
    work_of_interface: Final[BothWays]
    work_of_drive: Final[BothWays]
    lost_in_cycle: Final[float | None]
    u: Final[_Components]
    v: Final[_Components]
    f: Final[_Components]
    @property
    def external(self) -> _Components | None: ...
    @external.setter
    def external(self, field: ArrayLike | None) -> None: ...
    external_work: Final[float]
    tile: Final[tuple[slice, slice]]
    spacing: Final[float]
    _name: str
    _scene: str
    _substrate_edge: float
    _substrate_height: _Array
    _segment_number: int
    _top_then: float
    _top_position: Any
    _top_velocity: Any

class Point:
    top: Final[float]
    mean_height: Final[float]
    force: Final[float]
    energy: Final[float]
    elastic_energy: Final[float]
    interface_energy: Final[float]
    work: Final[float]
    dissipated: Final[float]
    dissipated_in_block: Final[float]
    branch_energy: Final[float]
    time: Final[float]
    instabilities: Final[int]
    contact: Final[float]
    repulsive_fraction: Final[float]
    number: Final[int]

class State:
    def __init__(self, u: ArrayLike, top: float = 0.0, branches: ArrayLike | None = None) -> None: ...
    u: Final[_Array]
    top: float
    branches: Final[_Array | None]

class Statics:
    def __init__(self, file: str, overrides: list[str]) -> None: ...
    def relax(self) -> Point: ...
    def free(self) -> RestState: ...
    def copy(self) -> State: ...
    def restore(self, state: State) -> None: ...
    def maps(self) -> SiteMaps: ...
    now: Final[Point]
    @property
    def mean_height(self) -> float: ...
    @mean_height.setter
    def mean_height(self, z: float | str) -> None: ...
    @property
    def top(self) -> float: ...
    @top.setter
    def top(self, z: float | str) -> None: ...
    _case: dict[str, Any]
    _substrate_height: _Array
    def _hold(self, time: float | str) -> None: ...
    def _load(self, pressure: float | str) -> None: ...
