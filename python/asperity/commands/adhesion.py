# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity adhesion`: from a measured map to its adhesion with an error, in one call.

The runs and the output are those of `estimate` for the map's scene (map_scene.py).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checks_call, checks_calls
from ..errors import BY_CODE, InternalError, Named, Stopped
from ..files import store
from ..running import lock, program
from ..terminal import Voice
from .options import SITES, Command, Options as Base, jobs, option, out, plan, word
from .studies import EARLY, show_estimate, told

if TYPE_CHECKING:
    from ..results.result import Result
    from ..running.pool import PoolOptions
    from ..studies.estimates import Estimate, Estimating
    from ..studies.map_scene import MapScene


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity adhesion`."""

    map: str = word("MAP", "HDF5, .npy, or any map that convert reads")
    young: str = option("100GPa", "Young's modulus of the half-space")
    poisson: float = option("0.25", "its Poisson's ratio")
    adhesion: str = option("200mJ/m2", "work of adhesion of flat surfaces")
    hardness: str | None = option("1GPa", "of the half-space, which then yields (default: it is elastic)", None)
    load: str | None = option("100MPa", "mean pressure on the map before the pull-off (default: the approach ends without load)", None)
    range: str | None = option("3Å", "of the attraction (default: 3 Å, or what the spacing resolves)", None)
    size: str | None = option("100nm", "the map's shorter edge; holds over what the file says", None)
    unit: str | None = option("nm", "of the heights; holds over what the file says", None)
    channel: str | None = option("NAME", "of a file with several maps: this one, by name or number", None, own=True)
    line_noise: str | None = option("HOW", "treatment of a scan's noise from line to line: keep, align-rows or isotropic", None,
                                    choices=("keep", "align-rows", "isotropic"))
    counter: str | None = option("MAP2", "map of a second rough solid, turned over onto the first; eight shifts show the error of the "
                                 "position", None)
    counter_young: str | None = option("70GPa", "Young's modulus of the second solid (default: rigid)", None)
    counter_poisson: float | None = option("0.25", "its Poisson's ratio (default: that of the first)", None)
    sites: int | None = option("N", "along an edge (default: the map's points, 256 at most)", None, limits=SITES)
    out: str | None = out("results/<map>-adhesion")
    jobs: int = jobs()
    plan: bool = plan()


@checks_calls
@dataclass
class Adhesion(Named):
    """Adhesion on a map: estimate (.numbers), result (run of the map's scene: series, fields), notes on changes of the map, scene
    (file), directory."""

    estimate: Estimate
    result: Result
    notes: list[str]
    scene: Path
    directory: Path

    def quote(self, path: str = "") -> str:
        """Spells a number for publication.

        Parameters
        ----------
        path : str
            Name of the number: "binding_energy", "lost.cycle", ...; "" for the first one.

        Returns
        -------
        str
            The number with its unit, its standard error and the parts of the error.

        Raises
        ------
        SceneError
            The estimate has no number of this name.
        """
        return self.estimate.quote(path)

    def _repr_html_(self) -> str:
        return self.estimate._repr_html_()

    def __repr__(self) -> str:
        return f"<Adhesion {self.directory}: {self.quote()}>"


@checks_call
def adhesion(map: str | os.PathLike, young: str | None = None, poisson: float | None = None, adhesion: str | None = None,
             out: str | os.PathLike | None = None, range: str | None = None, size: str | None = None, unit: str | None = None,
             channel: str | None = None, sites: int | None = None, jobs: int = 1, line_noise: str | None = None,
             hardness: str | None = None, load: str | None = None, *, E: str | None = None, nu: float | None = None,
             work: str | None = None, w: str | None = None, file_size: str | None = None, file_unit: str | None = None,
             counter: str | os.PathLike | None = None, counter_young: str | None = None, counter_poisson: float | None = None) -> Adhesion:
    """Computes the adhesion of a half-space, elastic or one that yields, on a measured, rigid map, or of two rough solids, with its
    error.

        found = asperity.adhesion("scan.gwy", young="100 GPa", poisson=0.25, adhesion="200 mJ/m2")
        found.quote(), found.quote("lost.cycle"), found.notes

    Parameters
    ----------
    map : str or os.PathLike
        File of heights: HDF5, .npy, or any that `convert` reads.
    young : str
        Young's modulus of the half-space with its unit.
    poisson : float
        Poisson's ratio of the half-space.
    adhesion : str
        Work of adhesion of flat surfaces with its unit.
    out : str or os.PathLike, optional
        Directory; None: results/<map>-adhesion. Existing runs are reused.
    range : str, optional
        Range of the exponential attraction, with its unit; None: 3 Å, or the range that the spacing resolves.
    size, unit : str, optional
        Shorter edge, with its unit, and unit of the heights; both override the file, with a note.
    channel : str, optional
        Name or number of the map in a file with several maps.
    sites : int, optional
        Number of sites along an edge; None: that of the map, at most 256.
    jobs : int
        Number of simultaneous runs, which share the processors.
    line_noise : str, optional
        Treatment of a scan's noise from line to line: "align-rows" or "isotropic" (surface.line_noise).
    hardness : str, optional
        Hardness of the half-space with its unit, the largest pressure that it bears; None: it is elastic.
    load : str, optional
        Mean pressure on the map at the end of the approach, with its unit; None: it ends without load.
    E, nu, work, w, file_size, file_unit : optional
        Other names of young, poisson, adhesion (work and w), size and unit.
    counter : str or os.PathLike, optional
        Map of a second solid of the same size, whose heights are outwards from it; it is turned over onto the first, whose map is `map`.
        Eight shifts of it give the part "position" of the error.
    counter_young : str, optional
        Young's modulus of the second solid with its unit; None: it is rigid.
    counter_poisson : float, optional
        Poisson's ratio of the second solid; None: that of the first.

    Returns
    -------
    Adhesion
        The numbers with their errors, the run, and notes on changes of the map.

    Raises
    ------
    SceneError
        The map or an argument is refused, or files would be replaced.
    Stopped
        The estimate stopped early; the same call continues.
    Error
        The run of the map failed.
    """
    from ..results.result import Result
    from ..running.pool import PoolOptions

    program.refuse_ranks()
    given = Options.of_call(locals())
    made, making = _estimating(given, PoolOptions(given.jobs, progress="off"), lambda _: None)
    making.warn()
    found, complete = _carried_out(making)
    if not complete:
        raise Stopped(str(making.place), "the estimate stopped early", "", "the same call goes on from here")
    if found is None:
        outcome = making.plan.scene.outcome
        raise BY_CODE.get(outcome.exit_code, InternalError)(str(making.place), "the run of the map failed", outcome.reason)
    return Adhesion(found, Result(making.place / "scene"), made.notes, made.file, making.place)


def _estimating(given: Options, options: PoolOptions, say: Callable[[str], None]) -> tuple[MapScene, Estimating]:
    """Returns the scene of the map, which is written, and its estimate. Raises SceneError if files would be replaced."""
    from ..reports import estimate as report_estimate
    from ..reports.run import run_page_files
    from ..running.pool import require_free_runs
    from ..studies.estimates import MAP_FILES, OF_A_MAP, RESULT, Estimating
    from ..studies.map_scene import SecondSolid, map_files, scene_of, stem_of

    place = store.chosen(given.out, f"results/{Path(given.map.partition(':/')[0]).stem}-adhesion")
    require_free_runs(place, OF_A_MAP)
    page = [] if store.is_named(place / "scene", "report.html") else run_page_files(["relaxed"], ("png",))
    store.require_free({place: [*map_files(given.counter), f"{stem_of(given.map)}.toml", RESULT, *report_estimate.FILES],
                        place / "maps": MAP_FILES, place / "scene": page}, inputs=[given.map, *filter(None, [given.counter])])
    made = scene_of(given.map, given.young, given.poisson, given.adhesion, place, reach=given.range, size=given.size, unit=given.unit,
                    channel=given.channel, sites=given.sites, line_noise=given.line_noise, hardness=given.hardness,
                    load=given.load, second=SecondSolid.given(given.counter, given.counter_young, given.counter_poisson))
    for line in (f"{given.map}: a scene of it is {made.file}", *(f"note: {note}" for note in made.notes)):
        say(line)
    return made, Estimating(str(made.file), [], str(place), options, None, (), made.also, made.notes, say, made.withheld, made.condition,
                            of_sites="--sites")


def _carried_out(making: Estimating) -> tuple[Estimate | None, bool]:
    """Carries out the estimate and writes its page and that of its run."""
    from ..reports import estimate as report_estimate
    from ..reports.run import write_run_page
    from ..results.result import Result

    with lock.in_use(making.place):
        found, complete = making.carry_out()
        if complete and found is not None:
            report_estimate.write(found)
            if not (making.place / "scene/report.html").exists():
                write_run_page(Result(making.place / "scene"), ("png",))
    return found, complete


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity adhesion`. Returns the exit code."""
    from ..running.pool import DONE, PHYSICS, STOPPED, PoolOptions

    _, making = _estimating(given, PoolOptions(given.jobs, progress=voice.progress), voice.say)
    if told(making.forecast(), given.plan, voice):
        return 0
    found, complete = _carried_out(making)
    if not complete:
        voice.show(EARLY)
        return STOPPED
    outcome = making.plan.scene.outcome
    if found is None or outcome.status != DONE:
        voice.show(f"The run of the map failed: {outcome.reason}")
        return outcome.exit_code or PHYSICS
    show_estimate(found, making, voice)
    voice.say(f"in {making.place}: report.html (the estimate), scene/report.html (the run), estimate.json, estimate.png")
    return 0


COMMAND = Command(Options, _carry_out, more=(
    "An elastic half-space on the rigid map, or two rough solids (--counter), bound by an exponential attraction: run, path at a held "
    "mean height, estimate, report. The same command goes on where it stopped."))
