# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Branches of a viscoelastic block (block.prony) from a master curve, by non-negative least squares.

    E'(ω) = E [1 + Σ r ω²τ²/(1 + ω²τ²)],    E''(ω) = E Σ r ωτ/(1 + ω²τ²)

The relative errors of both moduli at all frequencies are least in squares: first over times evenly spaced in log τ between the
inverse frequencies of the ends, then over the times as well. Branches that come out zero are left out.

The relaxed modulus E lies outside the measured range, and is stated as an interval: of all moduli that describe the curve as well
with branches up to SLOWEST times the period of the lowest frequency, and of a loss that falls on as a power law of the frequency.
If the interval is wide, E is not stated: whoever knows it says it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares, nnls

from ..above import from_above
from ..arguments import checks_call, chosen, spoken
from ..errors import SceneError
from ..files import store
from ..maps.channels import refuse
from ..maps.master_curve import MasterCurve, read_master_curve
from ..theories import viscoelastic
from ..units import quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_BRANCHES = 30
LARGEST_MISFIT = 0.25
"""rms error beyond which branches do not describe a curve."""
DENSITY = 5
"""So many times of a first look for each branch."""
NEGLIGIBLE = 1e-8
"""Branches that are nowhere more of a modulus are left out."""
LEAST_RELAXED = 1e-3
"""Of the storage modulus at the lowest frequency: a relaxed modulus below it, beside a larger loss modulus, is a liquid's."""
CLOSEST = 1.05
"""Times nearer to each other than this factor are one branch."""
SLOWEST = 100.0
"""Longest time of a branch that the data may hide, over the inverse of the lowest angular frequency."""
FLOOR = 0.01
"""Least relative error of measured moduli."""
WIDEST = 2.0
"""Ratio of the ends of an interval beyond which the relaxed modulus is not stated."""
LOSSLESS = 0.02
"""Loss tangent at an end of the curve below which the modulus does not change beyond it."""


@dataclass
class Prony:
    """Branches of a viscoelastic block that were fitted to a master curve."""

    young: float
    young_range: tuple[float, float]
    stated: bool
    prony: list[tuple[float, float]]
    poisson: float | None
    rms_error: float
    storage_error: float
    loss_error: float
    largest_error: float
    at: float
    source: str
    frequency: np.ndarray
    storage: np.ndarray
    loss: np.ndarray
    notes: list[str] = field(default_factory=list)

    def modulus(self, frequency: float | np.ndarray) -> np.ndarray:
        """Returns the fitted modulus."""
        return self.young * viscoelastic.modulus(self.prony, 1e-12 * np.asarray(frequency, float))

    @checks_call
    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws storage and loss modulus over frequency, measured and fitted."""
        return from_above("plots.prony.draw")(self, ax)

    @property
    def scene(self) -> dict[str, dict]:
        """Sections of a scene with this material: {"block": {"young", "prony", "poisson"}}."""
        return {"block": {"young": self.young, "prony": [list(branch) for branch in self.prony]} |
                ({} if self.poisson is None else {"poisson": self.poisson})}

    @property
    def toml(self) -> str:
        """The file that block.prony names: the keys young and prony of a scene, and the error of the fit."""
        rows = "".join(f"    [{ratio!r}, \"{1e-12 * time!r} s\"],\n" for ratio, time in self.prony)
        return (f"# Viscoelastic moduli: a scene names this file as block.prony, or has these lines. Of {self.source}, "
                f"{len(self.frequency)} frequencies\n# from {self.frequency[0]:.4g} to {self.frequency[-1]:.4g} rad/s. {self.errors}.\n"
                f"[block]\nyoung = {self.young!r} # GPa, relaxed; {self.relaxed}\n" +
                (f"poisson = {self.poisson!r}\n" if self.poisson is not None else "") +
                f"prony = [ # modulus over young, relaxation time\n{rows}]\n\n[fit]\nsource = {_quoted(self.source)}\n"
                f"rms_error = {float(f'{self.rms_error:.3g}')!r}\n")

    @property
    def relaxed(self) -> str:
        """The relaxed modulus in words, as it is known: "2.00 MPa (1.97 to 2.03 MPa by the data)"."""
        return (f"{1e3 * self.young:.3g} MPa, as stated" if self.stated else _megapascals(self.young)) + \
            f" ({_interval(*self.young_range)} by the data)"

    @property
    def errors(self) -> str:
        """The errors of the fit in words."""
        return (f"rms error {100 * self.rms_error:.2g} % (storage modulus {100 * self.storage_error:.2g} %, loss modulus "
                f"{100 * self.loss_error:.2g} %), largest {100 * self.largest_error:.2g} % at {self.at:.3g} rad/s")


def _megapascals(young: float) -> str:
    return f"{1e3 * young:#.3g}".rstrip(".") + " MPa"


def _interval(low: float, high: float) -> str:
    """Spells an interval of moduli in GPa, rounded outwards to three digits."""
    def rounded(value: float, way: Callable[[float], int]) -> float:
        step = 10.0 ** (math.floor(math.log10(value)) - 2) if value > 0 else 1.0
        return way(value / step) * step

    return f"{_megapascals(rounded(low, math.floor)) if low > 0 else '0'} to {_megapascals(rounded(high, math.ceil))}"


def _quoted(text: str) -> str:
    return '"' + "".join(c if c.isprintable() else "?" for c in text).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _columns(curve: MasterCurve, times: np.ndarray) -> np.ndarray:
    """Returns relative moduli of the relaxed solid and of each branch: rows of E', then of E''."""
    y = curve.frequency[:, None] * times
    storage = np.hstack([np.ones((len(y), 1)), y**2 / (1 + y**2)]) / curve.storage[:, None]
    loss = np.hstack([np.zeros((len(y), 1)), y / (1 + y**2)]) / curve.loss[:, None]
    return np.vstack([storage, loss])


def _solved(curve: MasterCurve, times: np.ndarray, relaxed: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Returns moduli of the relaxed solid and of the branches (Pa), and the relative errors. relaxed: its modulus, Pa; None: any."""
    columns = _columns(curve, times)
    free, wanted = (columns, np.ones(len(columns))) if relaxed is None else (columns[:, 1:], 1 - relaxed * columns[:, 0])
    scale = np.linalg.norm(free, axis=0)  # or nnls takes columns of 1e-9 for none
    found = nnls(free / scale, wanted, maxiter=100 * len(scale))[0] / scale
    moduli = found if relaxed is None else np.r_[relaxed, found]
    return moduli, columns @ moduli - 1


def _possible(curve: MasterCurve) -> tuple[float, float]:
    """Returns the least and the largest relaxed modulus (Pa) with which branches describe a curve as well as without a
    constraint: by 3 standard errors of independent points, or a tenth more of rms error, for errors that are not independent."""
    ends = 0.01 / curve.frequency[-1], SLOWEST / curve.frequency[0]
    times = np.geomspace(*ends, math.ceil(DENSITY * math.log10(ends[1] / ends[0])))
    moduli, error = _solved(curve, times)
    many, best = len(error), float(error @ error)
    limit = best + max(9.0, 0.2 * many) * max(best / many, FLOOR**2)

    def describes(relaxed: float) -> bool:
        error = _solved(curve, times, relaxed)[1]
        return bool(error @ error <= limit)

    def last(inside: float, outside: float) -> float:
        """Returns the modulus between two at which the curve is just described."""
        for _ in range(14):
            middle = 0.5 * (inside + outside)
            inside, outside = (middle, outside) if describes(middle) else (inside, middle)
        return outside

    return 0.0 if describes(0.0) else last(moduli[0], 0.0), last(moduli[0], 2 * float(curve.storage[0]))


def _with_power_law(curve: MasterCurve) -> tuple[float, float] | None:
    """Returns the relaxed moduli (Pa) of a loss that falls on as a power law ω^n below the curve, E = E' - E'' cot(nπ/2), for the
    exponents n that fit the lowest decade within 3 standard errors. None: the loss does not fall there."""
    lowest = curve.frequency <= max(10 * curve.frequency[0], np.sort(curve.frequency)[4])
    along = np.log(curve.frequency[lowest] / curve.frequency[0])
    (exponent, loss), spread = np.polyfit(along, np.log(curve.loss[lowest]), 1, cov=True)
    (_, storage), of_storage = np.polyfit(along, np.log(curve.storage[lowest]), 1, cov=True)
    slack = math.exp(storage) * 3 * math.sqrt(of_storage[1, 1])
    ends = [math.exp(storage) - math.exp(loss) / math.tan(0.5 * math.pi * min(n, 1.0)) if n > 0.01 else -math.inf
            for n in (exponent + sign * 3 * math.sqrt(spread[0, 0]) for sign in (-1, 1))]
    return (max(ends[0] - slack, 0.0), ends[1] + slack) if ends[1] > 0 else None


def _merged(times: np.ndarray) -> np.ndarray:
    kept = [time for k, time in enumerate(times) if k == 0 or time > CLOSEST * times[k - 1]]
    return np.array(kept)


def _starts(curve: MasterCurve, many: int, relaxed: float | None) -> list[np.ndarray]:
    """Returns two sets of times, s: evenly spaced ones, and those that many more times leave, next ones together until they are
    so many. With a stated relaxed modulus both end with the slowest time."""
    ends = 1 / curve.frequency[-1], (1 if relaxed is None else SLOWEST) / curve.frequency[0]
    even, found = (np.geomspace(*ends, number) for number in (many, DENSITY * many))
    weights = _solved(curve, found, relaxed)[0][1:]
    found, weights = found[weights > 0], weights[weights > 0]
    while len(found) > many or (len(found) > 1 and (found[1:] / found[:-1]).min() < (ends[1] / ends[0]) ** (1.5 / (DENSITY * many))):
        k = int(np.argmin(found[1:] / found[:-1]))
        one = np.exp(np.average(np.log(found[k:k + 2]), weights=weights[k:k + 2]))
        found, weights = np.r_[found[:k], one, found[k + 2:]], np.r_[weights[:k], weights[k:k + 2].sum(), weights[k + 2:]]
    return [even, found]


def _times(curve: MasterCurve, many: int, relaxed: float | None) -> np.ndarray:
    """Returns the times of the branches, s, the shortest first. relaxed: the stated relaxed modulus, Pa."""
    best, least = np.zeros(0), math.inf
    ends = math.log(0.1 / curve.frequency[-1]), math.log(10 * (1 if relaxed is None else SLOWEST) / curve.frequency[0])

    def look_at(times: np.ndarray) -> np.ndarray:
        nonlocal best, least
        moduli, error = _solved(curve, times, relaxed)
        times = times[(_columns(curve, times) * moduli).max(axis=0)[1:] > NEGLIGIBLE]
        if error @ error < least:
            best, least = times, error @ error
        return times

    for start in _starts(curve, many, relaxed):
        start = look_at(start)
        if len(start) and least > 1e-16 * len(curve.frequency):  # else the curve was made of these
            moved = least_squares(lambda x: _solved(curve, np.exp(x), relaxed)[1], np.log(start), bounds=ends, xtol=1e-13, ftol=1e-13,
                                  gtol=1e-13, max_nfev=200)
            look_at(_merged(np.sort(np.exp(moved.x))))
    return best


def _stated(text: str, stiff: float, high: float) -> float:
    """Returns a stated relaxed modulus in Pa of the curve's kind. stiff: Young's modulus over that kind; high: the largest that the
    data allow, Pa. Raises SceneError."""
    young = quantity(text, "Pa")
    if young is None or not 0 < young < math.inf:
        raise SceneError(f"--relaxed {text}", "is no modulus with its unit", "", "for example --relaxed 2MPa")
    if young > stiff * high:
        raise SceneError(f"--relaxed {text}", "is more than the data allow", f"at most {_megapascals(1e-9 * stiff * high)}: the storage "
                         "modulus at low frequencies is the relaxed one and what is still to relax",
                         f"say --relaxed {0.9e-6 * stiff * high:.2g}MPa, or less")
    return young / stiff


def _refuse_range(curve: MasterCurve, stiff: float, low: float, high: float) -> None:
    """Checks that the data bound the relaxed modulus. Raises InputOutputError."""
    if high <= WIDEST * low:
        return
    raise refuse(curve.source, "does not determine the relaxed modulus", f"at its lowest frequency, {curve.frequency[0]:.4g} rad/s, the loss "
                 f"tangent is still {curve.loss[0] / curve.storage[0]:.2g}: relaxed moduli of {_interval(1e-9 * stiff * low, 1e-9 * stiff * high)}, "
                 "with branches that are slower, describe the data as well",
                 f"measure to lower frequencies, down to the rubber's plateau, or state it, for example --relaxed {0.5e-6 * stiff * high:.2g}MPa: "
                 "within the measured frequencies the moduli are the same with any")


def fit(curve: MasterCurve, branches: int | None = None, poisson: float | None = None, relaxed: str = "") -> Prony:
    """Computes branches that fit a master curve. Raises InputOutputError, SceneError."""
    if curve.kind == "G" and poisson is None:
        raise SceneError("--poisson", "is missing", f"the moduli of {curve.source} are of shear, and block.young is 2 (1 + ν) times as "
                         "large", "say --poisson 0.49")
    if poisson is not None and not -1 < poisson < 0.5:
        raise SceneError(f"--poisson {poisson:g}", "is out of range", "Poisson's ratio is between -1 and 0.5", "for example --poisson 0.49")
    many = branches or min(MOST_BRANCHES, max(3, math.ceil(math.log10(curve.frequency[-1] / curve.frequency[0]))))
    if not 1 <= many <= MOST_BRANCHES:
        raise SceneError(f"--branches {many}", "is out of range", f"1 to {MOST_BRANCHES} are allowed", "for example --branches 8")
    if 2 * many + 1 > 2 * len(curve.frequency):
        raise refuse(curve.source, "has too few points", f"{len(curve.frequency)} frequencies do not determine {many} branches",
                     f"say --branches {len(curve.frequency) - 1}, or less")
    stiff = 1.0 if curve.kind == "E" else 2 * (1 + (poisson or 0.0))
    low, high = _possible(curve)
    known = _stated(relaxed, stiff, high) if relaxed else None
    times = _times(curve, many, known)
    moduli, error = _solved(curve, times, known)
    half = len(error) // 2
    worst = int(np.argmax(np.abs(error)))
    rms, storage, loss = (float(np.sqrt(np.mean(e**2))) for e in (error, error[:half], error[half:]))
    if rms > LARGEST_MISFIT:
        raise refuse(curve.source, "is not described by branches", f"{len(times)} of them miss its moduli by {100 * rms:.3g} % rms, the "
                     f"storage modulus by {100 * storage:.3g} %, the loss modulus by {100 * loss:.3g} %, most at "
                     f"{curve.frequency[worst % half]:.4g} rad/s: the two moduli of a linear solid follow from each other",
                     "look whether the columns are what their names say, or take more branches (--branches)")
    if known is None:
        if moduli[0] <= LEAST_RELAXED * curve.storage[0] and curve.loss[0] > curve.storage[0]:
            raise refuse(curve.source, "has no relaxed modulus", "its moduli are best fitted by a liquid, which flows at low frequencies",
                         "measure to lower frequencies, down to the rubber's plateau, or leave out the rows that flow")
        if tail := _with_power_law(curve):
            low, high = min(low, tail[0]), max(high, tail[1])
        low, high = min(low, moduli[0]), max(high, moduli[0])
        _refuse_range(curve, stiff, low, high)
    notes = list(curve.notes)
    slow, fast = (float(curve.loss[k] / curve.storage[k]) for k in (0, -1))
    young = 1e-9 * stiff * float(moduli[0])
    if slow > LOSSLESS and known is None:
        notes.append(f"at the lowest frequency the loss tangent is still {slow:.2g}: the relaxed modulus, young, is extrapolated; if it is known, "
                     "say it (--relaxed)")
    if fast > LOSSLESS:
        notes.append(f"at the highest frequency, {curve.frequency[-1]:.3g} rad/s, the loss tangent is still {fast:.2g}: the modulus at once, "
                     f"{_megapascals(young * sum(moduli) / moduli[0])}, is extrapolated, and faster motion is not described")
    if rms > 0.05:
        notes.append("the fit is poor: take more branches (--branches), or look at the plot")
    return Prony(young, (1e-9 * stiff * low, 1e-9 * stiff * high), known is not None,
                 [(float(m / moduli[0]), float(1e12 * t)) for m, t in zip(moduli[1:], times)],
                 poisson, rms, storage, loss, float(abs(error[worst])), float(curve.frequency[worst % half]), curve.source,
                 curve.frequency, 1e-9 * stiff * curve.storage, 1e-9 * stiff * curve.loss, notes)


@checks_call
def prony(source: str | Path, target: str | Path | None = None, branches: int | None = None, poisson: float | None = None,
          nu: float | None = None, frequency_unit: str = "", modulus_unit: str = "", modulus: str = "", relaxed: str = "") -> Prony:
    """Computes the branches of a viscoelastic block from a master curve of a rubber.

        asperity.prony("master.csv", "rubber.toml")     # then block.prony = "rubber.toml"

    Parameters
    ----------
    source : str or Path
        Text file with columns of frequency, storage and loss modulus (or tan δ), and maybe a shift factor aT, whose names and
        units stand above.
    target : str or Path, optional
        File to write for block.prony, which must not be there; its name ends in .toml.
    branches : int, optional
        Number of branches at most; by default one for each decade of frequency.
    poisson, nu : float, optional
        Poisson's ratio, which shear moduli need.
    frequency_unit : str
        Unit of the frequency, "Hz" or "rad/s", if the file does not say it.
    modulus_unit : str
        Unit of the moduli, "MPa", if the file does not say it.
    modulus : str
        "E" or "G", if the file does not say it.
    relaxed : str
        Relaxed Young's modulus with its unit, "60 MPa", if the file does not determine it.

    Returns
    -------
    Prony
        Relaxed modulus, branches and errors of the fit; its plot() draws them.

    Raises
    ------
    InputOutputError
        The file is no master curve, or no branches describe it.
    SceneError
        An argument is wrong, or the target is there already.
    """
    if target is not None:
        if Path(target).suffix.lower() != ".toml":
            raise SceneError(str(target), "is no name of a TOML file", "what is written is TOML", f"for example {Path(target).with_suffix('.toml')}")
        store.require_new(Path(target))
    if modulus not in ("", "E", "G"):
        raise SceneError(f"--modulus {modulus}", "is none of its choices", "choices: E, G", "say E of Young's moduli, G of shear moduli")
    found = fit(read_master_curve(source, frequency_unit, modulus_unit, modulus), branches, chosen("poisson", poisson=poisson, nu=nu), relaxed)
    found.notes = [spoken(note) for note in found.notes]
    if target is not None:
        with store.new(Path(target)) as beside:
            Path(beside).write_text(found.toml, encoding="utf-8")
    return found
