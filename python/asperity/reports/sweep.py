# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The page of a sweep: plots and table from sweep.json, and for one seed of each point contact maps, force curves and a link to the
page of the run."""

from __future__ import annotations

import base64
import contextlib
import io
import os
import shlex
from functools import partial
from pathlib import Path

import matplotlib.image
import numpy as np
from matplotlib.axes import Axes

from ..errors import Error, SceneError
from ..files import store
from ..plots import run as run_plots, sweep as plots
from ..plots.style import COLOURS, CONTACT, DASHES, GREY, KINDS, curve, finish
from ..results.result import KINDS as RESULTS, LISTED, Result, Values, expect, kinds_in, results_below
from ..running.pool import DONE, FAILED
from ..running.scene import toml_of
from ..studies.estimate import RESULT, load_estimate
from ..studies.grid import is_seed, shown
from ..studies.sweeps import Sweep, load_sweeps
from ..studies.tables import Table, text_of
from ..terminal import minus, number
from .estimate import write_estimate_page
from .page import Page, file_name, page_files
from .run import end, run_page_files, write_run_page
from .sentences import KeyNumber

MOST_POINTS = 24
MOST_CURVES = 6

FIGURES = {
    "gamma": ("Binding energy",
              "Binding energy and works of theory and simulation, over the binding energy Δγ of two flat surfaces. "
              "Of a sphere, γ by JKR from the largest attraction and from the energy at zero load. Bars: standard "
              "deviation over seeds and convergence of a run, added in squares."),
    "area": ("Contact area", "Projected contact area over the nominal area."),
    "separation": ("Mean separation", "Mean height of the lowest layer above the substrate’s mean plane."),
    "radius": ("Contact radius", "Radius of a circle as large as the area in contact."),
    "pull-off": ("Pull-off force", "Largest attraction of the substrate on the block during the pull-off."),
    "friction": ("Friction coefficient", "Mean friction of the last slide over the mean pressure, after the running-in; Persson’s "
                 "theory of rubber friction has hysteresis alone. Bars: standard error of the mean, and standard deviation over "
                 "seeds, added in squares."),
    "sliding-area": ("Contact area of the slide", "Mean projected contact area over the nominal area, while the block slides."),
    "hysteresis": ("Energy lost in the cycle", "Energy lost on the approach, on the pull-off, and in the whole cycle; of a "
                   "viscoelastic block also what it dissipates."),
    "works": ("Definitions of the work", "Work of the interface’s force on the mean height, approach and pull-off; the "
                 "work summed atom by atom, which is the energy of the pairs and the same both ways; and the state’s "
                 "energy."),
    "full-contact": ("Binding energy, theory and full contact",
                     "Persson’s theory, and the same if the whole area were in contact.")}
"""Of each plot its heading and caption."""


class _Points:
    """Points of one sweep that are shown one by one."""

    def __init__(self, sweep: Sweep, directory: Path):
        self.links: list[str] = []
        self.thumbs: list[dict[str, str]] = []
        self.runs: list[tuple[str, Result]] = []
        self.origin = ""
        self.unread: list[str] = []
        for name in _shown(sweep):
            self.links.append("")
            if name:
                self._look_at(name, sweep.directory, directory)

    def _look_at(self, name: str, place: Path, directory: Path) -> None:
        if not (place / name / "result.json").exists():
            return  # the table was sent alone
        try:
            run = Result(place / name)
        except Error as error:
            self.unread.append(str(error).splitlines()[0])
            return  # its row stays without a page
        self.unread += [f"{name}: {note}" for note in run.notes]
        page = run.directory / "report.html"
        if _wants_page(run.directory) and directory in (place, place.parent):  # a page elsewhere writes nothing into the sweep
            write_run_page(run, kinds=("png",))
        link = Path(os.path.relpath(page, directory)).as_posix() if page.exists() else ""
        self.links[-1] = link
        self.origin = self.origin or run.text("surface.origin")
        self.runs.append((name, run))
        state = run.fields.get("relaxed")
        if state is not None and "contact" in state:
            picture = io.BytesIO()
            matplotlib.image.imsave(picture, state["contact"] > 0, cmap=CONTACT, vmin=0, vmax=1, origin="lower",
                                    format="png")
            self.thumbs.append({"png": base64.b64encode(picture.getvalue()).decode(), "caption": name, "link": link})


def _shown(sweep: Sweep) -> list[str]:
    """Returns the directory of the shown point for each line of the table, or ""."""
    names = []
    for line, (_, places) in enumerate(sweep.table.groups):
        done = [p for i in places if (p := sweep.points[i]).get("status") == DONE and p.get("directory")]
        names.append(str(done[0]["directory"]) if done and line < MOST_POINTS else "")
    return names


def _wants_page(directory: Path) -> bool:
    """Returns True if the page of a point is missing or older than its result."""
    page = directory / "report.html"
    return not page.exists() or page.stat().st_mtime < (directory / "result.json").stat().st_mtime


def _require_free(directory: Path, sweeps: list[Sweep], kinds: tuple[str, ...]) -> None:
    """Checks that the page and the pages of the points would replace no file. Raises SceneError with the existing files."""
    curves = ["curves", *(f"curves-{file_name(s.name)}" for s in sweeps if len(sweeps) > 1)]
    names = {directory: page_files([*plots.names(sweeps), *curves], kinds)}
    own = [sweep for sweep in sweeps if directory in (sweep.directory, sweep.directory.parent)]
    for place in (sweep.directory / name for sweep in own for name in _shown(sweep) if name):
        if (place / "result.json").exists() and _wants_page(place):
            with contextlib.suppress(Error):  # a point that cannot be read stays without a page
                names[place] = run_page_files(Result(place).fields, ("png",))
    store.require_free(names)


def _force_curves(points: _Points, ax: Axes) -> bool:
    """Draws the force curves of several points in one plot, spread evenly over them."""
    runs = [(n, r) for n, r in points.runs
            if {"segment", "mean_height", "force"} <= set(r.series) and len(r.series["segment"]) > 1]
    ways = {"pull-off": "-", "approach": DASHES[4]}
    runs = [(n, r) for n, r in runs if ways.keys() & set(r.segment_names)]
    if len(runs) < 2:
        return False
    few = min(len(runs), MOST_CURVES)
    drawn_ways: dict[str, str] = {}
    for k in range(few):
        name, run = runs[k * (len(runs) - 1) // (few - 1)]
        drawn_ways |= {words: ways[words] for words in run.segment_names if words in ways}
        first = "pull-off" if "pull-off" in run.segment_names else "approach"
        unit, label = run_plots.force_unit(run)
        for segment, words in enumerate(run.segment_names):
            here = run.series["segment"] == segment
            if here.sum() > 1 and words in ways:
                curve(ax, run.series["mean_height"][here], run.series["force"][here] / unit,
                      name if words == first else "", colour=COLOURS[k], line=ways[words])
    for words, line in drawn_ways.items():
        ax.plot([], [], color=GREY, linestyle=line, label=words)
    felt = [h for _, r in runs for h in r.series["mean_height"][
        np.abs(r.series["force"]) > 1e-3 * np.abs(r.series["force"]).max()]]
    if felt:
        ax.set_xlim(min(felt), max(felt))
    return finish(ax, "mean height above the apex (Å)" if runs[0][1].curved else "mean separation (Å)", label)


def _half_way(table: Table, column: str) -> float | None:
    """Returns the roughness at which a quantity, averaged over seeds, has fallen to half, interpolated between points."""
    means = table.average(table.column(column)).mean
    points = sorted((x, y) for x, y in zip(table.at("surface.rms"), means) if np.isfinite(y))
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if y0 >= 0.5 > y1:
            return x0 + (x1 - x0) * (y0 - 0.5) / (y0 - y1)
    return None


def key_numbers(sweep: Sweep) -> list[KeyNumber]:
    """Returns the key numbers of a sweep over roughness alone."""
    table, curves = sweep.table, sweep.curves
    if [k for k in sweep.axes if not is_seed(k)] != ["surface.rms"] or not table.along:
        return []
    wanted = [("rms where the binding energy is half of Δγ", "binding_energy_ratio", "gamma_eff_ratio"),
              ("rms where half of the area is in contact", "contact_fraction", "contact_fraction")]
    if "contact_radius.relaxed" in table:
        wanted = [("rms where γ by JKR, way out, is half of Δγ", "jkr.pull_off_ratio", "gamma_eff_ratio")]
    found = []
    for name, simulated, theory in wanted:
        measured = _half_way(table, simulated) if sweep.simulated else None
        lines = {"theory": "persson." + theory, "renormalised": "renormalised." + theory}
        expected = {words: x for words, column in lines.items()
                    if (x := _half_way(curves, "theory." + column)) is not None}
        if measured is not None:
            note = ", ".join(f"{words}: {number(x, 2)} Å" for words, x in expected.items())
            found.append(KeyNumber(number(measured, 2), "Å", name, note))
        elif expected:
            words, x = next(iter(expected.items()))
            found.append(KeyNumber(number(x, 2), "Å", name, words))
    return found


def _lead(sweeps: list[Sweep]) -> str:
    parts = []
    for sweep in sweeps:
        axes = []
        for key in sweep.axes:
            values = list(dict.fromkeys(shown(p["set"].get(key)) for p in sweep.points))
            axes.append(f"{key} ({values[0]} to {values[-1]})" if values else key)
        parts.append(f"{sweep.name}: " * (len(sweeps) > 1) + f"{len(sweep.points)} points over {', '.join(axes)}.")
    return " ".join(parts)


def _notices(page: Page, sweep: Sweep) -> None:
    page.notices += [(f"{point.get('directory', '')} failed", Values(point).text("failure.reason"))
                     for point in sweep.points if point.get("status") == FAILED]
    waiting = sweep.table.status.count("waiting") if sweep.simulated else 0
    if waiting:
        page.notices.append(("This sweep is not finished", f"{waiting} of {len(sweep.points)} points of {sweep.name} "
                             "have no result yet; the same `asperity sweep` command goes on with them."))


def _table(page: Page, sweep: Sweep, points: _Points, several: bool) -> None:
    heads, rows, meaning = text_of(sweep.table)
    stride = max(1, (len(rows) + 39) // 40)
    page.section("points-" + file_name(sweep.name), f"The points of {sweep.name}" if several else "All points")
    page.table(heads, [[minus(cell) for cell in row] for row in rows[::stride]], points.links[::stride])
    if meaning:
        page.add("paragraph", f"In the table: {meaning}.")
    if stride > 1:
        page.add("paragraph", f"Every {stride}th of {len(rows)} lines; all are in sweep.csv.")
    page.add("thumbs", points.thumbs)
    if points.origin:
        page.add("paragraph", f"Measured surface: {points.origin}.")


def write_sweep_page(directory: Path, kinds: tuple[str, ...] = KINDS, out: Path | None = None) -> Page:
    """Writes DIR/report.html of a sweep, and the pages of its points."""
    sweeps, out = load_sweeps(directory), out or directory
    _require_free(out, sweeps, kinds)
    page = Page(out, "Asperity report · sweep", ", ".join(s.name for s in sweeps), _lead(sweeps),
                kinds=kinds)
    points = [_Points(sweep, out) for sweep in sweeps]
    page.unread = [line for some in points for line in some.unread]
    for sweep in sweeps:
        _notices(page, sweep)
        page.add("numbers", key_numbers(sweep))
        for note in sweep.notes:
            page.add("paragraph", f"Note: {note}.")
    page.section("plots", "Over the swept keys")
    for name in plots.names(sweeps):
        page.figure(name, *FIGURES[name], partial(plots.plot, sweeps, name))
    for sweep, some in zip(sweeps, points):
        page.figure("curves" + f"-{file_name(sweep.name)}" * (len(sweeps) > 1), "Force and separation",
                    "Force over the mean separation at some of the points: full lines: pull-off, dotted lines: approach.",
                    partial(_force_curves, some))
    note = plots.parts_of(sweeps)[2]
    if note:
        page.add("paragraph", f"Note: {note}.")
    for sweep, some in zip(sweeps, points):
        if sweep.points:
            _table(page, sweep, some, len(sweeps) > 1)
    for sweep in sweeps[1:]:
        page.section("scene-" + file_name(sweep.name), f"The scene {sweep.name}")
        page.add("preformatted", toml_of(sweep.scene).strip())
    end(page, Values({"run": sweeps[0].run}),
        f"The scene {sweeps[0].name}" if len(sweeps) > 1 else "The scene that the points vary", sweeps[0].scene,
        "Every key with its value; a swept key has the first of its values.")
    page.write()
    return page


def write_page(directory: Path, kinds: tuple[str, ...] = KINDS, out: str | None = None) -> Page:
    """Writes DIR/report.html of a directory with an estimate, a sweep, sweeps of several scenes, or a run. Raises InputOutputError, SceneError."""
    place = store.named(out)
    own = kinds_in(directory)
    below = results_below(directory) if directory.is_dir() and not own else {}
    if len(own) > 1:
        raise SceneError(str(directory), f"holds {len(own)} results: " + " and ".join(RESULTS[file] for file in own),
                         f"{', '.join(own)} are in it, and a page is of one", "move the others to directories of their own")
    if own == [RESULT]:
        return write_estimate_page(load_estimate(directory), place)
    if own == ["sweep.json"] or below and all(files == ["sweep.json"] for files in below.values()):
        return write_sweep_page(directory, kinds, place)
    runs = {**below, **(results_below(directory) if own and own != ["result.json"] else {})}
    commands = [f"asperity report {shlex.quote(str(one))}" for one in runs][:LISTED] + ["..."] * (len(runs) > LISTED)
    if below:
        raise SceneError(str(directory), f"holds {len(below)} results, and a page is of one or of a sweep",
                         ", ".join(f"{one.relative_to(directory)} ({RESULTS[files[0]]})" for one, files in [*below.items()][:LISTED])
                         + ", ..." * (len(below) > LISTED), "name one of them:\n" + "\n".join(commands))
    if own and own != ["result.json"]:
        page = directory / "report.html"
        raise SceneError(str(directory), f"holds {RESULTS[own[0]]}, of which this command makes no page",
                         f"{own[0]} is in it, with what its own command has written" + f": its page is {page}" * page.exists(),
                         "name one of its runs:\n" + "\n".join(commands) if commands else "look at these files")
    expect(directory, "result.json")
    return write_run_page(Result(directory), kinds, place)
