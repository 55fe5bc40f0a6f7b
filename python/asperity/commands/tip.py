# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity tip`: the force curve of a tip on a cantilever, pressed onto a sample and pulled off, in one call."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checks_call
from ..errors import BY_CODE, InternalError, Stopped
from ..files import store
from ..running import lock, program
from ..terminal import Voice
from .options import SITES, Command, Options as Base, jobs, option, out, plan, word
from .studies import EARLY, told

if TYPE_CHECKING:
    from ..running.pool import PoolOptions
    from ..studies.forecast import Forecast
    from ..studies.tip import Plan, Tip
    from ..studies.variations import Runs, Variation

RUNS = re.compile(r"tip|coarse|wide|tip,displacement_step=.*")
"""Directories of the runs."""


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity tip`."""

    map: str | None = word("MAP", "heights of the sample, any map that convert reads (default: smooth)", None)
    shape: str = option("SHAPE", "of the tip: sphere, or cone or pyramid with a round end (default: sphere)", "sphere",
                        choices=("sphere", "cone", "pyramid"), own=True)
    radius: str | None = option("20nm", "of the tip, or of the end of a cone or pyramid", None)
    angle: float | None = option("65", "of a cone or pyramid: degrees between its axis and its surface", None, own=True)
    tip_map: str | None = option("FILE", "heights of a measured tip, whose apex is put over the middle of the sample", None, own=True)
    young: str = option("3GPa", "Young's modulus of the sample")
    poisson: float = option("0.3", "its Poisson's ratio")
    adhesion: str = option("50mJ/m2", "work of adhesion of flat surfaces")
    hardness: str | None = option("1GPa", "of the sample, which then yields (default: it is elastic)", None)
    stiffness: str = option("0.2N/m", "of the cantilever")
    load: str | None = option("5nN", "the largest force (default: 1.5πwR; with --hardness what brings all of the contact to it)", None)
    range: str | None = option("3Å", "of the attraction (default: 3 Å, or what the spacing resolves)", None)
    size: str | None = option("100nm", "the map's shorter edge; holds over what the file says", None)
    unit: str | None = option("nm", "of the heights; holds over what the file says", None)
    channel: str | None = option("NAME", "of a file with several maps: this one, by name or number", None, own=True)
    sites: int | None = option("N", "along an edge of the box (default: 64 to 256, as needed)", None, limits=SITES)
    error: str | None = option("10%", "of the pull-off force, over its size: take as many sites as reach it", None, own=True)
    plan: bool = plan()
    out: str | None = out("results/<map>-tip")
    jobs: int = jobs()

    @property
    def place(self) -> Path:
        """Directory of the study."""
        return store.chosen(self.out, f"results/{Path(self.map.partition(':/')[0]).stem}-tip" if self.map else "results/tip")


@checks_call
def tip(map: str | os.PathLike | None = None, radius: str | None = None, young: str | None = None, poisson: float | None = None,
        adhesion: str | None = None, stiffness: str | None = None, load: str | None = None, out: str | os.PathLike | None = None,
        range: str | None = None, size: str | None = None, unit: str | None = None, channel: str | None = None,
        sites: int | None = None, jobs: int = 1, shape: str = "sphere", angle: float | None = None,
        tip_map: str | os.PathLike | None = None, error: str | None = None, hardness: str | None = None, *, E: str | None = None,
        nu: float | None = None, work: str | None = None, w: str | None = None, file_size: str | None = None, file_unit: str | None = None) -> Tip:
    """Computes the force curve of a tip on a sample that is elastic, or yields, with its numbers and their errors.

        found = asperity.tip("scan.gwy", radius="20 nm", E="3 GPa", nu=0.3, work="50 mJ/m2", stiffness="0.2 N/m")
        found.number("pull_off_force"), found.drive, found.force

    Parameters
    ----------
    map : str or os.PathLike, optional
        File of the sample's heights: HDF5, .npy, or any that `convert` reads; None: a smooth sample.
    radius : str, optional
        Radius of the tip, or of the end of a cone or pyramid, with its unit; None: of a measured tip.
    young : str
        Young's modulus of the sample with its unit.
    poisson : float
        Poisson's ratio of the sample.
    adhesion : str
        Work of adhesion of flat surfaces with its unit.
    stiffness : str
        Stiffness of the cantilever with its unit, "0.2 N/m".
    load : str, optional
        Largest force with its unit; None: 1.5πwR, the pull-off force of JKR; with a hardness the force that brings all of the contact to it.
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
    shape : str
        "sphere"; "cone" or "pyramid" (of four sides), whose end is rounded by a ball that touches the flanks.
    angle : float, optional
        Angle between axis and surface of a cone or pyramid, degrees.
    tip_map : str or os.PathLike, optional
        File of the heights of a measured tip, with its size and unit, in place of radius, shape and angle.
    error : str, optional
        Error of the pull-off force over its size, "10%", that decides the number of sites; None: the contact decides.
    hardness : str, optional
        Hardness of the sample with its unit, the largest pressure that it bears, under a sphere; None: the sample is elastic.
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
    from ..running.pool import PoolOptions

    program.refuse_ranks()
    given = Options.of_call(locals())
    found = _carried_out(*_planned(given), PoolOptions(given.jobs, progress="off"), lambda _: None)
    if found is None:
        raise Stopped(str(given.place), "the runs stopped early", "", "the same call goes on from here")
    return found


def _planned(given: Options) -> tuple[Plan, Path]:
    """Returns the planned runs and the directory of the study. Raises SceneError if files would be replaced."""
    from ..reports import tip as report_tip
    from ..running.pool import require_free_runs
    from ..studies.tip import files_of, plan_of

    place = given.place
    require_free_runs(place, RUNS)
    store.require_free({place: [*files_of(given.map is not None or given.tip_map is not None or given.shape != "sphere"), *report_tip.FILES]},
                       inputs=[one for one in (given.map, given.tip_map) if one])
    return plan_of(given.map, place, asdict(given)), place


def _runs(made: Plan, place: Path, options: PoolOptions, say: Callable[[str], None]) -> tuple[Runs, dict[str, Variation]]:
    """Returns the runs of a plan, and their rows by part."""
    from ..studies.variations import Runs, Variation

    own = str(made.scenes[""])
    rows = {part: Variation(part, part, [], scene=str(file)) for part, file in made.scenes.items()}
    rows["step"] = Variation("step", "step", [made.longer_step], scene=own)
    return Runs(own, [], place, options, say), rows


def _forecast(made: Plan, place: Path, options: PoolOptions) -> Forecast:
    """Returns the runs that are left, and their time."""
    from ..studies.tip import forecast_of

    runs, rows = _runs(made, place, options, lambda _: None)
    left = [part for part, job in zip(rows, runs.jobs(list(rows.values()))) if not (job.directory / "result.json").exists()]
    return forecast_of(made, place, left, options.jobs)


def _carried_out(made: Plan, place: Path, options: PoolOptions, say: Callable[[str], None]) -> Tip | None:
    """Carries out the runs and writes the page. Returns None if stopped before the end. Raises Error for a failed run."""
    from ..reports import tip as report_tip
    from ..results.result import Result
    from ..running.pool import DONE
    from ..studies.tip import tip_of

    with lock.in_use(place):
        runs, rows = _runs(made, place, options, say)
        if not runs.run(list(rows.values())):
            return None
        for row in rows.values():
            if row.outcome.status != DONE:
                raise BY_CODE.get(row.outcome.exit_code, InternalError)(str(place), f"the run {row.label or 'of the tip'} failed",
                                                                        row.outcome.reason, f"look at {place}")
        found = tip_of(made, {part: Result(job.directory) for part, job in zip(rows, runs.jobs(list(rows.values())))}, place)
        report_tip.write(found)
    return found


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity tip`. Returns the exit code."""
    from ..reports import tip as report_tip
    from ..running.pool import STOPPED, PoolOptions
    from ..studies.tip import plan_of

    options = PoolOptions(given.jobs, progress=voice.progress)
    if given.plan:
        with tempfile.TemporaryDirectory(prefix="asperity-") as folder:  # leaves nothing behind
            made = plan_of(given.map, Path(folder), asdict(given))
            forecast = _forecast(made, given.place, options)
        told(forecast, True, voice)
        for note in made.notes:
            voice.say(f"note: {note}")
        return 0
    made, place = _planned(given)
    for note in made.notes:
        voice.say(f"note: {note}")
    told(_forecast(made, place, options), False, voice)
    found = _carried_out(made, place, options, voice.say)
    if found is None:
        voice.show(EARLY)
        return STOPPED
    voice.tell({**report_tip.answer_of(found), "directory": place})
    voice.show(report_tip.text_of(found))
    voice.say(f"\nwritten: {place}: report.html, tip.json, curve.csv; the runs in tip, coarse, wide, ...")
    return 0


COMMAND = Command(Options, _carry_out, more=(
    "A rigid tip on a cantilever is pressed onto a sample, smooth or of a measured map, and pulled off, without periodic "
    "images: force curve, pull-off and jump-in with their errors, JKR's fit; with --hardness set, plastic work and what Oliver and Pharr read from "
    "the unloading. The same command goes on where it stopped."))
