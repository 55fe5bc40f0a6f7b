# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: runs the reference, the scene as it is, every value of every parameter (cost_parameters.py), and then
combinations: a value of each parameter, the cheapest whose own errors add up to no more than a target. For a target of
the user a combination is chosen once it was run and its error against the reference is within the target.
"""

from __future__ import annotations

import contextlib
import functools
import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np

from ..errors import SceneError
from .cost_parameters import ASKED, Base, CostCase, Row
from .variations import NAN, joined

TARGETS = (0.05, 0.01, 0.001)
TRIES = 4  # combinations that are run for a target


def errors_of(measured: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Returns the signed relative errors."""
    return (measured - reference) / np.where(reference == 0, NAN, np.abs(reference))


def largest_error(measured: np.ndarray, reference: np.ndarray, question: str) -> float:
    """Returns the largest absolute error of the quantities that the reference has; NaN if the measured run lacks one of
    them."""
    if question == "path" and np.isnan(reference[ASKED["state"]:]).all():
        return NAN  # a reference that followed no path says nothing of one
    asked = slice(ASKED[question])
    errors = np.abs(errors_of(measured, reference)[asked])[~np.isnan(reference[asked]) & (reference[asked] != 0)]
    return float(errors.max(initial=0.0)) if errors.size else NAN  # NaN if one of them is


def pareto_front(seconds: Sequence[float], errors: Sequence[float]) -> np.ndarray:
    """Returns the points that no other point beats in run time and error at once; NaN is never among them."""
    s, e = np.asarray(seconds, float), np.asarray(errors, float)
    beaten = (s <= s[:, None]) & (e <= e[:, None]) & ((s < s[:, None]) | (e < e[:, None]))
    return ~(np.isnan(s) | np.isnan(e) | beaten.any(axis=1))


class Cost:
    """The rows: the first is the reference, the second the scene itself."""

    def __init__(self, case: CostCase, target: float | None = None):
        self.case, self.target = case, target
        self.rows = [Row("reference", "reference", case.reference, compared=False), Row("scene", "as it is", []),
                     *(row for parameter in case.parameters for row in parameter.rows)]
        self.cheapest: dict[str, list[Row | None]] = {}
        self.chosen: Row | None = None  # for the target of the user
        self.smallest = NAN  # error: measured, or sum of own errors if none was run

    def answered(self, question: str) -> bool:
        return any(r.compared and not math.isnan(r.error[question]) for r in self.rows)

    def compare(self) -> None:
        """Computes errors, fronts and cheapest settings of the rows that exist."""
        for row in self.rows:
            row.error = {q: largest_error(row.numbers, self.rows[0].numbers, q) for q in ASKED}
        for question in ASKED:
            errors = [r.error[question] if r.compared else NAN for r in self.rows]
            for row, front in zip(self.rows, pareto_front([r.seconds for r in self.rows], errors).tolist()):
                row.front[question] = front
            self.cheapest[question] = [min((r for r, e in zip(self.rows, errors) if e <= t), key=lambda r: r.seconds,
                                           default=None) for t in TARGETS]

    def combinations(self, base: Base) -> list[tuple[float, float, Row]]:
        """Returns combinations of one value of each part, the cheapest first: time over that of the reference runs, sum of own
        errors, the row to run."""
        parts: dict[str, list[tuple[float, float, Row]]] = {p.part: [] for p in self.case.parameters if p.part in base.parts}
        for parameter in (p for p in self.case.parameters if p.part in parts):
            reference = parameter.rows[-1]
            # On a quasi-static path the velocity is another base.
            exact = parameter.exact and parameter.name != "velocity"
            for row in parameter.rows if exact else parameter.rows[:-1]:
                error = largest_error(row.numbers, reference.numbers, base.question)
                if not math.isnan(error):
                    parts[parameter.part].append((row.seconds / reference.seconds, error, row))
        found = []
        for some in itertools.product(*(parts[name] for name in base.parts if name in parts)):
            times, errors, rows = zip(*some)
            label = ", ".join(filter(None, [base.label, *(row.label for row in rows)]))
            setting = functools.reduce(joined, (row.own for row in rows), base.setting)
            found.append((math.prod(times), sum(errors), Row("combination", label, setting)))
        return sorted(found, key=lambda one: one[0])

    def _add(self, rows: list[Row], run: Callable[[list[Row]], bool]) -> bool:
        """Runs those that are not there. False: stopped before the end."""
        there = [row.setting for row in self.rows if row.parameter == "combination"]
        new = [row for i, row in enumerate(rows) if row.setting not in there + [one.setting for one in rows[:i]]]
        self.rows += new
        complete = not new or run(new)
        self.compare()
        return complete

    def choose(self, targets: tuple[float, ...], run: Callable[[list[Row]], bool]) -> bool:
        """Runs the cheapest combination of each base that may keep each target, side by side, and then further ones of
        those that missed. False: stopped before the end."""
        varied = {parameter.part for parameter in self.case.parameters}
        bases = [base for base in self.case.bases if varied.intersection(base.parts)]  # --parameters may leave out all of one
        searches = [(base, target, self.combinations(base)) for base in bases for target in targets]
        firsts = [next((row for _, error, row in every if error <= target), None) for _, target, every in searches]
        return self._add([row for row in firsts if row], run) and all(self._search(*one, run) for one in searches)

    def _search(self, base: Base, target: float, every: list[tuple[float, float, Row]],
                run: Callable[[list[Row]], bool]) -> bool:
        left = [one for one in every if one[1] <= target]
        measured: list[float] = []
        self.smallest = min((one[1] for one in every), default=NAN)
        while left and len(measured) < TRIES:
            _, added, row = left[0]
            if not self._add([row], run):
                return False
            row = next(r for r in self.rows if r.parameter == "combination" and r.setting == row.setting)
            measured.append(row.error[base.question])
            self.smallest = float(np.fmin.reduce(measured))
            if measured[-1] <= target:
                self.chosen = row
                break
            # Own errors added up to less than it has, or its run failed: the next has to promise half. Where none does,
            # one that promises less takes the place of one that failed.
            half = [one for one in left if one[1] <= 0.5 * added]
            left = half or [one for one in left if one[1] < added and math.isnan(measured[-1])]
        return True


def target_of(text: str) -> float:
    """Parses a relative error: "1%" and "0.01" are 0.01. Raises SceneError."""
    words = text.strip()
    with contextlib.suppress(ValueError):
        target = float(words.removesuffix("%")) * (0.01 if words.endswith("%") else 1.0)
        if 0.0 < target < 1.0:
            return target
    raise SceneError(f"--target {text}", "is no error to keep",
                     "a relative error is needed, above 0 and below 100 %", "for example --target 1%, or --target 0.01")
