# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Plots: what is drawn, in which units, and the files that are written."""

import io
from types import SimpleNamespace

import matplotlib.image
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import asperity
from asperity import units
from asperity.files import store
from asperity.plots import run as run_plots, style
from asperity.theories import combined
from conftest import SMALL


def axes():
    return Figure().add_subplot()


@pytest.mark.parametrize("rows, drawn", [(0, False), (1, False), (2, True)])
def test_a_curve_needs_two_rows_of_every_column(rows, drawn):
    run = SimpleNamespace(series={"force": np.arange(rows), "time": np.arange(rows)})
    assert bool(run_plots._columns(run, "force", "time")) == drawn
    assert not run_plots._columns(run, "force", "no such column")


def test_forces_of_flat_solids_are_stresses(path_run):
    ax = path_run.plot.separation(axes())
    curves = {c.label: c for c in style.drawn(ax).curves}
    assert set(curves) == {"approach", "pull-off"}
    segment, force = path_run.series["segment"], path_run.series["force"]
    # eV/Å over Å² in GPa: 1 eV/Å^3 = 160.2176634 GPa
    assert curves["pull-off"].y == pytest.approx(force[segment == 1] / path_run.edge**2 * 160.2176634)
    assert (curves["approach"].x == path_run.series["mean_height"][segment == 0]).all()
    assert "GPa" in ax.get_ylabel()
    felt = path_run.series["mean_height"][abs(force) > 0.01 * abs(force.min())]
    low, high = ax.get_xlim()
    assert low < felt.min() and high > felt.max()
    # The way through empty space is cut off.
    assert high - low < 1.09 * np.ptp(path_run.series["mean_height"][abs(force) > 1e-3 * abs(force.min())])


def test_forces_of_spheres_are_forces(sphere_run):
    ax = sphere_run.plot.separation(axes())
    assert ax.get_xlabel() == "mean height above the apex (nm)"
    way = sphere_run.series["top_displacement"]
    drawn = style.drawn(sphere_run.plot.loading(axes())).curves
    assert max(c.x.max() for c in drawn) == pytest.approx(0.1 * way.max())
    curves = {c.label: c for c in style.drawn(ax).curves}
    force = sphere_run.series["force"][sphere_run.series["segment"] == 0]
    assert curves["approach"].y == pytest.approx(force * 1.602176634)  # 1 eV/Å = 1.602176634 nN
    assert "nN" in ax.get_ylabel()


def test_energies_are_per_area(path_run):
    curves = {c.label: c for c in style.drawn(path_run.plot.energy(axes())).curves}
    assert curves["interface"].y == pytest.approx(1e3 * path_run.series["interface_energy"] / path_run.edge**2)


def test_the_theory_over_roughness_meets_the_runs_own(path_run):
    ax = path_run.plot.roughness(axes())
    theory = next(c for c in style.drawn(ax).curves if c.label == "Persson’s theory")
    at_own = np.interp(path_run.surface.rms, theory.x, theory.y)
    assert at_own == pytest.approx(path_run.theory.persson.gamma_eff / path_run.delta_gamma, abs=1e-3)
    assert theory.x[-1] == pytest.approx(1.8 * path_run.surface.rms)


def test_each_theory_is_over_its_own_reference(state_run):
    """Persson's Δγ can be given; the renormalised theory has that of the flat surfaces."""
    run = asperity.run({**state_run["scene"], "name": "given"}, {"theory.delta_gamma": 130.0, "drive.load": 100},
                       out=state_run.directory.with_name("given"))
    curves = {c.label: c for c in style.drawn(run.plot.roughness(axes())).curves}
    for label, ratio in (("Persson’s theory", run.theory.persson.gamma_eff / 130),
                         ("renormalised theory", combined.of_run(run).number("theory.renormalised.gamma_eff_ratio"))):
        curve = curves[label + " under a load of 100 MPa"]
        assert np.interp(run.surface.rms, curve.x, curve.y) == pytest.approx(ratio, abs=2e-3)
    assert curves["binding energy under a load of 100 MPa"].y == pytest.approx(run.binding_energy / run.delta_gamma)


def test_distributions_are_normalised(path_run):
    state = path_run.fields["relaxed"]
    one = style.drawn(path_run.plot.pressures(axes())).curves[0]
    y = np.nan_to_num(one.y)
    fraction = np.sum(y[::2] * (one.x[1::2] - one.x[::2]))
    assert fraction == pytest.approx(np.mean(state.pressure != 0), rel=1e-9)


def test_maps_are_seen_from_above(path_run):
    ax = path_run.plot.map("gap", axes())
    shown = ax.images[0]
    assert shown.origin == "lower" and (shown.get_array() == path_run.fields["relaxed"].gap).all()
    assert shown.get_extent() == pytest.approx([0, 8.32, 0, 8.32])  # nm


def test_what_is_not_there_is_a_message(state_run):
    with pytest.raises(asperity.InputOutputError, match="separation"):
        state_run.plot.separation(axes())
    with pytest.raises(asperity.UnknownName, match="has no state 'pull-off'\n.*it has relaxed"):
        state_run.plot.map("gap", axes(), state="pull-off")
    with pytest.raises(AttributeError, match="separation"):
        state_run.plot.sepration


def luminance(colour):
    r, g, b = (int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5))
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


@pytest.mark.parametrize("name", ["separation", "contact", "energy", "spectrum", "roughness"])
def test_curves_can_be_told_apart_in_grey(path_run, name):
    """No two curves of a plot share dashes, marker and brightness."""
    ax = getattr(path_run.plot, name)(axes())
    looks = []
    for line in ax.lines:
        if line.get_label().startswith("_"):
            continue
        # matplotlib keeps the pattern of dashes in a private name
        looks.append((str(line._unscaled_dash_pattern), line.get_marker(), round(luminance(line.get_color()), 1)))
    assert len(looks) > 1 and len(set(looks)) == len(looks), looks


def test_files_hold_the_curves(path_run, tmp_path):
    fig = style.make(lambda ax: run_plots.separation(path_run, ax))
    names = style.files_of("separation")
    assert names == ["separation.png", "separation.pdf", "separation.svg"]
    with store.outputs(tmp_path, names) as out:
        style.save(fig, out, "separation")
    written = [tmp_path / name for name in names]
    picture = matplotlib.image.imread(written[0])
    assert picture.shape[1] > 800 and picture[..., :3].std() > 0.05
    assert written[1].read_bytes().startswith(b"%PDF-") and b"/Subtype /Image" not in written[1].read_bytes()  # vectors
    assert b"<path" in written[2].read_bytes()
    text = style.csv(fig)
    table = np.genfromtxt(io.StringIO(text), delimiter=",", skip_header=1)
    segment = path_run.series["segment"]
    approach = table[:, 1][np.isfinite(table[:, 1])]
    stress = path_run.series["force"][segment == 0] / path_run.edge**2 / units.GIGAPASCAL
    assert approach == pytest.approx(stress, rel=1e-8)
    assert text.startswith("mean separation (Å),approach: mean stress F/A_0 (GPa)")
    # In a page: without a size of its own, the date or the colours of paper.
    inline = style.inline_svg(fig)
    assert inline.startswith("<svg") and "<metadata" not in inline
    assert " width=" not in inline.split(">")[0] and "var(--ink)" in inline
    fig = style.make(lambda ax: run_plots.map_of(path_run, path_run.fields["relaxed"], "gap", ax))
    assert np.genfromtxt(io.StringIO(style.csv(fig)), delimiter=",").shape == (32, 32)


def test_points_carry_their_uncertainty():
    from asperity.plots.sweep import SIMULATED
    from asperity.studies.tables import Table

    approach = SIMULATED["gamma"][2][0]

    def average(*results):
        return approach.average(Table(["surface.rms", "surface.seed"], [
            {"set": {"surface.rms": 1.0, "surface.seed": i}, "theory": {}, "status": "done", "result": r}
            for i, r in enumerate(results)], True))
    energy, ratio = "work_of_interface.approach", "work_of_interface.approach_ratio"
    uncertainty = "work_of_interface.uncertainty.approach"
    one = {energy: 50.0, ratio: 0.5, uncertainty: 3.0}
    assert average(one) == pytest.approx((0.5, 0.03))
    spread = 0.04 / np.sqrt(2)  # of two, a deviation of 0.04
    two = [{energy: 100 * r, ratio: r, uncertainty: 6.0 * r} for r in (0.5 - spread, 0.5 + spread)]
    assert average(*two) == pytest.approx((0.5, 0.05))  # with 0.03
    bare = [{ratio: 0.5 - spread}, {ratio: 0.5 + spread}]
    assert average(*bare) == pytest.approx((0.5, 0.04))
    assert np.isnan(average(bare[0])[1]).all()


def inside(fig):
    """Whether all that is written in a figure stands in it, and beside its curves."""
    canvas = FigureCanvasAgg(fig)
    canvas.draw()
    box, page = fig.get_tightbbox(canvas.get_renderer()), fig.get_size_inches()
    return box.x0 >= 0 and box.y0 >= 0 and box.x1 <= page[0] + 0.05 and box.y1 <= page[1]


def covered(fig):
    """Points of curves that lie under the legend."""
    legend = fig.axes[0].get_legend()
    if legend is None:
        return 0
    box = legend.get_window_extent(fig.canvas.get_renderer())
    return sum(int(box.contains(x, y)) for line in fig.axes[0].lines if len(line.get_xdata()) > 2
               for x, y in line.get_transform().transform(line.get_xydata()))


@pytest.mark.parametrize("name", sorted(run_plots.OF_RUN))
def test_labels_are_whole_and_legends_cover_nothing(path_run, name):
    fig = style.make(lambda ax: run_plots.OF_RUN[name](path_run, ax))
    if fig is None:
        assert name in ("friction", "sliding")
        return
    assert inside(fig), f"{name}: {fig.get_tightbbox()}"


def test_the_legend_of_the_energies_covers_no_curve(path_run):
    """Also where the curves fill the frame."""
    run = asperity.load(path_run.directory)
    for i, name in enumerate(("interface_energy", "work", "damped")):
        size = abs(path_run.series["interface_energy"]).max()
        run.series._read[name] = size * np.sin(2.0 * np.pi * i / 3 + np.arange(len(run.series["time"])))
    fig = style.make(lambda ax: run_plots.energy(run, ax))
    assert inside(fig) and not covered(fig)


def test_the_legend_of_a_sphere_covers_no_curve(sphere_run):
    fig = style.make(lambda ax: run_plots.separation(sphere_run, ax))
    assert len(fig.axes[0].get_legend().get_texts()) > 4
    assert inside(fig) and not covered(fig)


def test_a_large_error_of_the_balance_has_a_whole_label(path_run):
    run = asperity.load(path_run.directory)
    run.series._read["balance_error"] = -1234.5 * np.ones(len(run.series["time"]))
    assert inside(style.make(lambda ax: run_plots.balance(run, ax)))
    run.series._read["balance_error"] = 0.0123 * np.ones(len(run.series["time"]))
    ax = run.plot.balance(axes())
    assert style.drawn(ax).curves[0].y == pytest.approx(12.3) and "10^{-3}" in ax.get_ylabel()


def right_axis(ax):
    return next(child for child in ax.child_axes if child.yaxis.get_label_position() == "right")


def test_energies_over_an_area_have_a_second_axis_in_millijoules(path_run, sphere_run):
    for name, unit in (("energy", 16.02176634), ("roughness", 16.02176634 * path_run.delta_gamma)):
        ax = getattr(path_run.plot, name)(axes())
        FigureCanvasAgg(ax.figure).draw()
        right = right_axis(ax)
        assert "mJ/m²" in right.get_ylabel()
        assert right.get_ylim() == pytest.approx([unit * y for y in ax.get_ylim()])
        assert not sphere_run.plot.energy(axes()).child_axes  # eV


def test_stresses_have_a_unit_of_their_size(path_run):
    run = asperity.load(path_run.directory)
    for factor, unit in ((1.0, "GPa"), (1e-3, "MPa"), (1e-6, "kPa")):
        run.series._read["force"] = path_run.series["force"] * factor
        ax = run.plot.separation(axes())
        assert f"({unit})" in ax.get_ylabel()
        assert 0.05 < max(abs(c.y).max() for c in style.drawn(ax).curves) < 1e3


def test_what_the_captions_claim_is_true(path_run):
    """∫F dz of a curve is the work of the interface; the area of a quasi-static loop is what is lost."""
    run = asperity.run(SMALL, {"output.series": 2}, out=path_run.directory.with_name("dense"))
    segment, force, height = (run.series[n] for n in ("segment", "force", "mean_height"))
    for number, way in enumerate(("approach", "pull_off")):
        here = segment == number
        z, f = height[here], force[here]
        work = np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(z))
        assert 1e3 * work / run.edge**2 == pytest.approx(run.work_of_interface[way], rel=0.03)
    run = asperity.run({"name": "loop", "surface": {"sites": 32, "rms": 0.8}, "block": {"thickness": 128},
                        "drive": {"mode": "quasistatic", "displacement_step": 0.1}},
                       out=path_run.directory.with_name("loop"))
    x, y = run.series["top_displacement"], run.series["top_force"]
    loop = np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(x))
    assert abs(1e3 * loop / run.edge**2) == pytest.approx(run.lost.cycle, rel=0.03) and run.lost.cycle > 1.0


def test_times_have_a_unit_of_their_size(path_run):
    run = asperity.load(path_run.directory)
    for factor, unit in ((1.0, "ps"), (1e3, "ns"), (1e6, "µs")):
        run.series._read["time"] = path_run.series["time"] * factor
        for name in ("energy", "balance"):
            ax = getattr(run.plot, name)(axes())
            assert ax.get_xlabel() == f"time ({unit})"
            assert style.drawn(ax).curves[0].x[-1] == pytest.approx(path_run.series["time"][-1])


def test_fractions_have_no_ticks_above_one(path_run):
    ax = axes()
    ax.plot([0, 1], [0, 1], label="whole")
    style.finish(ax, "x", "fraction", legend="above", most=1)
    ticks = [*ax.get_yticks(), *ax.get_yticks(minor=True)]
    assert ax.get_ylim()[1] > 1.05 and max(ticks) == pytest.approx(1.0)


def test_the_way_through_empty_space_is_left_out_of_the_contact(path_run):
    run = asperity.load(path_run.directory)
    far = path_run.series["contact_fraction"] == 0
    run.series._read["top_displacement"] = path_run.series["top_displacement"] + 1000.0 * far
    low, high = run.plot.contact(axes()).get_xlim()
    touching = run.series["top_displacement"][~far]
    assert low < touching.min() and touching.max() < high < 900.0


def test_segments_of_a_path_are_told_apart():
    """Each segment is a curve of its own points: ways in their colours, other segments in the other colours in turn, named once;
    what a script led is grey; one point is no curve."""
    names = ["hold 1 ps", "approach", "pull-off", "slide", "hold 1 ps", "relax"]
    number = np.array([0, 0, 1, 1, 2, 2, 2, 3, 3, 4, 4, 5, -1, -1])
    x = np.arange(14.0)
    ax = axes()
    run = SimpleNamespace(segment_names=names, series={"segment": number})
    assert run_plots._by_segment(ax, run, x, -x, ", in contact", ("-", ":"))
    found = [(curve.label, line.get_color(), curve.x.tolist()) for curve, line in zip(style.drawn(ax).curves, ax.lines)]
    first, second, third = (run_plots.OTHERS[i % len(run_plots.OTHERS)] for i in (1, 2, 3))
    assert found == [("hold 1 ps, in contact", first, [0, 1]), ("approach, in contact", style.BLUE, [2, 3]),
                     ("pull-off, in contact", style.RED, [4, 5, 6]), ("slide, in contact", second, [7, 8]), ("", third, [9, 10]),
                     (run_plots.BY_HAND + ", in contact", style.GREY, [12, 13])]
    assert [line.get_linestyle() for line in ax.lines[:3]] == ["-", "-", ":"]
    assert not run_plots._by_segment(ax, SimpleNamespace(segment_names=["relax"], series={"segment": np.zeros(1)}), x[:1], x[:1], "")
