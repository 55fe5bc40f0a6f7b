# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The functions of the package for users, and the plots and reports of its results.

Results and sweeps are data alone; their plots and reports are attached here, above the modules that draw and write.
matplotlib and jinja2 are imported with the first of them.
"""

from __future__ import annotations

from pathlib import Path

from .commands.adhesion import Adhesion, adhesion
from .results.result import Result, load
from .running.runs import run
from .studies.estimates import Estimate, estimate, load_estimate
from .studies.sweeps import Sweep, load_sweep, sweep

__all__ = ["Adhesion", "Estimate", "Result", "Sweep", "adhesion", "estimate", "load", "load_estimate", "load_sweep", "run", "sweep"]


def _plot_of_run(self: Result):
    """Returns the plots of the run: result.plot.separation(ax), .energy, .map("gap"), ..."""
    from .plots.run import RunPlots

    return RunPlots(self)


def _plot_of_sweep(self: Sweep, name: str = "gamma", ax=None):
    """Draws a plot over the swept key.

    Parameters
    ----------
    name : str
        "gamma", "area", "separation", "radius", "pull-off" or "hysteresis".
    ax : matplotlib Axes, optional
        Axes to draw into; by default new ones.

    Returns
    -------
    Axes
        The axes with the plot.
    """
    from .plots.sweep import draw

    return draw([self], name, ax)


def _report_of_run(self: Result) -> Path:
    """Writes report.html into the directory.

    Returns
    -------
    Path
        The file.
    """
    from .reports.run import write_run_page

    return write_run_page(self).path


def _report_of_sweep(self: Sweep) -> Path:
    """Writes report.html into the directory.

    Returns
    -------
    Path
        The file.
    """
    from .reports.sweep import write_sweep_page

    return write_sweep_page(self.directory).path


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


def _text_of_estimate(self: Estimate) -> str:
    from .reports.estimate import text_of

    return text_of(self)


def _report_of_estimate(self: Estimate) -> Path:
    """Writes report.html into the directory.

    Returns
    -------
    Path
        The file.
    """
    from .reports.estimate import page_of

    page = page_of(self)
    page.write()
    return page.path


for kind, name, form in ((Estimate, "plot", _plot_of_estimate), (Estimate, "quote", _quote), (Estimate, "report", _report_of_estimate),
                         (Estimate, "__str__", _text_of_estimate), (Result, "plot", property(_plot_of_run)),
                         (Result, "report", _report_of_run), (Sweep, "plot", _plot_of_sweep), (Sweep, "report", _report_of_sweep)):
    setattr(kind, name, form)
