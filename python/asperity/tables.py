# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The tables of a sweep: columns, means over the seeds, sweep.csv, sweep-mean.csv, sweep.json, sweep.h5."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import h5py
import numpy as np

from . import files, program, terminal
from .grid import is_seed, shown
from .pool import DONE
from .result import Values

if TYPE_CHECKING:
    from .sweeps import Sweep

RENAMED = {"surface.rms": "realised_rms", "surface.rms_slope": "realised_rms_slope"}
"""Columns of a result whose path in result.json is that of a key of the scene."""
RENAMED_BACK = {column: path for path, column in RENAMED.items()}
FIRST = ("delta_gamma", "binding_energy", "work_of_adhesion.approach", "work_of_adhesion.pull_off",
         "work_of_adhesion.pairwise", "contact_fraction", "pushed_fraction", "pull_off_force", "jkr.in", "jkr.out",
         "jkr.in_averaged", "jkr.out_averaged", "sphere.maugis_images", "contact_radius.zero_load",
         "contact_radius.pull_off", "hysteresis.loop", "hysteresis.approach", "hysteresis.pull_off", "realised_rms",
         "realised_rms_slope", "energy.residual", "run.wall_seconds")
"""Columns of results that come first; whatever else result.json holds follows."""
THEORY_FIRST = ("delta_gamma", "gamma_eff", "gamma_eff_ratio", "contact_fraction", "gamma_full_contact",
                "gamma_full_contact_ratio", "theta", "gamma_eff_ratio_error", "contact_fraction_error")


def unit_of(column: str) -> str:
    """The unit of a column, a key of the scene or a value of a result."""
    schema = program.schema()
    if column in schema:
        return schema[column]["unit"]
    path = RENAMED_BACK.get(column, column)
    return program.quantity(path)["unit"] or program.quantity("theory." + path)["unit"]


def theory_numbers(point: Mapping[str, Any]) -> dict[str, float]:
    """The numbers of a point's theory, with the ratios to its Δγ."""
    numbers = Values(point["theory"]).numbers()
    flat = numbers.get("delta_gamma")
    if flat:
        if "gamma_eff" in numbers:
            numbers.setdefault("gamma_eff_ratio", numbers["gamma_eff"] / flat)
        if "gamma_full_contact" in numbers:
            numbers["gamma_full_contact_ratio"] = numbers["gamma_full_contact"] / flat
    return numbers


def status_of(point: Mapping[str, Any], simulated: bool) -> str:
    return str(point.get("status", "waiting") if simulated else point["theory"].get("status", ""))


def groups_of(axes: list[str], points: list[dict[str, Any]]) -> list[tuple[dict[str, Any], list[int]]]:
    """Points that differ in their seeds only: what they share, and their places."""
    found: dict[str, tuple[dict[str, Any], list[int]]] = {}
    for i, point in enumerate(points):
        values = {key: point["set"].get(key) for key in axes if not is_seed(key)}
        found.setdefault(json.dumps(values), (values, []))[1].append(i)
    return list(found.values())


@dataclass
class Spread:
    """Over the points that have a number; deviation: standard deviation of the single point (n - 1)."""

    count: int
    mean: float
    deviation: float


def spread_of(values: Iterator[float] | list[float]) -> Spread:
    there = [v for v in values if math.isfinite(v)]
    if not there:
        return Spread(0, math.nan, math.nan)
    mean = sum(there) / len(there)
    if len(there) < 2:
        return Spread(1, mean, math.nan)
    return Spread(len(there), mean, math.sqrt(sum((v - mean) * (v - mean) for v in there) / (len(there) - 1)))


def number(value: Any) -> float:
    """NaN for what is no number."""
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan


class Table(Mapping):
    """Columns by name: numpy arrays of numbers (NaN: none) or, of keys that are words, lists of strings."""

    def __init__(self, axes: list[str], columns: dict[str, Any], groups: list, status: list[str]):
        self.axes, self._columns, self._groups, self.status = axes, columns, groups, status

    @classmethod
    def of_points(cls, axes: list[str], points: list[dict[str, Any]], simulated: bool) -> Table:
        columns: dict[str, Any] = {}
        for key in axes:
            values = [p["set"].get(key) for p in points]
            numbers = np.array([number(v) for v in values])
            columns[key] = numbers if np.isfinite(numbers).all() else [shown(v) for v in values]

        def add(rows: list[dict[str, float]], first: tuple[str, ...], prefix: str = "") -> None:
            names = dict.fromkeys(name for row in rows for name in row)
            order = [n for f in first for n in (f, f + "_ratio") if n in names]
            for name in dict.fromkeys([*order, *names]):
                columns[prefix + name] = np.array([number(row.get(name)) for row in rows])

        if simulated:
            add([p.get("result", {}) for p in points], FIRST)
        add([theory_numbers(p) for p in points], THEORY_FIRST, "theory." if simulated else "")
        return cls(axes, columns, groups_of(axes, points), [status_of(p, simulated) for p in points])

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def units(self) -> dict[str, str]:
        return {name: unit_of(name) for name in self}

    @property
    def numbers(self) -> list[str]:
        """The columns that are no axes."""
        return [name for name in self if name not in self.axes]

    def spreads(self, name: str) -> list[Spread]:
        """Of a column, over the seeds of each group."""
        return [spread_of([self[name][i] for i in places]) for _, places in self._groups]

    def means(self) -> Table:
        axes = [key for key in self.axes if not is_seed(key)]
        columns: dict[str, Any] = {key: [self[key][places[0]] for _, places in self._groups] for key in axes}
        for name in self.numbers:
            spreads = self.spreads(name)
            columns[name] = np.array([s.mean for s in spreads])
            columns[name + ".deviation"] = np.array([s.deviation for s in spreads])
            columns[name + ".count"] = np.array([s.count for s in spreads])
        return Table(axes, columns, [], [])

    def frame(self):
        """The columns as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame({**self._columns, **({"status": self.status} if self.status else {})})


def _field(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if any(c in text for c in ',"\n') else text


def _number(value: float) -> str:
    return f"{value:.10g}" if math.isfinite(value) else ""


def _cell(value: Any) -> str:
    return _field(value if isinstance(value, str) else shown(float(value)))


def csv_of(table: Table) -> str:
    """One line a point under one line of names."""
    lines = [",".join([*(_field(n) for n in table), "status"])]
    for i, status in enumerate(table.status):
        cells = [_cell(table[n][i]) if n in table.axes else _number(table[n][i]) for n in table]
        lines.append(",".join([*cells, status]))
    return "\n".join(lines) + "\n"


def mean_csv_of(table: Table) -> str:
    """One line for all seeds: mean and standard deviation of every column, and how many points are done."""
    axes = [key for key in table.axes if not is_seed(key)]
    heads = [_field(key) for key in axes] + [h for n in table.numbers for h in (n, n + ".deviation")]
    lines = [",".join([*heads, "points"])]
    spreads = {name: table.spreads(name) for name in table.numbers}
    for g, (_, places) in enumerate(table._groups):
        cells = [_cell(table[key][places[0]]) for key in axes]
        for name in table.numbers:
            cells += [_number(spreads[name][g].mean), _number(spreads[name][g].deviation)]
        lines.append(",".join([*cells, str(sum(table.status[i] == DONE for i in places))]))
    return "\n".join(lines) + "\n"


def json_of(sweep: Sweep) -> dict[str, Any]:
    """sweep.json: everything the report and the plots of a sweep are made from."""
    points = sweep.points
    if sweep.simulated:  # in a fixed order, whatever was filled in when
        order = ("set", "delta_gamma", "theory", "directory", "status", "failure", "result")
        points = [{name: point[name] for name in order if name in point} for point in points]
    found: dict[str, Any] = {"name": sweep.name, "scene": sweep.scene, "axes": sweep.axes, "points": points}
    if sweep.theory:
        found["theory"] = sweep.theory
    if sweep.simulated:
        table = sweep.table
        spreads = {name: table.spreads(name) for name in table.numbers}
        found["means"] = []
        for g, (values, _) in enumerate(table._groups):
            line: dict[str, Any] = {"set": values}
            for name, of_groups in spreads.items():
                spread = of_groups[g]
                if spread.count:
                    line[name] = {"mean": spread.mean}
                    if spread.count > 1:
                        line[name]["deviation"] = spread.deviation
                    line[name]["count"] = spread.count
            found["means"].append(line)
    if sweep.notes:
        found["notes"] = sweep.notes
    found["run"] = {**sweep.run, **_build()}
    return found


@functools.lru_cache(maxsize=None)
def _build() -> dict[str, str]:
    """Version, git, compiler and flags of the program."""
    lines = (line.split(None, 1) for line in program.call(["info"]).splitlines()[1:])
    found = {line[0]: line[1].strip() for line in lines if len(line) == 2}
    return {name: found[name] for name in ("version", "git", "compiler", "flags") if name in found}


def write_hdf5(path: Path, table: Table) -> None:
    """sweep.h5: /points and /means, a data set a column with its unit; words as attributes of the groups."""
    with files.replacing(path) as beside, h5py.File(beside, "w") as file:
        for group, columns in (("points", table), ("means", table.means())):
            made = file.create_group(group)
            for name, values in columns.items():
                if len(values) and isinstance(values[0], str):
                    made.attrs[name] = np.array(values, dtype=h5py.string_dtype())
                    continue
                made.create_dataset(name, data=np.asarray(values, float)).attrs["unit"] = \
                    "" if name.endswith(".count") else unit_of(name.removesuffix(".deviation"))


def write_tables(sweep: Sweep) -> None:
    """The tables as they are at this moment. sweep.json is written last."""
    place, table = files.directory(sweep.directory), sweep.table
    files.write(place / "sweep.csv", csv_of(table))
    if sweep.simulated and any(is_seed(key) for key in sweep.axes):
        files.write(place / "sweep-mean.csv", mean_csv_of(table))
    write_hdf5(place / "sweep.h5", table)
    files.write(place / "sweep.json", files.sealed_json(json_of(sweep)))


# The table as text: what stands in a terminal and in a report.

def _flat_only(table: Table, values: np.ndarray) -> np.ndarray:
    """The nominal area of a sphere means nothing."""
    radius = table.get("contact_radius.zero_load")
    return values if radius is None else np.where(np.isfinite(radius), np.nan, values)


def _cells(table: Table, simulated: bool) -> list[tuple[str, np.ndarray, int]]:
    """Heads, columns and digits."""
    def column(name: str) -> np.ndarray:
        return table.get(name, np.full(len(table.status), np.nan))

    before = "theory." if simulated else ""
    theory = [("theory" if simulated else "γ_eff/Δγ", column(before + "gamma_eff_ratio"), 4 if simulated else 5),
              ("its contact" if simulated else "A/A0", column(before + "contact_fraction"), 4 if simulated else 5)]
    renormalised = [("renormalised", column(before + "renormalised.gamma_eff_ratio"), 4 if simulated else 5)]
    if simulated:
        cells = [(head, _flat_only(table, column(name)) if flat else column(name), digits)
                 for head, name, digits, flat in (
                     ("state", "binding_energy_ratio", 4, True), ("approach", "work_of_adhesion.approach_ratio", 4, True),
                     ("pull-off", "work_of_adhesion.pull_off_ratio", 4, True), ("JKR in", "jkr.in_ratio", 4, False),
                     ("JKR out", "jkr.out_ratio", 4, False), ("contact", "contact_fraction", 4, True),
                     ("radius, Å", "contact_radius.zero_load", 1, False), ("loop, eV", "hysteresis.loop", 1, False))]
        cells = [c for c in [*cells, *renormalised] if np.isfinite(c[1]).any()]
        return [*cells[:-1], *theory, cells[-1]] if cells and cells[-1][0] == "renormalised" else [*cells, *theory]
    cells = [("γ_eff, meV/Å²", column("gamma_eff"), 3), *theory,
             ("full contact", column("gamma_full_contact_ratio"), 5)]
    return cells + [c for c in renormalised if np.isfinite(c[1]).any()]


def _status(words: list[str]) -> str:
    """"3 done", "2 done, 1 failed"; of one point its word."""
    if len(words) == 1:
        return words[0]
    return ", ".join(f"{words.count(word)} {word}" for word in dict.fromkeys(words))


def text_of(sweep: Sweep) -> tuple[list[str], list[list[str]], str]:
    """Heads, a row for all seeds of a point, and what the numbers are."""
    table = sweep.table
    axes = [key for key in sweep.axes if not is_seed(key)]
    cells = _cells(table, sweep.simulated)
    rows = []
    for values, places in table._groups:
        row = [shown(values[key]) for key in axes]
        for _, column, digits in cells:
            spread = spread_of([column[i] for i in places])
            text = f"{spread.mean:.{digits}f}" if spread.count else "-"
            if spread.deviation > 0.5 * 10.0**-digits:
                text += f" ± {spread.deviation:.{digits}f}"
            row.append(text)
        rows.append([*row, _status([table.status[i] for i in places])])
    meaning = "binding energies and works of adhesion over Δγ" if sweep.simulated else ""
    if meaning and len(axes) < len(sweep.axes):
        meaning += ", mean ± standard deviation over the seeds"
    return [*axes, *(c[0] for c in cells), ""], rows, meaning


def print_table(sweep: Sweep, say: Callable[[str], None] = print) -> None:
    """The table on the terminal: twenty lines show as much as a hundred; the files have them all."""
    heads, rows, meaning = text_of(sweep)
    stride = max(1, (len(rows) + 19) // 25)
    if meaning:
        say(f"{sweep.name}: {meaning}")
    say(terminal.table(heads, [r for i, r in enumerate(rows) if i % stride == 0 or i + 1 == len(rows)],
                       left=(0, len(heads) - 1)))
    if stride > 1:
        say(f"  (every {stride}th of {len(rows)} lines; all are in the files)")
