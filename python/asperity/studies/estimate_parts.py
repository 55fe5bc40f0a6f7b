# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The parts of the error of a scene's number: which runs show each, and what follows from them.

A part has a shift, which corrects a bias, and a standard error. What a finer setting changes is measured; what lies beyond
it follows from the order of the error and is counted as its standard error in full. Every part varies one setting of a
base: the scene, or the quasi-static scene where its path can be followed so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.special import stdtrit

from ..results.result import Values
from ..running.pool import DONE
from ..units import GIGAPASCAL
from .quantities import AREA, Quantity, convergence_of, grain_of, number_of, slide_of
from .stated_number import INFINITE, Found, Number
from .variations import AT_REST, NAN, Choice, Setting, Variation, Variations, joined

GROUPS = ("convergence", "truncation", "discretisation", "geometry", "rate", "realisation")


def stated(q: Quantity, unit: str, value: float, result: Values) -> Number:
    """Returns the number of a result with its possible range, without parts of its error.

    A state at zero load that no load has pressed together before is bound, and the drive has pulled all the way: works
    have one sign. No more than Δγ can be gained over a wall, where each site has one height."""
    flat, keys = result.number("delta_gamma", 0.0), result.part("scene")
    sites, spacing = keys.number("surface.sites", 1.0), keys.number("surface.spacing", NAN)
    unpressed = keys.number("drive.load", 0.0) == 0.0 and not any(
        one.split()[0] not in ("relax", "approach", "pull-off", "hold") for one in map(str, keys.find("drive.path") or []))
    wall = keys.text("interface.kind") == "wall"
    least, most, unresolved, condition = 0.0, INFINITE, "", ""
    if q.path.startswith("slide.") and (slide := slide_of(result)) and not slide.find("steady"):
        condition = "for a slide that still drifts at its end; a longer one tells more"
    if q.path in ("binding_energy", "binding_energy_ratio") or q.path.startswith("work_of_drive."):
        size = flat if q.path != "binding_energy_ratio" else 1.0
        most = size if wall and q.path.startswith("binding_energy") else INFINITE
        if q.path == "work_of_drive.approach":
            least, most = -size if wall else -INFINITE, 0.0
        if not unpressed:
            least, most = -INFINITE, most if q.path.startswith("binding_energy") else INFINITE
    elif q.path == "yielding.largest_fraction":
        most = 1.0
    elif q.path in ("contact_fraction", AREA.path, "slide.steady_contact_area"):
        most = 1.0
        unresolved = f"contact of {round(value * sites**2)} of {round(sites**2)} sites"
    elif q.path == "contact_radius.relaxed":
        most = sites * spacing / math.sqrt(math.pi)
    elif q.path == "pull_off_stress" and wall and keys.text("interface.law") == "exponential":
        most = flat / 1e3 / keys.number("interface.range", NAN) / (1e-3 * GIGAPASCAL)
    return Number(q.path, q.symbol, q.name, unit, value, least=least, most=most, grain=grain_of(result, q.path, value),
                  unresolved=unresolved, condition=condition)


Rule = Callable[[Quantity, float, np.ndarray, list[Values]], Found]
"""From the number of the base, those of the rows, and the rows' results."""


def finer(ratio: float, order: float | None = None) -> Rule:
    """Makes the rule of one row, finer by a ratio. A number that would change its sign on the way to the limit is not at its order yet: its value in
    the row is taken."""
    def rule(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
        beyond = (rows[0] - base) / (ratio ** (q.order if order is None else order) - 1.0)
        return Found(rows[0] - base + (beyond if (rows[0] + beyond) * rows[0] >= 0.0 else 0.0), abs(beyond))
    return rule


def coarser(ratio: float, order: float | None = None) -> Rule:
    """Makes the rule of one row, coarser by a ratio and so cheaper than the base; otherwise as finer()."""
    def rule(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
        beyond = (base - rows[0]) / (ratio ** (q.order if order is None else order) - 1.0)
        return Found(beyond if (base + beyond) * base >= 0.0 else 0.0, abs(beyond))
    return rule


def limit(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
    """Takes the number of the last row; its last change is the standard error."""
    return Found(rows[-1] - base, abs(rows[-1] - (rows[-2] if len(rows) > 1 else base)))


def solved(q: Quantity, base: float, rows: np.ndarray, results: list[Values]) -> Found:
    """Takes the row of a better solution; the error is the bound that the row states, or its change."""
    stated = convergence_of(results[0], q.path)
    return Found(rows[0] - base, max(abs(rows[0] - base), stated if stated == stated else 0.0))


def standard_error(values: np.ndarray) -> float:
    """Computes the standard error of the mean of some values; of a few, so much larger that twice the error holds the mean
    with 95 % (Student's t)."""
    n = len(values)
    return float(stdtrit(n - 1, 0.975) / 1.96 * np.std(values, ddof=1) / math.sqrt(n))


def mean(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
    """Averages over rows of other surfaces of the same statistics."""
    values = np.array([base, *rows])
    return Found(float(values.mean()) - base, standard_error(values))


def widened(count: int, wider: bool) -> Rule:
    """Makes the rule of rows of other surfaces of the base's width, then some of half or twice the width. The error falls between the inverse of the
    width (waves that are missing) and of the area (means over a finite one)."""
    def rule(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
        here, there = np.array([base, *rows[:count]]), rows[count:]
        difference = float(there.mean() - here.mean()) if wider else float(here.mean() - there.mean())
        beyond = 1.0 / (2.0**1.5 - 1.0)
        factor = 1.0 + beyond if wider else beyond
        noise = math.hypot(standard_error(here), standard_error(there))
        return Found(factor * difference, max(beyond * abs(difference), factor * noise))
    return rule


def places(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
    """Estimates from the quarters of a map the scatter that other places on the sample would have, for the area of the map."""
    return Found(0.0, standard_error(rows))


def positions(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
    """Takes the scatter over places of one solid on the other as the error of any of them; the number is not corrected."""
    return Found(0.0, float(np.std([base, *rows], ddof=1)))


def edges(q: Quantity, base: float, rows: np.ndarray, _: list[Values]) -> Found:
    """Compares with the map in its mirror images: neither of the two treatments is right, and the number is not corrected."""
    return Found(0.0, 0.5 * abs(rows[0] - base))


@dataclass(eq=False)
class Part:
    """A part of the error. rows: runs that show it; without rows `what` says why. relative: error of a part without rows, over
    the number."""

    name: str
    group: str
    what: str
    rows: list[Variation] = field(default_factory=list)
    rule: Rule = limit
    base: Variation | None = None
    relative: float = 0.0

    @property
    def failed(self) -> str:
        """Reason why the part has no number although it was to be run; "" if it has one, or was not to be run."""
        for row in [self.base, *self.rows] if self.rows and self.base else []:
            if row.outcome.status != DONE:
                return f"{row.label}: {row.outcome.reason or 'it was not run'}"
        return ""

    def found(self, q: Quantity) -> Found | None:
        """Returns the shift and error of a quantity by this part; None if the part was not measured."""
        if self.relative and self.base:
            value = number_of(self.base.outcome.result, q.path)
            return None if math.isnan(value) else Found(0.0, abs(self.relative * value))
        if not self.rows or self.failed or not self.base:
            return None
        base, *rows = (number_of(row.outcome.result, q.path) for row in (self.base, *self.rows))
        if math.isnan(base) or np.isnan(rows).any():
            return None
        return self.rule(q, base, np.array(rows), [row.outcome.result for row in self.rows])


class Plan(NamedTuple):
    """The scene, its quasi-static twin, and the parts of the error."""

    scene: Variation
    rest: Variation | None
    """The quasi-static scene, which the parts of a dynamic path take as their base."""
    parts: list[Part]


SHIFTS = 8
"""Places of one solid on the other, with that of the scene."""


def _positions(scene: Variations, part: Callable[..., None]) -> None:
    """Adds the part of the position of a second solid: shifts by eighths of the box along x, and by three times as much along y."""
    if not scene.second_solid:
        return
    if scene.scene.text("surface.boundary") == "free" or scene.scene.text("surface.counter_crop") != "none":
        return part("position", "realisation", "not varied: the map of the second solid does not repeat")
    step = scene.edge / SHIFTS
    keys = ("surface.counter_shift_x", "surface.counter_shift_y")
    here = [scene.own(key) for key in keys]
    part("position", "realisation", f"{SHIFTS} shifts of the second solid", [
        (f"shift {k}/{SHIFTS}", [f"{key}={x + step * (factor * k % SHIFTS):.10g}" for key, x, factor in
                                 zip(keys, here, (1, 3))]) for k in range(1, SHIFTS)], positions)


def _box(scene: Variations, factor: float) -> Setting:
    """Returns the setting of a wider or narrower box at the same spacing; a block as thick as wide stays so."""
    return [f"surface.sites={scene.sites * factor:.0f}"] + [
        f"block.thickness={scene.sites * factor:.0f}"] * (scene.thickness == scene.sites)


SpacingAlso = Callable[[float], Setting]
"""What is set too with so many times the spacing."""


def is_coarse(scene: Variations) -> bool:
    """Returns True if a lattice of twice the spacing is as good to measure on: for a path, whose runs are long, if the lattice
    is no solid's own and all waves fit."""
    kind = scene.scene.text("surface.kind")
    waves = kind == "flat" or kind == "self-affine" and 4 * scene.own("surface.q_max") <= scene.sites
    waves = waves and not scene.second_solid
    return scene.moves and scene.continuous and waves and scene.sites % 4 == scene.thickness % 2 == 0 and scene.sites >= 64


def plan_of(scene: Variations, seeds: int, spacing_also: SpacingAlso = lambda _: [], maps: tuple[Part, ...] = ()) -> Plan:
    """Plans the parts of a scene's errors."""
    own, rest = scene.own, None
    start = Variation("scene", "the scene", [])
    if scene.dynamic and not scene.finite:
        rest = Variation("rate", "quasi-static", AT_REST)
    base, moved = rest or start, AT_REST if rest else []
    coarse = Variation("spacing", "twice the spacing", joined(moved, joined(scene.spaced(2), spacing_also(2)))) if is_coarse(scene) else None
    parts: list[Part] = []

    def part(name: str, group: str, what: str, choices: Sequence[Choice] = (), rule: Rule = limit, of: Variation | None = None,
             ) -> None:
        of = of or base
        common = coarse.setting if of is coarse else moved if of is base else []
        rows = [Variation(name, label, joined(common, setting)) for label, setting in choices]
        parts.append(Part(name, group, what, rows, rule, of))

    if scene.moves and (rest or not scene.dynamic):
        part("convergence", "convergence", f"drive.displacement_step {0.5 * own('drive.displacement_step'):.4g} Å and the bound of the result",
             scene.scaled("drive.displacement_step", 0.5), solved)
    else:
        part("convergence", "convergence", f"drive.tolerance {0.1 * own('drive.tolerance'):.2g}",
             scene.scaled("drive.tolerance", 0.1), solved)
    if scene.mixed and scene.scene.text("numerics.precision") == "mixed":
        part("precision", "convergence", "double precision", scene.precisions("double"))
    _truncation(scene, part)
    order = 1 if spacing_also(2) else None  # None: that of the quantity
    if coarse:
        parts.append(Part("spacing", "discretisation", f"spacing {2 * own('surface.spacing'):.4g} Å", [coarse], coarser(2, order), base))
    elif any(one.name == "spacing" for one in maps):
        pass  # a map has a scene of its own there
    elif scene.continuous:
        part("spacing", "discretisation", f"spacing {0.5 * own('surface.spacing'):.4g} Å",
             [("half the spacing", joined(scene.spaced(0.5), spacing_also(0.5)))], finer(2, order))
    else:
        part("spacing", "discretisation", "not varied: the spacing is that of the atoms")
    _in_time(scene, part, start)
    part("thickness", "geometry", f"{2 * scene.thickness} layers",
         scene.at("block.thickness", scene.thickness if coarse else 2 * scene.thickness), limit, coarse or base)
    if rest:
        parts.append(Part("rate", "rate", "velocity to 0: the quasi-static path", [rest], limit, start))
    elif scene.dynamic:
        part("rate", "rate", f"velocity {2 * own('drive.velocity'):.4g} m/s, to 0", scene.scaled("drive.velocity", 2),
             coarser(2, 1), start)
    else:
        part("rate", "rate", "none: the scene is quasi-static")
    if scene.scene.text("surface.kind") == "self-affine" and own("surface.rms") > 0:
        _surfaces(scene, part, seeds)
    elif not maps:
        part("width", "geometry", "not varied: the surface has no statistics to continue it by")
        part("seeds", "realisation", "none: there is one such surface")
    _positions(scene, part)
    for one in maps:
        one.base = base
        for row in one.rows:
            row.setting = joined(moved, row.setting)
    parts += maps
    return Plan(start, rest, sorted(parts, key=lambda one: GROUPS.index(one.group)))


def _truncation(scene: Variations, part: Callable) -> None:
    cutoff = scene.own("interface.cutoff")
    wide = min(2 * cutoff, 0.5 * scene.edge)
    if not scene.length:
        part("tail", "truncation", "none: " + ("the law has no cutoff" if scene.continuous else "a table ends where it says"))
    elif scene.scene.find("interface.pairs"):
        part("tail", "truncation", "not varied: interface.pairs have cutoffs of their own")
    elif wide < 1.05 * cutoff:
        part("tail", "truncation", "not varied: the box allows no larger cutoff")
    elif scene.scene.text("surface.kind") == "atoms" or any("slide" in one for one in scene.scene.find("drive.path")):
        part("tail", "truncation", f"cutoff {wide:.4g} Å: no tail acts here", scene.cut(False, wide), finer(wide / cutoff, 4))
    elif scene.scene.find("interface.tail"):
        part("tail", "truncation", f"cutoff {wide:.4g} Å", scene.cut(True, wide))
    else:
        part("tail", "truncation", f"tail, cutoff {wide:.4g} Å", scene.cut(True, cutoff, wide))


def _in_time(scene: Variations, part: Callable, start: Variation) -> None:
    own = scene.own
    if not scene.dynamic:
        return
    if scene.scene.text("block.model") != "lattice":
        layers = int(own("block.layers_per_level"))
        fewer = layers // 2 if layers >= 4 else 2 * layers
        part("levels", "discretisation", f"{fewer} layers a level", scene.layers(fewer),
             coarser(layers / fewer, 2) if fewer < layers else finer(2, 2), start)
    longer = scene.stable(2)
    part("timestep", "discretisation", f"time step {(2 if longer else 0.5) * own('drive.timestep'):.4g} fs",
         longer or scene.scaled("drive.timestep", 0.5), coarser(2, 2) if longer else finer(2, 2), start)


def _surfaces(scene: Variations, part: Callable, seeds: int) -> None:
    own, first = scene.own, int(scene.own("surface.seed"))
    numbers = range(first, first + seeds)
    others = [(f"seed {n}", [f"surface.seed={n}"]) for n in numbers[1:]]
    curved, wider = own("surface.radius") > 0, own("surface.rolloff") < 2 or scene.sites % 2 > 0 or scene.sites < 32
    factor = 2.0 if wider else 0.5
    if curved:
        part("width", "geometry", "not varied: images of the sphere are in it")
    elif scene.second_solid:
        part("width", "geometry", "not varied: the map of the second solid is as wide as the box")
    else:
        cutoff = min(own("surface.q_max"), scene.sites // 2)
        box = [*_box(scene, factor), f"surface.rolloff={factor * own('surface.rolloff'):.10g}",
               f"surface.q_max={factor * cutoff:.10g}"]
        of_box = numbers if wider else range(first, first + 2 * seeds)  # small ones scatter more, and take a quarter
        part("width", "geometry", f"{len(of_box)} surfaces of {factor * scene.sites:.0f} x {factor * scene.sites:.0f} sites",
             others + [(f"{factor:g} of the width, seed {n}", [*box, f"surface.seed={n}"]) for n in of_box],
             widened(len(others), wider))
    part("seeds", "realisation", f"{seeds} surfaces", others, mean)
