# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity estimate`: the numbers of a scene with their errors."""

from __future__ import annotations

from dataclasses import dataclass

from ..terminal import Voice
from .options import COUNT, Command, OfScene, jobs, option, out, plan
from .studies import EARLY, show_estimate, told


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity estimate`."""

    out: str | None = out("results/<scene>-estimate")
    jobs: int = jobs()
    seeds: int | None = option("N", "surfaces of a self-affine scene to average over (default: 8, or 4 with a path)", None, limits=COUNT)
    parts: list[str] = option("NAMES", "only these parts of the error: tail,seeds,...", [], commas=True)
    plan: bool = plan()


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity estimate`. Returns the exit code: 75 if stopped early, that of the scene if it failed."""
    from ..reports import estimate as report_estimate
    from ..running import lock
    from ..running.pool import PHYSICS, STOPPED, PoolOptions
    from ..studies.estimates import Estimating

    making = Estimating(given.scene(), given.sets, given.out, PoolOptions(given.jobs, progress=voice.progress), given.seeds, given.parts,
                        say=voice.say, also=report_estimate.FILES)
    if told(making.forecast(), given.plan, voice):
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
    show_estimate(found, making, voice)
    voice.say(f"in {making.place}: {', '.join(written)}")
    return 0


COMMAND = Command(Options, _carry_out, more=(
    "Parts of the error: convergence, tail, spacing, levels, timestep, thickness, width, edge (of a map), rate, seeds, places (of a map). "
    "The same command goes on where it stopped."))
