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
from .results.result import Result, load
from .running.runs import run
from .studies.curves import Curves, load_curve
from .studies.estimate import Estimate, load_estimate
from .studies.estimates import estimate
from .studies.prony import Prony, prony
from .studies.stress import Stress
from .studies.sweeps import Sweep, load_sweep, sweep
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


def _html_of_run(self: Result) -> str:
    from .reports.sentences import key_numbers

    return html_table(self.title, (), [(n.name, f"{n.value} {n.unit}".strip(), n.note) for n in key_numbers(self)],
                      self.failure_text or ("stopped early: " + self.stopped if self.stopped else ""))


# A result does not import what draws it.
for kind, name, form in (
        (Result, "plot", property(_plot_of_run)), (Result, "report", _report_of_run), (Result, "_repr_html_", _html_of_run),
        (Sweep, "plot", _plot_of_sweep), (Sweep, "report", _report_of_sweep),
        (Estimate, "plot", _plot_of_estimate), (Estimate, "report", _report_of_estimate), (Prony, "plot", _plot_of_prony)):
    if not isinstance(form, property) and not name.startswith("_"):
        form.__qualname__ = f"{kind.__name__}.{name}"
        form = checks_call(form)
    setattr(kind, name, form)
