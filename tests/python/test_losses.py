# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The books of quasi-static paths: work of the drive = stored + lost + dissipated in the block, in every segment and over a
cycle, and every place that shows one loss shows the others."""

import json
import math
import os
import shutil

import matplotlib.pyplot as plt
import pytest

import asperity
from asperity.plots import sweep as sweep_plots
from asperity.reports import run as report, sentences
from asperity.results.losses import losses
from asperity.studies import quantities, tables
from conftest import command, unsealed

pytestmark = pytest.mark.usefixtures("light_module")

ATOMS = {"surface": {"sites": 12, "rms": 0.4}, "block": {"young": 20.0, "poisson": 0.3, "thickness": 30},
         "drive": {"mode": "quasistatic", "velocity": 1.0}}
WALL = {"surface": {"sites": 12, "spacing": "1 nm", "rms": "0.5 nm"}, "block": {"young": "20 MPa", "poisson": 0.49},
        "interface": {"kind": "wall", "adhesion": "30 mJ/m^2", "range": "1 nm"},
        "drive": {"mode": "quasistatic", "velocity": 0.1, "displacement_step": "0.2 nm"}}
RELAXING = {"atoms": [[3.0, 50.0], [1.5, 1000.0]], "wall": [[9.0, "10 ns"]]}
PATHS = {"cycle": ["approach", "pull-off"], "rest": ["approach", "hold 2 ns", "pull-off"], "in contact": ["approach"],
         "while it rests": ["approach", "hold 0.2 ns"], "two cycles": ["approach", "pull-off"] * 2,
         "loads": ["approach", "load 3 MPa", "load -1 MPa", "hold 1 ns", "pull-off"]}


def terms(of):
    """stored, lost, and dissipated in the block; that of an elastic block is none."""
    return of["stored"] + of["lost"] + of.get("dissipated_in_block", 0.0)


CONTROLS, BLOCKS = ("top", "mean-height"), (("atoms", True), ("atoms", False), ("wall", True), ("wall", False))
CLOSED = [(kind, relaxes, CONTROLS[control], path) for i, (kind, relaxes) in enumerate(BLOCKS) for control in (0, 1)
          for k, path in enumerate(PATHS) if os.environ.get("ASPERITY_LONG") or (i + control + k) % 2 == 0]
"""Every path of every block, under one of the controls in turn."""


@pytest.mark.parametrize("kind, relaxes, control, path", CLOSED)
def test_the_books_of_a_path_close(place, kind, relaxes, control, path):
    steps = [s for s in PATHS[path] if relaxes or not s.startswith("hold")]
    if kind == "atoms":
        steps = [s.replace("3 MPa", "300 MPa").replace("-1 MPa", "-20 MPa") for s in steps]
    scene = json.loads(json.dumps({"atoms": ATOMS, "wall": WALL}[kind]))
    scene["drive"] |= {"control": control, "path": steps}
    if relaxes:
        scene["block"]["prony"] = RELAXING[kind]
    else:
        del scene["drive"]["velocity"]
    run = asperity.run(scene, out="run")
    lines = json.loads((run.directory / "result.json").read_text())["segments"]
    assert [line["name"] for line in lines] == steps
    largest = max(abs(line[key]) for line in lines for key in ("work_of_drive", "stored"))
    for line in lines:
        assert ("dissipated_in_block" in line) == relaxes
        gap = abs(line["work_of_drive"] - terms(line))
        assert gap <= 1e-3 * largest and gap <= 1.01 * line["uncertainty"] + 1e-9 * largest, line
    if "pull-off" in steps:  # the last cycle
        first = max((i + 1 for i, s in enumerate(steps[:-1]) if s == "pull-off" and "approach" in steps[i:]), default=0)
        last = len(steps) - steps[::-1].index("pull-off")
        work = sum(line["work_of_drive"] for line in lines[first:last])
        assert work == pytest.approx(run.lost.cycle + (run.dissipated_in_block.cycle if relaxes else 0.0),
                                     abs=1e-3 * largest)
        # The solids are at rest apart.
        assert sum(line["stored"] for line in lines[first:last]) == pytest.approx(0.0, abs=1e-4 * largest)
    if path == "cycle":  # the names of the two segments
        for line, way in zip(lines, ("approach", "pull_off"), strict=True):
            for key in ("work_of_drive", "stored", "lost") + ("dissipated_in_block",) * relaxes:
                assert run.number(f"{key}.{way}") == line[key]


def with_another_loss(place, run):
    """A copy of a run whose engine has one loss more, of the sites: its names are those of the loss of the block."""
    file, renamed = run.directory / "result.json", ("dissipated_in_block", "dissipated_in_sites")
    def more(node):
        if not isinstance(node, dict):
            return [more(one) for one in node] if isinstance(node, list) else node
        new = {key: more(value) for key, value in node.items()}
        return new | {renamed[1]: new[renamed[0]]} if renamed[0] in new else new
    shutil.copytree(run.directory, place)
    (place / "result.json").write_text(json.dumps(more({k: v for k, v in json.loads(file.read_text()).items() if k != "digest"})))
    with unsealed(place / "run.h5") as run_h5:
        run_h5["series"].copy(renamed[0], run_h5["series"], renamed[1])
    return asperity.load(place)


def test_a_further_loss_is_wherever_losses_are(rubber, tmp_path):
    place, scene = rubber
    run = with_another_loss(tmp_path / "run", asperity.run(scene, out=tmp_path / "one"))
    assert losses(run) == losses(run.series) == {"block": "dissipated_in_block", "sites": "dissipated_in_sites"}
    assert {q.path for q in quantities.quantities_of(run, False)} >= {name + ".cycle" for name in losses(run).values()}
    page = report.write_run_page(run, ())
    assert page is not None
    html = (run.directory / "report.html").read_text()
    _, axes = plt.subplots()
    assert run.plot.energy(axes)
    drawn = {text.get_text() for text in axes.get_legend().get_texts()}
    point = {"set": {"drive.velocity": 1.0}, "theory": {}, "status": tables.DONE, "result": tables.columns_of(run)}
    table = tables.Table(["drive.velocity"], [point], True)
    heads, traces = tables.text_of(table)[0], sweep_plots.losses_of([table])
    for where in losses(run):
        assert f"dissipated in the {where}" in html and f" + dissipated in the {where}" in html
        assert f"dissipated in the {where}" in drawn
        assert f"in the {where}{tables.BOTH}" in heads
        assert f"in the {where}, cycle" in {trace.label for trace in traces}


@pytest.fixture(scope="module")
def rubber(tmp_path_factory):
    """A block that is still stretched when the solids come apart."""
    scene = json.loads(json.dumps(ATOMS))
    scene["surface"] = {"sites": 12, "kind": "flat"}
    scene["block"]["prony"] = RELAXING["atoms"]
    scene["drive"] |= {"control": "top", "path": ["approach", "hold 0.2 ns", "pull-off"]}
    return tmp_path_factory.mktemp("rubber"), scene


def test_every_page_has_all_losses(rubber):
    place, scene = rubber
    run = asperity.run(scene, out=place / "run")
    assert run.dissipated_in_block.cycle > 10.0 and run.lost.cycle > 10.0
    words = sentences.results(run)
    shown = {name: f"{run.number(name + '.cycle'):.2f}" for name in ("lost", "dissipated_in_block")}
    for value in shown.values():
        assert any(value in sentence for sentence in words), (value, words)
    numbers = {n.name: n.value for n in sentences.key_numbers(run)}
    assert numbers["energy lost in a cycle"].startswith(f"{run.lost.cycle:.2f} (")
    assert numbers["dissipated in the block in a cycle"].startswith(f"{run.dissipated_in_block.cycle:.2f} (")
    page = report.write_run_page(run, ())
    assert page is not None
    html = (place / "run" / "report.html").read_text()
    for text in ("dissipated in the block", "stored"):
        assert f"<th>{text}" in html or f">{text}" in html, text
    values = [f"{section}.{key}={json.dumps(value)}" for section, keys in scene.items() for key, value in keys.items()]
    (place / "scene.toml").write_text("")
    said = command("run", place / "scene.toml", "--set", *values, "--progress", "off", "--out", place / "said")
    for key in ("lost", "dissipated_in_block", "stored"):
        for way in ("approach", "pull_off", "cycle"):
            value = run.number(f"{key}.{way}")
            assert (value is None) == ((key, way) == ("stored", "cycle"))
            assert value is None or f"{value:.2f}" in said, (key, way)


@pytest.mark.parametrize("stiffness", ["none", 100.0])
def test_a_spring_has_its_own_line_in_the_books_of_a_path_in_time(place, stiffness):
    # The top plane, released by the jump out of contact, oscillates on the spring: its energy is no motion of the block.
    run = asperity.run({"surface": {"sites": 12, "rms": 0.5}, "block": {"thickness": 12},
                        "drive": {"velocity": 20.0, "timestep": 15.0, "stiffness": stiffness}, "output": {"series": 1}}, out="run")
    found = json.loads((run.directory / "result.json").read_text())
    lines, sprung = found["segments"], stiffness != "none"
    left = [line["kinetic"] + line.get("spring", 0.0) for line in lines]
    works = [line["work_of_drive"] - line["lost"] for line in lines]
    state = found["binding_energy"]
    assert works[0] == pytest.approx(left[0] - state, abs=1e-3 * state)
    assert works[1] == pytest.approx(left[1] - left[0] + state, abs=1e-3 * state)
    assert found["lost"]["cycle"] == pytest.approx(sum(line["work_of_drive"] for line in lines), abs=1e-3 * state)
    assert [("spring" in line) for line in lines] == [sprung, sprung] and ("spring" in found) == sprung
    if sprung:  # the last step is the end of the path
        assert lines[1]["spring"] * (12 * 2.6) ** 2 / 1000 == pytest.approx(found["energy"]["spring"], rel=1e-9)


@pytest.mark.parametrize("wide", [0.8, 3.0])
def test_works_of_a_soft_box_are_said_to_be_its_own(place, wide):
    # Nearly flat surfaces at a held mean height jump in boxes wider than pi E* rho^2 / w.
    stiff, work, rho = 30e6 / (1 - 0.22**2), 37e-3, 1.5e-9
    widest = math.pi * stiff * rho**2 / work
    scene = {"surface": {"sites": 20, "spacing": f"{wide * widest / 20 * 1e9} nm", "rms": 0.05, "rolloff": 1, "q_max": 4},
             "block": {"young": "30 MPa", "poisson": 0.22},
             "interface": {"kind": "wall", "adhesion": "37 mJ/m^2", "range": "1.5 nm"},
             "drive": {"mode": "quasistatic", "control": "mean-height", "displacement_step": "0.05 nm"}}
    said = [note for note in asperity.check(scene).notes if "flat surfaces jump" in note]
    run = asperity.run(scene, out="run")
    told = " ".join(sentences.results(run))
    assert bool(said) == ("those of a box" in told) == (run.number("box.softness") is not None) == (wide > 1)
    loss = run.lost.cycle / run.delta_gamma
    if wide < 1:
        assert loss < 1e-4
        return
    assert run.number("box.softness") == pytest.approx(wide, rel=0.02)
    assert run.number("box.flat_loss") / run.delta_gamma == pytest.approx(loss, abs=0.015)
    assert f"wider than {widest * 1e10:.2g}"[:13] in said[0]
    scene["drive"]["path"] = ["relax"]
    assert not [note for note in asperity.check(scene).notes if "flat surfaces jump" in note]


@pytest.mark.parametrize("hardness", ["none", "2 GPa"])
@pytest.mark.parametrize("load", [1.0, 10.0, 80.0])
def test_an_uncertainty_without_attraction_is_small_beside_its_work(place, load, hardness):
    """Nothing is lost, and the errors of the points between the ends cancel."""
    scene = {"surface": {"sites": 96, "spacing": 1.0, "rms": 0.2, "rolloff": 3, "q_max": 24}, "block": {"young": 10, "poisson": 0.3},
             "interface": {"kind": "wall", "adhesion": 0, "hardness": hardness},
             "drive": {"mode": "quasistatic", "path": [f"load {load} MPa", f"load {10 * load} MPa", "pull-off"]}}
    run = asperity.run(scene, out=f"run-{load}-{hardness[:2]}")
    for segment in run.segments:
        assert 0 < segment.number("uncertainty") < 1e-3 * abs(segment.number("work_of_drive")), segment
    if hardness == "none":
        error = sum(segment.number("uncertainty") for segment in run.segments)
        assert abs(sum(segment.number("work_of_drive") for segment in run.segments)) <= error


def test_each_area_and_radius_over_a_wall_has_the_error_of_the_mesh(place):
    scene = {"surface": {"kind": "flat", "sites": 64, "spacing": "2 nm", "radius": "100 nm", "boundary": "free"},
             "block": {"young": "1 GPa", "poisson": 0.3}, "interface": {"kind": "wall", "adhesion": "50 mJ/m^2", "range": "2 nm"},
             "drive": {"mode": "quasistatic", "path": ["approach", "load 20 nN"], "displacement_step": "0.5 nm"}}
    run = asperity.run(scene, out="sphere")
    radius, area = run.number("contact_radius.relaxed"), run.contact_area
    assert radius == pytest.approx(run.edge * math.sqrt(area / math.pi), rel=1e-12) and 0 < area < run.contact_fraction
    assert run.number("contact_radius.uncertainty.relaxed") == pytest.approx(0.5 * radius * run.contact_area_uncertainty / area, rel=1e-9)
    for name in ("contact_radius", "contact_radius_uncertainty"):
        assert run.number(f"instrument.{name}") == pytest.approx(0.1 * run.number(
            f"contact_radius.{'uncertainty.' * ('unc' in name)}relaxed"), rel=1e-12)
    for segment in run.segments:
        assert 0 < segment.number("contact_area_uncertainty") < 0.2 * segment.number("contact_area")
    number = {one.name: one for one in sentences.key_numbers(run)}["contact radius"]
    assert number.unit == "nm" and "mesh: " in number.note
