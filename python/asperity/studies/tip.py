# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A tip on a cantilever, pressed onto a sample that is elastic, or yields, and pulled off: scenes, force curve, JKR's fit to it, and the
hardness and modulus that an instrument reads from the unloading.

Tip and roughness are one rigid surface that faces a flat elastic half-space, without periodic images. The scene is run unchanged,
and with a coarser spacing, a wider box and longer steps; the differences give the parts of the errors. Lengths are in nm, forces in
nN, moduli in GPa, works in N/m, unless a name says otherwise.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.ndimage import uniform_filter
from scipy.optimize import least_squares

from ..arguments import checks_call, checks_calls
from ..errors import Error, InputOutputError, SceneError
from ..files import store
from ..maps import height_map
from ..results.frames import data_frame
from ..results.result import Result, Values, read_json
from ..running import program
from ..running.scene import scene_file, toml_of
from ..theories.sphere import RATIOS, jkr, maugis
from ..theories.tip_shape import STEEPEST, TipShape, measured_tip
from ..theories.yielding import FULLY, Unloading, YieldingSphere, oliver_pharr
from ..units import ATTOJOULE, MILLIJOULE, NANONEWTON, conversion
from .forecast import START, Forecast, Size, seconds_of
from .map_scene import SITE_BYTES, edge_of, hardness_of, length, named, read_square, with_hardness, with_unit
from .stated_number import NAN, Found, Number, WithNumbers, numbers_of

FEWEST, MOST = 64, 256
"""Sites along an edge of the box unless others are asked for."""
LEAST = 24
"""Of which a coarser box can be made."""
RESULT, CURVE = "tip.json", "curve.csv"
"""Files of the numbers and of the force curve."""
RANGE = "3 Å"
ROOM = 1.3
"""Least width of the box over the diameter of the contact."""
ACROSS = 10
"""Least number of sites in the contact's radius without load."""
WIDEST = STEEPEST / math.sqrt(1 + STEEPEST**2)
"""Largest radius of the contact over that of the tip."""
COARSER, WIDER, LONGER = 1.5, 1.3, 2.0
"""Factors of spacing, width and step of the variations."""
PARTS = {"spacing": 1 / (COARSER - 1), "width": 1.0, "step": 1 / (LONGER - 1)}
"""Errors over the differences of a variation: an error of first order in spacing and step."""
RUN_OF = {"": "the tip", "spacing": "coarser spacing", "width": "wider box", "step": "longer steps"}
"""Words for the runs."""
EDGE = 0.15
"""Radius of a circle by its sites less its radius, in spacings."""
GRAIN = 0.01
"""Least error of a force or energy over its size, times the contact's radius in spacings."""
OF_SPACING, OF_STEP = 0.15, 0.005
"""Errors of the pull-off force over its size: per spacing over the radius of a contact, as tips over rings show, and by a step."""
LARGE = 0.15
"""Error of the pull-off force over its size from which a note says what reduces it."""
CUT = 0.02
"""Attraction beyond the box over the pull-off force from which JKR is not fitted."""
ALL_AT_HARDNESS = 0.9
"""Share of the contact at the hardness from which the load over the area is the hardness."""
JKR_FROM, DMT_BELOW = 5.0, 0.1
"""Maugis' parameter."""


class Contact(NamedTuple):
    """A tip on a half-space: radius of its end, E*, work of adhesion, range of the attraction, stiffness of the cantilever, the shape
    of a tip that is no sphere, and the hardness (infinite: the half-space is elastic)."""

    radius: float
    modulus: float
    work: float
    range: float
    stiffness: float
    shape: TipShape | None = None
    hardness: float = math.inf

    @property
    def yields(self) -> bool:
        """True if the half-space has a hardness."""
        return math.isfinite(self.hardness)

    @property
    def first_yield(self) -> float:
        """Load of the first yield without adhesion, nN."""
        return YieldingSphere(self.radius, self.modulus, self.hardness).first_yield

    @property
    def stiffness_of_contact(self) -> float:
        """K = 4 E*/3, GPa."""
        return 4 * self.modulus / 3

    @property
    def unit(self) -> float:
        """Force πwR, nN."""
        return math.pi * self.work * self.radius

    @property
    def parameter(self) -> float:
        """Maugis' λ for the largest stress w/range of the exponential attraction."""
        return 2 * self.work / self.range * float(np.cbrt(self.radius / (math.pi * self.work * self.stiffness_of_contact**2)))

    @property
    def tabor(self) -> float:
        """Tabor's number (R w²/E*²)^(1/3)/range."""
        return float(np.cbrt(self.radius * self.work**2 / self.modulus**2)) / self.range

    def step(self, load: float) -> float:
        """Returns the step of the drive, nm. It moves the force by a hundredth of πwR, through cantilever and contact in series, or the tip by a
        tenth of the length over which the attraction or the contact changes; at most the range, by which the tip moves before contact.
        A contact at the hardness changes over 2HA/E*."""
        contact = float(np.cbrt((self.unit / self.stiffness_of_contact) ** 2 / self.radius))
        if self.yields:
            contact = max(contact, 2 * math.sqrt(load * self.hardness / math.pi) / self.modulus)
        series = 1 / self.stiffness + 1 / (2 * self.modulus * self.radius_at(0.0))
        return min(self.range, max(0.01 * self.unit * series, 0.1 * min(self.range, contact)))

    @property
    def model(self) -> str:
        """Name of the theory that applies to the smooth sphere: JKR, DMT or Maugis."""
        return "JKR" if self.parameter > JKR_FROM else "DMT" if self.parameter < DMT_BELOW else "Maugis"

    def pull_off(self) -> float:
        """Returns the pull-off force of the smooth sphere by Maugis and Dugdale, nN."""
        return -self.unit * float(np.nanmin(maugis(self.parameter, RATIOS)[0]))

    @property
    def words(self) -> str:
        """The tip in words."""
        return self.shape.words if self.shape else f"sphere of {self.radius:.4g} nm"

    @property
    def widest(self) -> float:
        """Largest contact radius whose edge is gently sloped, nm."""
        return self.shape.widest if self.shape else WIDEST * self.radius

    def pull_off_by_jkr(self) -> float:
        """Returns the pull-off force of the smooth tip by JKR, nN."""
        return 1.5 * self.unit if self.shape is None else -float(self.shape.contact(self.modulus, self.work, 0.0)[2].min())

    def expected_error(self, spacing: float, range: float, curvature: float) -> float:
        """Returns the error of the pull-off force over its size that is expected of a spacing, nm: a sixth of the spacing over the
        radius of a contact, the change by a longer range, and a step. curvature: rms of the sample's, 1/nm."""
        contact = self._replace(radius=1 / (1 / self.radius + curvature), shape=None)
        longer = abs(self._replace(range=range).pull_off() / self.pull_off() - 1)
        return math.hypot(OF_SPACING * spacing / contact.radius_at(0.0), longer, OF_STEP)

    def radius_at(self, force: float) -> float:
        """Returns JKR's contact radius under a force, nm; at least that of a contact at the hardness which bears the attraction too."""
        if self.shape:
            a, _, forces = self.shape.contact(self.modulus, self.work, force)
            stable = slice(int(np.argmin(forces)), None)
            return float(np.interp(force, forces[stable], a[stable]))
        f = 3 * self.unit
        elastic = float(np.cbrt(self.radius / self.stiffness_of_contact * (force + f + math.sqrt(2 * f * force + f * f))))
        return max(elastic, math.sqrt((force + 2 * self.unit) / (math.pi * self.hardness)))

    def force_at(self, radius: float) -> float:
        """Returns the force at a contact radius by the rule of radius_at(), nN."""
        if self.shape:
            a, _, forces = self.shape.contact(self.modulus, self.work, 3 * self.unit)
            return float(np.interp(radius, a, forces))
        cubed = self.stiffness_of_contact * radius**3
        return min(cubed / self.radius - math.sqrt(6 * self.unit / self.radius * cubed), math.pi * radius**2 * self.hardness - 2 * self.unit)

    @property
    def load(self) -> float:
        """Largest force unless another one is given, nN: JKR's pull-off force; on a sample that yields the force from which all of the
        contact is at the hardness, if slopes stay gentle."""
        elastic = 1.5 * self.unit
        return max(elastic, min(FULLY * self.first_yield, 0.8 * self.force_at(WIDEST * self.radius))) if self.yields else elastic


class Fit(NamedTuple):
    """Fit of JKR to the retraction: work of adhesion and E* with standard errors, the zero of separations, nm, and the rms
    deviation, nN. failed: reason why there is no fit."""

    work: float = NAN
    work_error: float = NAN
    modulus: float = NAN
    modulus_error: float = NAN
    zero: float = NAN
    misfit: float = NAN
    failed: str = ""


@dataclass
class Plan:
    """Runs of a tip: the scenes by part ("" is the scene itself), the contact, and notes. asked_range: requested
    range before its increase, nm; longer_step: setting of the run with longer steps; spacing: of the sites, nm; beyond: attraction
    beyond the edges of the box, nN; expected, asked_error: the error of the pull-off force over its size that is expected, and the one that
    is asked for, or None."""

    scenes: dict[str, Path]
    contact: Contact
    load: float
    asked_range: float
    notes: list[str]
    longer_step: str
    spacing: float
    beyond: float
    expected: float
    asked_error: float | None

    @property
    def not_stated(self) -> dict[str, str]:
        """Reasons why numbers will not be stated, by number."""
        if not self.contact.range > 1.001 * self.asked_range:
            return {}
        why = (f"the range of the attraction decides, and is {self.contact.range:.3g} nm, which the spacing resolves, in place of "
               f"{self.asked_range:.3g} nm: that takes {(self.contact.range / self.asked_range) ** 2:.2g} times as many sites along an edge (sites)")
        return dict.fromkeys(("jump_in_distance", "lost", *["pull_off_force"] * self.contact.yields), why)


@checks_calls
@dataclass
class Tip(WithNumbers):
    """Contact of a tip: numbers with their errors, the force curve, the fit of JKR, the smooth sphere's theory.

    unloading                       what Oliver and Pharr read from the unloading of a sample that yields
    drive, tip, force, retracting   the curve: separation of the undeformed surfaces by the drive (the piezo) and by the tip,
                                    nm; force on the sample, nN, pressing is positive; True on the way out
    """

    numbers: list[Number]
    drive: np.ndarray
    tip: np.ndarray
    force: np.ndarray
    retracting: np.ndarray
    contact: Contact
    fit: Fit
    result: Result
    notes: list[str]
    directory: Path
    unloading: Unloading | None = None

    def columns(self) -> dict[str, np.ndarray]:
        """Returns the force curve as columns."""
        return {"drive": self.drive, "tip": self.tip, "force": self.force, "retraction": self.retracting}

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column."""
        return {"drive": "nm", "tip": "nm", "force": "nN", "retraction": ""}

    def frame(self):
        """Returns the force curve as a pandas DataFrame; its attrs["units"] has the unit of each column."""
        return data_frame(self.columns(), self.units)

    def __repr__(self) -> str:
        return f"<Tip {self.directory}: {self.numbers[0]}>"


def _checked(given: dict[str, Any], radius: str) -> Values:
    """Returns the keys of a scene with these quantities, in the scene's units. Raises SceneError that names the arguments."""
    return Values(_asked({"surface": {"kind": "flat", "sites": 32, "boundary": "free", "radius": radius},
                          "block": {"young": with_unit("young", given["young"]), "poisson": given["poisson"]},
                          "interface": {"kind": "wall", "adhesion": with_unit("adhesion", given["adhesion"]),
                                        "range": with_unit("range", given["range"] or RANGE), **with_hardness(given["hardness"])},
                          "drive": {"path": ["approach"], "mode": "quasistatic",
                                    "stiffness": with_unit("stiffness", given["stiffness"])}})["scene"])


def _asked(sections: dict[str, dict[str, Any]], to_run: bool = False) -> Values:
    """Returns what the program says of a scene. to_run: the scene must be one that can be run. Raises SceneError in the words of
    tip()."""
    try:
        with scene_file(sections) as file:
            answer = Values(program.check(file))
            if to_run and answer["problems"]:
                raise SceneError.of(answer["problems"])
            return answer
    except SceneError as error:
        raise SceneError.of([{"where": "", "what": named(one["what"]), "why": named(one["why"]),
                              "fix": named(one["fix"]).replace('; "none" is allowed too', "")} for one in error.listed]) from None


def _scene(keys: Values, contact: Contact, load: float) -> dict[str, dict[str, Any]]:
    """Returns the sections of the scenes of all runs. keys: the scene's keys of the sample; load: nN."""
    return {"surface": {"radius": f"{contact.radius:.10g} nm", "boundary": "free"} if contact.shape is None else {"boundary": "free"},
            "block": {"young": keys.number("block.young"), "poisson": keys.number("block.poisson")},
            "interface": {"kind": "wall", "adhesion": keys.number("interface.adhesion"), "range": f"{contact.range:.10g} nm",
                          "frictionless": True, **({"hardness": contact.hardness} if contact.yields else {})},
            "drive": {"mode": "quasistatic", "path": ["approach", "pull-off"], "load": f"{load:.10g} nN", "stiffness": contact.stiffness,
                      "displacement_step": f"{contact.step(load):.10g} nm"},
            "output": {"fields": ["relaxed"], "trajectory": "none"}}


def _refuse_steep(contact: Contact, load: float) -> None:
    """Raises SceneError if the contact, or the attraction beside it, is too wide for gentle slopes."""
    if contact.range > 0.3 * contact.radius:
        raise SceneError(f"range = {contact.range:g} nm", f"reaches around a {contact.words}",
                         "the surfaces are taken as gently sloped where they attract each other", "take a shorter range or a larger radius")
    widest = contact.widest
    if contact.radius_at(load) <= widest:
        return
    most = 0.95 * contact.force_at(widest)
    held = contact.radius_at(0.0) <= widest and most > 0
    raise SceneError(f"load = {load:g} nN", f"presses a {contact.words} into a contact of {2 * contact.radius_at(load):.3g} nm",
                     "the surfaces are taken as gently sloped, which such a contact is not",
                     (f'press less, for example load "{most:.2g} nN", or ' if held else "") + "take a larger tip, a stiffer sample or a "
                     "smaller work of adhesion")


def _force(text: object) -> float:
    """Returns a force with its unit, nN. Raises SceneError."""
    parts = re.fullmatch(r"\s*([-+\d.eE]+)\s*(\D.*?)\s*", str(text))
    factor = parts and conversion(parts[2], "nN")
    try:
        value = float(parts[1]) * factor if parts and factor else NAN
    except ValueError:
        value = NAN
    if not (math.isfinite(value) and value > 0):
        raise SceneError(f"load = {text}", "is no force that presses", "a tip is pressed onto the sample by a force above zero",
                         'for example "5 nN"')
    return value


class _Sample(NamedTuple):
    """Heights of a map, nm, and its pixel, nm."""

    heights: np.ndarray
    pixel: float

    def below(self, width: float, sites: int) -> np.ndarray:
        """Returns the heights at the sites of a box in the middle of the map, with their mean plane subtracted, nm."""
        spacing, points = width / sites, len(self.heights)
        smooth = uniform_filter(self.heights, max(1, round(spacing / self.pixel)), mode="nearest")
        at = (np.arange(points) + 0.5 - 0.5 * points) * self.pixel
        there = (np.arange(sites) + 0.5 - 0.5 * sites) * spacing
        return height_map.without_plane(RectBivariateSpline(at, at, smooth)(there, there))

    def curvature(self, width: float) -> float:
        """Returns the rms curvature of the heights in a box, 1/nm: all that the pixels show, as coarser sites lose roughness."""
        sites = max(3, round(width / self.pixel))
        bends = [np.diff(self.below(width, sites), 2, axis=axis) / (width / sites)**2 for axis in (0, 1)]
        return math.sqrt(float(np.mean([np.mean(bend**2) for bend in bends])))


def _with_box(keys: dict[str, dict[str, Any]], width: float, sites: int) -> dict[str, dict[str, Any]]:
    """Returns a smooth scene of a box of this width, nm."""
    return {**keys, "surface": {"kind": "flat", **keys["surface"], "sites": sites, "spacing": f"{width / sites:.10g} nm"}}


def _heights(sample: _Sample | None, shape: TipShape | None, width: float, sites: int) -> np.ndarray | None:
    """Returns the map of a box, nm: the sample's heights less the rise of a tip that is no sphere; None: there is neither."""
    heights = None if sample is None else sample.below(width, sites)
    if shape is None:
        return heights
    at = (np.arange(sites) - 0.5 * sites) * width / sites  # the apex is at a site, as that of a sphere
    return (0.0 if heights is None else heights) - shape.rise(*np.meshgrid(at, at))


def _written(place: Path, name: str, keys: dict[str, dict[str, Any]], heights: np.ndarray | None, width: float, sites: int) -> Path:
    """Writes the scene of a box, and its map in the same directory."""
    files = [f"{name}.toml"] + [f"{name}.npy"] * (heights is not None)
    scene = _with_box(keys, width, sites)
    if heights is not None:
        scene["surface"] |= {"kind": "file", "file": f"{name}.npy", "file_unit": "nm"}
    with store.outputs(place, files) as out:
        if heights is not None:
            with out.replacing(f"{name}.npy") as beside, open(beside, "wb") as opened:
                np.save(opened, heights)
        out.write(f"{name}.toml", "# Written by asperity tip.\n" + toml_of(scene))
    return place / f"{name}.toml"


def files_of(with_map: bool) -> list[str]:
    """Returns the names of the scenes and maps that plan_of() writes."""
    return [f"{name}.{ending}" for name in ("tip", "coarse", "wide") for ending in (("toml", "npy") if with_map else ("toml",))]


def plan_of(file: str | None, place: Path, given: dict[str, Any]) -> Plan:
    """Writes the scenes of a tip on a sample, after all checks. Raises SceneError."""
    size = None if given["size"] is None else edge_of(given["size"])
    shape, notes = _shape(given)
    keys = _checked(given, with_unit("radius", given["radius"]) if shape is None else f"{shape.radius:.10g} nm")
    for name, key in (("radius", "surface.radius"), ("adhesion", "interface.adhesion"), ("stiffness", "drive.stiffness")):
        if not keys.number(key, 0.0) > 0.0:
            raise SceneError(f"{name} = {given[name]}", "is not above zero", {"radius": "a tip is round", "stiffness": "the tip is held by "
                             "a cantilever", "adhesion": "the work of flat surfaces is above zero"}[name],
                             {"radius": 'for example "20 nm"', "stiffness": 'for example "0.2 N/m"', "adhesion": 'for example "50 mJ/m2"'}[name])
    if given["sites"] is not None and given["sites"] < LEAST:
        raise SceneError(f"sites = {given['sites']}", "are too few", f"a box with {COARSER:g} times the spacing is run for the error, and has 16 "
                         "sites at least", f"take {LEAST} or more, or leave it out")
    error = None if given["error"] is None else _share(given["error"])
    if error is not None and given["sites"] is not None:
        raise SceneError("sites", "are given beside the error", "the error decides how many are needed", "leave out one of them")
    poisson = keys.needed("block.poisson")
    contact = Contact(0.1 * keys.needed("surface.radius"), keys.needed("block.young") / (1 - poisson**2),
                      1e-3 * MILLIJOULE * keys.needed("interface.adhesion"), 0.1 * keys.needed("interface.range"), keys.needed("drive.stiffness"),
                      shape, hardness_of(keys, given["hardness"]) or math.inf)
    if contact.yields and shape is not None:
        raise SceneError("hardness", f"is given for a tip that is a {shape.words}", "the load of the first yield and the area that the unloading "
                         "tells are those of a sphere", "leave out hardness, or take a sphere (radius alone)")
    asked = contact.range
    load = float(f"{contact.load:.2g}") if given["load"] is None else _force(given["load"])
    sample, rms = None, 0.0
    if file is not None:
        heights, edge, said = read_square(file, given["unit"], size, given["channel"])
        sample, notes = _Sample(0.1 * height_map.filled(heights), 0.1 * edge / len(heights)), notes + said
    _refuse_steep(contact, load)
    reach = contact.radius_at(load)

    def width_for(rms: float, range: float) -> float:
        """Returns the width of a box for the contact and for the attraction around it, nm."""
        radius = contact.radius
        width = 2 * (ROOM * math.sqrt(reach**2 + 4 * radius * rms) + 4 * range)
        for _ in [0] * (1 if shape is None else 4):  # a tip that is no sphere attracts as the paraboloid that rises as much there
            radius = contact.radius if shape is None else max(contact.radius, shape.curvature_radius(0.5 * width))
            there = _asked(_with_box(_scene(keys, contact._replace(range=range, radius=radius, shape=None), load), width, 32))
            width = max(2 * (ROOM * math.sqrt(reach**2 + 4 * radius * rms) + 4 * range),
                        0.1 * there.needed("beyond_edges.width") + 4 * math.sqrt(2 * radius * rms) * bool(rms))
        return width

    def require_inside(width: float) -> None:
        for what, there in ((file, math.inf if sample is None else sample.pixel * len(sample.heights)),
                            (given["tip_map"], 2 * shape.half if shape else math.inf)):
            if WIDER * width > there:
                raise SceneError(str(what), f"is too small for this contact: {there:.4g} nm wide" + " around the apex" * (what != file),
                                 f"a contact of {2 * reach:.3g} nm, the attraction around it and a wider box to compare with take "
                                 f"{WIDER * width:.3g} nm", "press less (load), take a sharper tip, a shorter range, or a wider map")

    width = width_for(0.0, contact.range)
    require_inside(width)
    for _ in [0] * 3 if sample is not None else ():  # the rougher the sample, the wider is the region of its contacts
        rms = float(np.std(sample.below(width, FEWEST)))
        width = width_for(rms, contact.range)
        require_inside(width)
    finest = contact.modulus * contact.range**2 / (2 * contact.work)  # two sites beside the edge of a contact
    wanted = math.ceil(width / min(width / FEWEST, finest, contact.radius_at(0.0) / ACROSS, sample.pixel if sample is not None else math.inf))
    sites = given["sites"] or min(MOST, wanted + wanted % 2)

    def resolved(sites: int) -> float:
        """Returns the range of the attraction that acts on two sites beside the edge of a contact, nm: at least the asked one."""
        return max(contact.range, math.sqrt(2 * width / sites * contact.work / contact.modulus))

    curvature = 0.0 if sample is None else sample.curvature(width)

    def expected(sites: int) -> float:
        """Returns the error of the pull-off force over its size that is expected."""
        return contact.expected_error(width / sites, resolved(sites), curvature)

    if error is not None:
        sites = _sites_for(error, expected, f"{given['error']}", width)
    if resolved(sites) ** 2 > contact.range**2 / 0.999:
        longer = resolved(sites)
        if given["range"] is not None:
            raise SceneError(f"range = {given['range']}", f"is not resolved by a spacing of {width / sites:.3g} nm", "beside the edge of a "
                             f"contact it would act on less than two sites (w / E* = {contact.work / contact.modulus:.3g} nm)",
                             f'range "{math.ceil(1e3 * longer) / 1e3:g} nm", or leave it out for the numbers that depend on no range')
        notes.append(f"the range of the attraction is {longer:.3g} nm in place of {asked:.3g} nm, which a spacing of {width / sites:.3g} nm "
                     "does not resolve; numbers that depend on it are not stated")
        contact = contact._replace(range=longer)
        width = width_for(rms, longer)
        require_inside(width)
    if sample is not None:
        notes.append(f"the middle of the map is below the tip: {width:.3g} nm, {sites} sites along an edge; the mean plane is subtracted; "
                     f"its rms height is {float(np.std(sample.below(width, sites))):.3g} nm")
    scene = _scene(keys, contact, load)
    coarse = 2 * round(sites / COARSER / 2)
    wide = 2 * round(sites * WIDER / 2)
    boxes = {"": ("tip", width, sites), "spacing": ("coarse", width, coarse), "width": ("wide", width * wide / sites, wide)}
    as_sphere = contact if shape is None else contact._replace(radius=max(contact.radius, shape.curvature_radius(0.5 * width)), shape=None)
    checked = {part: _asked(_with_box(_scene(keys, as_sphere, load), box, across), to_run=True) for part, (_, box, across) in boxes.items()}
    beyond = 1.5 * as_sphere.unit * checked[""].needed("beyond_edges.part")
    scenes = {part: _written(place, name, scene, _heights(sample, shape, box, across), box, across)
              for part, (name, box, across) in boxes.items()}
    return Plan(scenes, contact, load, asked, notes, f"drive.displacement_step={LONGER * contact.step(load):.10g} nm", width / sites, beyond,
                math.hypot(expected(sites), beyond / (1.5 * contact.unit)), error)


def _shape(given: dict[str, Any]) -> tuple[TipShape | None, list[str]]:
    """Returns the shape of a tip that is no sphere, and notes. Raises SceneError for arguments that do not go together."""
    kind, file, angle = given["shape"], given["tip_map"], given["angle"]
    if file is not None:
        for name in ("radius", "angle"):
            if given[name] is not None:
                raise SceneError(name, "is given beside a measured tip", "its map has the whole tip", "leave it out")
        if kind != "sphere":
            raise SceneError(f"shape = {kind}", "is given beside a measured tip", "its map has the whole tip", "leave it out")
        try:
            heights, edge, notes = read_square(file, None, None, None)
        except Error as error:
            if "does not tell" not in str(error):
                raise
            raise SceneError(file, "does not tell how wide it is, or the unit of its heights", "no option says so of a measured tip",
                             "export it in a format that says both, .gwy for example, or as numbers below '# Width: 100 nm' and "
                             "'# Value units: nm'") from None
        found, said = measured_tip(0.1 * height_map.filled(heights), 0.1 * edge / len(heights))
        if not math.isfinite(found.radius) or not found.half > 0:
            raise SceneError(file, "has no apex", "its highest point is not round, or lies at the edge", "take a map with the apex in the middle")
        return found, [f"{note} (map of the tip)" for note in notes if "steep" not in note] + said + [f"the tip is a {found.words}"]
    if given["radius"] is None:
        raise SceneError("radius", "is missing", f"a {kind} is described by the radius of its end", 'for example --radius 20nm, or --tip-map FILE')
    if kind == "sphere":
        if angle is not None:
            raise SceneError("angle", "does not describe a sphere", "it is that between axis and flank", "leave it out, or take --shape cone")
        return None, []
    if angle is None or not 0 < angle < 90:
        raise SceneError("angle" if angle is None else f"angle = {angle:g}", "is missing" if angle is None else "is no angle between axis and flank",
                         f"a {kind} has one between 0 and 90 degrees", "for example --angle 65")
    return TipShape(kind, length("radius", given["radius"]), 1 / math.tan(math.radians(angle))), []


def _share(text: object) -> float:
    """Returns an error over its number: "10%". Raises SceneError."""
    parts = re.fullmatch(r"\s*([\d.eE+-]+)\s*%\s*", str(text))
    try:
        value = 0.01 * float(parts[1]) if parts else NAN
    except ValueError:
        value = NAN
    if not 0 < value < 1:
        raise SceneError(f"error = {text}", "is no share of the pull-off force", "it is above zero and below 100 %", "for example --error 10%")
    return value


def _sites_for(error: float, expected: Callable[[int], float], asked: str, width: float) -> int:
    """Returns the fewest sites along an edge of which an error is expected. Raises SceneError if they exceed the memory."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    most = int(math.sqrt(memory / (2 * SITE_BYTES)) / WIDER)
    at = sorted({2 * round(n / 2) for n in np.geomspace(min(FEWEST, most), most, 16)})
    errors = [expected(sites) for sites in at]
    if found := next((sites for sites, one in zip(at, errors) if one <= error), None):
        return found
    best = int(np.argmin(errors))
    raise SceneError(f"error = {asked}", f"is not reached on this computer: {100 * errors[best]:.2g} % is expected of {at[best]} sites along an edge",
                     f"its memory holds {most} sites beside a wider box, a spacing of {width / most:.2g} nm, and the error falls as the spacing "
                     "over the width of the contacts", f'--error {math.ceil(110 * errors[best])}%, a smoother map, or a longer range')


def forecast_of(plan: Plan, place: Path, left: Sequence[str], side_by_side: int) -> Forecast:
    """Returns what a plan runs. place: directory of the study; left: parts that are still to be run."""
    boxes = {part: Values(program.check(str(file))["scene"]) for part, file in plan.scenes.items()}
    seconds = {part: START + seconds_of(str(file), []) for part, file in plan.scenes.items()}
    boxes["step"], seconds["step"] = boxes[""], seconds[""] / LONGER
    sizes = []
    for part in left:
        sites = int(boxes[part].needed("surface.sites"))
        sizes.append(Size(RUN_OF[part], sites, 0.1 * sites * boxes[part].needed("surface.spacing"), seconds[part]))
    unstated = [(", ".join(NUMBERS[path][0].replace("_", " ") for path in plan.not_stated), next(iter(plan.not_stated.values())))] \
        if plan.not_stated else []
    return Forecast(place.name, place, len(boxes), len(left), sum(one.seconds for one in sizes) / side_by_side, unstated=unstated, sizes=sizes,
                    expected={"pull_off_force": plan.expected})


class _Measured(NamedTuple):
    """Numbers of a run by name, NaN if missing; the reason why one is missing; and the errors of those that are corrected or
    extrapolated."""

    values: dict[str, float]
    missing: dict[str, str]
    errors: dict[str, float]


def _curve(result: Result) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns drive and tip (separation of the undeformed surfaces, nm), force (nN), segment."""
    series = result.series
    zero = series["closest"][0]
    return (0.1 * (zero + series["drive_displacement"]), 0.1 * (zero + series["top_displacement"]),
            series["force"] / NANONEWTON, series["segment"])


def fold(tip: np.ndarray, force: np.ndarray, stiffness: float, degree: int) -> float:
    """Finds the place at which the tip jumps in, from an approach.

    The place z of the tip is a smooth function of the attraction F, which is exponential far away: z is a polynomial of ln F through
    the last points. The drive, z + F/k, comes no further than to the fold, where dz/dF = -1/k."""
    if len(tip) <= degree or not (force[-degree - 1:] < 0).all():
        return NAN
    x = np.log(-force[-degree - 1:] / stiffness)
    place = np.polynomial.Polynomial.fit(x, tip[-degree - 1:], degree)
    beyond = np.linspace(x[-1], x[-1] + 3, 3001)
    slope = place.deriv()(beyond) + np.exp(beyond)
    turned = np.flatnonzero(slope > 0)
    if not len(turned) or turned[0] == 0:
        return NAN
    i = int(turned[0])
    return float(place(beyond[i - 1] - (beyond[i] - beyond[i - 1]) * slope[i - 1] / (slope[i] - slope[i - 1])))


def _least(tip: np.ndarray, force: np.ndarray) -> float:
    """Returns the least force of points without a jump, by a parabola through the three points around it."""
    i = int(np.argmin(force))
    if not 0 < i < len(force) - 1:
        return float(force[i])
    bend, slope, least = np.polyfit(tip[i - 1:i + 2] - tip[i], force[i - 1:i + 2], 2)
    return float(least - 0.25 * slope**2 / bend) if bend > 0 else float(force[i])


def _measured(result: Result, contact: Contact) -> _Measured:
    drive, tip, force, segment = _curve(result)
    dissipated = result.series["dissipated"] / ATTOJOULE

    def before_jump(number: int) -> tuple[np.ndarray, bool]:
        """Returns the points of a segment up to its largest jump, and whether there is one."""
        points = np.flatnonzero(segment == number)
        lost = np.diff(dissipated[points])
        if not len(lost) or lost.max() <= 1e-4 * contact.unit * contact.range:
            return points, False
        return points[:int(np.argmax(lost)) + 1], True

    approach, jumps = before_jump(0)
    held, _ = before_jump(1)
    edge = EDGE * 0.1 * result.number("scene.surface.spacing", NAN)  # sites at the edge of the contact are counted whole
    width = 0.1 * result.edge
    radius = width * math.sqrt(max(0.0, result.number("contact_fraction", NAN)) / math.pi) - edge
    values = {"pull_off_force": -_least(tip[held], force[held]), "jump_in_distance": NAN, "contact_radius": radius, "lost": float(dissipated[-1])}
    missing, errors = {}, {"contact_radius": edge}
    if jumps:
        straight, values["jump_in_distance"] = (fold(tip[approach], force[approach], contact.stiffness, degree) for degree in (1, 2))
        errors["jump_in_distance"] = abs(values["jump_in_distance"] - straight)
        if not math.isfinite(errors["jump_in_distance"]):
            missing["jump_in_distance"] = "the points of the approach do not tell where its fold is"
    else:
        missing["jump_in_distance"] = "the tip comes into contact without a jump: the cantilever is stiffer than the attraction"
    if not values["contact_radius"] > 0:
        missing["contact_radius"] = "the surfaces are apart at zero load"
    if (unloading := _unloading(contact, tip, force)) is not None:
        top = int(np.argmax(force))
        values |= {"largest_depth": -float(tip[top]), "residual_depth": _depth_without_force(-tip[top:], force[top:]),
                   "hardness": unloading.hardness, "modulus": unloading.modulus, "largest_set": 0.1 * result.number("yielding.largest_set", NAN),
                   "plastic_work": float(result.series["dissipated_in_surface"][-1] / ATTOJOULE)}
        if not values["largest_set"] > 0:
            missing |= dict.fromkeys(("residual_depth", "hardness"), "the sample has not yielded: press more (load)")
        elif unloading.failed:
            missing |= dict.fromkeys(("hardness", "modulus"), unloading.failed)
    return _Measured(values, missing, errors)


def _unloading(contact: Contact, tip: np.ndarray, force: np.ndarray) -> Unloading | None:
    """Returns what Oliver and Pharr read from the curve of a sample that yields; None: it is elastic."""
    top = int(np.argmax(force))
    return oliver_pharr(contact.radius, -tip[top:], force[top:]) if contact.yields else None


def _depth_without_force(depth: np.ndarray, force: np.ndarray) -> float:
    """Returns the depth at which an unloading has no force, nm; NaN if it ends before."""
    after = int(np.argmax(force <= 0))
    return float(np.interp(0.0, force[[after, after - 1]], depth[[after, after - 1]])) if force[after] <= 0 and after > 0 else NAN


def _share_at_hardness(result: Result) -> float:
    """Returns the share of the contact that is at the hardness under the largest force."""
    pressed = Values(result.listed("segments", dict)[0])
    return pressed.number("yielding_fraction", 0.0) / max(pressed.number("contact_fraction", 0.0), 1e-9)


def _fitted(contact: Contact, tip: np.ndarray, force: np.ndarray) -> Fit:
    """Fits JKR's force as a function of the height of the retracting tip, with work of adhesion, E* and the zero of heights as
    parameters."""
    far = int(np.argmin(force))
    tip, force = tip[:far + 1], force[:far + 1]
    if len(tip) < 8 or not force[0] > 0:
        return Fit(failed="the way out has too few points")
    a = np.linspace((2 / 3) ** (1 / 3) / 2**(1 / 3) * 0.7, 6.0, 4000)
    reduced, _, approach = jkr(a)
    stable = slice(int(np.argmin(approach)), None)  # what a held tip can reach
    reduced, approach = reduced[stable], approach[stable]

    def curve(p: np.ndarray) -> np.ndarray:
        work, stiffness = math.exp(p[0]), 4 / 3 * math.exp(p[1])
        length = (math.pi * work * contact.radius**2 / stiffness) ** (1 / 3)
        return math.pi * work * contact.radius * np.interp((p[2] - tip) * contact.radius / length**2, approach, reduced)

    start = [math.log(contact.work), math.log(contact.modulus), 0.0]
    found = least_squares(lambda p: curve(p) - force, start, x_scale=[0.1, 0.1, 0.1], method="lm")
    if not found.success or not np.isfinite(found.x).all():
        return Fit(failed="the fit does not converge")
    misfit = math.sqrt(float(np.mean(found.fun**2)))
    try:
        spread = np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)) * np.sum(found.fun**2) / max(1, len(tip) - 3))
    except np.linalg.LinAlgError:
        return Fit(failed="the curve does not fix both numbers")
    work, modulus = math.exp(found.x[0]), math.exp(found.x[1])
    return Fit(work, work * float(spread[0]), modulus, modulus * float(spread[1]), float(found.x[2]), misfit)


def _fit_of(plan: Plan, pulled: Number, tip: np.ndarray, force: np.ndarray) -> Fit:
    """Fits JKR to the retraction of a sphere whose pull-off force is known."""
    if plan.contact.yields:
        return Fit(failed="a sample that yields does not unload as an elastic sphere")
    if plan.contact.shape is not None:
        return Fit(failed=f"JKR's closed form is that of a sphere, and the tip is a {plan.contact.words}")
    if pulled.reason or plan.beyond > CUT * pulled.value:
        return Fit(failed="the box leaves out a part of the attraction, which a fit would take for a smaller work")
    return _fitted(plan.contact, tip, force)


REMEDIES = {"spacing": "it falls as the spacing: --sites {sites}", "range": "the range is that of the spacing: --sites {sites}, or say the range",
            "width": "press less (--load), or take a wider map", "step": "its cause is the step of the drive, which follows the stiffness",
            "beyond the box": "take a wider map, or a shorter range (--range)"}
"""What reduces a part of the error of the pull-off force."""


def _missed(plan: Plan, pulled: Number) -> list[str]:
    """Returns what to do about a pull-off force whose error is above the one that is asked for."""
    limit = plan.asked_error or LARGE
    share = pulled.error / pulled.estimate if pulled.estimate > 0 else NAN
    if not share > limit:
        return []
    name, part = max(pulled.parts.items(), key=lambda one: one[1].error)
    sites = 2 * math.ceil(0.5 * Values(program.check(str(plan.scenes[""]))["scene"]).needed("surface.sites") * share / limit)
    return [f"the error of the pull-off force is {100 * share:.2g} % in place of {100 * limit:.2g} %, mostly by the {name}; "
            + REMEDIES[name].format(sites=sites)]


NUMBERS = {"pull_off_force": ("F_pull-off", "largest attraction on the way out", "nN"),
           "jump_in_distance": ("d_jump-in", "separation of the undeformed surfaces at which the tip jumps in", "nm"),
           "contact_radius": ("a_0", "contact radius at zero load, of the area as a circle", "nm"),
           "lost": ("W_lost", "energy lost in a cycle", "aJ")}
OF_YIELDING = {"largest_depth": ("h_max", "depth under the largest force", "nm"),
               "residual_depth": ("h_r", "depth at which the unloading has no force", "nm"),
               "hardness": ("H_OP", "hardness by Oliver and Pharr", "GPa"), "modulus": ("E*_OP", "E* by Oliver and Pharr", "GPa"),
               "largest_set": ("s_max", "largest permanent set", "nm"), "plastic_work": ("W_p", "plastic work, beside the energy lost", "aJ")}
"""Numbers of a sample that yields."""


def tip_of(plan: Plan, results: dict[str, Result], place: Path) -> Tip:
    """Returns the numbers of a tip from its runs."""
    own = _measured(results[""], plan.contact)
    others = {part: _measured(result, plan.contact) for part, result in results.items() if part}
    used = bool(plan.not_stated)
    numbers = []
    for path, (symbol, name, unit) in (NUMBERS | (OF_YIELDING if plan.contact.yields else {})).items():
        value = own.values[path]
        parts = {part: Found(0.0, PARTS[part] * abs(value - measured.values[path])) for part, measured in others.items()}
        withheld = own.missing.get(path, "")
        if not withheld and not all(math.isfinite(found.error) for found in parts.values()):
            withheld = "a coarser or wider run has no such number: its error is not known"
        withheld = withheld or plan.not_stated.get(path, "")
        if path == "pull_off_force":
            parts["beyond the box"] = Found(0.0, plan.beyond)
        if path in own.errors:
            parts[{"jump_in_distance": "fold", "contact_radius": "edge"}[path]] = Found(0.0, own.errors[path])
        if used and path == "pull_off_force":
            parts["range"] = Found(0.0, abs(plan.contact.pull_off() - plan.contact._replace(range=plan.asked_range).pull_off()))
        radius = own.values["contact_radius"]
        grain = GRAIN * abs(value) * plan.spacing / radius if path in ("pull_off_force", "lost") and radius > 0 else 0.0
        condition = "" if used or path in OF_YIELDING else f"for a range of {plan.contact.range:.3g} nm"
        if path == "hardness" and (share := _share_at_hardness(results[""])) < ALL_AT_HARDNESS:
            condition = f"of a contact of which {100 * share:.2g} % is at the hardness: below that of the sample"
        numbers.append(Number(path, symbol, name, unit, value, {} if withheld else parts, least=0.0, grain=grain, withheld=withheld,
                              condition=condition))
    drive, tip, force, segment = _curve(results[""])
    out = segment == 1
    notes = [*plan.notes, *_missed(plan, numbers[0])]
    edge = results[""].number("instrument.edge_distance", NAN)
    if edge < 0.5:
        notes.append(f"the contact comes within {edge:.2g} nm of the edge of the box: press less")
    return Tip(numbers, drive, tip, force, out, plan.contact, _fit_of(plan, numbers[0], tip[out], force[out]), results[""],
               notes, place, _unloading(plan.contact, tip, force))


@checks_call
def load_tip(directory: str | os.PathLike) -> Tip:
    """Loads the contact of a tip in a directory. The map of a measured tip is not loaded.

    Parameters
    ----------
    directory : str or os.PathLike
        Directory with tip.json.

    Returns
    -------
    Tip
        The numbers with their errors, the curve and the fit.

    Raises
    ------
    InputOutputError
        The directory has no contact of a tip, or it cannot be read.
    """
    place = Path(directory)
    if not (place / RESULT).exists():
        raise InputOutputError(str(directory), "holds no contact of a tip", f"{RESULT} is not in it" if place.is_dir() else
                               "there is no such directory", "name a directory that asperity tip has written")
    found = read_json(place / RESULT)
    contact, fit = Values(found.part("contact")), found.part("fit")
    shape = contact.find("shape")
    drive, tip, force, retracting = np.loadtxt(place / CURVE, delimiter=",", skiprows=1, unpack=True)
    described = [contact.needed(name) for name in ("radius", "modulus", "work", "range", "stiffness")]
    made = Contact(*described, shape and TipShape.loaded(shape), contact.number("hardness", math.inf))
    return Tip(numbers_of(found.part("numbers")), drive, tip, force, retracting == 1, made,
               Fit(**{name: NAN if value is None else value for name, value in fit.items()}), Result(place / "tip"),
               found.listed("notes", str), place, _unloading(made, tip, force))
