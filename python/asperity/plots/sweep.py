# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The plots of sweeps: simulated points, with their spread over the seeds, and curves of the theories.

The numeric key with the most values is the x axis; each combination of the other keys gives a curve. Colours distinguish curves;
dashes and markers distinguish quantities.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..errors import UnknownName
from ..files import store
from ..results.losses import losses
from ..results.result import Values, load_words
from ..running import program
from ..studies.grid import in_decades, shown
from ..studies.sweeps import Sweep
from ..studies.tables import Table
from ..units import MILLIJOULE, NANONEWTON, shown as shown_unit
from .style import (
    BLUE,
    COLOURS,
    DASHES,
    GREEN,
    GREY,
    PINK,
    RED,
    SKY,
    YELLOW,
    curve,
    drawn,
    drawn_into,
    files_of,
    finish,
    make,
    millijoules,
    save,
)

MOST_CURVES = len(COLOURS)


@dataclass
class Trace:
    """A quantity of the points: a column of the table divided by `unit`, "-column" with reversed sign. {at} and {under} in the
    label are replaced by load_words()."""

    label: str
    column: str
    colour: str = GREY
    line: Any = ""
    marker: str = ""
    filled: bool = True
    unit: float = 1.0
    uncertainty: str = ""
    """column of what its energy (the column without _ratio) may be wrong by"""

    def values(self, table: Table) -> np.ndarray:
        """Returns the values of the trace in the unit of the plot."""
        return table.column(self.column) / self.unit

    def average(self, table: Table) -> tuple[np.ndarray, np.ndarray]:
        """Returns means over the seeds with their error bars."""
        values = self.values(table)
        energy = table.column(self.column.removesuffix("_ratio"))
        over = np.divide(values, energy, where=energy != 0, out=energy * np.nan)
        error = table.column(self.uncertainty) * np.abs(over)
        mean, deviation, _ = table.average(values)
        bars = np.array([deviation, table.average(error).mean])
        return mean, np.where(np.isfinite(bars).any(axis=0), np.sqrt(np.nansum(bars**2, axis=0)), np.nan)


THEORY = Trace("Persson’s theory{under}", "theory.persson.gamma_eff_ratio", GREY, "-")
FULL = Trace("Persson’s theory{under}, assuming full contact", "theory.persson.gamma_full_contact_ratio", GREEN, DASHES[1])
RENORMALISED = Trace("renormalised theory{under}", "theory.renormalised.gamma_eff_ratio", PINK, DASHES[3])
SPHERE = Trace("sphere, renormalised law", "theory.sphere.renormalised_ratio", GREY, DASHES[4])
AREA = [Trace("Persson’s theory{under}", "theory.persson.contact_fraction", GREY, "-"),
        Trace("renormalised theory{under}", "theory.renormalised.contact_fraction", PINK, DASHES[3])]
SLIDING = "Persson’s theory of rubber friction"
FRICTION = [Trace(SLIDING, "theory.sliding.friction_coefficient", GREY, "-")]
SLIDING_AREA = [Trace(SLIDING, "theory.sliding.contact_fraction", GREY, "-")]
COEFFICIENT = "friction coefficient $μ$"
GAMMA, CONTACT, LOST = "$γ_{\\mathrm{eff}}$ / Δγ", "$A$ / $A_0$", "energy lost per nominal area (meV/Å²)"
Spec = tuple[str, list[Trace], list[Trace]]

SIMULATED: dict[str, Spec] = {
    "gamma": (GAMMA, [THEORY, RENORMALISED, SPHERE], [
        Trace("work of the interface, approach", "work_of_interface.approach_ratio", BLUE, "", "o",
              uncertainty="work_of_interface.uncertainty.approach"),
        Trace("−work of the interface, pull-off", "-work_of_interface.pull_off_ratio", RED, "", "s", False,
              uncertainty="work_of_interface.uncertainty.pull_off"),
        Trace("−work of the drive, approach", "-work_of_drive.approach_ratio", SKY, "", "<",
              uncertainty="work_of_drive.uncertainty.approach"),
        Trace("work of the drive, pull-off", "work_of_drive.pull_off_ratio", YELLOW, "", ">", False,
              uncertainty="work_of_drive.uncertainty.pull_off"),
        Trace("state {at}", "binding_energy_ratio", GREEN, "", "^",
              uncertainty="binding_energy_uncertainty"),
        Trace("by JKR, approach", "jkr.approach_ratio", SKY, "", "D"),
        Trace("by JKR, pull-off", "jkr.pull_off_ratio", YELLOW, "", "v", False),
        Trace("by JKR, energy at zero load", "jkr.relaxed_ratio", PINK, "", "^")]),
    "works": (GAMMA, [THEORY, RENORMALISED], [
        Trace("∫F dz, approach", "work_of_interface.approach_ratio", BLUE, "", "o"),
        Trace("−∫F dz, pull-off", "-work_of_interface.pull_off_ratio", RED, "", "s", False),
        Trace("atom by atom, both ways", "pair_binding_energy_ratio", YELLOW, "", "D", False),
        Trace("state {at}", "binding_energy_ratio", GREEN, "", "^")]),
    "area": (CONTACT, AREA, [Trace("state {at}", "contact_fraction", GREEN, "", "^")]),
    "separation": ("mean separation (Å)", [
        Trace("renormalised theory{under}", "theory.renormalised.separation", PINK, DASHES[3])], [
        Trace("state {at}", "relaxed.mean_height", GREEN, "", "^")]),
    "radius": ("√(contact area / π) (Å)", [], [
        Trace("{at}", "contact_radius.relaxed", GREEN, "", "^"),
        Trace("at the pull-off force", "contact_radius.pull_off", RED, "", "s", False)]),
    "pull-off": ("largest attraction of the pull-off (nN)", [],
                 [Trace("pull-off", "pull_off_force", RED, "", "s", False, unit=NANONEWTON)]),
    "friction": (COEFFICIENT, FRICTION, [
        Trace("mean of the slide", "slide.friction_coefficient", BLUE, "", "o", uncertainty="slide.friction_coefficient_error")]),
    "sliding-area": (CONTACT, SLIDING_AREA, [
        Trace("mean of the slide", "slide.steady_contact_area", GREEN, "", "^",
              uncertainty="slide.steady_contact_area_uncertainty")]),
    "hysteresis": (LOST, [], [
        Trace("approach", "lost.approach", BLUE, "", "o", uncertainty="lost.uncertainty.approach"),
        Trace("pull-off", "lost.pull_off", RED, "", "s", False, uncertainty="lost.uncertainty.pull_off"),
        Trace("cycle", "lost.cycle", PINK, "", "D")])}
OF_THEORY: dict[str, Spec] = {
    "gamma": (GAMMA, [THEORY, RENORMALISED, FULL], []), "area": (CONTACT, AREA, []),
    "full-contact": (GAMMA, [THEORY, FULL], []),
    "friction": (COEFFICIENT, FRICTION, []), "sliding-area": (CONTACT, SLIDING_AREA, [])}


def losses_of(tables: Sequence[Table]) -> list[Trace]:
    """Returns the traces of the losses beside `lost`."""
    traces = []
    for place, name in losses(column for table in tables for column in table).items():
        traces += [Trace(f"in the {place}, approach", f"{name}.approach", SKY, "", "<", uncertainty=f"{name}.uncertainty.approach"),
                   Trace(f"in the {place}, pull-off", f"{name}.pull_off", YELLOW, "", ">", False,
                         uncertainty=f"{name}.uncertainty.pull_off"),
                   Trace(f"in the {place}, cycle", f"{name}.cycle", GREEN, "", "^")]
    return traces


def _label_of(key: str) -> str:
    unit = shown_unit(program.schema().get(key, {}).get("unit", ""))
    name = {"surface.rms": "rms roughness $h_{\\mathrm{rms}}$", "drive.load": "load", "drive.velocity": "velocity $v$"}.get(key, key)
    return f"{name} ({unit})" if unit else name


def _curves(table: Table, x: str) -> dict[str, list[int]]:
    """Returns the groups of points that make a curve over x, by the values of the other axes in words."""
    found: dict[str, list[int]] = {}
    for group, (values, _) in enumerate(table.groups):
        words = []
        for key, value in values.items():
            if key != x:
                unit = program.schema().get(key, {}).get("unit", "") if isinstance(value, (int, float)) else ""
                words.append(f"{key.partition('.')[2]} = {shown(value)}" + f" {shown_unit(unit)}" * bool(unit))
        found.setdefault(", ".join(words), []).append(group)
    return {words: sorted(groups, key=table.at(x).__getitem__) for words, groups in found.items()}


def _words(sweeps: Sequence[Sweep], x: str) -> list[str]:
    """Returns the words that distinguish the curves of a sweep."""
    found = [curves for sweep in sweeps if len(curves := _curves(sweep.table, x)) > 1]
    return list(dict.fromkeys(words for curves in found for words in curves))


def _trace(ax: Axes, table: Table, x: str, trace: Trace, colours: dict[str, str], told: set[str]) -> bool:
    """Draws the curves of a sweep. colours: by the words of a curve; told: the words that the legend has."""
    curves = _curves(table, x)
    along, (means, bars) = table.at(x), trace.average(table)
    several = len(curves) > 1
    any_drawn = False
    for words, groups in curves.items():
        if not np.isfinite(means[groups]).any() or (several and words not in colours):
            continue
        label = trace.label
        if several:
            label = "" if words in told else words
            told.add(words)
        curve(ax, along[groups], means[groups], label, line=trace.line, marker=trace.marker, filled=trace.filled,
              colour=colours[words] if several else trace.colour, behind=not trace.marker,
              spread=bars[groups] if trace.marker else None)
        drawn(ax).curves[-1].label = trace.label + (f", {words}" if several else "")
        any_drawn = True
    if several and any_drawn:  # what the dashes and markers mean
        ax.plot([], [], color=GREY, linestyle=trace.line, marker=trace.marker or None, label=trace.label,
                markerfacecolor=GREY if trace.filled else "none")
    return any_drawn


def _agree(one: dict[str, float], other: dict[str, float]) -> bool:
    """Returns True if two curves, {point: value}, agree at all points that both have."""
    both = np.array([(one[point], other[point]) for point in one.keys() & other.keys()]).reshape(-1, 2)
    enough = one.keys() == other.keys() or (len(both) and np.ptp(np.nan_to_num(both)) > 1e-6)
    return bool(enough) and np.allclose(both[:, 0], both[:, 1], rtol=1e-6, atol=1e-9, equal_nan=True)


def _theories(sweeps: Sequence[Sweep], trace: Trace) -> list[list[Sweep]]:
    """Returns the sweeps that have this theory, grouped by equal curves."""
    found: list[tuple[list[Sweep], list[dict[str, float]]]] = []
    for sweep in sweeps:
        table = Table(sweep.axes, [*sweep.points, *sweep.theory], False)
        means = trace.average(table)[0]
        if not np.isfinite(means).any():
            continue
        values = {json.dumps(point, sort_keys=True): mean for (point, _), mean in zip(table.groups, means)}
        same = next((group for group in found if any(_agree(values, other) for other in group[1])), None)
        if same is None:
            found.append(([sweep], [values]))
        else:
            same[0].append(sweep)
            same[1].append(values)
    return [group for group, _ in found]


def parts_of(sweeps: Sequence[Sweep]) -> tuple[list[Sweep], str, str]:
    """Chooses the sweeps that share a plot."""
    shared: list[Sweep] = []
    along, notes = "", []
    for sweep in sweeps:
        x = sweep.table.along
        if x is None:
            notes.append("no plots: none of the swept keys is a number")
        elif along and x != along:
            notes.append(f"{sweep.name} is not in the plots: it sweeps another key")
        else:
            along = x
            shared.append(sweep)
    if (curves := len(_words(shared, along))) > MOST_CURVES:
        notes.append(f"the plots show the first {MOST_CURVES} of {curves} curves")
    return shared, along, "; ".join(dict.fromkeys(notes))


def names(sweeps: Sequence[Sweep]) -> list[str]:
    """Returns the plots that sweeps of this kind may have."""
    return list(SIMULATED if any(s.simulated for s in sweeps) else OF_THEORY)


def _flat(sweeps: Sequence[Sweep]) -> float:
    """Returns the common Δγ of all points, including those of the theory; 0 if there is none, if they differ, or for a sphere."""
    points = [point for sweep in sweeps for point in (*sweep.points, *sweep.theory)]
    found = {round(flat, 9) for point in points for name in ("delta_gamma", "theory.persson.delta_gamma")
             if (flat := Values(point).number(name))}
    sphere = any("contact_radius.relaxed" in sweep.table for sweep in sweeps)
    return found.pop() if len(found) == 1 and not sphere else 0.0


def plot(sweeps: Sequence[Sweep], name: str, ax: Axes) -> bool:
    """Draws a plot of sweeps."""
    shared, x, _ = parts_of(sweeps)
    if not shared:
        return False
    y, lines, points = (SIMULATED if shared[0].simulated else OF_THEORY)[name]
    points = points + losses_of([sweep.table for sweep in shared]) * (name == "hysteresis")
    if name == "works" and not any(np.isfinite(points[0].values(s.table)).any() for s in shared):
        return False  # of paths
    simulated = False
    colours = dict(zip(_words(shared, x), COLOURS))
    told: set = set()
    used, dashes = [trace.colour for trace in lines], [trace.line for trace in lines]
    of_theory: dict[str, str] = {}

    def unused(those: Sequence, taken: list, otherwise: Any) -> Any:
        taken.append(next((one for one in those if one not in taken), otherwise))
        return taken[-1]

    def words(sweep: Sweep) -> dict[str, str]:
        return dict(zip(("at", "under"), load_words(sweep.scene, "drive.load" in sweep.axes)))

    for trace in lines:
        for number, group in enumerate(_theories(shared, trace)):
            name = ", ".join(sweep.name for sweep in group)
            label = f"{name}: " * (len(group) < len(shared)) + trace.label.format(**words(group[0]))
            look = replace(trace, label=label)
            if number:  # a further theory: another colour, the same for all of it, and other dashes
                look.line = unused(DASHES, dashes, trace.line)
                look.colour = of_theory[name] = of_theory.get(name) or unused(COLOURS[::-1], used, trace.colour)
            table = Table(group[0].axes, [point for sweep in group for point in sweep.theory or sweep.points], False)
            _trace(ax, table, x, look, colours, told)
    for sweep in shared:
        if not sweep.simulated:
            continue
        table = sweep.table
        prefix = f"{sweep.name}: " if len(shared) > 1 else ""
        for trace in points:
            if not np.isfinite(trace.values(table)).any():
                continue
            colour = unused((trace.colour, *COLOURS), used, trace.colour)
            look = replace(trace, label=prefix + trace.label.format(**words(sweep)), colour=colour)
            simulated |= _trace(ax, table, x, look, colours, told)
    if not ax.lines or (shared[0].simulated and not simulated):
        return False
    ys = [v for c in drawn(ax).curves for v in c.y if np.isfinite(v)]
    full = [v for c in drawn(ax).curves if "full contact" not in c.label for v in c.y if np.isfinite(v)]
    low = min([0.0, *full])  # of the theory itself: full contact may go far below zero
    room = max(ys) - low
    ax.set_ylim(low - 0.02 * room, max(ys) + 0.05 * room if room else None)  # markers at the ends stay whole
    most = 1.0 if y in (GAMMA, CONTACT) and max(ys) <= 1.02 else None
    if most:
        ax.set_ylim(top=1.02)
    if y == LOST:
        millijoules(ax, MILLIJOULE, "mJ/m²")
    elif y == GAMMA and (flat := _flat(shared)):
        millijoules(ax, flat * MILLIJOULE, "$γ_{\\mathrm{eff}}$ (mJ/m²)")
    if low < 0:
        ax.axhline(0, color=GREY, linewidth=0.5, zorder=1)
    if x == "surface.rms":
        ax.set_xlim(left=0)
    xs = [v for c in drawn(ax).curves for v in c.x]
    return finish(ax, _label_of(x), y, log="x" * in_decades(xs),
                  legend="above" if len(ax.get_legend_handles_labels()[1]) > 5 else True, most=most)


def draw(sweeps: Sequence[Sweep], name: str, ax: Axes | None = None) -> Axes:
    """Draws a plot of sweeps for a user. Raises UnknownName, InputOutputError."""
    if name not in names(sweeps):
        raise UnknownName.among(sweeps[0].name, name, names(sweeps), "there is nothing to draw", "plot")
    return drawn_into(ax, lambda a: plot(sweeps, name, a), sweeps[0].name, name, f"plots: {', '.join(names(sweeps))}")


def plot_files(simulated: bool) -> list[str]:
    """Returns the names of all files that write_plots() may write."""
    return [file for name in (SIMULATED if simulated else OF_THEORY) for file in files_of(name)]


def write_plots(directory: Path, sweeps: Sequence[Sweep]) -> tuple[list[Path], str]:
    """Writes gamma.svg, .pdf, .png and the other plots."""
    note = parts_of(sweeps)[2]
    figures = {name: fig for name in names(sweeps) if (fig := make(partial(plot, sweeps, name))) is not None}
    if figures:
        with store.outputs(directory, [file for name in figures for file in files_of(name)]) as out:
            for name, fig in figures.items():
                save(fig, out, name)
    return [directory / f"{name}.svg" for name in figures], note
