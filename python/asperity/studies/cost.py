# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: runs the reference, the scene as it is, every value of every parameter (cost_parameters.py), and then
combinations: a value of each parameter, the cheapest whose own errors add up to no more than a target. For a target of
the user the cheapest settings are chosen of all that were run, the scene as it is among them, and whose error against
the reference is within the target. An area is known to one site at best.
"""

from __future__ import annotations

import contextlib
import functools
import itertools
import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from ..errors import Named, SceneError
from ..running.pool import FAILED, Outcome, PoolOptions
from ..terminal import html_table
from .cost_parameters import ASKED, Base, CostCase, Row, cost_case
from .forecast import Forecast
from .variations import NAN, Study, joined

TARGETS = (0.05, 0.01, 0.001)
TRIES = 4  # combinations that are run for a target


def errors_of(measured: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Computes signed relative errors."""
    return (measured - reference) / np.where(reference == 0, NAN, np.abs(reference))


def largest_error(measured: np.ndarray, reference: np.ndarray, question: str, grains: np.ndarray | float = 0.0) -> float:
    """Returns the largest absolute relative error of the quantities of the reference, each at least its resolution."""
    if question == "path" and np.isnan(reference[ASKED["state"]:]).all():
        return NAN  # a reference that followed no path says nothing of one
    asked = slice(ASKED[question])
    errors = np.maximum(np.abs(errors_of(measured, reference)), np.abs(errors_of(reference + grains, reference)))
    errors = errors[asked][~np.isnan(reference[asked]) & (reference[asked] != 0)]
    return float(errors.max(initial=0.0)) if errors.size else NAN  # NaN if one of them is


def pareto_front(seconds: Sequence[float], errors: Sequence[float]) -> np.ndarray:
    """Finds the points for which no other point has both a smaller run time and a smaller error."""
    s, e = np.asarray(seconds, float), np.asarray(errors, float)
    beaten = (s <= s[:, None]) & (e <= e[:, None]) & ((s < s[:, None]) | (e < e[:, None]))
    return ~(np.isnan(s) | np.isnan(e) | beaten.any(axis=1))


class Cost(Named):
    """Rows of the measured settings: the first is the reference, the second the scene itself. notes: on the scene."""

    def __init__(self, case: CostCase, target: float | None = None, notes: Sequence[str] = ()):
        self.case, self.target, self.notes = case, target, list(notes)
        self.rows = [Row("reference", "reference", case.reference, compared=False), Row("scene", "as it is", []),
                     *(row for parameter in case.parameters for row in parameter.rows)]
        self.cheapest: dict[str, list[Row | None]] = {}

    def _repr_html_(self) -> str:
        rows = [(row.parameter, row.label, f"{row.seconds:.3g}", *(f"{error:.2g}" for error in row.error.values())) for row in self.rows]
        return html_table("Cost of accuracy", ("parameter", "value", "s", *(f"error, {question}" for question in self.rows[0].error)), rows)

    @property
    def candidates(self) -> list[tuple[float, Row]]:
        """Rows that may be chosen for the target of the user, each with its error; without the reference and without values whose
        error is zero by definition."""
        own = {id(parameter.rows[-1]) for parameter in self.case.parameters if not parameter.exact}
        errors = [(row.error[self.case.bases[0].question], row) for row in self.rows if row.compared and id(row) not in own]
        return [(error, row) for error, row in errors if not math.isnan(error)]

    @property
    def chosen(self) -> Row | None:
        """The cheapest settings that meet the target of the user; None if no measured setting does."""
        return min((row for error, row in self.candidates if self.target and error <= self.target), key=lambda row: row.seconds,
                   default=None)

    @property
    def smallest(self) -> float:
        """The smallest error of the measured settings; NaN if there is none."""
        return min((error for error, _ in self.candidates), default=NAN)

    def answered(self, question: str) -> bool:
        """Returns True if a setting has an error for a question, "state" or "path"."""
        return any(r.compared and not math.isnan(r.error[question]) for r in self.rows)

    def compare(self) -> None:
        """Computes errors, fronts and cheapest settings of the rows that exist."""
        for row in self.rows:
            row.error = {q: largest_error(row.numbers, self.rows[0].numbers, q, self.rows[0].grains) for q in ASKED}
        for question in ASKED:
            errors = [r.error[question] if r.compared else NAN for r in self.rows]
            for row, front in zip(self.rows, pareto_front([r.seconds for r in self.rows], errors).tolist()):
                row.front[question] = front
            self.cheapest[question] = [min((r for r, e in zip(self.rows, errors) if e <= t), key=lambda r: r.seconds,
                                           default=None) for t in TARGETS]

    def combinations(self, base: Base) -> list[tuple[float, float, Row]]:
        """Returns combinations of one value of each part, the cheapest first."""
        least = largest_error(self.rows[0].numbers, self.rows[0].numbers, base.question, self.rows[0].grains)
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
            found.append((math.prod(times), max(least, sum(errors)), Row("combination", label, setting)))
        return sorted(found, key=lambda one: one[0])

    def _add(self, rows: list[Row], run: Callable[[list[Row]], bool]) -> bool:
        """Runs the missing rows. Returns False if stopped before the end."""
        there = [row.setting for row in self.rows if row.parameter == "combination"]
        new = [row for i, row in enumerate(rows) if row.setting not in there + [one.setting for one in rows[:i]]]
        self.rows += new
        complete = not new or run(new)
        self.compare()
        return complete

    def choose(self, targets: tuple[float, ...], run: Callable[[list[Row]], bool]) -> bool:
        """Runs the cheapest combinations of each base that may meet each target, simultaneously, and then further ones for the targets that were
        missed."""
        varied = {parameter.part for parameter in self.case.parameters}
        bases = [base for base in self.case.bases if varied.intersection(base.parts)]  # --parameters may leave out all of one
        searches = [(base, target, self.combinations(base)) for base in bases for target in targets]
        firsts = [next((row for _, error, row in every if error <= target), None) for _, target, every in searches]
        return self._add([row for row in firsts if row], run) and all(self._search(*one, run) for one in searches)

    def _search(self, base: Base, target: float, every: list[tuple[float, float, Row]],
                run: Callable[[list[Row]], bool]) -> bool:
        left = [one for one in every if one[1] <= target]
        tried = 0
        while left and tried < TRIES:
            _, added, row = left[0]
            if not self._add([row], run):
                return False
            row = next(r for r in self.rows if r.parameter == "combination" and r.setting == row.setting)
            tried, error = tried + 1, row.error[base.question]
            if error <= target:
                break
            # Own errors added up to less than it has, or its run failed: the next has to promise half. Where none does,
            # one that promises less takes the place of one that failed.
            half = [one for one in left if one[1] <= 0.5 * added]
            left = half or [one for one in left if one[1] < added and math.isnan(error)]
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


class Costing(Study):
    """Planned measurement of the cost of a scene's settings in a directory; carry_out() makes the runs."""

    def __init__(self, scene: str, overrides: list[str], out: str | None, options: PoolOptions, parameters: Iterable[str] = (),
                 target: float | None = None, say: Callable[[str], None] = print, files: Iterable[str] = ()):
        """Plans the runs. parameters: parameters to vary, by default all; target: relative error; files: names that the caller will
        write in the directory. Raises SceneError."""
        super().__init__(scene, overrides, out, "cost", options, say, files)
        self.case = cost_case(self.varied, list(parameters), same_experiment=target is not None)
        self.cost = Cost(self.case, target, self.notes)

    def forecast(self) -> Forecast:
        """Returns the runs of single settings that are left, and their time."""
        return self.forecast_of(self.cost.rows, "then the cheapest combinations of them")

    @property
    def reference(self) -> Outcome:
        """The outcome of the reference."""
        return self.cost.rows[0].outcome

    def carry_out(self) -> bool:
        """Carries out the runs and compares them, unless the reference fails. Returns False if stopped before the end."""
        cost = self.cost
        complete = self.runs.run(cost.rows)
        if complete and self.reference.status == FAILED:
            return True
        cost.compare()
        return complete and cost.choose(TARGETS if cost.target is None else (cost.target,), self.runs.run)
