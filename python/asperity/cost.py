# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: what accuracy costs in time for a scene.

Runs the reference, the scene as it is, every value of every parameter (cost_parameters.py), and then
combinations: a value of each parameter, the cheapest whose own errors add up to no more than a target. Each is
a process of its own with one thread, in a directory of its own; those that are there are not run again.

With a target of the user only the numerics are varied, and a combination is chosen once it was run and its error
against the reference is within the target.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from . import program
from .cost_parameters import ASKED, NAN, QUANTITIES, Base, CostCase, Parameter, Row, joined, nothing
from .errors import SceneError
from .pool import DONE, WAITING, Job, Pool, PoolOptions, look_at_all
from .result import Values

TARGETS = (0.05, 0.01, 0.001)
TRIES = 4
"""combinations that are run for a target of the user"""


def numbers_of(result: Values) -> np.ndarray:
    """One number a quantity; NaN: none."""
    flat, *numbers = (result.number(key, NAN) for key in ("delta_gamma", "binding_energy", "contact_fraction",
                      "work_of_drive.approach", "work_of_drive.pull_off", "pull_off_force"))
    flat = flat or NAN
    return np.array(numbers) / (flat, 1.0, flat, flat, 1.0)


def errors_of(measured: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Relative and with their signs."""
    return (measured - reference) / np.where(reference == 0, NAN, np.abs(reference))


def largest_error(measured: np.ndarray, reference: np.ndarray, question: str) -> float:
    """Without sign, of the quantities that the reference has. NaN: the measured run lacks one of them."""
    if question == "path" and np.isnan(reference[ASKED["state"]:]).all():
        return NAN  # a reference that followed no path says nothing of one
    asked = slice(ASKED[question])
    errors = np.abs(errors_of(measured, reference)[asked])[~np.isnan(reference[asked]) & (reference[asked] != 0)]
    return float(errors.max(initial=0.0)) if errors.size else NAN  # NaN if one of them is


def pareto_front(seconds: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Which of them are beaten by no other in time and error at once; NaN is never among them."""
    s, e = np.asarray(seconds, float), np.asarray(errors, float)
    beaten = (s <= s[:, None]) & (e <= e[:, None]) & ((s < s[:, None]) | (e < e[:, None]))
    return ~(np.isnan(s) | np.isnan(e) | beaten.any(axis=1))


def cheapest_within(seconds: np.ndarray, errors: np.ndarray, target: float) -> int | None:
    """The one of the least time with an error within the target."""
    return min((i for i, e in enumerate(errors) if e <= target), key=lambda i: seconds[i], default=None)


def order_of(x: list[float], errors: list[float], x0: float | None, floor: float = 1e-6) -> float | None:
    """error = c |x^p - x0^p|: the power p that fits best (least squares of the logarithms).

    x0: the parameter of the run that the errors are measured against; None: no error is left there. Errors that
    are NaN or below `floor` are left out. 0.05 <= |p| <= 8, positive where the error grows with x.
    """
    points = [(v, abs(e)) for v, e in zip(x, errors) if abs(e) > floor and v > 0 and v != x0]
    if len({v for v, _ in points}) < 2:
        return None
    at, error = np.array(points).T
    power = np.array([s * 0.01 * i for i in range(5, 801) for s in (1, -1)])[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):  # of a power that leaves no difference
        misfit = np.var(np.log(error) - np.log(np.abs(at**power - (0.0 if x0 is None else x0**power))), axis=1)
    return float(power[np.argmin(np.nan_to_num(misfit, nan=np.inf)), 0])


@dataclass
class Combination:
    """A row of each part of a base: own errors add, factors of time multiply."""

    rows: tuple[Row, ...]
    error: float
    time: float
    """over that of the reference runs"""

    def row(self, base: Base) -> Row:
        setting = base.setting
        for one in self.rows:
            setting = joined(setting, one.own)
        label = ", ".join([*filter(None, [base.label]), *(one.label for one in self.rows)])
        return Row("combination", label, setting, [], added=self.error)


@dataclass
class Search:
    """For the cheapest combination of a base that keeps a target: what was measured of it decides."""

    base: Base
    target: float
    left: list[Combination]
    """that may keep it, the cheapest first; none: the search has ended"""
    smallest: float
    """smallest error: measured, or sum of own errors if none was run"""
    tried: int = 0
    chosen: Row | None = None

    def look_at(self, row: Row) -> None:
        """row: of the first that is left, after its run."""
        error = row.error[self.base.question]
        self.smallest = error if self.tried == 0 else float(np.fmin(error, self.smallest))
        self.tried += 1
        if error <= self.target:
            self.chosen, self.left = row, []
        elif math.isnan(error):  # the run failed, something is too coarse there: what is finer takes longer
            self.left = [c for c in self.left if c.time >= 1.5 * self.left[0].time]
        else:  # own errors added up to less than it has: the next has to promise half
            self.left = [c for c in self.left[1:] if c.error <= 0.5 * self.left[0].error]


@dataclass
class Cost:
    """The rows: the first is the reference, the second the scene itself."""

    name: str
    scene: dict[str, Any]
    case: CostCase
    rows: list[Row] = field(default_factory=list)
    asked: Search | None = None
    """for a target of the user"""
    orders: list[tuple[Parameter, list[float | None]]] = field(default_factory=list)
    cheapest: dict[str, list[int | None]] = field(default_factory=dict)

    def answered(self, question: str) -> bool:
        return any(r.compared and not math.isnan(r.error[question]) for r in self.rows)

    def compare(self) -> None:
        """Errors, fronts, orders and cheapest settings of the rows that are there."""
        for row in self.rows:
            row.error = {q: largest_error(row.numbers, self.rows[0].numbers, q) for q in ASKED}
            row.own_error = nothing()
        seconds = [r.seconds for r in self.rows]
        for question in ASKED:
            errors = [r.error[question] if r.compared else NAN for r in self.rows]
            for row, front in zip(self.rows, pareto_front(seconds, errors).tolist()):
                row.front[question] = front
            self.cheapest[question] = [cheapest_within(seconds, errors, t) for t in TARGETS]
        self.orders = []
        for parameter in self.case.parameters:
            reference = parameter.reference
            if reference is None:
                continue
            others = [row for row in parameter.rows if row is not reference]
            for row in others:
                row.own_error = errors_of(row.numbers, reference.numbers)
            x0 = None if parameter.reference_is_exact else reference.x
            self.orders.append((parameter, [order_of([r.x for r in others], [r.own_error[q] for r in others], x0)
                                       for q in range(len(QUANTITIES))]))

    def _of_part(self, part: str, question: str) -> list[Combination]:
        """The values of a part's parameters, those that have an error."""
        found = []
        for parameter in self.case.parameters:
            reference = parameter.reference
            if parameter.part != part or reference is None:
                continue
            for row in parameter.rows:
                # Without time the velocity is another base.
                if row is reference and (not parameter.reference_is_exact or parameter.name == "velocity"):
                    continue
                error = largest_error(row.numbers, reference.numbers, question)
                if not math.isnan(error):
                    found.append(Combination((row,), error, row.seconds / reference.seconds))
        return found

    def search(self, base: Base, target: float) -> Search:
        there = {parameter.part for parameter in self.case.parameters}
        parts = [self._of_part(part, base.question) for part in base.parts if part in there]
        every = [Combination(tuple(one.rows[0] for one in some), sum(one.error for one in some),
                             math.prod(one.time for one in some)) for some in itertools.product(*parts)]
        return Search(base, target, sorted((c for c in every if c.error <= target), key=lambda c: c.time),
                      min((c.error for c in every), default=NAN))

    def choose(self, searches: list[Search], run: Callable[[list[Row]], bool]) -> bool:
        """Runs the first combination of each, and the next of those that missed. False: stopped before."""
        there: list[Row] = []
        for _ in range(TRIES):
            tried, new = [], []
            for search in (s for s in searches if s.left):
                row = search.left[0].row(search.base)
                same = next((other for other in there + new if other.setting == row.setting), None)
                if same is None:
                    new.append(row)
                tried.append((search, same or row))
            complete = not new or run(new)
            there += new
            self.rows += new
            self.compare()
            if not complete:
                return False
            for search, row in tried:
                search.look_at(row)
        return True


class Runs:
    """Settings that make the same scene are one run."""

    def __init__(self, scene: str, overrides: list[str], directory: Path, options: PoolOptions):
        self.scene, self.directory, self.options = scene, directory, options
        # Maps and frames would be timed too.
        self.common = joined(overrides, ["output.fields=zero-load", "output.trajectory=none"])
        self.made: dict[str, Job] = {}

    def run(self, rows: list[Row]) -> bool:
        """Runs the rows and fills in their numbers. False: stopped before the end."""
        overrides = [joined(self.common, row.setting) for row in rows]
        points = program.theory_points(self.scene, overrides, runnable=True)
        program.complaints(points)
        jobs: dict[str, Job] = {}
        for row, given, point in zip(rows, overrides, points):
            name = ",".join(one.partition(".")[2] for one in sorted(row.setting)) or "scene"
            key = json.dumps(point["scene"])
            jobs[key] = self.made.setdefault(key, Job(name, self.directory / name, self.scene, given, point))
        outcomes = look_at_all(list(jobs.values()), print)
        there = sum(o.status != WAITING for o in outcomes)
        print(f"{len(jobs)} run{'s' * (len(jobs) != 1)} in {self.directory}" + (f"; {there} are there already" if there else ""), flush=True)
        complete = Pool(list(jobs.values()), outcomes, self.options, self.directory).run()
        of_scene = dict(zip(jobs, outcomes))
        for row, point in zip(rows, points):
            row.outcome = of_scene[json.dumps(point["scene"])]
            if row.outcome.status == DONE:
                result = row.outcome.result
                row.numbers = numbers_of(result)
                row.seconds, row.wall = (result.number(f"run.{k}_seconds", NAN) for k in ("processor", "wall"))
        return complete


def target_of(text: str) -> float:
    """"1%" and "0.01" are 0.01. Raises SceneError."""
    found, target = re.fullmatch(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(%?)\s*", text), NAN
    with contextlib.suppress(ValueError):
        target = float(found[1]) * (0.01 if found[2] else 1.0) if found else NAN
    if not 0.0 < target < 1.0:
        raise SceneError(f"--target {text}", "is no error to keep",
                         "a relative error is needed, above 0 and below 100 %",
                         "for example --target 1%, or --target 0.01")
    return target
