# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity curve FILE`: measured force curves to w and E* with their errors."""

from __future__ import annotations

import os
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checks_call
from ..errors import SceneError
from ..files import store
from ..terminal import Voice
from .options import SITES, Command, Options as Base, jobs, option, out, word
from .tip import tip

if TYPE_CHECKING:
    from ..studies.curves import Curves
    from ..studies.tip import Tip

SHAPES = ("paraboloid", "sphere", "cone", "pyramid", "punch")
MODELS = ("auto", "hertz", "jkr", "dmt", "maugis")


@dataclass(kw_only=True)
class Options(Base):
    """Options of `asperity curve`."""

    file: str = word("FILE", "force curves: text of columns, or any file that afmformats reads")
    radius: str | None = option("20nm", "of the tip: of a paraboloid, sphere or flat punch", None)
    shape: str = option("SHAPE", "of the tip: paraboloid, sphere, cone, pyramid or punch (default: paraboloid)", "paraboloid", choices=SHAPES)
    angle: float | None = option("35", "of a cone or pyramid: degrees between its axis and its surface", None)
    model: str = option("MODEL", "whose numbers are stated: auto, hertz, jkr, dmt or maugis (default: auto)", "auto", choices=MODELS)
    range: str | None = option("3Å", "of the attraction, which determines Maugis' λ (default: λ is looked for)", None)
    poisson: float | None = option("0.3", "Poisson's ratio of the sample: E is stated beside E*", None)
    stiffness: str | None = option("0.2N/m", "of the cantilever; holds over what the file says", None)
    sensitivity: str | None = option("60nm/V", "of its deflection; holds over what the file says", None)
    interference: str | None = option("300nm", "period of a wave in the baseline, near which it is looked for", None)
    simulate: bool = option("", "lay the contact of the fitted tip, as asperity tip computes it, over the first curve", False)
    sites: int | None = option("N", "of --simulate: along an edge of the box (default: 64 to 256, as needed)", None, limits=SITES)
    out: str | None = out("results/<file>-curve")
    jobs: int = jobs("curves that are fitted at the same time (default: 1)")


@checks_call
def curve(file: str | os.PathLike, radius: str | None = None, shape: str = "paraboloid", angle: float | None = None, model: str = "auto",
          range: str | None = None, poisson: float | None = None, stiffness: str | None = None, sensitivity: str | None = None,
          interference: str | None = None, out: str | os.PathLike | None = None, jobs: int = 1, simulate: bool = False,
          sites: int | None = None, *, nu: float | None = None) -> Curves:
    """Fits contact models to measured force curves, and writes a page.

        found = asperity.curve("scan.jpk-force", radius="20 nm", poisson=0.3)
        found.number("work"), found.number("modulus"), found.curves[0].fits["retraction"].stated.values

    Parameters
    ----------
    file : str or os.PathLike
        Force curves: text of columns (height or separation, force or deflection), or any file that afmformats reads.
    radius : str, optional
        Radius of the tip with its unit, of a paraboloid, sphere or flat punch.
    shape : str
        "paraboloid", "sphere", "cone", "pyramid" or "punch".
    angle : float, optional
        Angle between axis and surface of a cone or pyramid, degrees.
    model : str
        Model whose numbers are stated: "hertz", "jkr", "dmt" or "maugis"; "auto": Hertz if no attraction is seen, else Maugis'.
    range : str, optional
        Range of the attraction with its unit, which determines Maugis' λ; None: λ is looked for, and the errors contain what the data allow.
    poisson : float, optional
        Poisson's ratio of the sample, for Young's modulus beside E*.
    stiffness, sensitivity : str, optional
        Stiffness of the cantilever, "0.2 N/m", and sensitivity of its deflection, "60 nm/V"; both override the file.
    interference : str, optional
        Period of a wave in the baseline with its unit, near which it is looked for.
    out : str or os.PathLike, optional
        Directory; None: results/<file>-curve.
    jobs : int
        Number of curves that are fitted, or of runs, at the same time.
    simulate : bool
        True: computes the contact of the fitted tip as `tip` does, which takes minutes; found.simulated, and the page, have it.
    sites : int, optional
        Number of sites along an edge of the box of simulate; None: 64 to 256, depending on the contact.
    nu : optional
        Other name of poisson.

    Returns
    -------
    Curves
        Numbers with their errors, and the fits of each curve.

    Raises
    ------
    SceneError
        An argument is refused, or files would be replaced.
    InputOutputError
        The file cannot be read, or none of its curves can be fitted.
    Stopped
        The runs of simulate stopped early; the same call continues.
    """
    return _carried_out(Options.of_call(locals()))


def _carried_out(given: Options) -> Curves:
    """Fits the curves and writes the page."""
    from ..reports import curve as report_curve
    from ..running import lock
    from ..studies.curves import curves_of, question_of

    place = store.chosen(given.out, f"results/{Path(given.file).stem}-curve")
    store.require_free({place: report_curve.FILES}, inputs=[given.file])
    found = curves_of(given.file, question_of(asdict(given)), given.stiffness, given.sensitivity, given.jobs)
    found.directory = place
    if given.simulate:
        found.simulated = _simulated(found, given, place / "simulated")
    with lock.in_use(place):
        report_curve.write(found)
    return found


def _simulated(found: Curves, given: Options, place: Path) -> Tip:
    """Runs the contact of the tip that was fitted to the first curve. Raises SceneError if it cannot be simulated."""
    main = found.curves[0].main
    if given.shape not in ("paraboloid", "sphere"):
        raise SceneError("simulate", f"has no round end of this {given.shape}", "its edge would be simulated, not the tip", "leave it out")
    if main is None or not main.work:
        raise SceneError("simulate", "needs a work of adhesion", "the curve shows no attraction, or the model has none", "leave it out")
    poisson = 0.3 if given.poisson is None else given.poisson  # of E* alone the contact depends
    try:
        return tip(radius=given.radius, young=f"{main.modulus * (1 - poisson**2):.6g} GPa", poisson=poisson, adhesion=f"{1e3 * main.work:.6g} mJ/m2",
                   stiffness=f"{found.curves[0].measured.stiffness:.6g} N/m", load=f"{float(main.stated.force.max()):.4g} nN", range=given.range,
                   sites=given.sites, out=place, jobs=given.jobs)
    except SceneError as error:
        raise SceneError.of([{**one, "where": "simulate", "fix": "leave it out"} for one in error.listed]) from None


def _carry_out(given: Options, voice: Voice) -> int:
    """Carries out `asperity curve`. Returns the exit code."""
    from ..reports import curve as report_curve

    found = _carried_out(given)
    voice.show(report_curve.text_of(found))
    voice.tell({**report_curve.answer_of(found), "directory": found.directory})
    for note in [*found.notes, *(f"not taken: {why}" for why in found.refused)]:
        voice.say(f"note: {note}")
    voice.say(f"\nwritten: {found.directory}: report.html, curve.json, curves.csv, fit.csv" + "; the runs in simulated" * given.simulate)
    return 0


COMMAND = Command(Options, _carry_out, progress=False, more=(
    "Baseline, point of contact, E*, work of adhesion and Maugis' λ are fitted together, with the deflection of the cantilever subtracted, on the "
    "way in and out. The errors contain noise, its correlation, and the models that the data allow."))
