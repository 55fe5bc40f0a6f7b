# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: what accuracy costs in time for a scene.

Runs the reference, the scene as it is, every value of every knob (cost_knobs.py), and then combinations: of
each knob the cheapest value whose own error is within the target's share. Each is a process of its own with
one thread, in a directory of its own; those that are there are not run again.
"""

from __future__ import annotations

import difflib
import json
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import files, program, terminal
from .cost_knobs import CostCase, Knob, KnobValue, Setting, cost_case, joined
from .errors import SceneError
from .pool import DONE, FAILED, STOPPED, WAITING, Job, Outcome, Pool, PoolOptions, look_at
from .result import Values

QUANTITIES = ("gamma", "contact", "approach", "pull-off", "force")
"""What is judged: binding energy at zero load over flat, contact fraction there, works of the two legs over flat,
largest attraction of the pull-off (eV/Å). Energies are compared over the flat reference of the same interaction, so
that a cutoff is not blamed for the adhesion that it takes from both."""
QUESTIONS = ("state", "path")
"""What a setting can be asked for: the relaxed state (gamma and contact), or all of the path too."""
ASKED = {"state": 2, "path": len(QUANTITIES)}
TARGETS = (0.05, 0.01, 0.001)
NAN = math.nan


def numbers_of(result: Values) -> list[float]:
    """One number a quantity; NaN: none."""
    def number(key: str) -> float:
        value = result.number(key)
        return NAN if value is None else value
    flat = number("delta_gamma") or NAN
    return [number("binding_energy") / flat, number("contact_fraction"), number("work_of_adhesion.approach") / flat,
            number("work_of_adhesion.pull_off") / flat, number("pull_off_force")]


def errors_of(measured: list[float], reference: list[float]) -> list[float]:
    """Relative and with their signs."""
    return [(m - r) / abs(r) if r else NAN for m, r in zip(measured, reference)]


def largest_error(measured: list[float], reference: list[float], question: str) -> float:
    """Without sign, of the quantities that the reference has. NaN: the measured run lacks one of them."""
    if question == "path" and all(math.isnan(r) for r in reference[2:]):
        return NAN  # a reference that followed no path says nothing of one
    pairs = list(zip(errors_of(measured, reference), reference))[: ASKED[question]]
    errors = [abs(e) for e, r in pairs if r and not math.isnan(r)]
    return max(errors) if errors and not any(math.isnan(e) for e in errors) else NAN


def pareto_front(seconds: list[float], errors: list[float]) -> list[bool]:
    """Which of them are beaten by no other in time and error at once; NaN is never among them."""
    def beaten(i: int) -> bool:
        return any(s <= seconds[i] and e <= errors[i] and (s < seconds[i] or e < errors[i])
                   for s, e in zip(seconds, errors))
    return [not (math.isnan(s) or math.isnan(e) or beaten(i)) for i, (s, e) in enumerate(zip(seconds, errors))]


def cheapest_within(seconds: list[float], errors: list[float], target: float) -> int | None:
    """The one of the least time with an error within the target."""
    there = [i for i, e in enumerate(errors) if e <= target]
    return min(there, key=lambda i: seconds[i], default=None)


def order_of(x: list[float], errors: list[float], x0: float | None, floor: float = 1e-6) -> float | None:
    """error = c |x^p - x0^p|: the power p that fits best (least squares of the logarithms).

    x0: the knob of the run that the errors are measured against; None: nothing is left of the error there. Errors that
    are NaN or below `floor` are left out. 0.05 <= |p| <= 8, positive where the error grows with x.
    """
    points = [(v, abs(e)) for v, e in zip(x, errors) if abs(e) > floor and v > 0 and v != x0]
    if len({v for v, _ in points}) < 2:
        return None

    def misfit(p: float) -> float:
        rest = x0**p if x0 is not None else 0.0
        try:
            d = [math.log(e) - math.log(abs(v**p - rest)) for v, e in points]
        except ValueError:
            return math.inf
        mean = sum(d) / len(d)
        return sum(v * v for v in d) / len(d) - mean * mean

    return min((s * 0.01 * i for i in range(5, 801) for s in (1, -1)), key=misfit)


@dataclass
class CostRow:
    """A setting that was run. knob: its name, or "reference", "scene", "combination"."""

    knob: str
    label: str
    setting: Setting
    """in full"""
    own: Setting
    """the part of it that is the knob's value"""
    x: float = 0.0
    judged: bool = True
    """its error is one of settings: not the reference, not another solid"""
    outcome: Outcome = field(default_factory=Outcome)
    numbers: list[float] = field(default_factory=lambda: [NAN] * len(QUANTITIES))
    own_error: list[float] = field(default_factory=lambda: [NAN] * len(QUANTITIES))
    error: dict[str, float] = field(default_factory=lambda: dict.fromkeys(QUESTIONS, NAN))
    front: dict[str, bool] = field(default_factory=lambda: dict.fromkeys(QUESTIONS, False))
    seconds: float = NAN
    """of the processor"""
    wall: float = NAN


@dataclass
class Cost:
    """The rows: the first is the reference, the second the scene itself."""

    name: str
    scene: dict[str, Any]
    case: CostCase
    rows: list[CostRow] = field(default_factory=list)
    orders: list[tuple[Knob, list[float | None]]] = field(default_factory=list)
    cheapest: dict[str, list[int | None]] = field(default_factory=dict)

    def answered(self, question: str) -> bool:
        return any(r.judged and not math.isnan(r.error[question]) for r in self.rows)

    def twin_of(self, knob: Knob) -> CostRow | None:
        return next((r for r in self.rows if knob.twin and r.knob == knob.name and r.own == knob.twin.setting), None)

    def judge(self) -> None:
        """Errors, fronts, orders and cheapest settings of the rows that are there."""
        for row in self.rows:
            row.error = {q: largest_error(row.numbers, self.rows[0].numbers, q) for q in QUESTIONS}
            row.own_error = [NAN] * len(QUANTITIES)
        seconds = [r.seconds for r in self.rows]
        for question in QUESTIONS:
            errors = [r.error[question] if r.judged else NAN for r in self.rows]
            for row, front in zip(self.rows, pareto_front(seconds, errors)):
                row.front[question] = front
            self.cheapest[question] = [cheapest_within(seconds, errors, t) for t in TARGETS]
        self.orders = []
        for knob in self.case.knobs:
            twin = self.twin_of(knob)
            if twin is None or knob.twin is None:
                continue
            others = [r for r in self.rows if r.knob == knob.name and r is not twin]
            for row in others:
                row.own_error = errors_of(row.numbers, twin.numbers)
            x0 = None if knob.twin_is_exact else knob.twin.x
            self.orders.append((knob, [order_of([r.x for r in others], [r.own_error[q] for r in others], x0)
                                       for q in range(len(QUANTITIES))]))

    def _cheapest_of_part(self, part: str, question: str, share: float) -> CostRow | None:
        """Of a part's knobs the cheapest value whose own error is within the share."""
        found = []
        for knob in self.case.knobs:
            twin = self.twin_of(knob)
            if knob.part != part or twin is None:
                continue
            found += [r for r in self.rows if r.knob == knob.name
                      and not (r is twin and knob.name == "velocity")  # it is another base
                      and largest_error(r.numbers, twin.numbers, question) <= share]
        return min(found, key=lambda r: r.seconds, default=None)

    def combinations(self) -> list[CostRow]:
        """Of each base and target the cheapest values together."""
        found: list[CostRow] = []
        there = {knob.part for knob in self.case.knobs}
        for base in self.case.bases:
            question = "state" if base.label == "zero load alone" else "path"
            for target in TARGETS:
                row = CostRow("combination", base.label, base.setting, [])
                chosen = [self._cheapest_of_part(part, question, target / len(base.parts))
                          for part in base.parts if part in there]
                if any(c is None for c in chosen):
                    continue
                for one in chosen:
                    row.setting = joined(row.setting, one.own)
                    row.label += ", " + one.label
                if all(row.setting != other.setting for other in found):
                    found.append(row)
        return found


@dataclass
class CostOptions:
    scene: str
    overrides: list[str] = field(default_factory=list)
    knobs: list[str] = field(default_factory=list)
    out: str = ""
    jobs: int = 1
    progress: str = "auto"


class _Runs:
    """Settings that make the same scene are one run."""

    def __init__(self, options: CostOptions, directory: Path):
        self.options, self.directory = options, directory
        self.made: dict[str, Job] = {}

    def run(self, rows: list[CostRow]) -> bool:
        """Runs the rows and fills in their numbers. False: stopped before the end."""
        # Maps and frames would be timed too.
        common = joined(self.options.overrides, ["output.fields=zero-load", "output.trajectory=none"])
        overrides = [joined(common, row.setting) for row in rows]
        points = program.theory_points(self.options.scene, overrides, runnable=True)
        program.complaints(points)
        jobs: list[Job] = []
        of_row = []
        for row, given, point in zip(rows, overrides, points):
            name = ",".join(one.partition(".")[2] for one in sorted(row.setting)) or "scene"
            job = self.made.setdefault(json.dumps(point["scene"]),
                                       Job(name, self.directory / name, self.options.scene, given, point["scene"]))
            if job not in jobs:
                jobs.append(job)
            of_row.append(jobs.index(job))
        outcomes = [look_at(job) for job in jobs]
        there = sum(o.status != WAITING for o in outcomes)
        print(f"{len(jobs)} runs in {self.directory}" + (f"; {there} are there already" if there else ""), flush=True)
        complete = Pool(jobs, outcomes, PoolOptions(self.options.jobs, 1, [], None, self.options.progress)).run()
        for row, i in zip(rows, of_row):
            row.outcome = outcomes[i]
            if row.outcome.status == DONE:
                result = row.outcome.result
                row.numbers = numbers_of(result)
                row.seconds, row.wall = (NAN if (v := result.number(k)) is None else v
                                         for k in ("run.processor_seconds", "run.wall_seconds"))
        return complete


def _chosen(knobs: list[Knob], names: list[str]) -> list[Knob]:
    there = [knob.name for knob in knobs]
    for name in names:
        if name not in there:
            near = difflib.get_close_matches(name, there, 1)
            raise SceneError(f"--knobs {name}", "is no knob of this scene", "knobs: " + ", ".join(there),
                             f"did you mean {near[0]}?" if near else "leave --knobs out for all of them")
    return [knob for knob in knobs if not names or knob.name in names]


def _row(knob: Knob, value: KnobValue) -> CostRow:
    return CostRow(knob.name, value.label, joined(knob.base, value.setting), value.setting, value.x,
                   judged=knob.name != "thickness")


def cost_command(options: CostOptions) -> int:
    """Returns the exit code: 75 if stopped before the end, that of the reference if it failed."""
    if "OMPI_COMM_WORLD_SIZE" in os.environ:
        raise SceneError("asperity cost", "it is not started under mpirun", "it starts its runs itself, each with one "
                         "thread, so that their times can be compared",
                         "asperity cost SCENE --jobs 2 runs two side by side")
    found = program.check(options.scene, options.overrides)
    case = cost_case(found["scene"], found.get("longest_timestep", 0.0))
    if found["problems"]:
        raise SceneError("\n".join(found["problems"]))
    case.knobs = _chosen(case.knobs, options.knobs)
    cost = Cost(found["name"], found["scene"], case)
    cost.rows = [CostRow("reference", "reference", case.reference, case.reference, judged=False),
                 CostRow("scene", "as it is", [], [])]
    cost.rows += [_row(knob, value) for knob in case.knobs
                  for value in [*knob.values, *([knob.twin] if knob.twin else [])]]
    directory = Path(options.out or f"results/{cost.name}-cost")
    print(f"reference: {case.reference_text}", flush=True)
    runs = _Runs(options, directory)
    complete = runs.run(cost.rows)
    reference = cost.rows[0].outcome
    if complete and reference.status == FAILED:
        print(f"The reference failed, and there is nothing to compare with: {reference.reason}")
        return reference.exit_code
    cost.judge()
    if complete:
        combinations = cost.combinations()
        complete = not combinations or runs.run(combinations)
        cost.rows += combinations
        cost.judge()
    written = write(cost, directory)
    print(text_of(cost))
    print(f"in {directory}:" + "".join(f" {name}" for name in written))
    if complete:
        return 0
    print("Stopped early: the same command goes on from here.")
    return STOPPED


# What is left behind.

def setting_text(row: CostRow) -> str:
    return "--set " + " ".join(row.setting) if row.setting else "the scene as it is"


def csv_of(cost: Cost) -> str:
    def number(value: float) -> str:
        return f"{value:.10g}" if math.isfinite(value) else ""
    lines = [",".join(["knob", "value", "setting", "processor_seconds", "wall_seconds", "ratio", *QUANTITIES,
                       *(f"error_{q}" for q in QUESTIONS), *(f"own_{q}" for q in QUANTITIES),
                       *(f"front_{q}" for q in QUESTIONS)])]
    scene = cost.rows[1].seconds or NAN
    for row in cost.rows:
        values = [row.seconds, row.wall, row.seconds / scene, *row.numbers, *row.error.values(), *row.own_error]
        lines.append(",".join([f'"{row.knob}"', f'"{row.label}"', f'"{" ".join(row.setting)}"', *map(number, values),
                               *(str(int(f)) for f in row.front.values())]))
    return "\n".join(lines) + "\n"


def json_of(cost: Cost) -> dict[str, Any]:
    def known(value: float | None) -> float | None:
        return None if value is None or not math.isfinite(value) else value

    def by_quantity(values: list) -> dict[str, float | None]:
        return {name: known(v) for name, v in zip(QUANTITIES, values)}

    settings = []
    for row in cost.rows:
        settings.append({"knob": row.knob, "value": row.label, "set": row.setting, "processor_seconds": known(row.seconds),
                         "wall_seconds": known(row.wall), "measured": by_quantity(row.numbers),
                         "error": {q: known(e) for q, e in row.error.items()}, "own_error": by_quantity(row.own_error),
                         "pareto": dict(row.front)})
        if row.outcome.status == FAILED:
            settings[-1]["failed"] = row.outcome.reason
    orders = []
    for knob, measured in cost.orders:
        orders.append({"knob": knob.name, "expected": knob.expected})
        if knob.order is not None:
            orders[-1]["expected_order"] = knob.order
        orders[-1]["measured"] = by_quantity(measured)
    cheapest: dict[str, list] = {}
    for question, places in cost.cheapest.items():
        for target, i in zip(TARGETS, places):
            if i is not None:
                row = cost.rows[i]
                cheapest.setdefault(question, []).append({
                    "target": target, "set": setting_text(row), "error": row.error[question],
                    "processor_seconds": row.seconds})
    return {"scene": cost.scene, "reference": cost.case.reference_text, "settings": settings, "orders": orders,
            "cheapest": cheapest}


def write(cost: Cost, directory: Path) -> list[str]:
    """Names of the files written."""
    from .plots import cost as plots
    from .plots import files as figures

    files.directory(directory)
    written = ["cost.csv", "cost.json"]
    files.write(directory / "cost.csv", csv_of(cost))
    for question in QUESTIONS:
        if cost.answered(question):
            fig = figures.make(lambda ax: plots.error_against_time(cost, question, ax))
            if fig is not None:
                figures.save(fig, directory / f"cost-{question}")
                written.append(f"cost-{question}.svg")
    files.write(directory / "cost.json", json.dumps(json_of(cost), indent=2, ensure_ascii=False) + "\n")
    return written


def percent(error: float) -> str:
    """A relative error in percent with two digits: "0.83", "-0.0012"; "-": none."""
    if math.isnan(error):
        return "-"
    if error == 0:
        return "0"
    digits = min(6, max(0, 1 - math.floor(math.log10(abs(100 * error)))))
    return f"{100 * error:.{digits}f}"


def text_of(cost: Cost) -> str:
    """The tables on the terminal."""
    parts = ["\nErrors in %, against the reference: γ and works over flat on flat. * marks what nothing beats in both "
             "time\nand error: first star the state at zero load (γ, contact), second the whole path. The last of a knob "
             "is the one its own error is taken against.\n"]
    rows: list[list[str]] = []
    last = ""
    for row in cost.rows:
        if row.knob != last and last:
            rows.append([])
        cells = ["" if row.knob == last else row.knob, row.label]
        last = row.knob
        if row.outcome.status == FAILED:
            rows.append([*cells, "failed"])
            continue
        ratio = row.seconds / cost.rows[1].seconds if cost.rows[1].seconds else NAN
        rows.append([*cells, *map(percent, errors_of(row.numbers, cost.rows[0].numbers)),
                     "-" if math.isnan(row.seconds) else f"{row.seconds:.2f} s",
                     f"{ratio:.2f}" if math.isfinite(ratio) else "-",
                     "".join("*" if f else " " for f in row.front.values())])
    parts.append(terminal.table(["knob", "value", "γ", "contact", "in", "out", "force", "processor", "to scene", ""], rows,
                                left=(0, 1)))
    if cost.orders:
        parts.append("\nOrder of each knob's own error (all else as in the scene): the power of the knob that fits it.\n")
        parts.append(terminal.table(["knob", "γ", "contact", "in", "out", "force", "expected"],
                                    [[knob.name, *("-" if p is None else f"{p:.1f}" for p in measured), knob.expected]
                                     for knob, measured in cost.orders], left=(0, 6)))
    for question, what in zip(QUESTIONS, ("the state at zero load (γ, contact)",
                                          "the whole path (works, pull-off force too)")):
        if not cost.answered(question):
            continue
        parts.append(f"\nCheapest for {what}:")
        for target, i in zip(TARGETS, cost.cheapest[question]):
            row = None if i is None else cost.rows[i]
            parts.append(f"  {100 * target:>4g} %  " + ("none of those that were run" if row is None else
                         f"{row.seconds:.2f} s, error {percent(row.error[question])} %: {setting_text(row)}"))
    if not cost.answered("path"):
        parts.append("\nThe path was not followed: works and force are not measured.")
    parts += [f"note: {note}" for note in cost.case.notes]
    parts += [f"failed: {r.knob} {r.label}: {r.outcome.reason}" for r in cost.rows if r.outcome.status == FAILED]
    return "\n".join(parts)
