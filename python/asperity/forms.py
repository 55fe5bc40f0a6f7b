# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a user calls: the functions of the package, and the plots and reports of its results.

Results and sweeps are data alone; their plots and reports are attached here, above the modules that draw and write.
matplotlib and jinja2 are imported with the first of them.
"""

from __future__ import annotations

from pathlib import Path

from .result import Result, load
from .runs import run
from .sweeps import Sweep, load_sweep, sweep

__all__ = ["Result", "Sweep", "load", "load_sweep", "run", "sweep"]


def _plot_of_run(self: Result):
    """Its plots: result.plot.separation(ax), .energy, .map("gap"), ..."""
    from .plots.run import RunPlots

    return RunPlots(self)


def _plot_of_sweep(self: Sweep, name: str = "gamma", ax=None):
    """A plot: gamma, area, separation, radius, pull-off or hysteresis over the swept key."""
    from .plots.sweep import draw

    return draw([self], name, ax)


def _report_of_run(self: Result) -> Path:
    """Writes report.html into the directory; its path."""
    from .report import write_run_page

    return write_run_page(self).path


def _report_of_sweep(self: Sweep) -> Path:
    """Writes report.html into the directory; its path."""
    from .report_sweep import write_sweep_page

    return write_sweep_page(self.directory).path


Result.plot = property(_plot_of_run)
Result.report = _report_of_run
Sweep.plot = _plot_of_sweep
Sweep.report = _report_of_sweep
