# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity sweep`, `cost` and `estimate`: each carries out, writes, prints, and returns the exit code."""

from __future__ import annotations

from ..plots.sweep import plot_files, write_plots
from ..reports import estimate as report_estimate
from ..reports.cost import FILES, answer_of, text_of, write
from ..running import lock
from ..running.pool import DONE, FAILED, PHYSICS, STOPPED, PoolOptions
from ..studies.cost import Costing, target_of
from ..studies.estimates import Estimating
from ..studies.sweeps import TABLES, Carried


def sweep_command(scenes: list[str], sets: list[str], out: str | None, theory_only: bool, options: PoolOptions) -> int:
    """Carries out `asperity sweep`.

    Parameters
    ----------
    scenes : list[str]
        Scene files.
    sets : list[str]
        Overrides and axes, each "key=values".
    out : str | None
        Result directory; None: the default one.
    theory_only : bool
        True: no simulation.
    options : PoolOptions
        Options of the runs.

    Returns
    -------
    int
        The exit code: 75 if stopped early, else that of the first failure.
    """
    done = Carried(scenes, sets, out, theory_only, options, lambda text: print(text, flush=True), plot_files(not theory_only))
    written, note = write_plots(done.place, done.sweeps)
    for sweep in done.sweeps:
        print()
        sweep.print_table()
        for said in sweep.notes:
            print(f"note: {said}")
        if len(sweep.run.get("programs", {})) > 1:
            print("note: points are by several programs: "
                  + ", ".join(f"{git} ({count})" for git, count in sweep.run["programs"].items()))
    if note:
        print(f"note: {note}")
    failed = [(job, outcome) for job, outcome in zip(done.jobs, done.outcomes) if outcome.status == FAILED]
    for job, outcome in failed:
        print(f"failed: {job.name} (exit {outcome.exit_code}): {outcome.reason}")
    if theory_only:
        print(f"{sum(len(s.points) for s in done.sweeps)} points in {done.place}")
    else:
        print(f"{sum(o.status == DONE for o in done.outcomes)} of {len(done.jobs)} points are done, in {done.place}")
    print(f"tables: {TABLES}" + "; plots: " * bool(written) + " ".join(path.name for path in written))
    if not done.complete:
        print("Stopped early: the same command goes on from here.")
        return STOPPED
    return next((outcome.exit_code for _, outcome in failed), 0)


def cost_command(scene: str, overrides: list[str], parameters: list[str], out: str | None, options: PoolOptions,
                 target: str | None = None) -> int:
    """Carries out `asperity cost`.

    Parameters
    ----------
    scene : str
        Scene file.
    overrides : list[str]
        Overrides.
    parameters : list[str]
        Only these; none: all.
    out : str | None
        Result directory; None: the default one.
    options : PoolOptions
        Options of the runs.
    target : str, optional
        Relative error to keep, "1%".

    Returns
    -------
    int
        The exit code: 75 if stopped early, that of the reference if it failed, 3 if nothing keeps the target.
    """
    def say(text: str) -> None:
        print(text, flush=True)

    costing = Costing(scene, overrides, out, options, parameters, None if target is None else target_of(target), say, FILES)
    cost = costing.cost
    say(f"reference: {costing.case.reference_text}")
    with lock.in_use(costing.place):
        complete = costing.carry_out()
        reference = costing.reference
        if complete and reference.status == FAILED:
            print(f"The reference failed, and there is nothing to compare with: {reference.reason}")
            return reference.exit_code
        written = write(cost, costing.place)
    print(text_of(cost))
    print(f"in {costing.place}:" + "".join(f" {name}" for name in written))
    if not complete:
        print("Stopped early: the same command goes on from here.")
        return STOPPED
    if target is not None:
        print("\n" + answer_of(cost))
    return 0 if target is None or cost.chosen else PHYSICS


def estimate_command(scene: str, overrides: list[str], out: str | None, options: PoolOptions, seeds: int | None,
                     parts: list[str], plan: bool) -> int:
    """Carries out `asperity estimate`.

    Parameters
    ----------
    scene : str
        Scene file.
    overrides : list[str]
        Overrides.
    out : str | None
        Result directory; None: the default one.
    options : PoolOptions
        Options of the runs.
    seeds : int | None
        Surfaces of a self-affine scene; None: 8, or 4 with a path.
    parts : list[str]
        Only these parts of the error; none: all.
    plan : bool
        True: only tells what would be run.

    Returns
    -------
    int
        The exit code: 75 if stopped early, that of the scene if it failed.
    """
    def say(text: str) -> None:
        print(text, flush=True)

    making = Estimating(scene, overrides, out, options, seeds, parts, say=say, also=report_estimate.FILES)
    say(making.told())
    if plan:
        return 0
    with lock.in_use(making.place):
        found, complete = making.carry_out()
        outcome = making.plan.scene.outcome
        if complete and found is None:
            print(f"The scene itself failed, and there is nothing to vary: {outcome.reason}")
            return outcome.exit_code or PHYSICS
        written = report_estimate.write(found) if complete and found is not None else []
    if not complete or found is None:
        print("Stopped early: the same command goes on from here.")
        return STOPPED
    print(report_estimate.text_of(found))
    print(f"in {making.place}: {', '.join(written)}")
    return 0
