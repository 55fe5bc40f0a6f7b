# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How plots look, and what was drawn into an axes.

Curves are told apart by colour (Okabe and Ito's, which the colour-blind can tell apart) and, in grey, by
their dashes and markers. Theory is drawn in dashes or dots and says so in the legend. What `curve` and
`image` draw is kept with the axes (`drawn`), for the CSV beside a plot and for the page's read-out.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from weakref import WeakKeyDictionary

import matplotlib
import matplotlib.ticker as ticker
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure

from ..errors import InputOutputError

BLUE, RED, GREEN, PINK, YELLOW, SKY, GREY = COLOURS = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#4d4d4d")
DASHES = ("-", (0, (6, 1.5)), (0, (3, 1.2)), (0, (6, 1.5, 1, 1.5)), (0, (1, 1.2)), (0, (8, 2, 2, 2)), (0, (2, 3)))

INK, PAPER = "#1a1a1b", "#fefefd"
"""Text and background; the page replaces them by its own, which may be dark."""

GAP = matplotlib.colormaps["cividis"].copy()
PRESSURE = LinearSegmentedColormap.from_list("pull-push", ["#08306b", BLUE, "#f4f2ec", RED, "#7f2704"])
CONTACT = ListedColormap(["#dfe3e6", "#0b4a6f"])
for _map in (GAP, PRESSURE, CONTACT):
    _map.set_bad("#9a9a9a")

RC = {
    "font.family": "DejaVu Sans", "font.size": 8, "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.7, "axes.labelsize": 8.5, "axes.edgecolor": INK, "axes.labelcolor": INK,
    "text.color": INK, "xtick.color": INK, "ytick.color": INK, "axes.facecolor": "none",
    "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True,
    "xtick.minor.visible": True, "ytick.minor.visible": True,
    "lines.linewidth": 1.3, "lines.markersize": 4.5, "legend.frameon": False, "legend.fontsize": 7.5,
    "legend.handlelength": 2.6, "figure.dpi": 100, "savefig.dpi": 220, "svg.hashsalt": "asperity",
    "pdf.fonttype": 42, "axes.unicode_minus": True, "image.interpolation": "none", "figure.facecolor": PAPER,
}
SIZE = (4.2, 3.0)
"""Width and height of a figure, inches: a little over a column of a paper."""


@dataclass
class Curve:
    """A curve or points as they were drawn; spread: length of the error bars, if there are any."""

    label: str
    x: np.ndarray
    y: np.ndarray
    spread: np.ndarray | None = None


@dataclass
class Drawn:
    curves: list[Curve] = field(default_factory=list)
    map: np.ndarray | None = None
    unit: str = ""


_drawn: WeakKeyDictionary[Axes, Drawn] = WeakKeyDictionary()


def drawn(ax: Axes) -> Drawn:
    """What the functions of this package have drawn into an axes."""
    return _drawn.setdefault(ax, Drawn())


def style() -> Any:
    """The context in which figures of the package are made: `with style(): fig, ax = ...`."""
    return matplotlib.rc_context(RC)


def drawn_into(ax: Axes | None, draw: Callable[[Axes], bool], where: str, name: str, why: str) -> Axes:
    """For people: draws into an axes, which is made if none is given; raises where there is nothing to draw."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    if not draw(ax):
        raise InputOutputError(where, f"has nothing for the plot {name!r}", why)
    return ax


def figure() -> tuple[Figure, Axes]:
    """A figure of the package's size that belongs to no window.

    The frame has a fixed place, so that the figures of a page or a paper line up.
    """
    made = Figure(figsize=SIZE)
    return made, made.add_axes((0.165, 0.155, 0.805, 0.815))


def plain(text: str) -> str:
    """A label without its mathematical markup."""
    return re.sub(r"[${}\\]|mathrm|_(?=\{)", "", text)


def curve(ax: Axes, x, y, label: str = "", *, colour: str = BLUE, line: Any = "-", marker: str = "",
          filled: bool = True, spread=None, behind: bool = False) -> None:
    """A curve, or points with error bars of the length `spread`. label "": none in the legend."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    options: dict[str, Any] = {"color": colour, "linestyle": line, "label": label or "_", "marker": marker or None,
                               "zorder": 1.8 if behind else 2.5, "markerfacecolor": colour if filled else PAPER}
    bars = None if spread is None else np.asarray(spread, float)
    if bars is not None and np.isfinite(bars).any():
        ax.errorbar(x, y, np.nan_to_num(bars), capsize=2, elinewidth=0.8, **options)
    else:
        ax.plot(x, y, **options)
    drawn(ax).curves.append(Curve(plain(label), x, y, bars))


def finish(ax: Axes, x: str, y: str, *, log: str = "", legend: bool = True, zero: bool = False) -> bool:
    """Labels, minor ticks and the legend; True, as of a plot that is drawn. log: "x", "y" or "xy" of the logarithmic axes;
    zero: with a line at y = 0."""
    if zero:
        ax.axhline(0, color=GREY, linewidth=0.5, zorder=1)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        if name in log:
            getattr(ax, f"set_{name}scale")("log")
            axis.set_minor_locator(ticker.LogLocator(subs=np.arange(2, 10), numticks=30))
            axis.set_minor_formatter(ticker.NullFormatter())
            low, high = axis.get_view_interval()
            if high < 12 * low:  # less than a decade: the minor ticks need their numbers
                axis.set_minor_formatter(ticker.LogFormatterSciNotation(labelOnlyBase=False))
        else:
            axis.set_minor_locator(ticker.AutoMinorLocator())
    handles, labels = ax.get_legend_handles_labels()
    if legend and len(labels) > 0:
        ax.legend(handles, labels, loc="best", frameon=True, facecolor=PAPER, framealpha=0.8, edgecolor="none",
                  fontsize=7.5 if len(labels) < 5 else 6.5)
    return True


def image(ax: Axes, values: np.ndarray, edge: float, *, label: str, cmap, high: float | None = None,
          words: tuple[str, str] | None = None) -> bool:
    """A map [y, x] of a box so wide (Å), with its scale; True. words: of a map of zeros and ones."""
    from matplotlib.patches import Patch

    values = np.asarray(values, float)
    finite = values[np.isfinite(values)]
    if words:
        low, high = 0.0, 1.0
    else:
        low, most = np.quantile(finite, [0.005, 0.995]) if finite.size else (0.0, 1.0)
        high = most if high is None else high
        if cmap is PRESSURE:
            high = max(abs(low), abs(high))
            low = -high
        if not high > low:
            high = low + max(1e-6, 1e-6 * abs(low))
    nm = 0.1 * edge
    if ax.figure.axes == [ax] and getattr(ax, "get_subplotspec", lambda: None)() is None:
        ax.set_position((0.1, 0.15, 0.8, 0.77 if words else 0.82))
    shown = ax.imshow(np.ma.masked_invalid(values), origin="lower", extent=(0, nm, 0, nm), cmap=cmap, vmin=low,
                      vmax=high, interpolation="none" if len(values) <= 1024 else "antialiased")
    ax.tick_params(which="both", direction="out", top=False, right=False)
    finish(ax, "x (nm)", "y (nm)", legend=False)
    if words:
        ax.legend(handles=[Patch(facecolor=cmap(i), edgecolor=INK, linewidth=0.5, label=w) for i, w in enumerate(words)],
                  loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    else:
        inside = finite.size and finite.min() >= low and finite.max() <= high
        ax.figure.colorbar(shown, ax=ax, label=label, extend="neither" if inside else "both", aspect=25)
    kept = drawn(ax)
    kept.map, kept.unit = values, label
    return True
