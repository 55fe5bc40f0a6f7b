# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity sweep`, `cost` and `estimate`: each carries out, writes, prints, and returns the exit code."""

from __future__ import annotations

from dataclasses import replace

from ..plots.sweep import plot_files, write_plots
from ..reports import estimate as report_estimate
from ..reports.cost import FILES, answer_of, json_of, text_of, write
from ..running import lock
from ..running.pool import DONE, FAILED, PHYSICS, STOPPED, PoolOptions
from ..studies.cost import Costing, target_of
from ..studies.estimates import Estimating
from ..studies.forecast import Forecast
from ..studies.sweeps import TABLES, Carried, forecast
from ..terminal import Voice


def told(forecast: Forecast, plan: bool, voice: Voice) -> bool:
    """Tells what a study will run.

    Parameters
    ----------
    forecast : Forecast
        Runs, their time, and the numbers that will not be stated.
    plan : bool
        True: the forecast is the result (--plan).
    voice : Voice
        Output of the command.

    Returns
    -------
    bool
        The value of `plan`: nothing is left to do.
    """
    for line in forecast.lines:
        (voice.show if plan else voice.say)(line)
    if plan:
        voice.tell(forecast.json())
    return plan


EARLY = "Stopped early: the same command goes on from here."


def sweep_command(scenes: list[str], sets: list[str], out: str | None, theory_only: bool, options: PoolOptions,
                  plan: bool, voice: Voice) -> int:
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
    plan : bool
        True: only tells what would be run.
    voice : Voice
        Output of the command.

    Returns
    -------
    int
        The exit code: 75 if stopped early, else that of the first failure.
    """
    if plan:
        told(forecast(scenes, sets, out, theory_only, options, voice.say), plan, voice)
        return 0
    done = Carried(scenes, sets, out, theory_only, options, voice.say, plot_files(not theory_only))
    written, note = write_plots(done.place, done.sweeps)
    for sweep in done.sweeps:
        voice.say("")
        voice.show(sweep.text())
        voice.tell({**sweep.json(sweep.table), "directory": sweep.directory})
        for said in sweep.notes:
            voice.say(f"note: {said}")
        if len(sweep.run.get("programs", {})) > 1:
            voice.say("note: points are by several programs: "
                      + ", ".join(f"{git} ({count})" for git, count in sweep.run["programs"].items()))
    if note:
        voice.say(f"note: {note}")
    failed = [(job, outcome) for job, outcome in zip(done.jobs, done.outcomes) if outcome.status == FAILED]
    for job, outcome in failed:
        voice.show(f"failed: {job.name} (exit {outcome.exit_code}): {outcome.reason}")
    if theory_only:
        voice.say(f"{sum(len(s.points) for s in done.sweeps)} points in {done.place}")
    else:
        voice.say(f"{sum(o.status == DONE for o in done.outcomes)} of {len(done.jobs)} points are done, in {done.place}")
    voice.say(f"tables: {TABLES}" + "; plots: " * bool(written) + " ".join(path.name for path in written))
    if not done.complete:
        voice.show(EARLY)
        return STOPPED
    return next((outcome.exit_code for _, outcome in failed), 0)


def cost_command(scene: str, overrides: list[str], parameters: list[str], out: str | None, options: PoolOptions,
                 target: str | None, plan: bool, voice: Voice) -> int:
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
    target : str | None
        Relative error to keep, "1%"; None: none.
    plan : bool
        True: only tells what would be run.
    voice : Voice
        Output of the command.

    Returns
    -------
    int
        The exit code: 75 if stopped early, that of the reference if it failed, 3 if nothing keeps the target.
    """
    costing = Costing(scene, overrides, out, options, parameters, None if target is None else target_of(target), voice.say, FILES)
    cost = costing.cost
    voice.say(f"reference: {costing.case.reference_text}")
    if plan:
        told(costing.forecast(), plan, voice)
        return 0
    with lock.in_use(costing.place):
        complete = costing.carry_out()
        reference = costing.reference
        if complete and reference.status == FAILED:
            voice.show(f"The reference failed, and there is nothing to compare with: {reference.reason}")
            return reference.exit_code
        written = write(cost, costing.place)
    voice.show(text_of(cost))
    voice.tell({**json_of(cost), "directory": costing.place})
    voice.say(f"in {costing.place}:" + "".join(f" {name}" for name in written))
    if not complete:
        voice.show(EARLY)
        return STOPPED
    if target is not None:
        voice.show("\n" + answer_of(cost))
    return 0 if target is None or cost.chosen else PHYSICS


def estimate_command(scene: str, overrides: list[str], out: str | None, options: PoolOptions, seeds: int | None,
                     parts: list[str], plan: bool, voice: Voice) -> int:
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
    voice : Voice
        Output of the command.

    Returns
    -------
    int
        The exit code: 75 if stopped early, that of the scene if it failed.
    """
    making = Estimating(scene, overrides, out, options, seeds, parts, say=voice.say, also=report_estimate.FILES)
    if told(making.forecast(), plan, voice):
        return 0
    with lock.in_use(making.place):
        found, complete = making.carry_out()
        outcome = making.plan.scene.outcome
        if complete and found is None:
            voice.show(f"The scene itself failed, and there is nothing to vary: {outcome.reason}")
            return outcome.exit_code or PHYSICS
        written = report_estimate.write(found) if complete and found is not None else []
    if not complete or found is None:
        voice.show(EARLY)
        return STOPPED
    voice.show(report_estimate.text_of(replace(found, notes=[note for note in found.notes if note not in making.said])))
    voice.tell({**found.json(), "directory": making.place})
    voice.say(f"in {making.place}: {', '.join(written)}")
    return 0
