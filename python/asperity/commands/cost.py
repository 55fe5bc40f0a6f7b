# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: what accuracy costs in run time."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..arguments import checks_call
from ..errors import BY_CODE, InternalError, Stopped
from ..running import lock, program
from ..running.scene import Overrides, SceneLike, scene_given
from ..terminal import Voice
from .options import Command, OfScene, executor, jobs, option, out, plan
from .studies import EARLY, on_workers, told

if TYPE_CHECKING:
    from ..studies.cost import Cost


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity cost`."""

    out: str | None = out("results/<scene>-cost")
    jobs: int = jobs("runs side by side, one thread each (default: 1)")
    executor: str = executor()
    target: str | None = option("ERROR", "find the cheapest numerical settings that keep this error: 1%, 0.01", None)
    parameters: list[str] = option("NAMES", "only these: timestep,cutoff,layers,...", [], commas=True)
    plan: bool = plan()


@checks_call
def cost(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None, jobs: int = 1,
         parameters: Iterable[str] = (), target: str | float | None = None) -> Cost:
    """Measures error and run time of the scene for numerical settings: one setting varied at a time, and combinations. Existing
    runs are reused; writes cost.csv and figures.

        found = asperity.cost("scene.toml", target="1%")
        found.chosen.setting, found.chosen.seconds      # ["drive.timestep=40"], s; chosen is None if no setting meets the target

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.
    out : str or os.PathLike, optional
        Directory; None: results/<scene>-cost.
    jobs : int
        Number of simultaneous runs, one thread each.
    parameters : iterable of str
        Settings to vary, ["timestep", "layers"]; by default all.
    target : str or float, optional
        Largest relative error, "1%" or 0.01, from numerical settings alone.

    Returns
    -------
    Cost
        Rows with settings, times (s) and relative errors; the first row is the reference, the second the scene itself.

    Raises
    ------
    SceneError
        The scene or an argument is refused, or files would be replaced.
    Stopped
        The runs stopped early; the same call continues.
    Error
        The run of the reference failed.
    """
    from ..reports import cost as report_cost
    from ..running.pool import FAILED, PoolOptions, refuse_jobs
    from ..studies.cost import Costing, target_of

    program.refuse_ranks()
    refuse_jobs(jobs)
    with scene_given(scene, overrides) as (file, sets):
        costing = Costing(file, sets, None if out is None else str(out), PoolOptions(jobs, 1, progress="off"), parameters,
                          None if target is None else target_of(str(target)), lambda _: None, report_cost.FILES)
        with lock.in_use(costing.place):
            complete = costing.carry_out()
            failed = costing.reference.status == FAILED
            if complete and not failed:
                report_cost.write(costing.cost, costing.place)
    if not complete:
        raise Stopped(f"{costing.place}: the runs stopped early", fix="the same call goes on from here")
    if failed:
        raise BY_CODE.get(costing.reference.exit_code, InternalError)(str(costing.place), "the reference failed", costing.reference.reason)
    return costing.cost


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity cost`. Returns the exit code: 75 if stopped early, that of the reference if it failed, 3 if nothing keeps the
    target."""
    from ..reports.cost import FILES, answer_of, json_of, text_of, write
    from ..running.pool import FAILED, PHYSICS, STOPPED, PoolOptions
    from ..studies.cost import Costing, target_of

    options = PoolOptions(given.jobs, 1, progress=voice.progress)
    target = None if given.target is None else target_of(given.target)
    with on_workers(given.executor, options) as leads:
        if not leads:
            return 0
        costing = Costing(given.scene(), given.sets, given.out, options, given.parameters, target, voice.say, FILES)
        found = costing.cost
        voice.say(f"reference: {costing.case.reference_text}")
        if given.plan:
            told(costing.forecast(), True, voice)
            return 0
        with lock.in_use(costing.place):
            complete = costing.carry_out()
            reference = costing.reference
            if complete and reference.status == FAILED:
                voice.show(f"The reference failed, and there is nothing to compare with: {reference.reason}")
                return reference.exit_code
            written = write(found, costing.place)
    voice.show(text_of(found))
    voice.tell({**json_of(found), "directory": costing.place})
    voice.say(f"in {costing.place}:" + "".join(f" {name}" for name in written))
    if not complete:
        voice.show(EARLY)
        return STOPPED
    if target is not None:
        voice.show("\n" + answer_of(found))
    return 0 if target is None or found.chosen else PHYSICS


COMMAND = Command(Options, _carry_out, more="The same command goes on where it stopped.")
