# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity adhesion`: from a measured map to its adhesion with an error, in one call.

The map is read, checked and made into a scene beside it: an elastic half-space on a wall with an exponential attraction of
the given work, led in and out at a held mean height. What the estimate of this scene runs and says is `estimate`'s.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import files, maps, missing_waves, program, report_estimate
from .errors import BY_CODE, InternalError, SceneError, Stopped
from .estimate_parts import SpacingAlso
from .estimates import MAP_FILES, RESULT, Estimate, Estimating, surface_made
from .pool import DONE, PHYSICS, STOPPED, PoolOptions, refuse_jobs
from .report import run_page_files, write_run_page
from .result import Result, Values
from .scene import scene_file, toml_of
from .units import GIGAPASCAL, MILLIJOULE
from .variations import Setting

SITES = 256
"""Sites along an edge unless others are asked for: a path and its variations take minutes."""
SITE_BYTES = 1200
"""Of a quasi-static path; the finest variation has four times as many sites."""
RANGE = "3 Å"
WIDEST_PIXEL = 1e4
"""Å"""
UNITS = {"E": ("GPa", "MPa"), "work": ("J/m^2", "mJ/m^2"), "range": ("Å", "nm"), "size": ("nm", "µm")}


@dataclass
class Adhesion:
    """Adhesion on a map: estimate (.numbers), result (the run of the map's scene: series, fields), notes on changes of the
    map, scene (its file), directory."""

    estimate: Estimate
    result: Result
    notes: list[str]
    scene: Path
    directory: Path

    def quote(self, path: str = "") -> str:
        """Spells a number as it is published.

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


ARGUMENTS = {"block.young": "E", "block.poisson": "nu", "interface.adhesion": "work", "interface.range": "range",
             "surface.file_size": "size", "surface.line_noise": "line_noise"}
"""What a scene's keys are called here."""


def _with_unit(name: str, value: object) -> str:
    """Returns the text of a quantity with its unit, as scenes have it."""
    text = re.sub(r"m2$", "m^2", str(value).strip())
    if re.fullmatch(r"[-+\d.eE]*", text):
        raise SceneError(f"{name} = {value!r}", "has no unit", "a bare number may be meant in several",
                         "write the one that is meant: " + " or ".join(f'"{text or 1} {unit}"' for unit in UNITS[name]))
    return text


def _read(file: str, unit: str | None, size: float | None, channel: str | None) -> tuple[np.ndarray, float, list[str]]:
    """Reads a square map: heights (Å, NaN at missing points), edge (Å), notes. Raises SceneError if adhesion cannot be
    computed of the map."""
    found = maps.read_map(file, unit, size or None, channel)
    heights, notes = found.heights, list(found.notes)

    def refuse(what: str, why: str, fix: str) -> SceneError:
        return SceneError(file, what, why, fix)

    rows, columns = heights.shape
    if min(rows, columns) < maps.FEWEST:
        raise refuse(f"has {columns} x {rows} points", f"{maps.FEWEST} along an edge are the least of which a surface is "
                     "made", "export the whole map")
    if found.size is None:
        raise refuse("does not tell how wide it is", "", 'name the length of its shorter edge: --size "100 nm"')
    missing = np.isnan(heights)
    if missing.mean() > 0.5:
        raise refuse("has no heights" if missing.all() else f"lacks {100 * missing.mean():.0f} % of its heights",
                     f"{int(missing.sum())} of {missing.size} points are missing", "export a part that was measured")
    pixel = [length / count for length, count in zip(found.size, (columns, rows))]
    if abs(pixel[0] / pixel[1] - 1) > 0.005:
        raise refuse("has pixels that are not square", f"{pixel[0]:.4g} x {pixel[1]:.4g} Å", "resample it before")
    if pixel[0] > WIDEST_PIXEL:
        raise refuse(f"has pixels of {pixel[0] / 1e4:.4g} µm", "adhesion is decided by roughness down to nanometres, which such "
                     "a map does not show", "measure a smaller area, or correct the unit of the file")
    if rows != columns:
        notes.append(f"the map is not square: its middle is taken, {min(rows, columns)} points along an edge")
        heights = maps.square(heights)
    steepest = max(np.nanmax(abs(np.diff(heights, axis=axis))) for axis in (0, 1))
    highest = float(np.nanmax(heights) - np.nanmin(heights))
    if not highest > 0.0:
        notes.append("the map is flat")
    for axis in (0, 1):
        along = np.abs(np.diff(heights, axis=axis)) > 0.5 * highest
        if highest > 0.0 and along.any(axis=axis).mean() > 0.5:
            raise refuse("has a step edge across it", f"most lines jump by more than half of its height, {highest:.4g} Å, "
                         "from one point to the next, and a plane cannot be subtracted from it",
                         "cut it to one side of the step, or write a scene of it (surface.detrend)")
    if missing.any():
        notes.append(f"{int(missing.sum())} points without a height are filled by Laplace's equation")
    if steepest > pixel[0]:
        notes.append(f"neighbouring points differ in height by up to {steepest / pixel[0]:.3g} pixels: so steep a map shows the side "
                     "of the tip")
    return heights, pixel[0] * len(heights), notes


def _smooth_below(most: int) -> int:
    """Returns the largest even number up to `most` that has no prime factor above 5."""
    def smooth(n: int) -> bool:
        for p in (2, 3, 5):
            while n % p == 0:
                n //= p
        return n == 1

    return next(n for n in range(most - most % 2, 0, -2) if smooth(n))


class MapScene(NamedTuple):
    """file: of the scene; notes: on what was made of the map; also: what another spacing sets too; withheld, condition: of
    numbers that depend on the range of the attraction, why they are not stated, or for which range they hold."""

    file: Path
    notes: list[str]
    also: SpacingAlso
    withheld: str
    condition: str


def scene_of(file: str, young: object, poisson: float, work: object, place: Path, *, reach: object = None,
             size: object = None, unit: str | None = None, channel: str | None = None, sites: int | None = None,
             line_noise: str | None = None) -> MapScene:
    """Writes the scene of a map and the map beside it. Raises SceneError for what no scene can be made of, before anything is
    written."""
    sections = {"block": {"young": _with_unit("E", young), "poisson": poisson},
                "surface": {"kind": "flat", "sites": 32, "line_noise": line_noise},
                "interface": {"kind": "wall", "adhesion": _with_unit("work", work),
                              "range": _with_unit("range", reach or RANGE)}, "drive": {"path": ["relax"]}}
    if size is not None:
        sections["surface"]["file_size"] = _with_unit("size", size)
    try:
        with scene_file(sections) as checked:  # the program reads the units
            keys = Values(program.check(checked)["scene"])
    except SceneError as error:
        said = re.sub(r"^.*?: (?=[a-z]+\.\w+ = )", "", str(error), flags=re.M)  # the place in a scene that nobody has seen
        raise SceneError(re.sub(r"^[a-z]+\.\w+(?= = )", lambda key: ARGUMENTS.get(key[0], key[0]), said, flags=re.M)) from None
    if not keys.number("interface.adhesion") > 0.0:
        raise SceneError(f"work = {work}", "is no adhesion", "the work of flat surfaces is above zero", 'for example "50 mJ/m^2"')
    heights, edge, notes = _read(file, unit, keys.number("surface.file_size"), channel)
    points = len(heights)
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")  # what is free now would be another scene later
    most = min(points, sites or SITES, int(math.sqrt(memory / (2 * 4 * SITE_BYTES))))
    n = _smooth_below(max(most, maps.FEWEST))
    spacing = edge / n
    stiff = keys.number("block.young") * GIGAPASCAL / (1 - keys.number("block.poisson") ** 2)  # eV/Å³
    adhesion, asked = keys.number("interface.adhesion") / 1e3, keys.number("interface.range")

    def resolved(spacing: float) -> float:
        """Returns the range, Å, whose attraction reaches over two spacings beside an edge of the contact (docs/explanation/model.md)."""
        return max(asked, math.sqrt(2 * spacing * adhesion / stiff))

    used = resolved(spacing)
    longer = f'--range "{math.ceil(used * 1e3) / 1e3:g} Å"'

    def sites_for(reach: float) -> str:
        """Spells the option of as many sites as resolve this range, "--sites 96, or "; "" if the map has fewer points."""
        least = edge * 2 * adhesion / (stiff * reach**2)
        enough = next((k for k in range(max(n, math.ceil(least)), points + 1) if _smooth_below(k) == k), 0)
        return f"--sites {enough}, or " * (enough > n)

    if reach is not None and used > 1.001 * asked:
        raise SceneError(f"range = {reach}", f"is not resolved by a spacing of {spacing:.4g} Å", "beside the edge of a contact it "
                         f"would act on less than two sites (work / E* = {adhesion / stiff:.3g} Å)", f"{sites_for(asked)}{longer}; or "
                         "leave it out for the numbers that depend on no range")
    if used > 0.25 * edge:
        raise SceneError(file, f"is too small for so soft a solid: its attraction would reach {used:.3g} Å, and the map is "
                         f"{edge:.4g} Å wide", f"on a spacing of {spacing:.3g} Å the edge of a contact is resolved with a range "
                         f"of {used:.3g} Å (work / E* = {adhesion / stiff:.3g} Å)", "take more sites, a wider map, or a stiffer solid")
    flat = maps.without_tilt(heights)
    rms = float(np.nanstd(maps.without_plane(heights)))
    if used > 1.001 * asked and used > rms > 0.0:
        flattened = stiff * missing_waves.energy_shown(heights, edge) * 1e3 * MILLIJOULE
        raise SceneError(file, f"is too smooth for so soft a solid: its attraction would reach {used:.3g} Å, and the rms height is "
                         f"{rms:.3g} Å", f"on a spacing of {spacing:.3g} Å the edge of a contact is resolved with that range (work / E* = "
                         f"{adhesion / stiff:.3g} Å), which would act across the roughness in place of pressing it flat; pressed flat, the "
                         f"map stores {flattened:.3g} of the {1e3 * adhesion * MILLIJOULE:.3g} mJ/m^2 of the work",
                         f"{sites_for(rms)}a map with smaller pixels; or, if the attraction does reach so far, {longer}")
    withheld = condition = ""
    if used > 1.001 * asked:
        notes.append(f"the range of the attraction is {used:.4g} Å in place of {asked:.4g} Å, which a spacing of "
                     f"{spacing:.4g} Å does not resolve; numbers that depend on it are not stated, and the part spacing of the "
                     "others follows it")
        withheld = (f"the range of the attraction decides, and is {0.1 * used:.3g} nm, which the spacing resolves, in place of "
                    f"{0.1 * asked:.3g} nm; {longer} states what holds for that range")
    else:
        condition = f"for a range of {0.1 * used:.3g} nm"
    periodic = maps.jump(flat) < maps.PERIODIC
    if periodic:
        heights = flat
    notes.append("its tilt is subtracted, and without it the map is periodic" if periodic else "the mean plane is subtracted, and "
                 "a smooth part that contains the jumps between opposite edges: the part edge is its effect")
    scene = {"surface": {"kind": "file", "file": "map.npy", "file_unit": "Å", "file_size": edge, "file_missing": "fill",
                         "sites": n, "spacing": spacing, "detrend": "none" if periodic else "periodic", "resample": "band-limited",
                         "line_noise": line_noise},
             "block": {"young": keys.number("block.young"), "poisson": poisson, "thickness": n},
             "interface": {"kind": "wall", "adhesion": keys.number("interface.adhesion"), "range": used,
                           "frictionless": True},
             "drive": {"mode": "quasistatic", "control": "mean-height", "path": ["approach", "pull-off"], "displacement_step": 0.25 * used}}
    stem = _stem(file)
    with files.outputs(place, ("map.npy", f"{stem}.toml"), inputs=[file]) as out:
        with out.replacing("map.npy") as beside, open(beside, "wb") as opened:
            np.save(opened, heights)
        out.write(f"{stem}.toml", f"# Written by asperity adhesion from {Path(file).name}.\n" + toml_of(scene))
    slope = math.sqrt(np.nanmean(np.diff(flat, axis=0) ** 2) + np.nanmean(np.diff(flat, axis=1) ** 2)) * points / edge
    made = surface_made(str(place / f"{stem}.toml"))
    notes += [doubt.replace("surface.line_noise = ", "--line-noise ") for doubt in made.doubts]
    kept = made.slope
    if n < points:
        notes.append(f"waves below {2 * spacing / 10:.3g} nm are lost: {n} of {points} points along an edge carry an rms slope of "
                     f"{kept:.3g}; the map's neighbours have {slope:.3g}")
    else:
        notes.append(f"all {points} points along an edge are taken, {spacing / 10:.3g} nm apart; roughness below is not measured")

    def also(factor: float) -> Setting:
        return [f"interface.range={resolved(factor * spacing):.10g}"] * (used > asked)

    return MapScene(place / f"{stem}.toml", notes, also, withheld, condition)


def adhesion(map: str | os.PathLike, E: str, nu: float, work: str, out: str | os.PathLike | None = None,
             range: str | None = None, size: str | None = None, unit: str | None = None, channel: str | None = None,
             sites: int | None = None, jobs: int = 1, line_noise: str | None = None) -> Adhesion:
    """Computes the adhesion of a soft or hard elastic half-space on a measured, rigid map, with its error.

        found = asperity.adhesion("scan.gwy", E="100 GPa", nu=0.25, work="200 mJ/m^2")
        found.quote(), found.quote("lost.cycle"), found.notes

    Parameters
    ----------
    map : str or os.PathLike
        File of heights: HDF5, .npy, or any that `convert` reads.
    E, work : str
        Young's modulus of the half-space and work of adhesion of flat surfaces, with units.
    nu : float
        Poisson's ratio of the half-space.
    out : str or os.PathLike, optional
        Directory; None: results/<map>-adhesion. Runs that are there are not run again.
    range : str, optional
        Range of the exponential attraction, with its unit; None: 3 Å, or the range that the spacing resolves.
    size, unit : str, optional
        Shorter edge, with its unit, and unit of the heights; they hold over the file, and a note names both.
    channel : str, optional
        Name or number of the map in a file with several.
    sites : int, optional
        Sites along an edge; None: as many as the map has, 256 at most.
    jobs : int
        Runs side by side; they share the processors.
    line_noise : str, optional
        Treatment of a scan's noise from line to line: "align-rows" or "isotropic" (surface.line_noise).

    Returns
    -------
    Adhesion
        The numbers with their errors, the run, and notes on changes of the map.

    Raises
    ------
    SceneError
        The map or an argument is refused, or files are in the way.
    Stopped
        The estimate stopped early; the same call continues.
    Error
        The run of the map failed.
    """
    program.refuse_ranks()
    refuse_jobs(jobs)
    place = files.chosen(None if out is None else str(out), _place(str(map)))
    _require_free(place, str(map))
    made = scene_of(str(map), E, nu, work, place, reach=range, size=size, unit=unit, channel=channel, sites=sites,
                    line_noise=line_noise)
    making = _estimating(made, place, PoolOptions(jobs=jobs, progress="off"), lambda _: None)
    found, complete = _carried_out(making)
    if not complete:
        raise Stopped(str(place), "the estimate stopped early", "", "the same call goes on from here")
    if found is None:
        outcome = making.plan.scene.outcome
        raise BY_CODE.get(outcome.exit_code, InternalError)(str(place), "the run of the map failed", outcome.reason)
    return Adhesion(found, Result(place / "scene"), made.notes, made.file, place)


def _estimating(made: MapScene, place: Path, options: PoolOptions, say: Callable[[str], None]) -> Estimating:
    return Estimating(str(made.file), [], str(place), options, None, (), made.also, made.notes, say, made.withheld, made.condition)


def _stem(file: str) -> str:
    """Returns the name of the scene of a map."""
    return re.sub(r"[^\w.-]", "-", Path(file.partition(":/")[0]).stem) or "map"


def _require_free(place: Path, file: str) -> None:
    """Checks that no file is in the way of those that are known beforehand: all but the runs'. Raises SceneError."""
    page = [] if files.is_named(place / "scene", "report.html") else run_page_files(["relaxed"], ("png",))
    files.require_free({place: ["map.npy", f"{_stem(file)}.toml", RESULT, *report_estimate.FILES], place / "maps": MAP_FILES,
                        place / "scene": page}, inputs=[file])


def _place(file: str) -> str:
    return f"results/{Path(file.partition(':/')[0]).stem}-adhesion"


def _carried_out(making: Estimating) -> tuple[Estimate | None, bool]:
    """Carries out the estimate and writes its page and that of its run."""
    with files.in_use(making.place):
        found, complete = making.carry_out()
        if complete and found is not None:
            report_estimate.write(found)
            if not (making.place / "scene/report.html").exists():
                write_run_page(Result(making.place / "scene"), ("png",))
    return found, complete


def adhesion_command(file: str, young: str, poisson: float, work: str, out: str | None, options: PoolOptions, **more) -> int:
    """Carries out `asperity adhesion`. Returns the exit code."""
    place = files.chosen(out, _place(file))
    _require_free(place, file)
    made = scene_of(file, young, poisson, work, place, **more)
    print(f"{file}: a scene of it is {made.file}", *(f"note: {note}" for note in made.notes), sep="\n", flush=True)
    making = _estimating(made, place, options, lambda text: print(text, flush=True))
    print(making.told(), flush=True)
    found, complete = _carried_out(making)
    if not complete:
        print("Stopped early: the same command goes on from here.")
        return STOPPED
    outcome = making.plan.scene.outcome
    if found is None or outcome.status != DONE:
        print(f"The run of the map failed: {outcome.reason}")
        return outcome.exit_code or PHYSICS
    print(report_estimate.text_of(replace(found, notes=[note for note in found.notes if note not in made.notes])))
    print(f"in {place}: report.html (the estimate), scene/report.html (the run), estimate.json, estimate.png")
    return 0
