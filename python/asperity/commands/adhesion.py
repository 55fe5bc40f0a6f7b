# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity adhesion`: from a measured map to its adhesion with an error, in one call.

The runs and the output are those of `estimate` for the map's scene (map_scene.py).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from ..arguments import checks_call, checks_calls, chosen
from ..errors import BY_CODE, InternalError, Named, Stopped
from ..files import store
from ..reports import estimate as report_estimate
from ..reports.run import run_page_files, write_run_page
from ..results.result import Result
from ..running import lock, program
from ..running.pool import DONE, PHYSICS, STOPPED, PoolOptions, refuse_jobs, require_free_runs
from ..studies.estimates import MAP_FILES, OF_A_MAP, RESULT, Estimate, Estimating
from ..studies.map_scene import MapScene, scene_of, stem_of
from ..terminal import Voice
from .studies import told


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
        return report_estimate.quote(self.estimate.number(path))

    def __repr__(self) -> str:
        return f"<Adhesion {self.directory}: {self.quote()}>"


@checks_call
def adhesion(map: str | os.PathLike, young: str | None = None, poisson: float | None = None, adhesion: str | None = None,
             out: str | os.PathLike | None = None, range: str | None = None, size: str | None = None, unit: str | None = None,
             channel: str | None = None, sites: int | None = None, jobs: int = 1, line_noise: str | None = None, *,
             E: str | None = None, nu: float | None = None, work: str | None = None, w: str | None = None,
             file_size: str | None = None, file_unit: str | None = None) -> Adhesion:
    """Computes the adhesion of an elastic half-space on a measured, rigid map, with its error.

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
    E, nu, work, w, file_size, file_unit : optional
        Other names of young, poisson, adhesion (work and w), size and unit.

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
    program.refuse_ranks()
    refuse_jobs(jobs)
    stiffness = chosen("young", 'young="100 GPa"', young=young, E=E)
    ratio = chosen("poisson", "poisson=0.25", poisson=poisson, nu=nu)
    bond = chosen("adhesion", 'adhesion="200 mJ/m2"', adhesion=adhesion, work=work, w=w)
    size, unit = chosen("size", size=size, file_size=file_size), chosen("unit", unit=unit, file_unit=file_unit)
    place = store.chosen(None if out is None else str(out), _place(str(map)))
    _require_free(place, str(map))
    made = scene_of(str(map), stiffness, ratio, bond, place, reach=range, size=size, unit=unit, channel=channel, sites=sites,
                    line_noise=line_noise)
    making = _estimating(made, place, PoolOptions(jobs=jobs, progress="off"), lambda _: None)
    making.warn()
    found, complete = _carried_out(making)
    if not complete:
        raise Stopped(str(place), "the estimate stopped early", "", "the same call goes on from here")
    if found is None:
        outcome = making.plan.scene.outcome
        raise BY_CODE.get(outcome.exit_code, InternalError)(str(place), "the run of the map failed", outcome.reason)
    return Adhesion(found, Result(place / "scene"), made.notes, made.file, place)


def _estimating(made: MapScene, place: Path, options: PoolOptions, say: Callable[[str], None]) -> Estimating:
    return Estimating(str(made.file), [], str(place), options, None, (), made.also, made.notes, say, made.withheld, made.condition,
                      of_sites="--sites")


def _require_free(place: Path, file: str) -> None:
    """Checks that no file would be replaced. Raises SceneError."""
    require_free_runs(place, OF_A_MAP)
    page = [] if store.is_named(place / "scene", "report.html") else run_page_files(["relaxed"], ("png",))
    store.require_free({place: ["map.npy", f"{stem_of(file)}.toml", RESULT, *report_estimate.FILES], place / "maps": MAP_FILES,
                        place / "scene": page}, inputs=[file])


def _place(file: str) -> str:
    return f"results/{Path(file.partition(':/')[0]).stem}-adhesion"


def _carried_out(making: Estimating) -> tuple[Estimate | None, bool]:
    """Carries out the estimate and writes its page and that of its run."""
    with lock.in_use(making.place):
        found, complete = making.carry_out()
        if complete and found is not None:
            report_estimate.write(found)
            if not (making.place / "scene/report.html").exists():
                write_run_page(Result(making.place / "scene"), ("png",))
    return found, complete


def adhesion_command(file: str, young: str, poisson: float, adhesion: str, out: str | None, options: PoolOptions, plan: bool, voice: Voice,
                     **more) -> int:
    """Carries out `asperity adhesion`.

    Parameters
    ----------
    file : str
        Map of heights.
    young : str
        Young's modulus of the half-space with its unit.
    poisson : float
        Poisson's ratio of the half-space.
    adhesion : str
        Work of adhesion of flat surfaces with its unit.
    out : str | None
        Result directory; None: the default one.
    options : PoolOptions
        Options of the runs.
    plan : bool
        True: only tells what would be run.
    voice : Voice
        Output of the command.
    **more : Any
        Further arguments of map_scene.scene_of().

    Returns
    -------
    int
        The exit code.
    """
    place = store.chosen(out, _place(file))
    _require_free(place, file)
    made = scene_of(file, young, poisson, adhesion, place, **more)
    for line in (f"{file}: a scene of it is {made.file}", *(f"note: {note}" for note in made.notes)):
        voice.say(line)
    making = _estimating(made, place, options, voice.say)
    if told(making.forecast(), plan, voice):
        return 0
    found, complete = _carried_out(making)
    if not complete:
        voice.show("Stopped early: the same command goes on from here.")
        return STOPPED
    outcome = making.plan.scene.outcome
    if found is None or outcome.status != DONE:
        voice.show(f"The run of the map failed: {outcome.reason}")
        return outcome.exit_code or PHYSICS
    voice.show(report_estimate.text_of(replace(found, notes=[note for note in found.notes if note not in making.said])))
    voice.tell({**found.json(), "directory": place})
    voice.say(f"in {place}: report.html (the estimate), scene/report.html (the run), estimate.json, estimate.png")
    return 0
