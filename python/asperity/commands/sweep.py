# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity sweep`: a scene over several values of its keys."""

from __future__ import annotations

from dataclasses import dataclass

from ..terminal import Voice, parse_duration
from .options import SCENE, Command, OfScene, executor, jobs, option, out, plan, word
from .studies import EARLY, on_workers, told


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity sweep`."""

    words: list[str] = word("SCENE", SCENE + "; several share the plots", [])
    out: str | None = out("results/<scene>-sweep")
    jobs: int = jobs("points side by side; each takes an equal share of the processors, unless OMP_NUM_THREADS or --launch chooses "
                     "(default: 1)")
    executor: str = executor()
    launch: str = option("WORDS", 'what to put before the program for every point: "mpirun -n 2"', "")
    wall_limit: str = option("23h50m", "stop with checkpoints when this time has passed (exit 75)", "")
    theory_only: bool = option("", "the theory alone, no simulation", False)
    plan: bool = plan()


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity sweep`. Returns the exit code: 75 if stopped early, else that of the first failure."""
    from ..plots.sweep import plot_files, write_plots
    from ..running.pool import DONE, FAILED, STOPPED, PoolOptions
    from ..studies.sweeps import TABLES, Carried, forecast

    scenes = given.scenes()
    options = PoolOptions(given.jobs, progress=voice.progress, launch=given.launch.split(),
                          wall_limit=parse_duration(given.wall_limit) if given.wall_limit else None)
    if given.plan:
        told(forecast(scenes, given.sets, given.out, given.theory_only, options, voice.say), True, voice)
        return 0
    with on_workers(given.executor, options) as leads:
        if not leads:
            return 0
        done = Carried(scenes, given.sets, given.out, given.theory_only, options, voice.say, plot_files(not given.theory_only))
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
    if given.theory_only:
        voice.say(f"{sum(len(s.points) for s in done.sweeps)} points in {done.place}")
    else:
        voice.say(f"{sum(o.status == DONE for o in done.outcomes)} of {len(done.jobs)} points are done, in {done.place}")
    voice.say(f"tables: {TABLES}" + "; plots: " * bool(written) + " ".join(path.name for path in written))
    if not done.complete:
        voice.show(EARLY)
        return STOPPED
    return next((outcome.exit_code for _, outcome in failed), 0)


COMMAND = Command(Options, _carry_out, more=(
    "--set key=v1,v2,..., key=start:stop:step or key=start:stop:xFACTOR sweeps a key, beside those of the scene's [sweep]; with several, "
    "every combination. The same command goes on where a sweep stopped. Several scenes share one set of plots."))
