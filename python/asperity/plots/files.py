# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Figures as files: PNG, PDF and SVG beside the CSV of what is in them; and as a picture of a page."""

from __future__ import annotations

import io
import itertools
import json
import re
from pathlib import Path
from typing import Any, Callable
from weakref import WeakKeyDictionary

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import files
from .style import COLOURS, INK, PAPER, drawn, figure, plain, style

KINDS = ("png", "pdf", "svg")
MOST_POINTS = 500
"""Of a curve that are kept for the read-out of a page."""


def make(draw: Callable[[Axes], bool]) -> Figure | None:
    """The figure that a function draws; None if it had nothing to draw."""
    with style():
        fig, ax = figure()
        return fig if draw(ax) else None


_made: WeakKeyDictionary[Figure, dict[str, bytes]] = WeakKeyDictionary()


def _bytes(fig: Figure, kind: str) -> bytes:
    kept = _made.setdefault(fig, {})  # the SVG is wanted twice
    if kind not in kept:
        stream = io.BytesIO()
        when = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
        with style():
            fig.savefig(stream, format=kind, metadata=when)
        kept[kind] = stream.getvalue()
    return kept[kind]


def save(fig: Figure, stem: Path, kinds: tuple[str, ...] = KINDS) -> list[Path]:
    """Writes stem.png, .pdf, .svg; their paths."""
    written = []
    for kind in kinds:
        written.append(stem.with_name(f"{stem.name}.{kind}"))
        files.write(written[-1], _bytes(fig, kind))
    return written


def csv(fig: Figure) -> str:
    """What is in a figure: two columns a curve, three where it has a spread; of a map its matrix."""
    ax = fig.axes[0]
    kept = drawn(ax)
    if kept.map is not None:
        return files.csv_text(kept.map, 6)
    heads: list[str] = []
    columns: list[np.ndarray] = []
    x, y = plain(ax.get_xlabel()), plain(ax.get_ylabel())
    for one in kept.curves:
        name = f"{one.label}: {y}" if one.label else y
        heads += [x, name]
        columns += [one.x, one.y]
        if one.spread is not None:
            heads.append(name + ", deviation over seeds and uncertainty of a run, added in squares")
            columns.append(one.spread)
    return files.csv_text([heads, *itertools.zip_longest(*columns, fillvalue=np.nan)], 9)


def inline_svg(fig: Figure) -> str:
    """The figure as SVG whose colours are those of the page around it (var(--ink), var(--c0), ...)."""
    text = _bytes(fig, "svg").decode()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r'(<svg[^>]*?) width="[^"]*" height="[^"]*"|(<svg[^>]*?) height="[^"]*"([^>]*?) width="[^"]*"',
                  lambda m: (m[1] or m[2] + m[3]), text, count=1)
    for i, colour in enumerate(COLOURS):
        text = text.replace(colour, f"var(--c{i})")
    return text.replace(INK, "var(--ink)").replace(PAPER, "var(--paper)")


def readout(fig: Figure) -> str:
    """What a page needs to tell the values under the pointer, as JSON: the frame in parts of the figure,
    the axes' limits, and the curves thinned, or the map in 16 bits."""
    import base64

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
            data["curves"].append([one.label, [[float("%.5g" % a), float("%.5g" % b)]
                                               for a, b in zip(x[some], y[some])]])
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
