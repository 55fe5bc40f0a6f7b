# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity tip`: the force curve of a tip on a cantilever, pressed onto a sample and pulled off, in one call."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..arguments import checks_call, chosen
from ..errors import BY_CODE, InternalError, Stopped
from ..files import store
from ..reports import tip as report_tip
from ..results.result import Result, Values
from ..running import lock, program
from ..running.pool import DONE, STOPPED, PoolOptions, refuse_jobs, require_free_runs
from ..studies.tip import NUMBERS, Plan, Tip, files_of, plan_of, seconds_of, tip_of
from ..studies.variations import Runs, Variation
from ..terminal import Voice, duration, table

RUNS = re.compile(r"tip|coarse|wide|tip,displacement_step=.*")
"""Directories of the runs."""


@checks_call
def tip(map: str | os.PathLike | None = None, radius: str | None = None, young: str | None = None, poisson: float | None = None,
        adhesion: str | None = None, stiffness: str | None = None, load: str | None = None, out: str | os.PathLike | None = None,
        range: str | None = None, size: str | None = None, unit: str | None = None, channel: str | None = None,
        sites: int | None = None, jobs: int = 1, *, E: str | None = None, nu: float | None = None, work: str | None = None,
        w: str | None = None, file_size: str | None = None, file_unit: str | None = None) -> Tip:
    """Computes the force curve of a spherical tip on an elastic sample, with its numbers and their errors.

        found = asperity.tip("scan.gwy", radius="20 nm", E="3 GPa", nu=0.3, work="50 mJ/m2", stiffness="0.2 N/m")
        found.number("pull_off_force"), found.drive, found.force

    Parameters
    ----------
    map : str or os.PathLike, optional
        File of the sample's heights: HDF5, .npy, or any that `convert` reads; None: a smooth sample.
    radius : str
        Radius of the tip with its unit.
    young : str
        Young's modulus of the sample with its unit.
    poisson : float
        Poisson's ratio of the sample.
    adhesion : str
        Work of adhesion of flat surfaces with its unit.
    stiffness : str
        Stiffness of the cantilever with its unit, "0.2 N/m".
    load : str, optional
        Largest force with its unit; None: 1.5πwR, the pull-off force of JKR.
    out : str or os.PathLike, optional
        Directory; None: results/<map>-tip, or results/tip. Existing runs are reused.
    range : str, optional
        Range of the exponential attraction with its unit; None: 3 Å, or the range that the spacing resolves.
    size, unit : str, optional
        Shorter edge of the map, with its unit, and unit of the heights; both override the file, with a note.
    channel : str, optional
        Name or number of the map in a file with several maps.
    sites : int, optional
        Number of sites along an edge of the box; None: 64 to 256, depending on the contact.
    jobs : int
        Number of simultaneous runs, which share the processors.
    E, nu, work, w, file_size, file_unit : optional
        Other names of young, poisson, adhesion (work and w), size and unit.

    Returns
    -------
    Tip
        Numbers with their errors, the force curve, and the fit of JKR.

    Raises
    ------
    SceneError
        The map or an argument is refused, or files would be replaced.
    Stopped
        The runs stopped early; the same call continues.
    Error
        A run failed.
    """
    program.refuse_ranks()
    refuse_jobs(jobs)
    given = {"radius": chosen("radius", 'radius="20 nm"', radius=radius), "young": chosen("young", 'young="3 GPa"', young=young, E=E),
             "poisson": chosen("poisson", "poisson=0.3", poisson=poisson, nu=nu),
             "adhesion": chosen("adhesion", 'adhesion="50 mJ/m2"', adhesion=adhesion, work=work, w=w),
             "stiffness": chosen("stiffness", 'stiffness="0.2 N/m"', stiffness=stiffness), "load": load, "range": range,
             "size": chosen("size", size=size, file_size=file_size), "unit": chosen("unit", unit=unit, file_unit=file_unit),
             "channel": channel, "sites": sites}
    file = None if map is None else str(map)
    place = store.chosen(None if out is None else str(out), _place(file))
    made = _planned(file, place, given)
    found = _carried_out(made, place, PoolOptions(jobs=jobs, progress="off"), lambda _: None)
    if found is None:
        raise Stopped(str(place), "the runs stopped early", "", "the same call goes on from here")
    return found


def _place(file: str | None) -> str:
    return f"results/{Path(file.partition(':/')[0]).stem}-tip" if file else "results/tip"


def _planned(file: str | None, place: Path, given: dict[str, Any]) -> Plan:
    require_free_runs(place, RUNS)
    store.require_free({place: [*files_of(file is not None), *report_tip.FILES]}, inputs=[file] if file else [])
    return plan_of(file, place, given)


def _carried_out(made: Plan, place: Path, options: PoolOptions, say: Callable[[str], None]) -> Tip | None:
    """Carries out the runs and writes the page. Returns None if stopped before the end. Raises Error for a failed run."""
    own = str(made.scenes[""])
    rows = {part: Variation(part, part, [], scene=str(file)) for part, file in made.scenes.items()}
    rows["step"] = Variation("step", "step", [made.longer_step], scene=own)
    with lock.in_use(place):
        runs = Runs(own, [], place, options, say)
        if not runs.run(list(rows.values())):
            return None
        for row in rows.values():
            if row.outcome.status != DONE:
                raise BY_CODE.get(row.outcome.exit_code, InternalError)(str(place), f"the run {row.label or 'of the tip'} failed",
                                                                        row.outcome.reason, f"look at {place}")
        found = tip_of(made, {part: Result(job.directory) for part, job in zip(rows, runs.jobs(list(rows.values())))}, place)
        report_tip.write(found)
    return found


def _told(file: str | None, place: Path, given: dict[str, Any], voice: Voice) -> None:
    """Prints what would be run, how long it takes, and what will not be stated. Leaves nothing behind."""
    with tempfile.TemporaryDirectory(prefix="asperity-") as folder:
        made = plan_of(file, Path(folder), given)
        scenes = {part: Values(program.check(str(scene))["scene"]) for part, scene in made.scenes.items()}
        seconds = seconds_of(made)
    runs = []
    for part, time in seconds.items():
        keys = scenes.get(part, scenes[""])
        sites = int(keys.needed("surface.sites"))
        runs.append({"part": part, "sites": sites, "width": 0.1 * sites * keys.needed("surface.spacing"), "seconds": time})
    names = {"": "the tip", "spacing": "coarser spacing", "width": "wider box", "step": "longer steps"}
    total = sum(seconds.values())
    voice.tell({"directory": place, "runs": runs, "seconds": total, "not_stated": list(made.not_stated), "notes": made.notes})
    voice.show(table(["run", "sites", "width, nm", "about"],
                     [[names[run["part"]], str(run["sites"]), f"{run['width']:.4g}", duration(run["seconds"])] for run in runs]))
    voice.show(f"\n{len(runs)} runs, about {duration(total)} of one process at a time; they would be in {place}.")
    for note in made.notes:
        voice.say(f"note: {note}")
    for path, why in made.not_stated.items():
        voice.show(f"{NUMBERS[path][0].replace('_', ' ')} will not be stated: {why}")


def tip_command(file: str | None, out: str | None, options: PoolOptions, plan: bool, voice: Voice, **given: Any) -> int:
    """Carries out `asperity tip`.

    Parameters
    ----------
    file : str | None
        Map of heights; None: a smooth sample.
    out : str | None
        Result directory; None: the default one.
    options : PoolOptions
        Options of the runs.
    plan : bool
        True: only tells what would be run.
    voice : Voice
        Output of the command.
    **given : Any
        Arguments of tip(): radius, young, poisson, adhesion, stiffness, load, range, size, unit, channel, sites.

    Returns
    -------
    int
        The exit code.
    """
    place = store.chosen(out, _place(file))
    if plan:
        _told(file, place, given, voice)
        return 0
    made = _planned(file, place, given)
    for note in made.notes:
        voice.say(f"note: {note}")
    found = _carried_out(made, place, options, voice.say)
    if found is None:
        voice.show("Stopped early: the same command goes on from here.")
        return STOPPED
    voice.tell({**report_tip.answer_of(found), "directory": place})
    voice.show(report_tip.text_of(found))
    voice.say(f"\nwritten: {place}: report.html, tip.json, curve.csv; the runs in tip, coarse, wide, ...")
    return 0
