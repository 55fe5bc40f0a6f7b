# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity cost`: what accuracy costs in run time."""

from __future__ import annotations

from dataclasses import dataclass

from ..terminal import Voice
from .options import Command, OfScene, executor, jobs, option, out, plan
from .studies import EARLY, on_workers, told


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity cost`."""

    out: str | None = out("results/<scene>-cost")
    jobs: int = jobs("runs side by side, one thread each (default: 1)")
    executor: str = executor()
    target: str | None = option("ERROR", "find the cheapest numerical settings that keep this error: 1%, 0.01", None)
    parameters: list[str] = option("NAMES", "only these: timestep,cutoff,layers,...", [], commas=True)
    plan: bool = plan()


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity cost`. Returns the exit code: 75 if stopped early, that of the reference if it failed, 3 if nothing keeps the
    target."""
    from ..reports.cost import FILES, answer_of, json_of, text_of, write
    from ..running import lock
    from ..running.pool import FAILED, PHYSICS, STOPPED, PoolOptions
    from ..studies.cost import Costing, target_of

    options = PoolOptions(given.jobs, 1, progress=voice.progress)
    target = None if given.target is None else target_of(given.target)
    with on_workers(given.executor, options) as leads:
        if not leads:
            return 0
        costing = Costing(given.scene(), given.sets, given.out, options, given.parameters, target, voice.say, FILES)
        cost = costing.cost
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


COMMAND = Command(Options, _carry_out, more="The same command goes on where it stopped.")
