# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The table of a sweep: columns, their means over the seeds, and the extract for terminals and reports."""

from __future__ import annotations

import functools
import json
from collections import UserDict
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ..arguments import checks_calls
from ..errors import Named, UnknownName
from ..results.frames import data_frame, data_set
from ..results.losses import losses
from ..results.result import Values, finite
from ..running import program
from ..running.pool import DONE
from ..terminal import html_table, millijoules, number
from .grid import is_seed, shown

RENAMED = {"surface.rms": "realised_rms", "surface.rms_slope": "realised_rms_slope"}
"""Columns of a result whose path in result.json is that of a key of the scene."""
SLIDE, SEGMENT = "slide.", "segments[]."
"""Beginnings of the columns of a path's last slide that has a mean friction, and of their paths in result.json."""
RENAMED_BACK = {column: path for path, column in RENAMED.items()}
AREA, CONTACT, SITES = "nominal area", "area in contact of a sphere", "all sites of the lowest layer"
"""What numbers of a result are over, as program.quantity() says it."""


@functools.cache
def over_flat(path: str) -> bool:
    """Returns True if a number of a result is an energy for which the table has a column with the ratio to Δγ."""
    known = program.quantity(path)
    return known["unit"] == "meV/Å^2" and known["per"] in (AREA, CONTACT) and path != "delta_gamma" and \
        "uncertainty" not in path


@functools.cache
def of_area(column: str) -> bool:
    """Returns True if a column is a value per nominal area, which has no meaning for a sphere, or a mean over all sites."""
    path = column.removesuffix("_ratio")
    return not path.startswith("theory.") and program.quantity(path)["per"] in (AREA, SITES) or \
        path == "relaxed.mean_height"


def unit_of(column: str) -> str:
    """Returns the unit of a column, a key of the scene or a value of a result."""
    schema = program.schema()
    if column in schema:
        return schema[column]["unit"]
    path = RENAMED_BACK.get(column, column)
    return program.quantity(SEGMENT + path.removeprefix(SLIDE) if path.startswith(SLIDE) else path)["unit"]


def columns_of(result: Values) -> dict[str, float]:
    """Returns the numbers of result.json for the columns of a table."""
    flat = result.number("delta_gamma")
    found: dict[str, float] = {}
    for path, value in result.numbers().items():
        if path.split(".")[0] in ("scene", "units", "failure", "theory", "interface", "run") and path != "run.wall_seconds":
            continue
        found[RENAMED.get(path, path)] = value
        if flat and over_flat(path):
            found[path + "_ratio"] = value / flat
    if slides := [segment for segment in result.listed("segments", dict) if "steady_friction" in segment]:
        found |= {SLIDE + name: number for name, number in Values(slides[-1]).numbers().items()}
    return found


def _theory_numbers(point: Mapping[str, Any]) -> dict[str, float]:
    """Returns the numbers of a point's theories, with the ratios to their Δγ."""
    numbers = Values({"theory": point["theory"]}).numbers()
    if flat := numbers.get("theory.persson.delta_gamma"):
        for name in ("theory.persson.gamma_eff", "theory.persson.gamma_full_contact"):
            if name in numbers:
                numbers.setdefault(name + "_ratio", numbers[name] / flat)
    if flat := point.get("delta_gamma"):
        for name in ("theory.sphere.maugis_images", "theory.sphere.renormalised"):
            if name in numbers:
                numbers[name + "_ratio"] = numbers[name] / flat
    return numbers


class Average(NamedTuple):
    """A value for each group of points. deviation: standard deviation of the single point (n - 1)."""

    mean: np.ndarray
    deviation: np.ndarray
    points: np.ndarray


@checks_calls
class Columns(Named, UserDict):
    """Columns by name: numpy arrays of numbers (NaN: missing), or lists of strings for keys with words."""

    def __repr__(self) -> str:
        rows = len(next(iter(self.data.values()), ()))
        some = ", ".join(list(self)[:6]) + ", ..." * (len(self) > 6)
        return f"<{type(self).__name__}: {rows} rows, {len(self)} columns: {some}>"

    def _repr_html_(self) -> str:
        names, rows = list(self)[:8], max((len(column) for column in self.values()), default=0)
        def text(value: object) -> str:
            return f"{value:.5g}" if isinstance(value, float) else str(value)

        return html_table(f"{rows} rows, {len(self)} columns", [f"{name}, {self.units[name]}".removesuffix(", ") for name in names],
                          [[text(self[name][i]) for name in names] for i in range(min(rows, 12))])

    def __missing__(self, name: str) -> Any:
        raise UnknownName.among("the table", name, self, what="column")

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column; "" for pure numbers."""
        return {name: "" if name.endswith(".count") else unit_of(name.removesuffix(".deviation")) for name in self}

    def frame(self):
        """Returns the columns as a pandas DataFrame; its attrs["units"] has the unit of each column."""
        return data_frame(self.data, self.units)

    def to_xarray(self):
        """Returns the columns as an xarray Dataset along "point"; attrs["units"] of each has its unit."""
        return data_set({name: (("point",), values) for name, values in self.data.items()}, self.units)


@checks_calls
class Table(Columns):
    """The points of a sweep, a row each: the axes, the numbers of the results, the numbers of the theory.

    groups   points that differ in their seeds only: the values that they share, and their rows
    status   of each point, in a word
    """

    def __init__(self, axes: list[str], points: list[dict[str, Any]], simulated: bool):
        self.axes, self.simulated = axes, simulated
        self.status = [str(p.get("status", "waiting") if simulated else Values(p["theory"]).text("persson.status"))
                       for p in points]
        self._done = np.array([not simulated or status == DONE for status in self.status], bool)
        groups: dict[str, tuple[dict[str, Any], list[int]]] = {}
        for i, point in enumerate(points):
            values = {key: point["set"].get(key) for key in axes if not is_seed(key)}
            groups.setdefault(json.dumps(values), (values, []))[1].append(i)
        self.groups = list(groups.values())
        columns: dict[str, Any] = {}
        for key in axes:
            column = [p["set"].get(key) for p in points]
            numbers = np.array([finite(v, np.nan) for v in column])
            columns[key] = numbers if np.isfinite(numbers).all() else [shown(v) for v in column]
        results = [p.get("result", {}) for p in points] if simulated else []
        theory = [_theory_numbers(point) for point in points]
        for rows in (results, theory):  # in the order of result.json
            for name in dict.fromkeys(name for row in sorted(rows, key=len, reverse=True) for name in row):
                columns[name] = np.array([finite(row.get(name), np.nan) for row in rows])
        super().__init__(columns)

    @property
    def along(self) -> str | None:
        """The key along x: the numeric key with the most values."""
        numbers = [k for k in self.axes if not is_seed(k) and isinstance(self[k], np.ndarray) and len(self[k])]
        return max(numbers, key=lambda k: len(set(self[k])), default=None)

    def counted(self, name: str) -> np.ndarray:
        """Returns a column, with NaN for unfinished points; columns of the theory are complete."""
        return self[name] if name.startswith("theory.") else np.where(self._done, self[name], np.nan)

    def column(self, name: str) -> np.ndarray:
        """Returns a column, with NaN for meaningless or missing values; "-name": with reversed sign."""
        if name.startswith("-"):
            return -self.column(name[1:])
        found = self.counted(name) if name in self else np.full(len(self.status), np.nan)
        sphere = self.get("contact_radius.relaxed")
        if sphere is None or not of_area(name):
            return found
        return np.where(np.isfinite(sphere), np.nan, found)

    def at(self, key: str) -> np.ndarray:
        """Returns the value of a key for each group; NaN if it is no number."""
        return np.array([finite(values.get(key), np.nan) for values, _ in self.groups])

    def average(self, values: np.ndarray) -> Average:
        """Averages over the points of each group that have a number."""
        there = [(v := values[rows])[np.isfinite(v)] for _, rows in self.groups]
        return Average(np.array([v.mean() if len(v) else np.nan for v in there]),
                       np.array([v.std(ddof=1) if len(v) > 1 else np.nan for v in there]),
                       np.array([len(v) for v in there]))

    def averages(self) -> dict[str, Average]:
        """Averages every column that is no axis; results over the finished points."""
        return {name: self.average(self.counted(name)) for name in self if name not in self.axes}

    def means(self) -> Columns:
        """Returns one row for each group: mean, .deviation and .count of every column."""
        columns: dict[str, Any] = {}
        for key in (key for key in self.axes if not is_seed(key)):
            column = [self[key][rows[0]] for _, rows in self.groups]
            columns[key] = np.array(column) if isinstance(self[key], np.ndarray) else column
        for name, (mean, deviation, count) in self.averages().items():
            columns |= {name: mean, name + ".deviation": deviation, name + ".count": count}
        return Columns(columns)

    def frame(self):
        """Returns the table as a pandas DataFrame with the column "status" ("done", "failed", "waiting")."""
        return super().frame().assign(status=self.status)


BOTH = ", meV/Å² (mJ/m²)"
# The table as text: head, column and digits; columns without numbers are left out.
OF_SIMULATION = (("state", "binding_energy_ratio", 4), ("interface, in", "work_of_interface.approach_ratio", 4),
                 ("interface, out", "work_of_interface.pull_off_ratio", 4),
                 ("drive, in", "work_of_drive.approach_ratio", 4), ("drive, out", "work_of_drive.pull_off_ratio", 4),
                 ("JKR in", "jkr.approach_ratio", 4), ("JKR out", "jkr.pull_off_ratio", 4), ("contact", "contact_fraction", 4),
                 ("contact area", "contact_area", 4),
                 ("radius, Å", "contact_radius.relaxed", 1), ("friction μ", "slide.friction_coefficient", 4),
                 ("±", "slide.friction_coefficient_error", 4), ("sliding A/A0", "slide.steady_contact_area", 4),
                 ("theory μ", "theory.sliding.friction_coefficient", 4), ("theory A/A0", "theory.sliding.contact_fraction", 4),
                 ("lost" + BOTH, "lost.cycle", 4),
                 ("theory", "theory.persson.gamma_eff_ratio", 4), ("theory, contact", "theory.persson.contact_fraction", 4),
                 ("renormalised", "theory.renormalised.gamma_eff_ratio", 4))
OF_THEORY = tuple((head, "theory." + name, digits) for head, name, digits in (
    ("γ_eff" + BOTH, "persson.gamma_eff", 3), ("γ_eff/Δγ", "persson.gamma_eff_ratio", 5),
    ("A/A0", "persson.contact_fraction", 5), ("full contact", "persson.gamma_full_contact_ratio", 5),
    ("renormalised", "renormalised.gamma_eff_ratio", 5), ("friction μ", "sliding.friction_coefficient", 5),
    ("sliding A/A0", "sliding.contact_fraction", 5)))


OF_ADHESION = ("theory.persson.", "theory.renormalised.")
"""Beginnings of columns that the text of a sweep over slides leaves out."""


def _status(words: list[str]) -> str:
    """Returns the status of several points, "3 done" or "2 done, 1 failed", or the word of a single point."""
    if len(words) == 1:
        return words[0]
    return ", ".join(f"{words.count(word)} {word}" for word in dict.fromkeys(words))


def text_of(table: Table) -> tuple[list[str], list[list[str]], str]:
    """Returns a table as text."""
    axes = [key for key in table.axes if not is_seed(key)]
    slides = np.isfinite(table.column("theory.sliding.friction_coefficient")).any()  # in place of theories of adhesion
    shown_columns = OF_SIMULATION if table.simulated else OF_THEORY
    at = [name for _, name, _ in OF_SIMULATION].index("lost.cycle") + 1
    others = [(f"in the {place}" + BOTH, name + ".cycle", 4) for place, name in losses(table).items()]
    cells = [(head, table.average(column), digits)
             for head, name, digits in (*shown_columns[:at], *others, *shown_columns[at:])
             if np.isfinite(column := table.column(name)).any() and not (slides and name.startswith(OF_ADHESION))]
    rows = []
    for group, (values, places) in enumerate(table.groups):
        row = [shown(values[key]) for key in axes]
        for head, (mean, deviation, count), digits in cells:
            seen = deviation[group] > min(0.5 * 10.0**-digits, 5e-4 * abs(mean[group]))
            row.append((number(float(mean[group]), digits) if count[group] else "-") +
                       (f" ± {number(float(deviation[group]), digits)}" if seen else "") +
                       (f" ({millijoules(float(mean[group]))})" if head.endswith(BOTH) and count[group] else ""))
        rows.append([*row, _status([table.status[i] for i in places])])
    meaning = ("binding energy of the state, and works of interface and drive on the solids in approach (in) and pull-off (out), "
               "over Δγ; the drive's is negative where it is pulled, the interface's where it pulls") if table.simulated else ""
    if meaning and len(axes) < len(table.axes):
        meaning += ", mean ± standard deviation over the seeds"
    return [*axes, *(c[0] for c in cells), ""], rows, meaning
