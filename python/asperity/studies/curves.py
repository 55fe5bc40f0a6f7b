# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Measured force curves: work of adhesion and E* with their errors, from fits of contact models to both directions of each curve
(curve_fit.py), with pull-off force and energy lost. Lengths are in nm, forces in nN, moduli in GPa, works in N/m.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arguments import checks_call, checks_calls
from ..errors import InputOutputError, Named, SceneError
from ..maps.force_curves import ForceCurve, read_force_curves
from ..results.frames import data_frame
from ..results.result import Values, read_json
from ..theories.indentation import SHAPES, Indenter
from .curve_fit import Compared, Fit, Regions, Unfit, compared, regions
from .map_scene import length
from .stated_number import NAN, Found, Number, WithNumbers, numbers_of

if TYPE_CHECKING:
    from .tip import Tip

WAYS = {False: "approach", True: "retraction"}
OF_LAW = 0.05
"""Share of w that depends on the law of the attraction: of an exponential law, fitted by Dugdale's of the same range, 4 % at λ = 0.6."""
OF_LAW_MODULUS, LONG_RANGED = 0.06, 0.5
"""Share of E* that depends on it, and λ below which it does: of an exponential law 6 % at λ = 0.2, 4 % at 0.13, and 0.4 % at 0.6 and 1.2."""
POINTS = {"height": "nm", "force": "nN", "model": "nN", "residual": "nN", "in the fit": "", "retraction": ""}
"""Columns of the points of a curve, with their units."""
RESULT, FIT = "curve.json", "fit.csv"
"""Files of the fits, and of the points of the first curve."""
POOR = 2.0
"""Residual of a fit over the noise from which it does not describe the curve."""
FEW = 3
"""Neighbouring points over which a pull-off force is averaged."""


@dataclass
class Question:
    """Tip and model of a fit: the indenter, Poisson's ratio (NaN: only E* is stated), a model of SHAPES or "auto", range of the attraction
    (nm; None: λ is looked for) and period of an interference (nm; None: none)."""

    indenter: Indenter
    poisson: float = NAN
    model: str = "auto"
    range: float | None = None
    period: float | None = None


@dataclass
class FittedCurve(Named):
    """A force curve with its fits: by direction ("approach", "retraction") the fits, or why there are none, and the numbers."""

    measured: ForceCurve
    fits: dict[str, Compared]
    failed: dict[str, str]
    numbers: list[Number]

    @property
    def name(self) -> str:
        """File of the curve and its number in it."""
        return self.measured.name

    def frame(self):
        """Returns the points of both directions, less the baseline, with the stated models, as a pandas DataFrame."""
        return data_frame(points_of(self), POINTS)

    @property
    def main(self) -> Compared | None:
        """Fits of the direction whose numbers are stated: the retraction if attraction is seen, else the approach; None: there are none."""
        stated = {way: one for way, one in self.fits.items() if "work" in one.stated.values}
        return stated.get("retraction") or self.fits.get("approach") or self.fits.get("retraction")


@checks_calls
@dataclass
class Curves(WithNumbers):
    """Force curves of a file with their fits.

    numbers    work, modulus (E*), young (if Poisson's ratio is known), pull_off_force and lost, of a single curve with its errors, of several
               their means with the error by their scatter
    curves     the curves, each with measured, fits and numbers
    refused    reasons for curves that are not taken
    simulated  the contact of the fitted tip as `tip` computes it; None: it was not asked for
    """

    file: str
    question: Question
    numbers: list[Number]
    curves: list[FittedCurve]
    refused: list[str]
    notes: list[str] = field(default_factory=list)
    directory: Path = Path()
    simulated: Tip | None = None

    def values(self, path: str) -> np.ndarray:
        """Returns a number of each curve, NaN where it is not stated, in the unit of number(path)."""
        own = self.number(path)
        found = [next((n for n in one.numbers if n.path == path), None) for one in self.curves]
        return np.array([NAN if n is None else n.estimate * (_scale(n.unit) / _scale(own.unit)) for n in found])

    def columns(self) -> dict[str, Any]:
        """Returns name and place (µm) of each curve, and its numbers with their errors, as columns."""
        found: dict[str, Any] = {"curve": [one.name for one in self.curves]}
        for k, name in enumerate("xy"):
            found[name] = np.array([NAN if one.measured.place is None else one.measured.place[k] for one in self.curves])
        for number in self.numbers:
            found[number.path], errors = self.values(number.path), []
            for one, value in zip(self.curves, found[number.path]):
                own = next((n for n in one.numbers if n.path == number.path), None)
                errors.append(own.error * value / own.estimate if own is not None and own.estimate else NAN)
            found[f"{number.path}.error"] = np.array(errors)
        return found

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column."""
        return {"curve": "", "x": "µm", "y": "µm"} | {name: n.unit for n in self.numbers for name in (n.path, f"{n.path}.error")}

    def frame(self):
        """Returns the numbers of all curves as a pandas DataFrame, a row each; its attrs["units"] has the unit of each column."""
        return data_frame(self.columns(), self.units)

    def __repr__(self) -> str:
        return f"<Curves {self.file}: {', '.join(map(str, self.numbers[:2]))}>"


UNITS = {"kPa": 1e-6, "MPa": 1e-3, "GPa": 1.0}


def points_of(one: FittedCurve) -> dict[str, np.ndarray]:
    """Returns the points of both directions of a curve with the stated models, as columns."""
    found: dict[str, list[np.ndarray]] = {name: [] for name in POINTS}
    for way, fits in one.fits.items():
        fit = fits.stated
        for column, values in zip(found.values(), (fit.height, fit.force, fit.fitted, fit.force - fit.fitted, fit.used,
                                                   np.full(len(fit.height), way == WAYS[True]))):
            column.append(np.asarray(values))
    return {name: np.concatenate(column) if column else np.zeros(0) for name, column in found.items()}


def missed(one: FittedCurve, simulated: Tip) -> tuple[float, float]:
    """Returns by how much the simulated contact, and the stated model, miss the retraction where the model is fitted in contact: rms, nN."""
    fit = one.fits["retraction"].stated if "retraction" in one.fits else one.fits["approach"].stated
    at = fit.used & np.isfinite(fit.fitted) & (fit.fitted != 0.0)
    held = simulated.retracting
    there = np.interp(fit.height[at] - fit.values["contact"], simulated.drive[held], simulated.force[held])
    return tuple(float(np.sqrt(np.mean((fit.force[at] - other) ** 2))) for other in (there, fit.fitted[at]))


def _scale(unit: str) -> float:
    return UNITS.get(unit, 1.0)


def _modulus_unit(value: float) -> str:
    return next((unit for unit in ("GPa", "MPa") if value >= 1.0 * UNITS[unit]), "kPa")


def question_of(given: Mapping[str, Any]) -> Question:
    """Returns the question of a call. Raises SceneError."""
    shape, poisson = given["shape"], given["poisson"]
    size, models = SHAPES[shape]
    other = "angle" if size == "radius" else "radius"
    if given[size] is None:
        raise SceneError(size, "is missing", f"a {shape} is described by it", f"for example --{size} " + ("20nm" if size == "radius" else "35"))
    if given[other] is not None:
        raise SceneError(other, f"does not describe a {shape}", f"that has the {size} alone", "leave it out, or choose another --shape")
    if size == "angle" and not 0 < given["angle"] < 90:
        raise SceneError(f"angle = {given['angle']:g}", "is no angle between axis and surface", "it is between 0 and 90 degrees",
                         "for example --angle 35")
    if given["model"] not in ("auto", *models):
        raise SceneError(f"model = {given['model']}", f"has no closed form for a {shape}", f"its models are {', '.join(models)}",
                         f"take --model {models[-1]}, or --shape paraboloid")
    if poisson is not None and not -1 < poisson <= 0.5:
        raise SceneError(f"poisson = {poisson:g}", "is no Poisson's ratio", "it is above -1, and 0.5 at most", "for example --poisson 0.3")
    if given["range"] is not None and (given["model"] not in ("auto", "maugis") or "maugis" not in models):
        raise SceneError("range", "does not enter this model", "the range of the attraction determines λ of Maugis and Dugdale",
                         "leave it out, or take --model maugis")
    return Question(Indenter(shape, length("radius", given["radius"]) if size == "radius" else float(given["angle"])),
                    NAN if poisson is None else poisson, given["model"], None if given["range"] is None else length("range", given["range"]),
                    None if given["interference"] is None else length("interference", given["interference"]))


def fitted(question: Question, measured: ForceCurve) -> FittedCurve:
    """Fits both directions of a curve, and returns it with its numbers."""
    fits: dict[str, Compared] = {}
    failed: dict[str, str] = {}
    found: dict[str, Regions] = {}
    for retracting, way in WAYS.items():
        try:
            found[way] = regions(*measured.direction(retracting), retracting)
            model = question.model
            if model != "auto" and model != "hertz" and not found[way].dip:
                raise Unfit("no attraction is seen")
            fits[way] = compared(question.indenter, found[way], measured.stiffness, model, question.range, question.period)
        except Unfit as reason:
            failed[way] = str(reason)
    one = FittedCurve(measured, fits, failed, [])
    one.numbers = _numbers(question, one)
    return one


def _numbers(question: Question, one: FittedCurve) -> list[Number]:
    """Returns the numbers of a curve with the parts of their errors."""
    main, numbers = one.main, []
    law = question.model == "auto" or question.range is not None
    given = "" if question.model == "auto" else f"if the model of the contact is {question.model}: its error is not included"
    if main is not None:
        others = [found for found in one.fits.values() if found is not main]
        between = {}
        if others:  # as far as the errors of both directions do not explain the difference
            scatter = sum(error**2 for found in (main, *others) for error in (found.of_fit[1], found.of_model[1]))
            between["direction"] = Found(0.0, 0.5 * main.modulus * math.sqrt(max(0.0, math.log(others[0].modulus / main.modulus) ** 2 - scatter)))
        if "work" in main.stated.values:
            parts = {"fit": Found(0.0, 1e3 * main.work * main.of_fit[0]), "model": Found(0.0, 1e3 * main.work * main.of_model[0])}
            if law:
                parts["law of the attraction"] = Found(0.0, OF_LAW * 1e3 * main.work)
            numbers.append(Number("work", "w", "work of adhesion", "mJ/m²", 1e3 * main.work, parts, least=0.0, condition=given))
        unit = _modulus_unit(main.modulus)
        parts = {"fit": Found(0.0, main.modulus * main.of_fit[1]), "model": Found(0.0, main.modulus * main.of_model[1]), **between}
        if law and "work" in main.stated.values and main.parameter[1] < LONG_RANGED:
            parts["law of the attraction"] = Found(0.0, OF_LAW_MODULUS * main.modulus)
        for path, symbol, name, factor in (("modulus", "E*", "contact modulus E/(1-ν²)", 1.0),
                                           ("young", "E", "Young's modulus", 1 - question.poisson**2)):
            if factor == factor:
                scaled = {part: Found(0.0, factor / UNITS[unit] * shift.error) for part, shift in parts.items()}
                numbers.append(Number(path, symbol, name, unit, factor * main.modulus / UNITS[unit], scaled, least=0.0, condition=given))
    if way := one.fits.get("retraction"):
        force, noise = way.stated.force, way.stated.noise
        smooth = np.convolve(force, np.ones(FEW) / FEW, "valid")
        least = int(np.argmin(smooth))
        step = 0.5 * abs(float(force[least:least + FEW].min() - smooth[least]))
        numbers.append(Number("pull_off_force", "F_pull-off", "largest attraction on the way out", "nN", max(0.0, -float(smooth[least])),
                              {"noise": Found(0.0, noise / math.sqrt(FEW)), "step": Found(0.0, step),
                               "baseline": Found(0.0, way.stated.errors["offset"])}, least=0.0))
    if len(one.fits) == 2:
        ways = [one.fits[way].stated for way in ("approach", "retraction")]
        low, high = max(w.height.min() for w in ways), min(w.height.max() for w in ways)
        at = np.linspace(low, high, 4000)
        area, scatter, shift = 0.0, 0.0, 0.0
        for sign, way in zip((1.0, -1.0), ways):
            area += sign * (high - low) * float(np.interp(at, way.height[::-1], way.force[::-1]).mean())
            scatter = math.hypot(scatter, way.noise * (high - low) / math.sqrt(len(way.height) / way.slack))
            shift = math.hypot(shift, way.errors["offset"] * (high - low))
        numbers.append(Number("lost", "W_lost", "energy lost in a cycle", "aJ", area, {"noise": Found(0.0, scatter), "baseline": Found(0.0, shift)}))
    return numbers


def _means(curves: list[FittedCurve]) -> list[Number]:
    """Returns the numbers of a single curve, or the means of several with the error by their scatter."""
    if len(curves) == 1:
        return curves[0].numbers
    found = []
    for path in ("work", "modulus", "young", "pull_off_force", "lost"):
        own = [n for one in curves for n in one.numbers if n.path == path and n.estimate == n.estimate]
        if not own:
            continue
        unit = sorted(own, key=lambda n: n.estimate)[len(own) // 2].unit
        values = np.array([n.estimate * _scale(n.unit) / _scale(unit) for n in own])
        scatter = float(np.std(values, ddof=1)) if len(own) > 1 else NAN
        parts = {"scatter of the curves": Found(0.0, scatter / math.sqrt(len(own)))}
        found.append(Number(path, own[0].symbol, own[0].name, unit, float(values.mean()), parts,
                            condition=f"mean of {len(own)} curves, which scatter by {scatter:.2g} {unit}",
                            withheld="" if len(own) > 1 else "a single curve has it"))
    return found


def curves_of(file: str, question: Question, stiffness: str | None, sensitivity: str | None, jobs: int = 1) -> Curves:
    """Reads and fits the force curves of a file. Raises InputOutputError."""
    measured, refused = read_force_curves(file, stiffness, sensitivity)
    if jobs > 1 and len(measured) > 1:
        with ProcessPoolExecutor(jobs) as pool:
            found = list(pool.map(partial(fitted, question), measured))
    else:
        found = [fitted(question, one) for one in measured]
    good = [one for one in found if one.fits]
    refused = refused + [f"{one.name}: {way}: {why}" for one in found for way, why in one.failed.items()]
    if not good:
        raise InputOutputError(file, "has no curve that can be fitted", refused[0] if refused else "it holds none",
                               "look at the curve: force over height, with a baseline and a contact")
    notes = list(dict.fromkeys(note for one in good for note in one.measured.notes))
    for one in good[:1]:
        parameter = one.main.parameter if one.main else (NAN, NAN, NAN)
        if question.range is None and parameter[2] > 2 * parameter[1]:
            notes.append(f"Maugis' λ is not known better than {parameter[1]:.2g} to {parameter[2]:.2g}: the error of w has this; the range of the "
                         "attraction (--range) determines λ")
    poor = {one.name: one.main.stated.residual for one in good if one.main and one.main.stated.residual > POOR}
    if poor:
        notes.append(f"the model misses {next(iter(poor)) if len(poor) == 1 else f'{len(poor)} of {len(good)} curves'} by {max(poor.values()):.2g} "
                     "times the noise far from the sample at most: drift, viscosity, a tether or another shape of the tip is measured too, which "
                     "the errors do not include")
    notes.append("the errors of radius and stiffness of the cantilever are not included: w grows as 1/R, E* as 1/√R")
    return Curves(file, question, _means(good), good, refused, notes)


@checks_call
def load_curve(directory: str | os.PathLike) -> Curves:
    """Loads the fitted force curves in a directory. Points are those of fit.csv: of the first curve.

    Parameters
    ----------
    directory : str or os.PathLike
        Directory with curve.json.

    Returns
    -------
    Curves
        The numbers with their errors, and the fits of each curve.

    Raises
    ------
    InputOutputError
        The directory has no fitted curves, or they cannot be read.
    """
    place = Path(directory)
    if not (place / RESULT).exists():
        raise InputOutputError(str(directory), "holds no fitted curves", f"{RESULT} is not in it" if place.is_dir() else
                               "there is no such directory", "name a directory that asperity curve has written")
    found = read_json(place / RESULT)
    asked = found.part("question")
    question = Question(Indenter(**found.part("tip")), Values(asked).number("poisson", np.nan), asked["model"], asked["range"], asked["period"])
    points = np.genfromtxt(place / FIT, delimiter=",", skip_header=1)
    curves = []
    for k, one in enumerate(map(Values, found.listed("curves", dict))):
        fits = {way: _loaded(Values(fit), points[points[:, -1] == (way == "retraction")] if k == 0 else np.zeros((0, len(POINTS))))
                for way, fit in one.part("fits").items()}
        place_of = one.find("place")
        measured = ForceCurve(one.text("name"), *np.zeros((2, 0)), np.zeros(0, bool), one.number("stiffness", np.nan), place_of and tuple(place_of))
        curves.append(FittedCurve(measured, fits, one.part("failed"), numbers_of(one.part("numbers"))))
    return Curves(found.text("file"), question, numbers_of(found.part("numbers")), curves, found.listed("refused", str),
                  found.listed("notes", str), place)


def _loaded(saved: Values, points: np.ndarray) -> Compared:
    """Returns the fits of a direction as they are saved, with the points of the stated one."""
    fits, stated = {}, saved.text("stated")
    for name, one in saved.part("models").items():
        at = points if name == stated else points[:0]
        fits[name] = Fit(name.partition(" ")[0], one["values"], one["errors"], np.array(one["covariance"]), one["noise"], one["correlated"], np.nan,
                         len(one["errors"]), one["points"], at[:, 0], at[:, 1], at[:, 2], at[:, 4] == 1, lambda height: 0.0 * height)
    worse = {name: one["worse_by"] for name, one in saved.part("models").items()}
    low_to_high = tuple(np.nan if one is None else one for one in saved.find("maugis"))
    return Compared(fits, fits[stated], worse, saved.number("work", 0.0), saved.number("modulus", np.nan), tuple(saved.find("of_fit")),
                    tuple(saved.find("of_model")), low_to_high)
