# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Two rough solids (surface.counter): the sum of the maps, the compliances in series, displacement and stresses of each, slides, refusals,
ranks and resumed runs."""

import re
import sys

import h5py
import numpy as np
import pytest

import asperity
from asperity.running import program
from asperity.running.scene import assignments, toml_of
from asperity.studies.estimates import surface_made
from asperity.studies.stress import stresses_in
from asperity.units import GIGAPASCAL
from conftest import ROOT, command

sys.path.insert(0, str(ROOT / "scenes/validation"))
from two_solids import AREAS, SHIFTS, SITES, banded, full, scene, slope

pytestmark = pytest.mark.usefixtures("light_module")

N = SITES


@pytest.fixture(scope="module")
def maps():
    return banded(N, 2, 8), np.roll(banded(N, 3, 7), 5, axis=0)


def run(place, name, scene, overrides=None):
    return asperity.run(scene, overrides, out=place / name)


def test_sums_of_the_test_map(tmp_path):
    h = banded(256, 4, 32)
    assert h.std() == pytest.approx(1.42107e-3, rel=5e-6) and full(h) == pytest.approx(2.39918e-5, rel=5e-6)
    made = scene(tmp_path, h, -h[:, ::-1], 256)
    file = tmp_path / "made.toml"
    file.write_text(toml_of(made))

    def total(*overrides):
        return surface_made(str(file), overrides).heights / 256

    for d, expected in SHIFTS.items():
        s = total(f"surface.counter_shift_x={-d}")
        assert abs(s - (h - np.roll(h, -d, axis=1))).max() < 1e-15
        found = (s.var() / h.var(), slope(s) ** 2 / slope(h) ** 2, full(s) / full(h))
        assert found == pytest.approx(expected, abs=6e-5), d
    half = np.fft.ifft2(np.fft.fft2(h) * np.exp(2j * np.pi * 0.5 * np.fft.fftfreq(256))).real
    assert abs(total("surface.counter_shift_x=-0.5") - (h - half)).max() < 1e-14
    np.save(tmp_path / "counter.npy", 256 * h[:, ::-1])
    turned = total("surface.counter_turn=90")
    assert abs(turned - (h + np.rot90(h, -1))).max() < 1e-15
    assert slope(turned) == pytest.approx(0.112447, abs=5e-7) and full(turned) == pytest.approx(4.7904e-5, rel=2e-5)
    assert abs(total("surface.counter_turn=-270") - turned).max() == 0


@pytest.mark.parametrize("turn, shift, area", [(turn, shift, areas[1]) for (turn, shift), areas in AREAS.items()])
def test_area_of_the_test_map_on_itself(tmp_path, turn, shift, area):
    h = -banded(256, 4, 32)  # the areas are those of gaps of the test map
    made = scene(tmp_path, h, h[:, ::-1] if turn else -h[:, ::-1], 256, counter_turn=turn, counter_shift_x=shift)
    made["interface"] = {"kind": "wall", "adhesion": 0.0, "range": 1.0}
    made["drive"] |= {"load": 0.01e4 / (1 - 0.3**2), "tolerance": 1e-3}
    assert run(tmp_path, "pressed", made).contact_fraction == pytest.approx(area, abs=1e-4)


def test_turns_between_quarters_are_band_limited(tmp_path):
    n, wide = 48, 96
    x, y = np.meshgrid(np.arange(wide), np.arange(wide))
    q = 2 * np.pi / wide * np.array([[9, 4], [-3, 14], [0, 11]])
    wave = sum(np.cos(a * x + b * y + i) for i, (a, b) in enumerate(q)) / wide / 30
    made = scene(tmp_path, np.zeros((n, n)), wave[:, ::-1] * wide / n, n, counter_size=wide, counter_crop="middle", counter_turn=30.0,
                 counter_shift_x=2.5, counter_shift_y=-4.0)
    file = tmp_path / "turned.toml"
    file.write_text(toml_of(made))
    middle, (cosine, sine) = (wide - 1) / 2, (np.cos(np.pi / 6), np.sin(np.pi / 6))
    dx, dy = x - middle - 2.5, y - middle + 4.0
    there = middle + cosine * dx + sine * dy, middle - sine * dx + cosine * dy
    exact = sum(np.cos(a * there[0] + b * there[1] + i) for i, (a, b) in enumerate(q)) / 30
    found, cut = surface_made(str(file)).heights, slice((wide - n) // 2, (wide + n) // 2)
    assert abs(found - exact[cut, cut]).max() < 1e-4 * abs(exact).max()


def test_a_rigid_flat_solid_changes_no_bit(tmp_path, maps):
    pair = run(tmp_path, "pair", scene(tmp_path, maps[0], np.zeros((N, N))))
    alone = scene(tmp_path, *maps)
    alone["surface"] = {key: value for key, value in alone["surface"].items() if not key.startswith("counter")}
    single = run(tmp_path, "single", alone)
    assert pair.binding_energy == single.binding_energy and pair.contact_fraction == single.contact_fraction > 0
    for name in ("pressure", "gap", "u_z"):
        assert (pair.fields["relaxed"][name] == single.fields["relaxed"][name]).all(), name
    assert "u_z_counter" not in pair.fields["relaxed"] and pair.number("surface.counter.rms") == 0
    stiff = run(tmp_path, "stiff", scene(tmp_path, maps[0], np.zeros((N, N)), counter_young=1e6, counter_poisson=0.3))
    assert stiff.binding_energy == pytest.approx(single.binding_energy, rel=1e-3) and stiff.binding_energy != single.binding_energy


@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_solids_of_one_material_are_one_of_half_the_modulus(tmp_path, maps, boundary):
    pair = run(tmp_path, "pair", scene(tmp_path, *maps, counter_young=10, counter_poisson=0.3, boundary=boundary))
    half = run(tmp_path, "half", scene(tmp_path, *maps, boundary=boundary), {"block.young": 5})
    there, here = half.fields["relaxed"], pair.fields["relaxed"]
    assert abs(here.pressure - there.pressure).max() < 1e-9 * there.pressure.max()
    assert pair.number("relaxed.elastic_energy") == pytest.approx(half.number("relaxed.elastic_energy"), rel=1e-9)
    shape = here.u_z - here.u_z.mean()
    of_counter = here.u_z_counter - here.u_z_counter.mean()
    assert abs(of_counter + 0.5 * shape).max() < 1e-4 * abs(shape).max()


COATED = {"counter_young": 70, "counter_poisson": 0.2, "counter_layers": [[3.0, 5.0, 0.4]], "counter_surface_stress": 0.5}
COAT = {"block.layers": [[2.0, 90.0, 0.25]], "block.surface_stress": 0.3}
EXACT = {"drive.tolerance": 1e-8}  # the energy of a state has an error of the second order in it: 4e-12 at 1e-6


@pytest.fixture(scope="module")
def coated(tmp_path_factory, maps):
    place = tmp_path_factory.mktemp("pair")
    return run(place, "coated", scene(place, *maps, **COATED), {**COAT, **EXACT, "output.stress": "section"})


def test_swapped_solids_are_the_same(tmp_path, maps, coated):
    swapped = scene(tmp_path, *maps, counter_young=10, counter_poisson=0.3, counter_layers=[[2.0, 90.0, 0.25]], counter_surface_stress=0.3)
    other = {"block.young": 70, "block.poisson": 0.2, "block.layers": [[3.0, 5.0, 0.4]], "block.surface_stress": 0.5, **EXACT}
    material = run(tmp_path, "material", swapped, other)
    assert material.binding_energy == coated.binding_energy
    assert (material.fields["relaxed"].pressure == coated.fields["relaxed"].pressure).all()
    # The displacement of the block is that of the second solid where the two are swapped.
    here, there = coated.fields["relaxed"], material.fields["relaxed"]
    of_block = here.u_z + here.u_z_counter
    assert np.ptp(of_block + there.u_z_counter) < 1e-4 * np.ptp(of_block) and np.ptp(here.u_z_counter) > 0.05 * np.ptp(of_block)
    both = run(tmp_path, "both", scene(tmp_path, *maps[::-1], **{k: v for k, v in swapped["surface"].items() if k.startswith("counter_")}), other)
    assert both.binding_energy == pytest.approx(coated.binding_energy, rel=1e-12)
    assert abs(both.substrate.height[:, ::-1] - coated.substrate.height).max() < 1e-12
    assert both.number("surface.rms") == pytest.approx(coated.number("surface.rms"), rel=1e-12)
    pressure = coated.fields["relaxed"].pressure
    # Mirrored sums round otherwise: each state is exact to its residual forces.
    left = sum(state.number("relaxed.residual_force") for state in (both, coated))
    assert abs(both.fields["relaxed"].pressure[:, ::-1] - pressure).max() < left / coated.number("scene.surface.spacing") ** 2 / GIGAPASCAL
    assert both.number("surface.own.rms") == pytest.approx(coated.number("surface.counter.rms"), rel=1e-12)


def test_moduli_and_displacements_of_each_wave(tmp_path, maps):
    """10 GPa, 0.3 and 70 GPa, 0.2: E* is 9.5498 GPa, and the softer solid takes 0.86903 of the displacement. Of thick solids, so that waves are
    those of half-spaces."""
    state = run(tmp_path, "state", scene(tmp_path, *maps, counter_young=70, counter_poisson=0.2), {"block.thickness": 4 * N}).fields["relaxed"]
    pressure, both, counter = (np.fft.fft2(values) for values in (state.pressure, state.u_z, state.u_z_counter))
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(N), np.fft.fftfreq(N)[:, None])
    strong = (abs(pressure) > 1e-3 * abs(pressure).max()) & (q > 0)
    assert strong.sum() > 100
    np.testing.assert_allclose(2 * pressure[strong] / (q * both)[strong], 9.5498, rtol=1e-5)
    np.testing.assert_allclose((both + counter)[strong] / both[strong], 0.86903, rtol=1e-5)


R, TIME, SHARE = 3.0, 40.0, 10 / (10 + 70)
"""A branch (ps) of a solid in series with a stiffer one, and the share of that one."""


def viscoelastic(place, **surface):
    made = scene(place, banded(16, 1, 5), banded(16, 2, 6), 16, **surface)
    made["drive"] |= {"path": ["load 400 MPa", "hold 30 ps"], "velocity": 2.0, "displacement_step": 0.5, "tolerance": 1e-4,
                      "control": "top" if surface["boundary"] == "free" else "mean-height"}
    del made["drive"]["load"]
    made["output"] = {"fields": ["segments"]}
    return made


@pytest.mark.parametrize("boundary, poisson", [("periodic", 0.3), ("free", 0.0)])
def test_branches_of_two_solids_in_series(tmp_path, boundary, poisson):
    """A solid with one branch on an elastic one is one solid with the branch (1 - x) r/(1 + x r) of the time (1 + x r) tau."""
    modulus = (1 - poisson**2) / (1 - 0.3**2)  # of the same E*
    pair = run(tmp_path, "pair", viscoelastic(tmp_path, counter_young=70 * modulus, counter_poisson=poisson, boundary=boundary),
               {"block.prony": [[R, TIME]]})
    x = SHARE
    single = run(tmp_path, "single", viscoelastic(tmp_path, boundary=boundary),
                 {"block.young": 10 * 70 / 80, "block.prony": [[(1 - x) * R / (1 + x * R), (1 + x * R) * TIME]]})
    kept = run(tmp_path, "kept", viscoelastic(tmp_path, boundary=boundary), {"block.young": 10 * 70 / 80, "block.prony": [[R, TIME]]})
    for name in ("work_of_drive", "dissipated_in_block", "stored"):
        found, expected, other = (np.array([segment.number(name) for segment in one.segments]) for one in (pair, single, kept))
        size = abs(expected).max()  # points are relaxed to the tolerance
        assert abs(found - expected).max() < 1e-5 * size and abs(other - expected).max() > 0.01 * size, name
    there, here = single.fields["segment-1"], pair.fields["segment-1"]
    assert abs(here.pressure - there.pressure).max() < 1e-4 * there.pressure.max()
    # The second solid is elastic, whatever the path has been: its displacement is p/S.
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(16), np.fft.fftfreq(16)[:, None])
    if boundary == "periodic":
        pressure, counter = np.fft.fft2(here.pressure)[0, 1:4], np.fft.fft2(here.u_z_counter)[0, 1:4]
        np.testing.assert_allclose(-2 * pressure / (q[0, 1:4] * counter), 70 / (1 - 0.3**2), rtol=1e-3)


def test_layers_of_the_solids_own_material_are_none(tmp_path, maps):
    plain = run(tmp_path, "plain", scene(tmp_path, *maps, counter_young=70, counter_poisson=0.2))
    coated = run(tmp_path, "coated", scene(tmp_path, *maps, counter_young=70, counter_poisson=0.2, counter_layers=[[3.0, 70.0, 0.2]]),
                 {"block.layers": [[2.0, 10.0, 0.3]]})
    assert coated.binding_energy == pytest.approx(plain.binding_energy, rel=1e-9)


def test_stresses_in_each_solid(tmp_path, maps, coated):
    block = asperity.stress(coated, out=tmp_path / "block")
    recorded = stresses_in(coated)[0]
    assert (block.section["zz"] == recorded.section["zz"]).all()
    counter = asperity.stress(coated, solid="counter", friction=0.2, out=tmp_path / "counter")
    pressure = coated.fields["relaxed"].pressure
    assert counter.solid == "counter" and counter.friction == 0.2 and len(counter.layers) == 2
    one = run(tmp_path, "one", scene(tmp_path, *maps, counter_young=90, counter_poisson=0.3))
    first, second = (asperity.stress(one, solid=solid, out=tmp_path / solid) for solid in ("block", "counter"))
    for name in ("xx", "zz", "xz"):  # the stresses of one pressure do not depend on Young's modulus
        assert abs(first.section[name] - second.section[name]).max() < 1e-5 * pressure.max(), name
    sheared = [asperity.stress(one, solid=solid, friction=0.3, out=tmp_path / f"{solid}-sheared") for solid in ("block", "counter")]
    assert abs(sheared[0].section["xz"][0] + sheared[1].section["xz"][0]).max() < 1e-5 * pressure.max()


def test_a_slide_moves_the_second_map(tmp_path, maps):
    made = scene(tmp_path, *maps, counter_young=70, counter_poisson=0.2)
    made["interface"]["adhesion"] = 0.0
    made["drive"] |= {"path": ["approach", "slide x 2.5 Å", "slide y 1 Å"], "load": 800.0, "control": "mean-height", "displacement_step": 0.1,
                      "tolerance": 1e-4}
    made["output"] = {"fields": ["segments"]}
    slid = run(tmp_path, "slid", made)
    there = slid.fields["segment-2"]
    assert there.slide == (2.5, 1.0) and slid.number("energy.balance_error") < 2e-3
    height = slid.series["mean_height"][-1]
    made["surface"] |= {"counter_shift_x": -2.5, "counter_shift_y": -1.0}
    made["drive"]["path"] = ["approach", f"height {height:.12g} Å"]
    placed = run(tmp_path, "placed", made)
    pressure = placed.fields["segment-1"].pressure
    assert abs(there.pressure - pressure).max() < 0.02 * pressure.max() and pressure.max() > 0


REFUSED = [
    ({"interface.kind": "atoms"}, "surface.counter", "a composite is for walls"),
    ({"drive.mode": "dynamic", "drive.path": ["approach"], "interface.kind": "wall"}, "surface.counter", "without inertia"),
    ({"block.prony": [[1.0, "1 ns"]], "surface.counter_young": 3, "surface.counter_poisson": 0.2, "drive.path": ["approach"]}, "block.prony",
     "surface.counter_poisson = 0.3 and surface.counter_young = 2.84375"),
    ({"block.prony": [[1.0, "1 ns"]], "surface.counter_young": 3, "surface.counter_poisson": 0.3, "surface.counter_layers": [[2, 1, 0.3]],
      "drive.path": ["approach"]}, "block.prony", "leave the layers and surface stresses of both solids out"),
    ({"block.prony": [[1.0, "1 ns"]], "surface.counter_young": 3, "surface.counter_poisson": 0.3, "surface.counter_surface_stress": 1,
      "drive.path": ["approach"]}, "block.prony", "with layers or a surface stress"),
    ({"surface.counter": "none", "surface.counter_turn": 90}, "surface.counter_turn", 'surface.counter is "none"'),
    ({"surface.counter": "none", "surface.counter_shift_x": 1}, "surface.counter_shift_x", 'surface.counter is "none"'),
    ({"surface.counter": "none", "surface.counter_young": 1}, "surface.counter_young", 'surface.counter is "none"'),
    ({"surface.counter_poisson": 0.1}, "surface.counter_poisson", 'surface.counter_young is "rigid"'),
    ({"surface.counter_layers": [[1, 1, 0.3]]}, "surface.counter_layers", 'surface.counter_young is "rigid"'),
    ({"surface.counter_surface_stress": 1}, "surface.counter_surface_stress", 'surface.counter_young is "rigid"'),
    ({"surface.counter_young": 1, "surface.counter_layers": [[40, 1, 0.3]]}, "surface.counter_layers", "block.thickness"),
    ({"surface.radius": 1000, "drive.path": ["approach", "slide x 1 Å"]}, "drive.path", "two spheres"),
    ({"drive.path": ["approach", "slide x 1 Å until steady"]}, "drive.path", "slides on unchanged"),
    ({"drive.path": ["approach", "slide x 1 Å"], "output.stress": "section"}, "drive.path", "stress_friction"),
]


def problems(place, made, overrides):
    file = place / "refused.toml"
    file.write_text(toml_of(made))
    try:
        return program.check(str(file), assignments(overrides))["problems"]
    except asperity.SceneError as refused:
        return refused.listed


@pytest.mark.parametrize("overrides, key, words", REFUSED, ids=[f"{key}-{i}" for i, (_, key, _) in enumerate(REFUSED)])
def test_what_has_no_meaning_is_refused(tmp_path, maps, overrides, key, words):
    found = [" ".join(one.values()) for one in problems(tmp_path, scene(tmp_path, *maps), overrides)]
    assert any(key in one and words in one for one in found), found


BAD = [
    (np.zeros((40, 40)), {}, "surface.resample"),
    (np.full((N, N), np.nan), {}, "surface.counter_missing"),
    (1e3 * np.eye(N), {}, "surface.counter_unit"),
    (np.zeros((N, N)), {"surface.counter_size": 24, "surface.resample": "band-limited"}, "does not cover the box"),
    (np.zeros((N, N)), {"surface.counter_size": 64, "surface.resample": "band-limited"}, "surface.counter_crop"),
    (np.zeros((N, N)), {"surface.counter_turn": 30}, "quarter turn"),
    (np.zeros((N, N)), {"surface.counter_shift_x": 3, "surface.boundary": "free"}, "does not cover the box"),
    (np.zeros((N, 2 * N)), {}, "surface.counter_crop"),
    (np.zeros((N, N)), {"surface.counter": "nothing.npy"}, "no such file"),
    (np.zeros((N, N)), {"surface.counter_unit": "kg"}, "surface.counter_unit"),
]


@pytest.mark.parametrize("heights, overrides, words", BAD, ids=[words for *_, words in BAD])
def test_a_bad_map_gets_one_clear_error(tmp_path, maps, heights, overrides, words):
    found = problems(tmp_path, scene(tmp_path, maps[0], heights), overrides)
    text = " ".join(" ".join(one.values()) for one in found)
    assert len(found) == 1 and "surface.counter" in text and words in text, found


def complex_map(place):
    np.save(place, np.zeros((N, N), complex))


def damaged(place):
    np.save(place, np.zeros((N, N)))
    place.write_bytes(place.read_bytes()[:-100])


def filled(value, shape=(N, N), where=(3, 4)):
    heights = np.zeros(shape)
    heights[where] = value
    return lambda place: np.save(place, heights)


UNREADABLE = {
    "hole": filled(np.nan), "infinity": filled(np.inf), "all holes": filled(np.nan, where=...), "row": filled(0.0, (N * N,), 3),
    "volume": filled(0.0, (2, N, N), (1, 2, 3)), "oblong": filled(0.0, (N, N // 2)), "another size": filled(0.0, (N // 2, N // 2)),
    "complex numbers": complex_map, "damaged": damaged, "empty": lambda place: place.write_bytes(b""),
    "text": lambda place: place.write_text("a map"), "folder": lambda place: place.mkdir(), "none": lambda place: None}


@pytest.mark.parametrize("kind", UNREADABLE)
def test_a_bad_map_of_either_solid_has_the_same_error(tmp_path, maps, kind):
    """What surface.file refuses surface.counter refuses in the same words, with its own keys and its own file."""
    found = []
    for key in ("file", "counter"):
        place = tmp_path / key
        place.mkdir()
        made = scene(place, *maps)
        made["surface"][key] = str(place / "bad.npy")
        UNREADABLE[kind](place / "bad.npy")
        [problem] = problems(place, made, {})
        text = " ".join(problem.values())
        assert "bad.npy" in text or f"surface.{key}" in text
        text = text.replace(str(place), "").replace(f"surface.{key}", "surface.KEY").replace(f"{key}_", "KEY_").replace(f"{key} =", "KEY =")
        found.append(re.sub(r"toml:\d+:\d+", "toml", text))
    assert found[0] == found[1]


def arrays(file):
    """All arrays of a file by name."""
    found = {}
    with h5py.File(file) as opened:
        opened.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


@pytest.fixture(scope="module")
def path_scene(tmp_path_factory):
    place = tmp_path_factory.mktemp("path")
    made = scene(place, banded(16, 1, 5), banded(16, 2, 6), 16, **COATED, counter_turn=90.0, counter_shift_x=2.3)
    made["drive"] |= {"path": ["approach", "pull-off"], "load": 0.0, "control": "mean-height", "displacement_step": 0.4, "tolerance": 1e-4}
    made["output"] = {"stress": "volume", "stress_depths": 4, "fields": ["relaxed", "segments"]}
    (place / "pair.toml").write_text(toml_of(made))
    command("run", place / "pair.toml", "--out", place / "one")
    return place


def same(one, other):
    """Two files hold the same arrays, bit for bit."""
    one, other = arrays(one), arrays(other)
    assert set(one) == set(other) and any(name.startswith("stress/") for name in one)
    for name, values in one.items():
        assert np.array_equal(values, other[name], equal_nan=True), name


def test_a_run_resumed_on_other_ranks_has_the_same_bits(path_scene):
    place = path_scene / "changing"
    for number, ranks in enumerate((3, 1, 4, 2)):
        steps = ["--set", f"drive.max_steps={8 * (number + 1)}"] if number < 3 else []
        command("run", path_scene / "pair.toml", "--out", place, *steps, *(["--resume", "auto"] if number else []), ranks=ranks)
    same(path_scene / "one/run.h5", place / "run.h5")


@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_ranks_have_the_same_bits(path_scene, ranks):
    still = ["--set", "drive.path=relax", "output.fields=relaxed"]
    if not (path_scene / "still").exists():
        command("run", path_scene / "pair.toml", "--out", path_scene / "still", *still)
    command("run", path_scene / "pair.toml", "--out", path_scene / str(ranks), *still, ranks=ranks)
    one, many = (arrays(path_scene / name / "run.h5") for name in ("still", str(ranks)))
    assert set(one) == set(many) and any(name.startswith("stress/") for name in one) and "fields/relaxed/u_z_counter" in one
    for name, values in one.items():
        assert np.array_equal(values, many[name], equal_nan=True), name


def test_a_resumed_run_has_the_same_bits(path_scene):
    command("run", path_scene / "pair.toml", "--out", path_scene / "parts", "--set", "drive.max_steps=20")
    command("run", path_scene / "pair.toml", "--out", path_scene / "parts", "--resume", "auto")
    one, parts = (arrays(path_scene / name / "run.h5") for name in ("one", "parts"))
    assert set(one) == set(parts)
    for name, values in one.items():
        assert np.array_equal(values, parts[name], equal_nan=True), name
    command("run", path_scene / "pair.toml", "--out", path_scene / "other", "--set", "drive.max_steps=5")
    np.save(path_scene / "counter.npy", np.zeros((16, 16)))
    command("run", path_scene / "pair.toml", "--out", path_scene / "other", "--resume", "auto", expect=2, says=["counter"])


def test_plan_knows_the_bytes_of_the_stresses(path_scene):
    planned = program.plan(str(path_scene / "pair.toml"))["bytes"]
    written = arrays(path_scene / "one/run.h5")
    stresses = sum(values.nbytes for name, values in written.items() if name.startswith("stress/relaxed/") and values.ndim > 2)
    assert planned["stress"] == pytest.approx(stresses, rel=0.01) and planned["stress"] > 24 * 4 * 16**2
    state = sum(values.nbytes for name, values in written.items() if name.startswith("fields/relaxed/") and values.shape == (16, 16))
    assert planned["state"] == state and planned["maps"] > planned["stress"]  # the root holds them whole
    assert program.plan(str(path_scene / "pair.toml"), ["output.stress=none"])["bytes"]["stress"] == 0


def test_an_estimate_has_no_part_that_fails(tmp_path, maps):
    """Of a map on a surface that is drawn, or flat."""
    made = scene(tmp_path, *maps, counter_young=70, counter_poisson=0.2)
    drawn = {key: value for key, value in made["surface"].items() if not key.startswith("file")}
    for kind, more in (("self-affine", {"rms": 0.4, "q_max": 8, "rolloff": 2}), ("flat", {})):
        found = asperity.estimate(made | {"surface": drawn | more | {"kind": kind}}, out=tmp_path / kind, seeds=2,
                                  parts=["spacing", "thickness", "width", "seeds"])
        assert not [part for part in found.parts if part["failed"]] and found.number("binding_energy").parts["spacing"].error > 0, kind


def test_adhesion_of_two_maps_has_the_error_of_the_position(tmp_path, maps):
    for name, heights in zip(("first", "second"), maps):
        np.save(tmp_path / f"{name}.npy", N * heights)
    found = asperity.adhesion(tmp_path / "first.npy", young="10 GPa", poisson=0.3, adhesion="60 mJ/m2", range="2 Å", size="3.2 nm", unit="Å",
                              counter=tmp_path / "second.npy", counter_young="70 GPa", counter_poisson=0.2, out=tmp_path / "out")
    keys = found.result.part("scene")
    assert keys.number("surface.counter_young") == 70 and keys.text("surface.counter") == "counter.npy"
    position = found.estimate.number("binding_energy").parts["position"]
    runs = [asperity.load(one).binding_energy for one in sorted((tmp_path / "out").glob("*counter_shift_x*"))]
    assert len(runs) == 7 and position.shift == 0
    assert position.error == pytest.approx(np.std([found.result.binding_energy, *runs], ddof=1), rel=1e-9) and position.error > 0
    assert not [part for part in found.estimate.parts if part["failed"]], found.estimate.parts
    for given, words in (({"counter_young": "1 GPa"}, "no second solid"), ({"counter": tmp_path / "first.npy", "counter_poisson": 0.2}, "rigid")):
        with pytest.raises(asperity.SceneError, match=words):
            asperity.adhesion(tmp_path / "first.npy", young="10 GPa", poisson=0.3, adhesion="60 mJ/m2", out=tmp_path / "refused", **given)
