# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""From a map to its adhesion: a surface of known adhesion by way of an export, and what is no map."""

import json
import re
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import asperity
from asperity.maps import convert, height_map
from asperity.running import program
from asperity.running.pool import PoolOptions
from asperity.running.scene import scene_file
from asperity.studies.estimates import Estimating, surface_made
from conftest import ROOT, command

pytestmark = pytest.mark.usefixtures("light_module")

MATTER = {"block": {"young": "5 GPa", "poisson": 0.3, "thickness": 32},
          "interface": {"kind": "wall", "range": 3, "adhesion": "200 mJ/m^2"}, "drive": {"path": ["relax"]}}
SURFACE = {"sites": 32, "spacing": 5, "rms": 2.5, "q_max": 8, "seed": 3}
GIVEN = dict(E="5 GPa", nu=0.3, work="200 mJ/m2")


@pytest.fixture(scope="module")
def known(tmp_path_factory):
    """Heights of a periodic surface, Å, its binding energy, and that in the limit of a fine lattice."""
    place = tmp_path_factory.mktemp("known")
    scene = {"surface": SURFACE, **MATTER}
    run = asperity.run(scene, out=place / "run")
    fine = asperity.run(scene, {"surface.sites": 128, "surface.spacing": 1.25, "block.thickness": 128}, place / "fine")
    return run.substrate["height"], run.binding_energy, fine.binding_energy


def distorted(heights, missing=0.01, noise=0.02):
    """As an instrument has them: tilted, with noise, some missing. Not those at the edges, nor the highest."""
    draw = np.random.default_rng(1)
    y, x = np.indices(heights.shape)
    found = heights + 150.0 + 0.4 * x - 0.7 * y + draw.normal(0.0, noise, heights.shape)
    found[draw.random(heights.shape) < missing] = np.nan
    return found


def write_text(path, heights):
    """As Gwyddion exports it, in other units along and across."""
    rows = "\n".join("\t".join("bad" if np.isnan(v) else f"{1e-1 * v:.6f}" for v in row) for row in heights)
    edge = SURFACE["sites"] * SURFACE["spacing"] * 1e-4
    path.write_text(f"# Channel: Height\n# Width: {edge} µm\n# Height: {edge} µm\n# Value units: nm\n{rows}\n")


def test_a_surface_comes_back_from_an_export(place, known):
    heights, binding, limit = known
    write_text(place / "scan.txt", distorted(heights))
    found = asperity.adhesion(place / "scan.txt", **GIVEN, jobs=2)
    number = found.estimate.numbers["binding_energy"]
    assert 0.3 * 12.48 < binding < 0.95 * 12.48  # partly in contact
    assert number.value == pytest.approx(binding, rel=0.02)
    assert abs(number.estimate - limit) <= 2 * number.error
    assert found.result.binding_energy == number.value and "lost.cycle" in found.estimate.numbers
    assert any("points without a height are filled" in note for note in found.notes)
    assert any("the map is periodic" in note for note in found.notes) and "edge" not in number.parts
    assert "γ_eff = " in found.quote()
    for name in ("report.html", "scene/report.html", "estimate.json", "estimate.png"):
        assert (place / "results/scan-adhesion" / name).exists()
    before = {path: path.stat().st_mtime_ns for path in place.glob("results/*/*/result.json")}
    again = asperity.adhesion(place / "scan.txt", **GIVEN)
    assert again.quote() == found.quote() and before == {p: p.stat().st_mtime_ns for p in before}


def test_every_form_of_a_map_is_the_same_scene(place, known):
    """The state alone, of the scene that a map becomes."""
    heights, binding, _ = known
    edge = SURFACE["sites"] * SURFACE["spacing"]
    numbers = {}
    write_text(place / "text.txt", heights)
    np.save(place / "plain.npy", 1e-1 * heights)
    with h5py.File(place / "map.h5", "w") as file:
        file["scan"] = 1e-4 * heights
        file["scan"].attrs.update(unit="µm", size_x=0.1 * edge, size_y=0.1 * edge, size_unit="nm")
    for name, more in (("text.txt", {}), ("plain.npy", dict(unit="nm", size="16 nm")), ("map.h5", {}), ("map.h5:/scan", {})):
        from asperity.studies.map_scene import scene_of

        made = scene_of(str(place / name), "5 GPa", 0.3, "0.2 J/m^2", place / re.sub(r"\W", "", name), **more)
        numbers[name] = asperity.run(made.file, {"drive.path": ["relax"]}).binding_energy
        assert made.also(0.5) == [] and not made.withheld and made.condition == "for a range of 0.3 nm"  # it is resolved
    assert all(n == pytest.approx(binding, rel=0.02) for n in numbers.values()), numbers
    assert np.ptp(list(numbers.values())) < 1e-4 * binding


def test_a_coarse_map_says_what_is_lost(place):
    draw = np.random.default_rng(2)
    np.save(place / "rough.npy", np.cumsum(np.cumsum(draw.normal(size=(64, 64)), axis=0), axis=1))
    said = command("adhesion", "rough.npy", "--E", "1MPa", "--nu", "0.49", "--work", "50mJ/m2", "--unit", "nm", "--size",
                   "1um", "--sites", "20", "--progress", "off", "--out", "lost", expect=2, env={"OMPI_COMM_WORLD_SIZE": "2"})
    assert "not one of several ranks" in said
    from asperity.studies.map_scene import scene_of

    made = scene_of("rough.npy", "10MPa", 0.49, "50mJ/m2", place / "lost", size="1um", unit="nm", sites=20)
    assert any("waves below 100 nm are lost: 20 of 64 points" in note for note in made.notes), made.notes
    assert any("a smooth part that contains the jumps" in note for note in made.notes)
    assert any("does not resolve" in note for note in made.notes) and made.also(0.5) < made.also(1) < made.also(2)
    assert "the range of the attraction decides" in made.withheld


STEP = np.where(np.arange(32) < 16, 0.0, 50.0) + np.zeros((32, 1))
BAD = {"three pixels": (np.zeros((3, 3)), {}, "3 x 3 points"),
       "all missing": (np.full((32, 32), np.nan), {}, "has no heights"),
       "most missing": (np.where(np.arange(32) < 20, np.nan, np.zeros((32, 1))), {}, "lacks 62 % of its heights"),
       "a step": (STEP, {}, "a step edge"),
       "millimetres": (STEP, {"size": "5 mm"}, "pixels of 156.2 µm"),
       "colours": (np.zeros((32, 32, 3), np.uint8), {}, "a picture of colours"),
       "no width": (STEP, {"size": None}, "does not tell how wide"),
       "no unit": (STEP, {"unit": None}, "does not tell the unit"),
       "unit": (STEP, {"unit": "parsec"}, "none of length"),
       "no number": (STEP, {"E": 100}, "has no unit"),
       "no adhesion": (STEP, {"work": "0 mJ/m^2"}, "is no adhesion"),
       "Poisson's ratio": (STEP, {"nu": 0.75}, "^poisson = 0.75"), "another unit": (STEP, {"work": "50 mJ/m"}, "^adhesion = \"50 mJ/m\""),
       "jelly": (np.random.default_rng(1).normal(size=(32, 32)), {"E": "10 Pa"}, "too small for so soft"),
       "stretched": (np.zeros((32, 40)), {"size": None, "square": True}, "not square")}


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_map_is_refused_in_a_sentence(place, name):
    heights, more, says = BAD[name]
    given = {**GIVEN, "unit": "nm", "size": "100 nm", **more}
    if given.pop("square", False):
        with h5py.File("map.h5", "w") as file:
            file["heights"] = heights
            file["heights"].attrs.update(unit="nm", size_x=100.0, size_y=100.0)
    np.save("map.npy", heights)
    with pytest.raises(asperity.Error, match=says) as raised:
        asperity.adhesion("map.h5" if name == "stretched" else "map.npy", **given)
    assert "fix: " in str(raised.value) and not (place / "results").exists()


def test_pictures_are_refused_by_what_they_are(place):
    import matplotlib.image

    matplotlib.image.imsave("scan.png", np.zeros((32, 32, 3)))
    for call in (lambda: asperity.adhesion("scan.png", **GIVEN), lambda: convert.convert("scan.png", "scan.h5")):
        with pytest.raises(asperity.InputOutputError, match="is a picture .PNG., not a map of heights"):
            call()


def test_pieces_of_maps():
    draw = np.random.default_rng(3)
    heights = draw.normal(size=(9, 9))
    y, x = np.indices(heights.shape)
    tilted = heights + 3.0 + 2.0 * x - y
    tilted[2, 3] = heights[2, 3] = np.nan
    np.testing.assert_allclose(height_map.without_plane(tilted), height_map.without_plane(heights), atol=1e-12)
    pieces = height_map.quarters(heights)
    assert [p.shape for p in pieces] == [(5, 5)] * 4 and pieces[3][0, 0] == heights[4, 4]
    whole = height_map.mirrored(heights)
    assert whole.shape == (18, 18) and height_map.jump(whole) == 0.0
    assert np.nanmean(whole) == pytest.approx(np.nanmean(heights)) and height_map.square(np.zeros((5, 8))).shape == (5, 5)
    wave = np.sin(2 * np.pi * np.arange(32) / 32) + np.zeros((32, 1))
    slope = 0.3 * np.arange(32)
    assert np.abs(height_map.without_tilt(wave + slope[:, None] - slope) - wave).max() < 0.02
    assert height_map.jump(wave) == pytest.approx(1.0, abs=0.5) and height_map.jump(wave[:, :12]) > height_map.PERIODIC


def test_pieces_of_a_scaled_map_are_scaled_alike(place):
    draw = np.random.default_rng(4)
    heights = 0.1 * np.cumsum(np.cumsum(draw.normal(size=(64, 64)), axis=0), axis=1)  # its opposite edges jump
    np.save("map.npy", heights)
    scene = {"surface": {"kind": "file", "file": "map.npy", "file_unit": "nm", "file_size": 83.2, "sites": 32,
                         "detrend": "periodic", "resample": "band-limited"},
             "block": {"thickness": 32}, "drive": {"path": ["relax"]}}
    np.save("small.npy", heights / 100)  # as it is, the map is larger than the box
    as_measured = 100 * asperity.run(scene, {"surface.file": "small.npy"}, out="whole").surface.rms
    found = asperity.estimate(scene, {"surface.rms": 0.5}, "found", parts="edge,places").numbers["binding_energy"]
    quarter, mirrored = (np.load(f"found/maps/{name}.npy") for name in ("quarter-1", "mirrored"))
    np.testing.assert_allclose(quarter, 10 * heights[:32, :32] * 0.5 / as_measured, rtol=1e-9)
    assert mirrored.shape == (128, 128)
    assert asperity.load("found/mirrored").surface.rms == pytest.approx(mirrored.std(), rel=0.02)  # not scaled again
    assert found.parts["edge"].shift == found.parts["places"].shift == 0.0
    four = [asperity.load(f"found/quarter-{i}").binding_energy for i in (1, 2, 3, 4)]
    assert found.parts["places"].error == pytest.approx(1.624 * np.std(four, ddof=1) / 2, rel=1e-3)
    mirror = asperity.load("found/mirrored").binding_energy
    assert found.parts["edge"].error == pytest.approx(0.5 * abs(mirror - found.value))


def test_a_file_in_a_folder_of_a_run_is_seen_before_anything_is_written(place):
    np.save("map.npy", np.random.default_rng(1).normal(size=(32, 32)).cumsum(axis=0).cumsum(axis=1) / 50)
    for folder in ("scene", "quarter-2", "finer,range=5"):
        Path("out", folder).mkdir(parents=True)
        Path("out", folder, "run.h5").write_text("mine")
        with pytest.raises(asperity.SceneError, match="is there already and is not replaced"):
            asperity.adhesion("map.npy", **{**GIVEN, "unit": "nm", "size": "100 nm"}, out="out")
        assert [str(file) for file in Path("out").rglob("*") if file.is_file()] == [f"out/{folder}/run.h5"]
        shutil.rmtree("out")


def test_a_surface_is_made_by_one_start_of_the_program(place, monkeypatch):
    started = []
    monkeypatch.setattr(program, "call", lambda words, call=program.call, **more: started.append(words) or call(words, **more))
    Path("rough.toml").write_text("[surface]\nsites = 16\n")
    made = surface_made("rough.toml")
    assert len(started) == 1 and made.heights.shape == (16, 16) and made.rms == pytest.approx(made.heights.std())


def test_what_will_not_be_stated_is_said_before_the_first_run(place):
    """With what would help; the same in Python as a warning."""
    scan = ROOT / "scenes/measured/uncd_afm_100nm_512.h5"
    given = ("adhesion", scan, "--young", "10GPa", "--poisson", "0.3", "--adhesion", "20mJ/m2", "--sites", "32", "--out", "a")
    said = command(*given, "--plan", says=["9 runs, about", "the numbers will not be stated: roughness that the map does not show decides",
                                           "a map with smaller pixels"])
    assert said.index("will not be stated") and not list(Path("a").glob("*/result.json"))
    told = json.loads(command(*given, "--plan", "--json"))
    assert told["runs"] == told["left"] == 9 and told["seconds"] > 0 and told["unstated"][0]["numbers"] == "the numbers"


def test_sites_that_show_enough_of_a_map_are_named(place):
    """A self-affine map of H = 0.8, on a quarter of its points: what they cut off and what is beyond the map is too much, the latter
    alone is not."""
    draw = np.random.default_rng(2)
    q = np.hypot(*np.meshgrid(128 * np.fft.fftfreq(128), 128 * np.fft.fftfreq(128)))
    waves = np.where(q > 0, np.fft.fft2(draw.normal(size=(128, 128))) / np.maximum(q, 1.0) ** 1.8, 0.0)
    height = np.fft.ifft2(waves).real
    np.save("map.npy", height / height.std())
    said = command("adhesion", "map.npy", "--unit", "nm", "--size", "200nm", "--young", "10GPa", "--poisson", "0.3", "--adhesion", "50mJ/m2",
                   "--sites", "32", "--plan", says="--sites 128 shows enough of it")
    assert "will not be stated" in said


def test_the_law_of_missing_waves_is_that_of_the_map_without_its_line_noise(place):
    draw = np.random.default_rng(5)
    q = np.hypot(*np.meshgrid(128 * np.fft.fftfreq(128), 128 * np.fft.fftfreq(128)))
    waves = np.fft.fft2(draw.normal(size=(128, 128))) / np.maximum(q, 1.0) ** 1.8
    clean = np.fft.ifft2(np.where(q > 0, waves, 0.0)).real
    clean *= 1.0 / clean.std()
    np.save("map.npy", clean + 0.3 * draw.normal(size=(128, 1)))
    scene = {"surface": {"kind": "file", "file": "map.npy", "file_unit": "nm", "file_size": 1280.0, "sites": 64, "spacing": 20.0,
                         "detrend": "periodic", "resample": "band-limited"},
             "block": {"young": 0.05, "thickness": 64}, "interface": {"kind": "wall", "range": 10.0},
             "drive": {"mode": "quasistatic", "control": "mean-height", "path": ["approach", "pull-off"]}}
    hurst = {}
    for treatment in ("keep", "align-rows"):
        scene["surface"]["line_noise"] = treatment
        with scene_file(scene) as file:
            hurst[treatment] = Estimating(file, [], treatment, PoolOptions(progress="off"), None, ["waves"]).law.hurst
    np.save("map.npy", clean)
    scene["surface"]["line_noise"] = "keep"
    with scene_file(scene) as file:
        true = Estimating(file, [], "clean", PoolOptions(progress="off"), None, ["waves"]).law.hurst
    assert hurst["align-rows"] == pytest.approx(true, abs=0.1) and hurst["keep"] < true - 0.3
