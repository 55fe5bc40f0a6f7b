# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a study would run, how long that takes, and what it will not state: --plan, and the first lines of a study."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..errors import Error
from ..running import program
from ..running.pool import Job
from ..terminal import duration, table

START = 0.3
"""s; what a run takes beside its simulation."""
PLANNED = 8
"""Runs of a study that are planned one by one; times of the others lie between theirs."""


class Size(NamedTuple):
    """A run of a study: what it is for, sites along an edge of its box, width of the box (nm), and time (s)."""

    run: str
    sites: int
    width: float
    seconds: float


@dataclass
class Forecast:
    """Runs of a study that are still to be made, of `all_runs`, the seconds that they take (NaN: not known), what is run beyond them,
    the numbers that will not be stated, each with the reason, of a study whose runs differ in size, those that are left, and the errors
    over their size that numbers are expected to have."""

    name: str
    directory: Path
    all_runs: int
    runs: int
    seconds: float
    beyond: str = ""
    unstated: list[tuple[str, str]] = field(default_factory=list)
    sizes: list[Size] = field(default_factory=list)
    expected: dict[str, float] = field(default_factory=dict)

    def __str__(self) -> str:
        """Spells the forecast: "scan: 9 runs, about 3 min"."""
        time = "a time that is not known" if math.isnan(self.seconds) else duration(self.seconds)
        there = self.all_runs - self.runs
        return (f"{self.name}: {self.all_runs} run{'s' * (self.all_runs != 1)}" + f", of which {there} are there" * (there > 0)
                + (f", about {time}" if self.runs else "") + f"; {self.beyond}" * bool(self.beyond))

    @property
    def lines(self) -> list[str]:
        """The forecast and, in a line each, what will not be stated."""
        rows = [[one.run, str(one.sites), f"{one.width:.4g}", "not known" if math.isnan(one.seconds) else duration(one.seconds)]
                for one in self.sizes]
        sizes = [table(["run", "sites", "width, nm", "about"], rows)] if rows else []
        errors = [f"expected error of the {name.replace('pull_off', 'pull-off').replace('_', ' ')}: about {100 * error:.2g} %"
                  for name, error in self.expected.items()]
        return [*sizes, str(self), *errors, *(f"note: {names} will not be stated: {why}" for names, why in self.unstated)]

    def json(self) -> dict[str, Any]:
        """Returns the forecast as JSON has it."""
        return {"name": self.name, "directory": self.directory, "plan": str(self), "runs": self.all_runs, "left": self.runs,
                "seconds": self.seconds, "unstated": [{"numbers": names, "why": why} for names, why in self.unstated]} | (
                    {"sizes": [one._asdict() for one in self.sizes]} if self.sizes else {}) | (
                    {"expected": self.expected} if self.expected else {})


def seconds_of(scene: str, overrides: list[str]) -> float:
    """Returns the time of a run by `asperity plan`."""
    try:
        return program.plan(scene, overrides)["seconds"]["altogether"]
    except Error:
        return math.nan


def seconds_of_all(jobs: Sequence[Job]) -> float:
    """Returns the time of runs one after the other, s: by `asperity plan` of at most PLANNED of them; NaN if unknown."""
    if not jobs:
        return 0.0
    some = np.unique(np.linspace(0, len(jobs) - 1, min(PLANNED, len(jobs))).round().astype(int))
    known = [seconds_of(jobs[k].file, jobs[k].overrides) for k in some]
    return float(np.interp(np.arange(len(jobs)), some, known).sum()) + START * len(jobs)
