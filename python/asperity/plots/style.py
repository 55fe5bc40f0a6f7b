# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How plots look, what was drawn into an axes, and figures as files: PNG, PDF and SVG beside the CSV of what is in
them, and as a picture of a page.

Curves are told apart by colour (Okabe and Ito's, which the colour-blind can tell apart) and, in grey, by
their dashes and markers. Theory is drawn in dashes or dots and says so in the legend. What `curve` and
`image` draw is kept with the axes (`drawn`), for the CSV beside a plot and for the page's read-out.
"""

from __future__ import annotations

import base64
import io
import itertools
import json
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import Any, cast
from weakref import WeakKeyDictionary

import matplotlib
import matplotlib.ticker as ticker
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure

from ..errors import InputOutputError
from ..files import store

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

RC: dict[str, Any] = {
    "font.family": "DejaVu Sans", "font.size": 8, "mathtext.fontset": "dejavusans",
    "text.usetex": False,  # a matplotlibrc of the current folder starts no LaTeX
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
KINDS = ("png", "pdf", "svg")
MOST_POINTS = 500
"""Of a curve that are kept for the read-out of a page."""


@dataclass
class Curve:
    """A curve or points as they were drawn; spread: length of the error bars, if there are any."""

    label: str
    x: np.ndarray
    y: np.ndarray
    spread: np.ndarray | None = None


@dataclass
class Drawn:
    """Contents of an axes: curves, or a map [y, x] with its unit."""

    curves: list[Curve] = field(default_factory=list)
    map: np.ndarray | None = None
    unit: str = ""


_drawn: WeakKeyDictionary[Axes, Drawn] = WeakKeyDictionary()
_made: WeakKeyDictionary[Figure, dict[str, bytes]] = WeakKeyDictionary()


def drawn(ax: Axes) -> Drawn:
    """Returns the curves and maps that this package has drawn into an axes."""
    return _drawn.setdefault(ax, Drawn())


def style() -> Any:
    """Returns the context in which figures of the package are made: `with style(): fig, ax = ...`."""
    return matplotlib.rc_context(cast(Any, RC))  # whose keys the stubs list


def drawn_into(ax: Axes | None, draw: Callable[[Axes], bool], where: str, name: str, why: str,
               fix: str = "") -> Axes:
    """Draws into an axes for a user, and makes one if none is given. Raises InputOutputError."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    if not draw(ax):
        raise InputOutputError(where, f"has nothing for the plot {name!r}", why, fix)
    return ax


def plain(text: str) -> str:
    """Returns a label without its mathematical markup."""
    return re.sub(r"[${}\\]|mathrm|_(?=\{)", "", text)


def curve(ax: Axes, x, y, label: str = "", *, colour: str = BLUE, line: Any = "-", marker: str = "",
          filled: bool = True, spread=None, behind: bool = False) -> None:
    """Draws a curve, or points with error bars."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    options: dict[str, Any] = {"color": colour, "linestyle": line, "label": label or "_", "marker": marker or None,
                               "zorder": 1.8 if behind else 2.5, "markerfacecolor": colour if filled else PAPER}
    bars = None if spread is None else np.asarray(spread, float)
    if bars is not None and np.isfinite(bars).any():
        ax.errorbar(x, y, np.nan_to_num(bars), capsize=2, elinewidth=0.8, **options)
    else:
        ax.plot(x, y, **options)
    drawn(ax).curves.append(Curve(plain(label), x, y, bars))


def finish(ax: Axes, x: str, y: str, *, log: str = "", legend: bool | str = True, zero: bool = False,
           most: float | None = None) -> bool:
    """Adds labels, minor ticks and the legend."""
    if zero:
        ax.axhline(0, color=GREY, linewidth=0.5, zorder=1)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        if name in log:
            getattr(ax, f"set_{name}scale")("log")
            axis.set_minor_locator(ticker.LogLocator(subs=[float(n) for n in range(2, 10)], numticks=30))
            axis.set_minor_formatter(ticker.NullFormatter())
            low, high = axis.get_view_interval()
            if high < 12 * low:  # less than a decade: the minor ticks need their numbers
                axis.set_minor_formatter(ticker.LogFormatterSciNotation(labelOnlyBase=False))
        else:
            axis.set_minor_locator(ticker.AutoMinorLocator())
    handles, labels = ax.get_legend_handles_labels()
    if legend == "above" and len(labels) > 0:
        low, high = ax.get_ylim()
        longest = max(map(len, labels))
        columns = 3 if longest < 20 else 2 if longest < 36 else 1
        rows = -(-len(labels) // columns)
        part = 0.03 + (0.065 if rows < 4 else 0.055) * rows  # of the frame
        room = part / (1 - part)
        ax.set_ylim(low, high * (high / low) ** room if "y" in log else high + room * (high - low))
        ax.legend(handles, labels, loc="upper center", ncols=columns, fontsize=6.5, columnspacing=0.9, handlelength=2.0,
                  handletextpad=0.5, labelspacing=0.5 if rows < 4 else 0.25)
        if most is not None and most < ax.get_ylim()[1]:
            for set_locator, places in ((ax.yaxis.set_major_locator, ax.yaxis.get_majorticklocs()),
                                        (ax.yaxis.set_minor_locator, ax.yaxis.get_minorticklocs())):
                set_locator(ticker.FixedLocator([place for place in places if low <= place <= most + 1e-9]))
    elif legend and len(labels) > 0:
        ax.legend(handles, labels, loc="best", frameon=True, facecolor=PAPER, framealpha=0.8, edgecolor="none",
                  fontsize=7.5 if len(labels) < 5 else 6.5)
    return True


def millijoules(ax: Axes, factor: float, label: str) -> None:
    """Adds a second axis in mJ/m² on the right."""
    right = ax.secondary_yaxis("right", functions=(partial(np.multiply, factor), partial(np.multiply, 1.0 / factor)))
    right.set_ylabel(label)
    right.yaxis.set_minor_locator(ticker.AutoMinorLocator())
    ax.tick_params(axis="y", which="both", right=False)
    if ax.figure.axes == [ax] and getattr(ax, "get_subplotspec", lambda: None)() is None:
        box = ax.get_position()
        ax.set_position((box.x0, box.y0, 0.845 - box.x0, box.height))


def image(ax: Axes, values: np.ndarray, edge: float, *, label: str, cmap, high: float | None = None,
          words: tuple[str, str] | None = None) -> bool:
    """Draws a map of a periodic box with its scale."""
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
        patches = [Patch(facecolor=cmap(i), edgecolor=INK, linewidth=0.5, label=word) for i, word in enumerate(words)]
        ax.legend(handles=patches, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    else:
        inside = finite.size and finite.min() >= low and finite.max() <= high
        ax.figure.colorbar(shown, ax=ax, label=label, extend="neither" if inside else "both", aspect=25)
    kept = drawn(ax)
    kept.map, kept.unit = values, label
    return True


def make(draw: Callable[[Axes], bool]) -> Figure | None:
    """Returns the figure that a function draws; None if it had nothing to draw."""
    with style():
        fig = Figure(figsize=SIZE)  # of no window; its frame has a fixed place, so that the figures of a page line up
        return fig if draw(fig.add_axes((0.165, 0.155, 0.805, 0.815))) else None


def picture(fig: Figure, kind: str) -> bytes:
    """Returns a figure as the content of a file."""
    kept = _made.setdefault(fig, {})  # the SVG is wanted twice
    if kind not in kept:
        stream = io.BytesIO()
        when = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
        with style():
            fig.savefig(stream, format=kind, metadata=when)
        kept[kind] = stream.getvalue()
    return kept[kind]


def files_of(stem: str, kinds: Iterable[str] = KINDS) -> list[str]:
    """Returns the names of the files of a figure."""
    return [f"{stem}.{kind}" for kind in kinds]


def save(fig: Figure, out: store.Outputs, stem: str, kinds: Iterable[str] = KINDS) -> None:
    """Writes the files of a figure."""
    for kind in kinds:
        out.write(f"{stem}.{kind}", picture(fig, kind))


def csv(fig: Figure) -> str:
    """Returns the content of a figure: two columns a curve, three with a spread; of a map its matrix."""
    ax = fig.axes[0]
    kept = drawn(ax)
    if kept.map is not None:
        return store.csv_text(kept.map, 6)
    heads: list[str] = []
    columns: list[np.ndarray] = []
    x, y = plain(ax.get_xlabel()), plain(ax.get_ylabel())
    for one in kept.curves:
        name = f"{one.label}: {y}" if one.label else y
        heads += [x, name]
        columns += [one.x, one.y]
        if one.spread is not None:
            heads.append(name + ", deviation over seeds and convergence of a run, added in squares")
            columns.append(one.spread)
    return store.csv_text([heads, *itertools.zip_longest(*columns, fillvalue=np.nan)], 9)


def inline_svg(fig: Figure) -> str:
    """Returns the figure as SVG whose colours are those of the page around it (var(--ink), var(--c0), ...)."""
    text = picture(fig, "svg").decode()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r'(<svg[^>]*?) width="[^"]*" height="[^"]*"|(<svg[^>]*?) height="[^"]*"([^>]*?) width="[^"]*"',
                  lambda m: (m[1] or m[2] + m[3]), text, count=1)
    for i, colour in enumerate(COLOURS):
        text = text.replace(colour, f"var(--c{i})")
    return text.replace(INK, "var(--ink)").replace(PAPER, "var(--paper)")


def readout(fig: Figure) -> str:
    """Returns the data with which a page tells the values under the pointer, as JSON: the frame in parts of the figure, the
    axes' limits, and the curves thinned, or the map in 16 bits."""
    ax = fig.axes[0]
    box, kept = ax.get_position(), drawn(ax)
    data: dict[str, Any] = {
        "frame": [round(v, 5) for v in (box.x0, 1 - box.y1, box.x1, 1 - box.y0)],
        "x": [*ax.get_xlim(), ax.get_xscale()], "y": [*ax.get_ylim(), ax.get_yscale()]}
    if kept.map is not None:
        values = kept.map[:: max(1, len(kept.map) // 128), :: max(1, len(kept.map) // 128)]
        finite = values[np.isfinite(values)]
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
        scaled = np.where(np.isfinite(values), 65534 * (values - low) / ((high - low) or 1), 65535)
        data["map"] = {"n": len(values), "low": low, "high": high, "unit": kept.unit,
                       "values": base64.b64encode(np.round(scaled).astype("<u2").tobytes()).decode()}
    else:
        data["curves"] = []
        for one in kept.curves:
            keep = np.isfinite(one.x) & np.isfinite(one.y)
            x, y = one.x[keep], one.y[keep]
            some = slice(None, None, 1 + len(x) // MOST_POINTS)
            data["curves"].append([one.label, [[float(f"{a:.5g}"), float(f"{b:.5g}")]
                                               for a, b in zip(x[some], y[some])]])
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
