# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The page of a run and of a sweep: what it says, that it stands alone, and what becomes of damaged results."""

import base64
import json
import re
import shutil
from html.parser import HTMLParser

import matplotlib.image
import numpy as np
import pytest

import asperity
from asperity.reports import sentences
from asperity.reports.page import Page
from asperity.reports.sweep import key_numbers, write_page
from asperity.results.result import Values
from asperity.theories import combined
from conftest import ROOT, SMALL, STATE, command, unsealed


class PageText(HTMLParser):
    """Text, links, sources, and the data of the read-outs of a page."""

    def __init__(self, path):
        super().__init__()
        self.text, self.links, self.data, self.tags, self.stack = "", [], [], [], []
        self.feed(path.read_text())
        self.text = re.sub(r"\s+", " ", self.text.replace("\u2060", "").replace("\u00a0", " "))

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.stack.append((tag, dict(attributes)))
        self.links += [v for k, v in attributes if k in ("href", "src", "xlink:href")]

    def handle_endtag(self, tag):
        while self.stack and self.stack.pop()[0] != tag:
            pass

    def handle_data(self, data):
        tag, attributes = self.stack[-1] if self.stack else ("", {})
        if attributes.get("type") == "application/json":
            self.data.append(json.loads(data))
        elif tag not in ("script", "style"):
            self.text += data


def page(directory, whole=False):
    """The report of a directory; whole: by the command, with all kinds of files."""
    if whole:
        assert "report.html: one page" in command("report", directory)
    else:
        write_page(directory, kinds=())
    return PageText(directory / "report.html")


def test_the_page_of_a_path(path_run):
    before = (path_run.directory / "result.json").read_bytes()
    found = page(path_run.directory, whole=True)
    for text in ("small: rms 0.5 Å, 32 × 32", "binding energy, state at zero load", "Persson’s theory", "Energy balance:",
                 "Not simulated", "Force and separation", "Energies", "Contact over the path", "The state at zero load",
                 "Distribution of gaps", "Distribution of pressure", "pull-off stress",
                 "Height of the substrate", "Roughness spectrum", "Binding energy and roughness", "All numbers",
                 "Time spent", "timestep = 20.0", "Provenance", "compiler", "machine", "arXiv:1112.5275"):
        assert text in found.text, text
    # Numbers are those of the result, to the digits that are shown.
    assert f"{path_run.binding_energy / path_run.delta_gamma:.4f}" in found.text
    assert f"−{-path_run.work_of_interface.pull_off:.2f} (" in found.text
    assert "Dynamic path at 100 m/s: approach, pull-off." in found.text
    # Nothing is fetched from anywhere.
    assert [v for v in found.links if not v.startswith(("#", "data:"))] == []
    assert found.tags.count("figure") == found.tags.count("svg") == len(found.data) == 13
    stems = {p.stem for p in (path_run.directory / "report").glob("*.csv")}
    assert len(stems) == 13
    for stem in stems:
        for kind in ("png", "pdf", "svg"):
            assert (path_run.directory / "report" / f"{stem}.{kind}").stat().st_size > 500
        picture = matplotlib.image.imread(path_run.directory / "report" / f"{stem}.png")
        assert picture[..., :3].std() > 0.02, f"{stem} is blank"
    assert (path_run.directory / "result.json").read_bytes() == before
    # The scene in the page is the scene.
    text = re.search(r"<pre>(.*?)</pre>", (path_run.directory / "report.html").read_text(), re.S)[1]
    scene = path_run.directory / "again.toml"
    scene.write_text(text.replace("&#34;", '"').replace("&quot;", '"'))
    assert asperity.running.program.check(str(scene))["scene"] == path_run.find("scene")


def test_values_can_be_read_by_pointing(path_run, light):
    found = page(path_run.directory)
    curves = [d for d in found.data if "curves" in d]
    maps = [d for d in found.data if "map" in d]
    assert len(curves) == 9 and len(maps) == 4
    force = dict(map(tuple, curves[0]["curves"]))  # force over separation comes first
    segment = path_run.series["segment"] == 1
    height, stress = path_run.series["mean_height"], path_run.series["force"] / path_run.edge**2 * 160.21766
    assert force["pull-off"][0] == pytest.approx([height[segment][0], stress[segment][0]], rel=1e-4)
    one = next(d["map"] for d in maps if "gap" in d["map"]["unit"])
    raw = np.frombuffer(base64.b64decode(one["values"]), "<u2").reshape(one["n"], one["n"])
    gap = path_run.fields["relaxed"].gap
    assert one["low"] + raw / 65534 * (one["high"] - one["low"]) == pytest.approx(gap, abs=2e-5 * np.ptp(gap))
    left, top, right, bottom = curves[0]["frame"]
    assert 0 < left < right <= 1 and 0 < top < bottom <= 1


def stored(tmp_path, path, load, full=20.0):
    """A result as a file alone, with a Δγ of its own for Persson's theory."""
    tmp_path.joinpath("result.json").write_text(json.dumps({
        "scene": {"surface": {"sites": 32, "spacing": 2.6}, "drive": {"path": path, "load": load}},
        "delta_gamma": 80.0, "binding_energy": 40.0, "contact_fraction": 0.5,
        "theory": {"persson": {"gamma_eff": 50.0, "delta_gamma": 100.0, "contact_fraction": 0.25,
                               "gamma_full_contact": full},
                   "renormalised": {"gamma_eff": 60.0}}}))
    return asperity.load(tmp_path)


@pytest.mark.parametrize("path, load, at, under", [
    (["relax"], 100.0, "under a load of 100 MPa", " under a load of 100 MPa"),
    (["relax"], 0.0, "at zero load", ""),
    (["approach", "pull-off"], -5.5, "at zero load", " under a load of −5.5 MPa")])  # the state carries none
def test_a_load_is_told_of_what_carries_it(tmp_path, path, load, at, under):
    run = stored(tmp_path, path, load)
    numbers = {n.name: n for n in sentences.key_numbers(run)}
    assert f"renormalised theory{under}" in numbers and numbers[f"contact area in theory{under}"].value == "25.0\u00a0%"
    theory, = sentences.results(run)
    assert theory.startswith(f"Persson’s theory{under} gives")
    assert theory.endswith(" mJ/m²)" + f" {at}" * bool(under) + ".")
    assert sentences.state_in_words(run, "relaxed") == at
    assert sentences.state_in_words(run, f"segment-{len(path) - 1}") == f"at the end of segment {len(path)}, “{path[-1]}”"


def test_full_contact_that_does_not_pay_is_no_binding_energy(tmp_path):
    assert "or 20.00 meV/Å² (320 mJ/m²) if the whole area were in contact" in sentences.results(stored(tmp_path, ["relax"], 0.0))[0]
    rough = sentences.results(stored(tmp_path, ["relax"], 0.0, full=-7000.0))[0]
    assert "full contact would store more elastic energy than adhesion gives" in rough and "7000" not in rough


def test_the_ratio_of_a_theory_is_over_its_own_energy(tmp_path, light):
    run = stored(tmp_path, ["approach", "pull-off"], 0.0)
    numbers = {n.name: n for n in sentences.key_numbers(run)}
    assert numbers["Persson’s theory"].value == "0.500" and numbers["renormalised theory"].value == "0.750"
    assert "50.00 meV/Å² (801 mJ/m²; 50.0\u00a0% of its Δγ, 100.00 meV/Å²)" in sentences.results(run)[0]
    assert "60.00 meV/Å² (961 mJ/m²; 75.0\u00a0% of Δγ)" in sentences.results(run)[0]
    rows = re.findall(r"<tr>(.*?)</tr>", (tmp_path / "report.html").read_text() if page(tmp_path) else "", re.S)
    rows = [re.findall(r"<td.*?>(.*?)</td>", row) for row in rows]
    over, joules = ({cells[0].split(":")[0]: cells[i] for cells in rows if len(cells) == 5} for i in (-1, -2))
    assert joules["binding_energy"] == "641" and joules["contact_fraction"] == ""
    assert over["theory.persson.gamma_full_contact"] == "0.2000" and over["theory.renormalised.gamma_eff"] == "0.7500"


def test_a_sphere_has_its_own_numbers_and_curves(sphere_run, light):
    found = page(sphere_run.directory)
    for text in ("R = 100 Å", "Maugis-Dugdale with images", "as a JKR sphere", "largest attraction, pull-off"):
        assert text in found.text, text
    labels = [label for d in found.data for label, _ in d.get("curves", [])]
    for name in ("JKR", "JKR with images", "Maugis-Dugdale with images"):
        assert f"theory: smooth sphere, {name}" in labels
    # The curve goes as deep as JKR's pull-off force, 3πγR/2.
    _, _, force = combined.sphere_curves(sphere_run, 1.0)[0]
    assert force.min() == pytest.approx(-1.5 * np.pi * sphere_run.delta_gamma * 1e-3 * 100, rel=1e-3)


def test_runs_that_failed_or_stopped_say_so_at_the_top(tmp_path, light):
    with pytest.raises(asperity.PhysicsError):
        asperity.run(SMALL, {"drive.timestep": 70, "drive.velocity": 200, "drive.load": 20000}, out=tmp_path / "failed")
    found = page(tmp_path / "failed")
    assert "This run failed" in found.text and "why:" in found.text
    assert found.text.index("This run failed") < found.text.index("Simulated")
    asperity.run(SMALL, {"drive.max_steps": 50}, out=tmp_path / "stopped")
    found = page(tmp_path / "stopped")
    assert "stopped early" in found.text and "max_steps" in found.text and "Not simulated" in found.text


def test_what_is_missing_or_damaged_is_left_out_and_told(path_run, tmp_path, light):
    bare, damaged, shaped = (tmp_path / n for n in ("a <b> & c", "damaged", "shaped"))
    for copy in (bare, damaged, shaped):
        shutil.copytree(path_run.directory, copy, ignore=shutil.ignore_patterns("report*", "export"))
    (bare / "run.h5").unlink()
    (bare / "result.json").write_text('{"delta_gamma": 1}')
    found = page(bare)
    assert "a <b> & c" in found.text and "<b>" not in (bare / "report.html").read_text()
    (damaged / "run.h5").write_text("nonsense")
    found = page(damaged)
    assert "it is not an HDF5 file" in found.text and "binding energy, state at zero load" in found.text
    with unsealed(shaped / "run.h5") as file:
        del file["substrate/height"], file["fields/relaxed/gap"]
        file["substrate/height"] = np.zeros((3000, 1))
        file["fields/relaxed/gap"] = np.zeros(3)
    found = page(shaped)
    assert "Height of the substrate: no figure" in found.text and "Gap: no figure" in found.text
    assert "Force and separation" in found.text
    # The command says it as well, with the exit code of files; so it does of another run's run.h5.
    command("report", damaged, expect=4, says=["shows only a part of the result", "it is not an HDF5 file"])
    shutil.copy(asperity.run(SMALL, {"surface.seed": 2, "drive.max_steps": 20}, out=tmp_path / "other").file.path, damaged)
    command("report", damaged, expect=4, says="result.json was written with another one")
    assert "written with another one" in PageText(damaged / "report.html").text
    assert not asperity.load(damaged).series and asperity.load(path_run.directory).series


HOSTILE = [
    "{", "[1, 2]", "null", '{"scene": [1, ', "[" * 50_000, '{"a":' * 50_000, '{"a":' * 500 + "1" + "}" * 500, "\0\xff",
    '{"scene": 3, "run": {"stopped": 3, "phases": [1]}, "theory": [], "binding_energy": "x", "delta_gamma": 1e999}',
    '{"name": {}, "scene": {"surface": {"sites": "x","spacing": [], "rms": {}}, "drive": {"path": 3}}, "failure": [1]}',
    '{"scene": {"surface": [], "drive": 1, "x": {"y": {"z": [null, {}]}}}, "units": []}',
    '{"delta_gamma": 1e300, "binding_energy": -1e300, "surface": {"rms": 1e-300, "origin": 4}, "run": {"steps": 1}}',
    '{"scene": {"surface": {"sites": 1e300, "spacing": 1e300, "radius": -1.0}}, "pull_off_force": 1.0}',
    '{"delta_gamma": %s}' % ("9" * 400)]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_results_give_a_page_or_a_message(tmp_path, text):
    (tmp_path / "result.json").write_bytes(text.encode("latin-1"))
    try:
        asperity.load(tmp_path)
    except asperity.InputOutputError as error:
        assert "why:" in str(error)
    else:
        assert "How to cite" in page(tmp_path).text


def test_contact_is_what_the_interface_counts(state_run, tmp_path, light):
    assert "nearer to an atom of the substrate than the inflection" in page(state_run.directory).text
    for law, text in (("smeared", "nearer to the wall than the inflection"), ("exponential", "that touch the wall")):
        of_law = {"interface.adhesion": 50, "interface.range": 1} if law != "smeared" else {}
        run = asperity.run(STATE, {"surface.rms": 0.5, "interface.kind": "wall", "interface.law": law, **of_law}, out=tmp_path / law)
        found = page(run.directory).text
        assert text in found and "to an atom of the substrate" not in found


def test_theory_and_states(state_run, tmp_path, light):
    found = page(state_run.directory)
    assert "Gap" in found.text and "dynamic: a state of force balance" in found.text
    scene = tmp_path / "s.toml"
    scene.write_text("[surface]\nsites = 32\nrms = 0.5\n")
    command("theory", scene, "--out", tmp_path / "theory")
    found = page(tmp_path / "theory")
    assert "nothing was simulated" in found.text and "Persson’s theory" in found.text


def test_a_measured_surface_says_whose_it_is(tmp_path, light):
    measured = ROOT / "scenes/measured"
    for name in ("uncd.toml", "uncd_afm_100nm_512.h5"):
        shutil.copy(measured / name, tmp_path)
    run = asperity.run(tmp_path / "uncd.toml", {"surface.sites": 24, "surface.file_size": 62.4, "surface.rms": 0.5},
                       out=tmp_path / "run")
    (tmp_path / "uncd_afm_100nm_512.h5").unlink()  # it need not be there any more
    found = page(run.directory)
    assert "L. Pastewka, CC BY 4.0" in found.text and "a measured substrate" in found.text
    assert "with the map beside it" in found.text
    labels = [label for d in found.data for label, _ in d.get("curves", [])]
    assert "Persson’s theory" in labels  # over the stored surface


def test_the_page_of_a_sweep(tmp_path, light):
    out = tmp_path / "points"
    sweep = asperity.sweep(STATE, {"surface.rms": [0.2, 0.6], "surface.seed": [1, 2]}, out=out, jobs=2)
    assert sweep.directory == out
    found = page(out, whole=True)
    for text in ("4 points over surface.rms (0.2 to 0.6), surface.seed (1 to 2).", "All points", "±",
                 "The scene that the points vary", "Binding energy", "Contact area"):
        assert text in found.text, text
    assert [v for v in found.links if not v.startswith(("#", "data:"))] == \
        ["rms%3D0.2%2Cseed%3D1/report.html", "rms%3D0.6%2Cseed%3D1/report.html"] * 2
    assert "theory" in (out / "report/gamma.csv").read_text().splitlines()[0]
    assert (out / "rms=0.6,seed=1/report.html").exists() and not (out / "rms=0.6,seed=2/report.html").exists()
    before = (out / "rms=0.6,seed=1/report.html").stat().st_mtime_ns
    stored = json.loads((out / "sweep.json").read_text())
    stored["points"][0].update(status="failed", failure={"exit_code": 3, "reason": "the balance is off"})
    stored["points"][3].update(status="waiting", result={})
    del stored["digest"]  # or the change would be refused
    (out / "sweep.json").write_text(json.dumps(stored))
    found = page(out)
    assert (out / "rms=0.6,seed=1/report.html").stat().st_mtime_ns == before  # not made again
    assert "Bars: standard deviation over seeds and convergence of a run, added in squares." in found.text
    assert "rms=0.2,seed=1 failed" in found.text and "the balance is off" in found.text
    assert "This sweep is not finished" in found.text


def test_the_page_of_a_sweep_of_paths(tmp_path, light):
    sweep = asperity.sweep(SMALL, {"surface.rms": [0.3, 0.6]}, out=tmp_path / "paths", jobs=2)
    page(sweep.directory)
    columns = np.genfromtxt(sweep.directory / "report/curves.csv", delimiter=",", names=True)
    run = asperity.load(sweep.directory / "rms=0.3")
    up = run.series["segment"] == run.segment_names.index("pull-off")
    drawn = [columns[name][:up.sum()] for name in columns.dtype.names]
    assert any(np.allclose(x, run.series["mean_height"][up], rtol=1e-8) for x in drawn)
    assert len(drawn) == 8  # height and force of two approaches and two pull-offs


@pytest.mark.parametrize("curved, says", [
    (False, [("the binding energy is half of Δγ", "1.60", "theory: 1.40 Å, renormalised: 1.80 Å"),
             ("half of the area is in contact", "1.90", "theory: 1.40 Å")]),
    (True, [("γ by JKR, way out, is half of Δγ", "1.50", "theory: 1.40 Å, renormalised: 1.80 Å")])])
def test_where_a_sweep_over_roughness_has_half(curved, says):
    points = []
    for rms, ratio in ((1.0, 0.8), (2.0, 0.3)):  # straight lines: the half is known
        result = {"delta_gamma": 50.0, "binding_energy_ratio": ratio, "contact_fraction": ratio + 0.15}
        if curved:
            result |= {"contact_radius.relaxed": 20.0, "jkr.pull_off_ratio": ratio - 0.05}
        theory = {"persson": {"delta_gamma": 50.0, "gamma_eff": 50.0 * ratio - 5.0, "contact_fraction": ratio - 0.1},
                  "renormalised": {"gamma_eff_ratio": ratio + 0.1}}
        points.append({"set": {"surface.rms": rms}, "delta_gamma": 50.0, "status": "done", "theory": theory,
                       "directory": f"rms={rms}", "result": result})
    found = key_numbers(asperity.Sweep("s", {"surface": {"rms": 1.0}}, ["surface.rms"], points, simulated=True))
    assert [(n.name, n.value, n.note) for n in found] == [("rms where " + a, b, c) for a, b, c in says]


def test_the_page_of_a_sweep_of_the_theory(tmp_path, light):
    scene = tmp_path / "small.toml"
    scene.write_text("[surface]\nsites = 32\n")
    command("sweep", scene, "--theory-only", "--set", "surface.rms=0.2:1:0.4", "drive.load=0,100", "--out",
            tmp_path / "sweep")
    found = page(tmp_path / "sweep")
    for text in ("6 points over surface.rms (0.2 to 1), drive.load (0 to 100)", "All points", "if the whole area were in contact"):
        assert text in found.text, text
    labels = [label for d in found.data for label, _ in d["curves"]]
    assert "Persson’s theory, load = 100 MPa" in labels


def test_what_is_no_result_is_a_message(tmp_path):
    assert "holds no result" in command("report", tmp_path, expect=4)
    assert "there is no such directory" in command("report", tmp_path / "gone", expect=4)
    (tmp_path / "file").write_text("")
    assert "it is a file" in command("report", tmp_path / "file", expect=4)
    command("report", expect=2)
    (tmp_path / "sweep.json").write_text('{"points": 3}')
    assert "is no sweep" in command("report", tmp_path, expect=4)
    (tmp_path / "sweep.json").unlink()
    (tmp_path / "result.json").write_text('{"scene": [1, ')
    assert "it is not JSON" in command("report", tmp_path, expect=4)


def test_under_mpirun_one_rank_speaks(state_run):
    assert command("report", state_run.directory, ranks=2, expect=2).count("not one of several ranks") == 1
    command("export", state_run.directory, "--to", "xyz", ranks=1)


KINDS_OF_PAGES = {  # files of results in the folder or below -> the exit code, and what is said
    ("result.json",): (0, "one page"), ("sweep.json",): (0, "one page"),
    ("a/result.json", "b/result.json"): (2, ["holds 2 results", "a (a run), b (a run)", "asperity report DIR/a", "asperity report DIR/b"]),
    ("a/result.json", "b/sweep.json"): (2, ["holds 2 results", "b (a sweep)"]),
    ("a/sweep.json", "b/sweep.json"): (0, "one page"),
    ("a/b/result.json",): (2, ["holds 1 results", "asperity report DIR/a/b"]),
    ("result.json", "sweep.json"): (2, ["holds 2 results: a run and a sweep", "move the others"]),
    ("result.json", "estimate.json"): (2, ["a run and an estimate"]),
    ("tip.json", "tip/result.json"): (2, ["holds the force curve of a tip", "asperity report DIR/tip"]),
    ("states.json",): (2, ["holds stable states", "look at these files"]), ("cost.csv", "scene/result.json"): (2, ["holds a cost"]),
    (): (4, "holds no result")}


@pytest.mark.parametrize("files", KINDS_OF_PAGES, ids=" ".join)
def test_a_page_is_of_one_result_or_says_why_not(tmp_path, light, files):
    content = {"sweep.json": '{"name": "s", "scene": {}, "axes": ["surface.rms"], "points": []}'}
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content.get(name.rpartition("/")[2], '{"delta_gamma": 1}'))
    code, says = KINDS_OF_PAGES[files]
    command("report", tmp_path, expect=code, says=says if isinstance(says, str) else [one.replace("DIR", str(tmp_path)) for one in says])
    assert (tmp_path / "report.html").exists() == (code == 0)


RUBBER = {"name": "rubber", "surface": {"sites": 16, "spacing": 10.0, "rms": 2.0, "q_max": 4}, "block": {"young": 0.01, "poisson": 0.49,
          "thickness": 16, "prony": [[20.0, 1000.0]]}, "interface": {"kind": "wall", "adhesion": 0},
          "drive": {"mode": "quasistatic", "control": "mean-height", "load": 2.0, "velocity": 1.0, "path": ["relax", "slide x 10 nm under load"]}}


@pytest.mark.parametrize("adhesion", [0, 20])
def test_the_page_of_a_sweep_of_slides_has_friction_and_no_pull_off(tmp_path, light, adhesion):
    """Plots and words are those of what the points have: slides have neither approach nor pull-off."""
    scene = {**RUBBER, "interface": {"kind": "wall", "adhesion": f"{adhesion} mJ/m2", "range": "4 nm"}}
    sweep = asperity.sweep(scene, {"drive.velocity": [0.5, 5.0]}, out=tmp_path / "slides")
    found = page(sweep.directory)
    assert "Friction coefficient" in found.text and (sweep.directory / "report/friction.csv").exists()
    assert not (sweep.directory / "report/curves.csv").exists()
    shown = [label for d in found.data for label, _ in d.get("curves", [])]
    assert "mean of the slide" in shown and not any(word in label for label in shown for word in ("pull-off", "approach"))
    for word in ("pull-off", *["binding energy"] * (not adhesion)):
        assert word not in found.text.lower().partition("the scene that the points vary")[0], word


@pytest.mark.parametrize("model, says", [("continuum", r"mesh: [\d.e-]+"), ("lattice", "mesh: not included")])
def test_numbers_over_a_wall_have_the_error_of_the_mesh_or_lack_it(tmp_path, model, says):
    """On the page and on the terminal; over atoms the sites are no mesh."""
    rough = {"surface": {"sites": 32, "rms": "0.5 Å", "q_max": 8}, "block": {"thickness": 32, "young": "1 GPa"},
             "drive": {"mode": "quasistatic", "control": "mean-height"}}
    wall = {"interface": {"kind": "wall", "adhesion": "0.3 mJ/m2", "range": "3 Å"}}
    run = asperity.run({**rough, **wall, "block": {**rough["block"], "model": model}}, out=tmp_path / model)
    assert 0 < run.contact_area < run.contact_fraction < 1
    notes = {one.name: one.note for one in sentences.key_numbers(run)}
    for name in ("binding energy, state at zero load", "largest attraction, pull-off"):
        assert re.search(says, notes[name]), notes
    assert "area, less half sites of its edges: " in notes["contact fraction, state at zero load"] and \
        "±" in notes["contact fraction, state at zero load"]
    atoms = asperity.run(rough, {"surface.sites": 16, "surface.q_max": 4, "drive.path": "relax"}, out=tmp_path / "atoms")
    assert not any("mesh" in one.note + one.name for one in sentences.key_numbers(atoms))


def test_no_part_of_a_page_is_left_out(tmp_path):
    """A form that the template does not have is an error, not an empty place."""
    page = Page(tmp_path, "kicker", "title", "lead")
    page.add("paragraph", "a sentence")
    page.write()
    assert "a sentence" in page.path.read_text()
    page.add("text", "another one")
    with pytest.raises(asperity.InternalError, match="no form of the name text"):
        page.write()


def test_what_is_left_out_follows_the_scene():
    assert sentences.left_out(Values({"surface": {"counter_young": None}, "interface": {"hardness": "none"}})) == [
        "deformation of the substrate: it is rigid", "plastic flow: the block is elastic throughout"]
    assert sentences.left_out(Values({"surface": {"counter_young": 110.0}, "interface": {"hardness": 1.0}})) == []
