# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The plots of one run. Each function draws into axes and returns False if there is nothing to draw."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from ..arguments import checks_call, checks_calls
from ..errors import UnknownName
from ..results.losses import losses
from ..results.result import Plots, Result, State
from ..theories import combined
from ..units import ATTOJOULE, GIGAPASCAL, MILLIJOULE, NANONEWTON
from .style import (
    BLUE,
    CONTACT,
    DASHES,
    GAP,
    GREEN,
    GREY,
    PINK,
    PRESSURE,
    RED,
    SKY,
    YELLOW,
    curve,
    drawn_into,
    finish,
    image,
    millijoules,
)

WAYS = {"approach": BLUE, "pull-off": RED}  # other segments of a path have the other colours in turn
OTHERS = (GREEN, PINK, SKY, YELLOW)
BY_HAND = "led by the script"
TOP = "displacement of the top plane"
DRIVE = "displacement of the drive"
CURVE = 16
"""Number of roughnesses of a theory's curve."""


def _columns(run: Result, *names: str) -> list[np.ndarray]:
    """Returns columns of the series, if all exist and there is a curve to draw."""
    columns = [run.series[name] for name in names if name in run.series]
    return columns if len(columns) == len(names) and len(columns[0]) > 1 else []


def force_unit(run: Result) -> tuple[float, str]:
    """Returns divisor and label for the forces of a run in plots: forces over the area, except for spheres and free edges.

    Parameters
    ----------
    run : Result
        Result of the run.

    Returns
    -------
    tuple[float, str]
        Divisor of forces in eV/Å, and the label of the axis: nN, or GPa, MPa, kPa.
    """
    if run.in_newtons or not run.edge:
        return NANONEWTON, "force $F$ (nN)"
    area, force = run.edge**2 * GIGAPASCAL, run.series["force"] if "force" in run.series else np.zeros(0)
    largest = np.abs(force[np.isfinite(force)]).max(initial=0.0) / area
    scale, name = next(((s, n) for s, n in ((1.0, "GPa"), (1e-3, "MPa")) if largest >= 0.1 * s), (1e-6, "kPa"))
    scale, name = (scale, name) if largest > 0.0 else (1.0, "GPa")
    return area * scale, f"mean stress $F/A_0$ ({name})"


def length_unit(run: Result) -> tuple[float, str]:
    """Returns divisor and unit for the lengths of a run in plots.

    Parameters
    ----------
    run : Result
        Result of the run.

    Returns
    -------
    tuple[float, str]
        Divisor of lengths in Å, and the unit: nm for a sphere or a box with free edges, otherwise Å.
    """
    return (10.0, "nm") if run.in_newtons else (1.0, "Å")


def _by_segment(ax: Axes, run: Result, x: np.ndarray, y: np.ndarray, name: str = "", lines=("-", DASHES[1])) -> bool:
    """Draws a curve for each segment of the path, and one for steps controlled by a script."""
    labels: set[str] = set()
    others = 0
    for number, words in (*enumerate(run.segment_names), (-1, BY_HAND)):
        here = run.series["segment"] == number
        if words not in WAYS and number >= 0:
            others += 1
        if here.sum() > 1:
            curve(ax, x[here], y[here], "" if words in labels else words + name,
                  colour=WAYS.get(words, OTHERS[others % len(OTHERS)]) if number >= 0 else GREY,
                  line=lines[words == "pull-off"])
            labels.add(words)
    return bool(labels)


def separation(run: Result, ax: Axes) -> bool:
    """Draws the force of the substrate over the mean separation, for approach and pull-off; for a sphere with the curves of smooth
    spheres.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    if not (columns := _columns(run, "mean_height", "force", "segment")):
        return False
    height, force, _ = columns
    unit, label = force_unit(run)
    one, length = length_unit(run)
    beside = combined.sphere_curves(run, force.max())
    for number, (words, x, y) in enumerate(beside):
        curve(ax, np.asarray(x) / one, y / unit, words if "theory" in words else "theory: " + words,
              colour=(GREY, YELLOW, YELLOW, PINK)[number % 4], line=DASHES[(4, 2, 3, 1)[number % 4]], behind=True)
    height = height / one
    _by_segment(ax, run, height, force / unit)
    least, greatest = force.min(), force.max()
    felt = height[np.abs(force) > -1e-3 * least]  # beyond, nothing is felt
    if felt.size and felt.max() > felt.min():
        room = 0.04 * (felt.max() - felt.min())
        ax.set_xlim(felt.min() - room, felt.max() + room)
    if run.curved and least < 0:  # the theory's curves may go much deeper than the run
        lowest = min([least] + [v for _, _, y in beside for v in y if v > 1.5 * least])
        room = 0.08 * (greatest - least)
        ax.set_ylim((lowest - room) / unit, (greatest + room) / unit)
    return finish(ax, ("mean height above the apex" if run.curved else "mean separation") + f" ({length})", label, zero=True,
                  legend="above" if beside else True)


def loading(run: Result, ax: Axes) -> bool:
    """Draws the force over the displacement of the drive, like the record of a testing machine.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    sprung = "drive_displacement" in run.series
    columns = _columns(run, "drive_displacement" if sprung else "top_displacement", "top_force", "segment")
    # With the mean height prescribed, the top plane follows: the plot of the separation again.
    if not columns or run.key("drive.control") == "mean-height":
        return False
    unit, label = force_unit(run)
    one, length = length_unit(run)
    return (_by_segment(ax, run, columns[0] / one, columns[1] / unit)
            and finish(ax, f"{DRIVE if sprung else TOP} ({length})", label, zero=True))


def contact(run: Result, ax: Axes) -> bool:
    """Draws contact fraction and fraction of repulsive sites over the displacement of the top plane.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    columns = _columns(run, "top_displacement", "contact_fraction", "repulsive_fraction", "segment")
    one, length = length_unit(run)
    columns[:1] = [column / one for column in columns[:1]]
    if not columns or not _by_segment(ax, run, columns[0], columns[1], ", in contact"):
        return False
    _by_segment(ax, run, columns[0], columns[2], ", repulsive", (DASHES[4], DASHES[2]))
    ax.set_ylim(bottom=0)
    top, touching = columns[0], columns[0][columns[1] > 1e-3 * columns[1].max()]
    if touching.size and np.ptp(touching) < 0.5 * np.ptp(top):  # most of the way is through empty space
        room = max(0.15 * np.ptp(touching), 0.01 * np.ptp(top))
        ax.set_xlim(touching.min() - room, touching.max() + room)
    return finish(ax, f"{TOP} ({length})", "fraction of the sites", legend="above" if len(run.segment_names) > 2 else True, most=1)


def friction(run: Result, ax: Axes) -> bool:
    """Draws the force against each slide of the path over its distance.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    unit, label = force_unit(run)
    drawn = False
    for number, words in enumerate(run.segment_names):
        word, *rest = words.split()
        if word != "slide" or "slide_x" not in run.series:
            continue
        here, axis = run.series["segment"] == number, rest[0]
        place, force = run.series["slide_" + axis][here], run.series["lateral_force_" + axis][here]
        if len(place) > 1:
            sign = np.sign(place[-1] - place[0])
            curve(ax, np.abs(place - place[0]), -sign * force / unit, words, colour=OTHERS[number % len(OTHERS)])
            drawn = True
    return drawn and finish(ax, "distance of the slide (Å)", "force against it (nN)" if run.in_newtons else
                            "shear stress against it " + label[label.rindex("("):], zero=True)


def _time(picoseconds: np.ndarray) -> tuple[np.ndarray, str]:
    """Returns times in a unit of their size, and the label of the axis."""
    for size, unit in ((1e6, "µs"), (1e3, "ns")):
        if np.abs(picoseconds).max(initial=0.0) >= 3 * size:
            return picoseconds / size, f"time ({unit})"
    return picoseconds, "time (ps)"


def energy(run: Result, ax: Axes) -> bool:
    """Draws the energies along the path, per nominal area (meV/Å²), or in total (aJ) for a sphere or free edges.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    timed = "time" in run.series
    along = _columns(run, "time" if timed else "step")
    if not along or not run.edge:
        return False
    unit = 1 / ATTOJOULE if run.in_newtons else 1e3 / run.edge**2
    x, label = _time(along[0]) if timed else (along[0], "point of the path")
    for name, words, colour, line in (
            ("interface_energy", "interface", BLUE, "-"), ("elastic_energy", "elastic", RED, DASHES[1]),
            ("kinetic_energy", "kinetic", GREEN, DASHES[3]), ("work", "work of the drive", GREY, DASHES[2]),
            ("damped", "damped", PINK, DASHES[4]),
            ("dissipated", "dissipated", PINK, DASHES[4]),
            *((name, f"dissipated in the {place}", colour, DASHES[3])
              for (place, name), colour in zip(losses(run.series).items(), OTHERS))):
        if name in run.series:
            curve(ax, x, run.series[name] * unit, words, colour=colour, line=line)
    if not run.in_newtons:
        millijoules(ax, MILLIJOULE, "mJ/m²")
    return finish(ax, label, "energy (aJ)" if run.in_newtons else "energy per area (meV/Å²)", legend="above")


def balance(run: Result, ax: Axes) -> bool:
    """Draws the error of the energy balance over time.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    if not (columns := _columns(run, "time", "balance_error")):
        return False
    largest = np.abs(columns[1][np.isfinite(columns[1])]).max(initial=0.0)
    power = int(np.clip(3 * np.floor(np.log10(largest) / 3), -15, 0)) if largest > 0 else 0
    x, label = _time(columns[0])
    curve(ax, x, columns[1] * 10.0**-power)
    return finish(ax, label, "energy balance error" + f" ($10^{{{power}}}$)" * (power < 0))


def spectrum(run: Result, ax: Axes) -> bool:
    """Draws the radially averaged power spectrum C(q) of the surface, realised and target; of two rough solids that of each and of their
    sum.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    found = run.substrate.spectrum if run.substrate else None
    if found is None or not (found[1] > 0).any():  # flat
        return False
    q, realised, target = found
    pair = run.substrate.pair_spectra
    curve(ax, q[realised > 0], realised[realised > 0], "sum" if pair else "realised")
    for one, label, line in zip(pair or (), ("first solid", "second solid"), DASHES[1:]):
        if (one > 0).any():
            curve(ax, q[one > 0], one[one > 0], label, colour=RED, line=line)
    if (target > 0).any():
        curve(ax, q[target > 0], target[target > 0], "target", colour=RED, line=DASHES[1])
    return finish(ax, "wavevector $q$ (1/Å)", "$C(q)$ (Å⁴)", log="xy")


def roughness(run: Result, ax: Axes) -> bool:
    """Draws γ_eff/Δγ of the theories over the roughness, with the numbers of this run at its roughness.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    flat, rms = run.number("delta_gamma") or 0.0, run.number("surface.rms") or run.number("theory.persson.h_rms") or 0.0
    if flat <= 0 or rms <= 0 or run.key("surface.kind") == "atoms":  # no theory, and Δγ but a unit
        return False
    at, pressed = run.load_words
    for words, x, y, line in theory_over_roughness(run, rms):
        curve(ax, x, y, words + pressed, colour=GREY, line=line, behind=True)
    names = (("jkr.approach_averaged", "approach, by JKR", BLUE, "o"), ("jkr.pull_off", "pull-off, by JKR", RED, "s")) \
        if run.curved else (("work_of_interface.approach", "work of the interface, approach", BLUE, "o"),
                            ("-work_of_interface.pull_off", "−work of the interface, pull-off", RED, "s"),
                            ("-work_of_drive.approach", "−work of the drive, approach", SKY, "<"),
                            ("work_of_drive.pull_off", "work of the drive, pull-off", YELLOW, ">"),
                            ("binding_energy", f"binding energy {at}", GREEN, "^"))
    for key, label, colour, marker in names:
        if (value := run.number(key.lstrip("-"))) is not None:
            value *= -1 if key.startswith("-") else 1  # of works on the solids, the energy of separating them
            curve(ax, [rms], [value / flat], label, colour=colour, line="", marker=marker, filled=marker not in "s>")
    ax.set_xlim(left=0)
    lowest = min([0.0] + [np.nanmin(c.get_ydata()) for c in ax.lines if np.isfinite(c.get_ydata()).any()])
    ax.set_ylim(bottom=1.1 * lowest)
    if ax.lines and not run.curved and run.number("theory.persson.delta_gamma", flat) == flat:
        millijoules(ax, flat * MILLIJOULE, "$γ_{\\mathrm{eff}}$ (mJ/m²)")
    return bool(ax.lines) and finish(ax, "rms roughness $h_{\\mathrm{rms}}$ (Å)", "$γ_{\\mathrm{eff}}$ / Δγ", zero=True)


def theory_over_roughness(run: Result, rms: float) -> list[tuple[str, list, list, object]]:
    """Computes the theories of the run's scene at CURVE roughnesses up to 1.8 times that of the run.

    Parameters
    ----------
    run : Result
        Result of the run.
    rms : float
        Rms roughness of the run, Å.

    Returns
    -------
    list[tuple[str, list, list, object]]
        For each theory its label, roughnesses (Å), γ_eff/Δγ and style of line; [] without a theory.
    """
    if run.key("surface.kind") == "flat":
        return []
    values = [1.8 * rms * i / CURVE for i in range(1, CURVE + 1)]
    points = combined.variations_of(run, [{"surface.rms": value} for value in values], quick=True)
    if not all("theory" in p for p in points):
        return []
    curves: list[tuple[str, list, list, Any]] = []
    for words, line, key, flat in (("Persson’s theory", "-", "persson.gamma_eff", "theory.persson.delta_gamma"),
                                   ("renormalised theory", DASHES[3], "renormalised.gamma_eff", "delta_gamma")):
        found = [(value, gamma / point.needed(flat)) for value, point in zip(values, points)
                 if (gamma := point.number("theory." + key)) is not None]
        if found:
            curves.append((words, [value for value, _ in found], [ratio for _, ratio in found], line))
    return curves


def sliding(run: Result, ax: Axes) -> bool:
    """Draws Persson's theory of rubber friction over velocity: friction coefficient and contact area.

    Parameters
    ----------
    run : Result
        Result of `asperity theory`.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    if not (points := run.listed("theory.sliding.curve", dict)):
        return False
    velocity = [point["velocity"] for point in points]
    curve(ax, velocity, [point["friction_coefficient"] for point in points], "friction coefficient $μ$")
    curve(ax, velocity, [point["contact_fraction"] for point in points], "contact area $A$ / $A_0$", colour=GREEN, line=DASHES[1])
    ax.set_ylim(bottom=0)
    return finish(ax, "velocity $v$ (m/s)", "$μ$, $A$ / $A_0$", log="x")


def _histogram(ax: Axes, edges: np.ndarray, density: np.ndarray, x: str, y: str) -> bool:
    curve(ax, np.repeat(edges, 2)[1:-1], np.repeat(np.where(density > 0, density, np.nan), 2))
    return finish(ax, x, y, log="y")


def gaps(state: State, ax: Axes) -> bool:
    """Draws the distribution of gaps P(u).

    Parameters
    ----------
    state : State
        State of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    found = state.gap_distribution
    if found is None or not (found[1] > 0).any():
        return False
    return _histogram(ax, found[0], found[1], "gap $u$ (Å)", "$P(u)$ (1/Å)")


def pressures(state: State, ax: Axes) -> bool:
    """Draws the distribution of the interface's pressure over the sites with a force.

    Parameters
    ----------
    state : State
        State of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    if "pressure" not in state:
        return False
    pressure = state["pressure"]
    felt = pressure[np.isfinite(pressure) & (pressure != 0)]  # a site beyond the interaction range feels exactly nothing
    if felt.size < 100 or not felt.max() > felt.min():
        return False
    count, edges = np.histogram(felt, bins=80)
    return _histogram(ax, edges, count / (pressure.size * np.diff(edges)), "pressure $p$ (GPa), positive is repulsive",
                      "$P(p)$ (1/GPa)")


def height(run: Result, ax: Axes) -> bool:
    """Draws the substrate from above.

    Parameters
    ----------
    run : Result
        Result of the run.
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    return bool(run.substrate and run.edge) and image(
        ax, run.substrate.height / length_unit(run)[0], run.edge, label=f"height ({length_unit(run)[1]})", cmap=GAP)


def map_of(run: Result, state: State, name: str, ax: Axes) -> bool:
    """Draws a map of a state from above.

    Parameters
    ----------
    run : Result
        Result of the run.
    state : State
        State of the run.
    name : str
        "gap", "distance", "u_x", "u_y", "u_z" (Å), "pressure" (GPa) or "contact".
    ax : Axes
        Axes to draw into.

    Returns
    -------
    bool
        False if there is nothing to draw.
    """
    if name not in state or not run.edge:
        return False
    unit, length = length_unit(run)
    look: dict[str, Any] = {"label": f"{name} ({length})", "cmap": GAP}
    if name == "contact":
        unit, look = 1.0, {"label": name, "cmap": CONTACT, "words": ("apart", "in contact")}
    elif name == "pressure":
        unit, look = 1.0, {"label": "pressure (GPa), positive is repulsive", "cmap": PRESSURE}
    elif name == "gap" and run.curved:  # around a sphere it grows without end; beyond the cutoff it does not matter
        cutoff = run.number("interface.cutoff")
        look["high"] = cutoff and cutoff / unit
    return image(ax, state[name] / unit if unit != 1.0 else state[name], run.edge, **look)


OF_RUN = {f.__name__: f for f in (separation, loading, contact, friction, energy, balance, spectrum, roughness,
                                    sliding, height)}
OF_STATE = {f.__name__: f for f in (gaps, pressures)}


@checks_calls
class RunPlots(Plots):
    """Plots of a result, result.plot: each method draws into axes, or makes new ones, and returns them.

    Of the run: separation, loading, contact, friction, energy, balance, spectrum, roughness, sliding, height. Of a state:
    gaps(state="relaxed"), pressures(...), map("gap", state="relaxed"); by default the relaxed state, or the first one.
    """

    def __init__(self, run: Result):
        self._run = run

    def __repr__(self) -> str:
        return f"<plots of {self._run.directory}: {', '.join(dir(self))}>"

    def _draw(self, name: str, ax: Axes | None, draw: Callable[..., bool], *of: Any) -> Axes:
        return drawn_into(ax, partial(draw, *of), str(self._run.directory), name, "the run wrote no such data",
                          "see drive.path, output.series and output.fields")

    if not TYPE_CHECKING:  # type checkers know the names (Plots)
        def __getattr__(self, name: str) -> Callable[..., Axes]:
            if name in OF_RUN:
                def draw(ax=None):
                    return self._draw(name, ax, OF_RUN[name], self._run)
            elif name in OF_STATE:
                def draw(ax=None, state=None):
                    return self._draw(name, ax, OF_STATE[name], self._state(state))
            else:
                raise UnknownName.among(str(self._run.directory), name, [*OF_RUN, *OF_STATE, "map"], what="plot")
            draw.__name__ = draw.__qualname__ = name
            return checks_call(draw)

    def _state(self, name: str | None) -> State:
        if name is None:  # of what a script wrote, that of the last moment
            name = next((n for n in ("relaxed", *self._run.fields) if n in self._run.fields), "relaxed")
        if name not in self._run.fields:
            raise UnknownName.among(str(self._run.directory), name, self._run.fields, "it has no states: see output.fields", "state")
        return self._run.fields[name]

    def map(self, name: str, ax: Axes | None = None, state: str | None = None) -> Axes:
        """Draws a map of a state.

        Parameters
        ----------
        name : str
            "gap", "distance", "u_x", "u_y", "u_z" (Å), "pressure" (GPa) or "contact".
        ax : Axes, optional
            Axes to draw into; None: new ones.
        state : str, optional
            Name of the state; None: the relaxed state, or the first one.

        Returns
        -------
        Axes
            The axes with the map.

        Raises
        ------
        UnknownName
            The run has no such state or map.
        """
        if name not in (shown := self._state(state)):
            raise UnknownName.among(str(self._run.directory), name, shown, what="map")
        return self._draw(name, ax, map_of, self._run, shown, name)

    def __dir__(self) -> list[str]:
        return [*OF_RUN, *OF_STATE, "map"]
