# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The plots of sweeps: simulated points, with their spread over the seeds, beside the curves of the theory.

The key with the most values that are numbers is the x axis; the other keys give a curve each, told apart by
colours, while dashes and markers tell the quantities apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from .. import files as writing
from .. import program
from ..errors import InputOutputError
from ..grid import is_seed, shown
from ..tables import groups_of, number, spread_of, theory_numbers
from ..units import NANONEWTON
from ..units import shown as shown_unit
from . import files
from .style import BLUE, COLOURS, DASHES, GREEN, GREY, PINK, RED, SKY, YELLOW, curve, drawn, finish

if TYPE_CHECKING:
    from ..sweeps import Sweep

TITLES = {"gamma": "Binding energy", "area": "Contact area", "separation": "Mean separation",
          "radius": "Contact radius", "pull-off": "Pull-off force", "hysteresis": "Energy lost in the cycle",
          "full-contact": "Binding energy, theory and full contact"}
MOST_CURVES = len(COLOURS)


@dataclass
class Trace:
    """A quantity of the points: column of the result ("theory.": of the theory) over `unit`."""

    label: str
    column: str
    colour: str = GREY
    line: Any = ""
    marker: str = ""
    filled: bool = True
    flat: bool = False
    """of a sphere it means nothing"""
    unit: float = 1.0
    unless: str = ""
    """not drawn where it equals this column"""
    uncertainty: str = ""
    """column of what its energy (the column without _ratio) may be wrong by"""

    def value(self, point: dict[str, Any]) -> float:
        if self.column.startswith("theory."):
            return number(theory_numbers(point).get(self.column[7:]))
        result = point.get("result", {})
        if self.flat and np.isfinite(number(result.get("contact_radius.zero_load"))):
            return np.nan
        if self.unless and result.get(self.column) == result.get(self.unless):
            return np.nan
        return number(result.get(self.column)) / self.unit

    def error(self, point: dict[str, Any]) -> float:
        """The uncertainty of value(), NaN where the result has none."""
        result = point.get("result", {})
        energy = number(result.get(self.column.removesuffix("_ratio")))
        return number(result.get(self.uncertainty)) * abs(self.value(point) / energy) if energy else np.nan


THEORY = Trace("theory", "theory.gamma_eff_ratio", GREY, "-")
FULL = Trace("theory, assuming full contact", "theory.gamma_full_contact_ratio", GREEN, DASHES[1])
RENORMALISED = Trace("renormalised theory", "theory.renormalised.gamma_eff_ratio", PINK, DASHES[3])
AREA = [Trace("theory", "theory.contact_fraction", GREY, "-"),
        Trace("renormalised theory", "theory.renormalised.contact_fraction", PINK, DASHES[3])]
GAMMA, CONTACT = "$γ_{\\mathrm{eff}}$ / Δγ", "$A$ / $A_0$"
Spec = tuple[str, list[Trace], list[Trace]]

SIMULATED: dict[str, Spec] = {
    "gamma": (GAMMA, [THEORY, RENORMALISED], [
        Trace("approach", "work_of_adhesion.approach_ratio", BLUE, "", "o", flat=True,
              uncertainty="work_of_adhesion.uncertainty.approach"),
        Trace("pull-off", "work_of_adhesion.pull_off_ratio", RED, "", "s", False, flat=True,
              uncertainty="work_of_adhesion.uncertainty.pull_off"),
        Trace("state at zero load", "binding_energy_ratio", GREEN, "", "^", flat=True,
              uncertainty="binding_energy_uncertainty"),
        Trace("deepest state", "states.deepest.binding_energy_ratio", GREEN, "", "^", False, flat=True,
              unless="states.first.binding_energy_ratio"),
        Trace("curved, in", "jkr.in_ratio", SKY, "", "D"),
        Trace("curved, out", "jkr.out_ratio", YELLOW, "", "v", False)]),
    "area": (CONTACT, AREA, [Trace("state at zero load", "contact_fraction", GREEN, "", "^", flat=True)]),
    "separation": ("mean separation (Å)", [Trace("renormalised theory", "theory.renormalised.separation", PINK, DASHES[3])],
                   [Trace("state at zero load", "zero_load.mean_height", GREEN, "", "^", flat=True)]),
    "radius": ("√(contact area / π) (Å)", [], [
        Trace("at zero load", "contact_radius.zero_load", GREEN, "", "^"),
        Trace("at the pull-off force", "contact_radius.pull_off", RED, "", "s", False)]),
    "pull-off": ("largest attraction on the way out (nN)", [],
                 [Trace("pull-off", "pull_off_force", RED, "", "s", False, unit=NANONEWTON)]),
    "hysteresis": ("∮ $F$ d$z$ (eV)", [], [Trace("hysteresis loop", "hysteresis.loop", PINK, "", "o")])}
OF_THEORY: dict[str, Spec] = {
    "gamma": (GAMMA, [THEORY, RENORMALISED, FULL], []), "area": (CONTACT, AREA, []),
    "full-contact": (GAMMA, [THEORY, FULL], [])}


def _label_of(key: str) -> str:
    unit = shown_unit(program.schema().get(key, {}).get("unit", ""))
    name = {"surface.rms": "rms roughness $h_{\\mathrm{rms}}$", "drive.load": "load"}.get(key, key)
    return f"{name} ({unit})" if unit else name


def _curves(sweep: Sweep, points: list[dict[str, Any]], x: str) -> dict[str, list[tuple[float, list[dict]]]]:
    """Groups of points over x, by the values of the other axes in words."""
    found: dict[str, list[tuple[float, list[dict]]]] = {}
    for values, places in groups_of(sweep.axes, points):
        words = []
        for key, value in values.items():
            if key != x:
                unit = program.schema().get(key, {}).get("unit", "") if isinstance(value, (int, float)) else ""
                words.append(f"{key.partition('.')[2]} = {shown(value)}" + f" {shown_unit(unit)}" * bool(unit))
        found.setdefault(", ".join(words), []).append((number(values.get(x)), [points[i] for i in places]))
    return {words: sorted(groups, key=lambda g: g[0]) for words, groups in found.items()}


def _bar(trace: Trace, points: list[dict[str, Any]], deviation: float) -> float:
    """The spread over the seeds and the mean uncertainty of one, as independent errors."""
    parts = [deviation, spread_of([trace.error(p) for p in points]).mean]
    return float(np.sqrt(np.nansum(np.square(parts)))) if np.isfinite(parts).any() else np.nan


def _trace(ax: Axes, curves: dict, trace: Trace, prefix: str, first: bool, colour: str) -> bool:
    several = len(curves) > 1
    any_drawn = False
    for i, (words, groups) in enumerate(list(curves.items())[:MOST_CURVES]):
        spreads = [spread_of([trace.value(p) for p in points]) for _, points in groups]
        if not any(s.count for s in spreads):
            continue
        label = (words if first else "") if several else prefix + trace.label
        curve(ax, [x for x, _ in groups], [s.mean for s in spreads], label, line=trace.line, marker=trace.marker,
              filled=trace.filled, colour=COLOURS[i] if several else colour, behind=not trace.marker,
              spread=[_bar(trace, points, s.deviation) for (_, points), s in zip(groups, spreads)] if trace.marker else None)
        drawn(ax).curves[-1].label = prefix + trace.label + (f", {words}" if several else "")
        any_drawn = True
    if several and any_drawn:  # what the dashes and markers mean
        ax.plot([], [], color=GREY, linestyle=trace.line, marker=trace.marker or None, label=prefix + trace.label,
                markerfacecolor=GREY if trace.filled else "none")
    return any_drawn


def parts_of(sweeps: Sequence[Sweep]) -> tuple[list[Sweep], str, str]:
    """The sweeps that share a plot, their key along x, and what kept others out."""
    from ..sweeps import plotted_axis

    shared: list[Sweep] = []
    along, note = "", ""
    for sweep in sweeps:
        x = plotted_axis(sweep.axes, sweep.points)
        if x is None:
            note = "no plots: none of the swept keys is a number"
        elif along and x != along:
            note = f"{sweep.name} is not in the plots: it sweeps another key"
        else:
            along = x
            shared.append(sweep)
            others = len({tuple(shown(p["set"].get(k)) for k in sweep.axes if k != x and not is_seed(k))
                          for p in sweep.points})
            if others > MOST_CURVES:
                note = f"the plots show the first {MOST_CURVES} of {others} curves"
    return shared, along, note


def names(sweeps: Sequence[Sweep]) -> list[str]:
    """The plots that sweeps of this kind may have."""
    return list(SIMULATED if any(s.simulated for s in sweeps) else OF_THEORY)


def plot(sweeps: Sequence[Sweep], name: str, ax: Axes) -> bool:
    """Draws one of `names(sweeps)`; False if there is nothing to draw."""
    shared, x, _ = parts_of(sweeps)
    if not shared:
        return False
    y, lines, points = (SIMULATED if shared[0].simulated else OF_THEORY)[name]
    simulated = False
    used = {trace.colour for trace in lines}
    for part, sweep in enumerate(shared):
        if part == 0:  # a sweep without curves of its own has the theory of its points
            curves = _curves(sweep, sweep.theory or sweep.points, x)
            for trace in lines:
                _trace(ax, curves, trace, "", trace is lines[0], trace.colour)
        if not sweep.simulated:
            continue
        curves = _curves(sweep, sweep.points, x)
        prefix = f"{sweep.name}: " if len(shared) > 1 else ""
        last = GREY
        for i, trace in enumerate(points):
            if not any(np.isfinite(trace.value(p)) for p in sweep.points):
                continue
            colour = next((c for c in (trace.colour, *COLOURS) if c not in used), trace.colour)
            if trace.unless:  # of the same colour as what it is compared with
                colour = last
            last = colour
            used.add(colour)
            simulated |= _trace(ax, curves, trace, prefix, i == 0 and not lines, colour)
    if not ax.lines or (shared[0].simulated and not simulated):
        return False
    ys = [v for c in drawn(ax).curves for v in c.y if np.isfinite(v)]
    full = [v for c in drawn(ax).curves if "full contact" not in c.label for v in c.y if np.isfinite(v)]
    low = min([0.0, *full])  # of the theory itself: full contact may go far below zero
    ax.set_ylim(bottom=low - 0.02 * (max(ys) - low))  # markers at zero stay whole
    if y in (GAMMA, CONTACT) and max(ys) <= 1.02:
        ax.set_ylim(top=1.02)
    if low < 0:
        ax.axhline(0, color=GREY, linewidth=0.5, zorder=1)
    if x == "surface.rms":
        ax.set_xlim(left=0)
    finish(ax, _label_of(x), y)
    return True


def draw(sweeps: Sequence[Sweep], name: str, ax: Axes | None = None) -> Axes:
    """The same for people: makes an axes if none is given, raises InputOutputError if there is nothing."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    if name not in names(sweeps) or not plot(sweeps, name, ax):
        raise InputOutputError(sweeps[0].name, f"has nothing for the plot {name!r}",
                               f"plots: {', '.join(names(sweeps))}", "")
    return ax


def write_plots(directory: Path, sweeps: Sequence[Sweep]) -> tuple[list[Path], str]:
    """gamma.svg, .pdf, .png and the others into the directory; the SVG files, and what kept a sweep out."""
    note = parts_of(sweeps)[2]
    written = []
    for name in names(sweeps):
        fig = files.make(lambda ax: plot(sweeps, name, ax))
        if fig is not None:
            writing.directory(directory)
            files.save(fig, directory / name)
            written.append(directory / f"{name}.svg")
    return written, note
