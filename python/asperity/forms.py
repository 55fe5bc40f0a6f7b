# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The functions of the package for users, and the plots and reports of its results.

Results and sweeps are data alone; their plots and reports are attached here, above the modules that draw and write.
matplotlib and jinja2 are imported with the first of them.
"""

from __future__ import annotations

import os
from pathlib import Path

from .arguments import checks_call
from .commands.adhesion import Adhesion, adhesion
from .commands.curve import curve
from .commands.stress import stress
from .commands.tip import tip
from .files import store
from .results.frames import Frames
from .results.result import Group, Result, Values, load
from .running.runs import run
from .studies.cost import Cost
from .studies.curves import Curves, load_curve
from .studies.estimates import Estimate, estimate, load_estimate
from .studies.prony import Prony, prony
from .studies.stated_number import Number
from .studies.stress import Stress
from .studies.sweeps import Sweep, load_sweep, sweep
from .studies.tables import Columns, text_of
from .studies.tip import Tip, load_tip
from .terminal import html_table

__all__ = ["Adhesion", "Curves", "Estimate", "Prony", "Result", "Stress", "Sweep", "Tip", "adhesion", "curve", "estimate", "load",
           "load_curve", "load_estimate", "load_sweep", "load_tip", "prony", "run", "stress", "sweep", "tip"]


def _place(out: str | os.PathLike | None) -> Path | None:
    """Returns the directory that a user names. Raises SceneError if it can be none."""
    return None if out is None else store.chosen(os.fspath(out), "")


def _plot_of_run(self: Result):
    """Returns the plots of the run: result.plot.separation(ax), .energy, .map("gap"), ..."""
    from .plots.run import RunPlots

    return RunPlots(self)


def _plot_of_sweep(self: Sweep, name: str = "gamma", ax=None):
    """Draws a plot over the swept key.

    Parameters
    ----------
    name : str
        "gamma", "area", "separation", "radius", "pull-off", "friction", "sliding-area" or "hysteresis".
    ax : matplotlib Axes, optional
        Axes to draw into; by default new ones.

    Returns
    -------
    Axes
        The axes with the plot.
    """
    from .plots.sweep import draw

    return draw([self], name, ax)


def _report_of_run(self: Result, out: str | os.PathLike | None = None) -> Path:
    """Writes report.html into a directory.

    Parameters
    ----------
    out : str or Path, optional
        Directory of the page; None: that of the run.

    Returns
    -------
    Path
        The file.
    """
    from .reports.run import write_run_page

    return write_run_page(self, out=_place(out)).path


def _report_of_sweep(self: Sweep, out: str | os.PathLike | None = None) -> Path:
    """Writes report.html into a directory.

    Parameters
    ----------
    out : str or Path, optional
        Directory of the page; None: that of the sweep.

    Returns
    -------
    Path
        The file.
    """
    from .reports.sweep import write_sweep_page

    return write_sweep_page(self.directory, out=_place(out)).path


def _plot_of_estimate(self: Estimate, ax=None):
    """Draws the shifts of the first number and their errors, as bars.

    Parameters
    ----------
    ax : matplotlib Axes, optional
        Axes to draw into; by default new ones.

    Returns
    -------
    Axes
        The axes with the plot.
    """
    from .plots.style import drawn_into
    from .reports.estimate import chart

    return drawn_into(ax, lambda a: chart(self, a), self.name, "estimate", "it has no number")


def _plot_of_prony(self: Prony, ax=None):
    """Draws storage and loss modulus over frequency, measured and fitted."""
    from .plots.prony import moduli
    from .plots.style import drawn_into

    return drawn_into(ax, lambda a: moduli(self, a), self.source, "moduli", "it has no branches")


def _quote(self: Estimate, path: str = "") -> str:
    """Returns a number as it is published, with its error and the parts of the error.

    Parameters
    ----------
    path : str
        Path of the number in result.json; "": the first number.

    Returns
    -------
    str
        Sentence with the number, mJ/m² and meV/Å² for energies per area.
    """
    from .reports.estimate import quote

    return quote(self.number(path))


def _html_of_run(self: Result) -> str:
    from .reports.sentences import key_numbers

    return html_table(self.title, (), [(n.name, f"{n.value} {n.unit}".strip(), n.note) for n in key_numbers(self)],
                       self.failure_text or ("stopped early: " + self.stopped if self.stopped else ""))


def _html_of_sweep(self: Sweep) -> str:
    heads, rows, meaning = text_of(self.table)
    return html_table(self.name, heads, rows, meaning)


def _html_of_estimate(self: Estimate) -> str:
    return html_table(self.name, (), [[_quote(self, path)] for path in self.numbers],
                       f"not measured: {'; '.join(self.unseen)}" if self.unseen else "")


def _html_of_adhesion(self: Adhesion) -> str:
    return _html_of_estimate(self.estimate)


def _text_of_estimate(self: Estimate) -> str:
    from .reports.estimate import text_of

    return text_of(self)


def _report_of_estimate(self: Estimate, out: str | os.PathLike | None = None) -> Path:
    """Writes report.html into a directory.

    Parameters
    ----------
    out : str or Path, optional
        Directory of the page; None: that of the estimate.

    Returns
    -------
    Path
        The file.
    """
    from .reports.estimate import page_of

    page = page_of(self, _place(out))
    page.write()
    return page.path


def _html_of_group(self: Group) -> str:
    rows = [(name, self.unit(name), " x ".join(map(str, self[name].shape))) for name in self]
    return html_table(self._called.strip("/"), ("array", "unit", "shape"), rows)


def _html_of_columns(self: Columns) -> str:
    names, rows = list(self)[:8], max((len(column) for column in self.values()), default=0)
    def text(value: object) -> str:
        return f"{value:.5g}" if isinstance(value, float) else str(value)

    return html_table(f"{rows} rows, {len(self)} columns", [f"{name}, {self.units[name]}".removesuffix(", ") for name in names],
                       [[text(self[name][i]) for name in names] for i in range(min(rows, 12))])


def _html_of_values(self: Values) -> str:
    return html_table(self._called, (), [(name, f"{value:.6g}") for name, value in self.numbers().items()])


def _html_of_cost(self: Cost) -> str:
    rows = [(row.parameter, row.label, f"{row.seconds:.3g}", *(f"{error:.2g}" for error in row.error.values())) for row in self.rows]
    return html_table("Cost of accuracy", ("parameter", "value", "s", *(f"error, {question}" for question in self.rows[0].error)), rows)


def _html_of_frames(self: Frames) -> str:
    return html_table(repr(self).strip("<>"), ("step", "time, ps"), [(str(a), f"{b:.6g}") for a, b in zip(self.steps[:12], self.times)])


def _html_of_numbers(self: Number) -> str:
    return html_table(self.name, (), [(str(self),)])


for kind, name, form in (
        (Group, "_repr_html_", _html_of_group), (Columns, "_repr_html_", _html_of_columns), (Values, "_repr_html_", _html_of_values),
        (Cost, "_repr_html_", _html_of_cost), (Frames, "_repr_html_", _html_of_frames), (Number, "_repr_html_", _html_of_numbers),
        (Estimate, "plot", _plot_of_estimate), (Estimate, "quote", _quote), (Estimate, "report", _report_of_estimate),
                         (Estimate, "__str__", _text_of_estimate), (Estimate, "_repr_html_", _html_of_estimate),
                         (Adhesion, "_repr_html_", _html_of_adhesion), (Result, "_repr_html_", _html_of_run),
                         (Sweep, "_repr_html_", _html_of_sweep), (Result, "plot", property(_plot_of_run)),
                         (Prony, "plot", _plot_of_prony),
                         (Result, "report", _report_of_run), (Sweep, "plot", _plot_of_sweep), (Sweep, "report", _report_of_sweep)):
    if not isinstance(form, property) and not name.startswith("_"):
        form.__qualname__ = f"{kind.__name__}.{name}"
        form = checks_call(form)
    setattr(kind, name, form)
