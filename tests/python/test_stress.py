# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Stresses below the surface: of a rough contact against point loads summed densely, the command and its files, the keys of output, and
what has no stresses."""

import base64
import json
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np
import pytest

import asperity
from asperity.reports.stress import image_of
from asperity.studies.stress import COMPONENTS, largest_tension, stresses_in, von_mises
from asperity.units import GIGAPASCAL
from conftest import command

pytestmark = pytest.mark.usefixtures("light_module")

SPACING, SITES, POISSON = 2.0, 32, 0.3
ROUGH = {"surface": {"sites": SITES, "spacing": SPACING, "rms": 0.6, "rolloff": 2, "q_max": 8, "seed": 3},
         "block": {"young": 20, "poisson": POISSON},
         "interface": {"kind": "wall", "law": "exponential", "adhesion": 2.0, "range": 3.0},
         "drive": {"path": ["relax"], "load": 600.0, "mode": "quasistatic"}}
DEPTHS = {"output.stress": "volume", "output.stress_depth": 4 * SPACING, "output.stress_depths": 5}


@pytest.fixture(scope="module")
def rough(tmp_path_factory):
    return asperity.run(ROUGH, DEPTHS, out=tmp_path_factory.mktemp("stress") / "rough")


def boussinesq(x, y, z):
    """Stresses at (x, y) and depth z by a unit force on a half-space, tension positive (Johnson, Contact Mechanics, 3.2)."""
    r2, rho = x**2 + y**2, np.sqrt(x**2 + y**2 + z**2)
    c, s = x / np.sqrt(r2), y / np.sqrt(r2)
    term = (1 - 2 * POISSON) * (1 - z / rho) / r2
    radial = term - 3 * z * r2 / rho**5
    hoop = -term + (1 - 2 * POISSON) * z / rho**3
    normal, shear = -3 * z**3 / rho**5, -3 * np.sqrt(r2) * z**2 / rho**5
    return np.array([radial * c**2 + hoop * s**2, radial * s**2 + hoop * c**2, normal, (radial - hoop) * c * s, shear * c,
                     shear * s]) / (2 * np.pi)


def of_patches(pressure, depth, images=2, points=6):
    """Stresses by pressures that are constant on each site, in a periodic box with held sides: point forces on a Gauss grid of each site and of
    its images, and the difference between held and free sides of the mean pressure."""
    n = len(pressure)
    node, weight = np.polynomial.legendre.leggauss(points)
    offset = np.arange(n) - n // 2 + 0.5 * (n % 2)
    kernel = np.zeros((6, n, n))
    for i, wi in zip(node, weight):
        for j, wj in zip(node, weight):
            for a in range(-images, images + 1):
                for b in range(-images, images + 1):
                    x, y = np.meshgrid(SPACING * (offset + a * n - 0.5 * i), SPACING * (offset + b * n - 0.5 * j))
                    kernel += 0.25 * wi * wj * SPACING**2 * boussinesq(x, y, depth)
    found = np.zeros((6, n, n))
    for y in range(n):
        for x in range(n):  # dense: each site on all others
            found += pressure[y, x] * np.roll(kernel, (y - n // 2, x - n // 2), axis=(1, 2))
    mean = pressure.mean()
    found[:2] += mean * ((1 + 2 * POISSON) / 2 - POISSON / (1 - POISSON))
    return dict(zip(COMPONENTS, found))


def test_agrees_with_dense_patches(rough):
    found, pressure = stresses_in(rough)[0], rough.fields["relaxed"].pressure
    assert 0.05 < rough.contact_fraction < 0.9
    for index, most in ((1, 0.055), (2, 0.03), (4, 0.016)):
        dense = of_patches(pressure, index * SPACING)
        waves = {name: values[index] for name, values in found.volume.items()}
        assert found.depth[index] == pytest.approx(index * SPACING, rel=1e-6)
        largest = von_mises(dense).max()
        assert von_mises(waves).max() == pytest.approx(largest, rel=most)
        for name in COMPONENTS:
            assert np.abs(waves[name] - dense[name]).max() < 3 * most * largest, (name, index)


def test_errors_cover_dense_patches(rough):
    found, pressure = stresses_in(rough)[0], rough.fields["relaxed"].pressure
    for measure, of in (("von_mises", von_mises), ("tension", largest_tension)):
        one = found.of(measure)
        if one.error is None:
            continue
        near = np.array([0.9, 1.0, 1.1]) * one.depth
        dense = max(of(of_patches(pressure, depth)).max() for depth in near)
        assert abs(one.value - dense) <= one.error, measure
    assert found.of("von_mises").error is not None


def test_balances_at_every_depth(rough):
    found, pressure = stresses_in(rough)[0], rough.fields["relaxed"].pressure
    for zz in found.volume["zz"]:
        assert zz.mean() == pytest.approx(-pressure.mean(), rel=1e-6)
    np.testing.assert_allclose(found.volume["zz"][0], -pressure, atol=1e-6 * np.abs(pressure).max())
    np.testing.assert_allclose(found.volume["xz"][0], 0.0, atol=1e-6 * np.abs(pressure).max())


def test_the_command_gives_what_the_run_recorded(rough, tmp_path):
    out = tmp_path / "out"
    told = json.loads(command("stress", rough.directory, "--out", out, "--volume", "--depth", "0.8nm", "--json"))
    recorded = stresses_in(rough)[0]
    for one in told["layers"][0].values():
        if isinstance(one, dict):
            assert set(one) >= {"value", "error", "x", "y", "depth", "reason"}
    assert told["layers"][0]["von_mises"]["value"] == pytest.approx(recorded.of("von_mises").value, rel=1e-6)
    with h5py.File(out / "stress.h5") as file:
        assert file["stress/relaxed/volume"].shape == (6, 48, SITES, SITES)
        assert file["stress/relaxed/largest"].attrs["unit"] in ("GPa", b"GPa")
    image = ElementTree.parse(out / "stress.vti").getroot().find("ImageData")
    assert image.get("WholeExtent") == f"0 {SITES - 1} 0 {SITES - 1} 0 47"
    assert {array.get("Name") for array in image.iter("DataArray")} >= {"stress xx (GPa)", "von Mises (GPa)"}
    page = (out / "report.html").read_text()
    assert "Stress of von Mises" in page and "Section" in page
    command("stress", rough.directory, "--out", out, says=["von Mises", "sides are held"])  # its own files are replaced
    (out / "stress.json").write_text("mine")
    command("stress", rough.directory, "--out", out, expect=2, says=["stress.json"])
    assert (out / "stress.json").read_text() == "mine"
    assert asperity.stress(rough, out=tmp_path / "python").of("tresca").value == pytest.approx(recorded.of("tresca").value, rel=1e-6)


@pytest.mark.parametrize("volume", [True, False])
def test_the_image_is_in_the_format_of_vtk(rough, volume):
    """Read by the format's description alone: an extent in points, x fastest, and arrays of base64 after their lengths in bytes. VTK's reader
    finds the same (test_viewers.py)."""
    found = stresses_in(rough)[0]
    found.volume = found.volume if volume else {}
    file = ElementTree.fromstring(image_of(found))
    assert file.attrib == {"type": "ImageData", "version": "1.0", "byte_order": "LittleEndian", "header_type": "UInt64"}
    [image] = file
    [piece] = image
    assert piece.get("Extent") == image.get("WholeExtent")
    first_x, last_x, first_y, last_y, first_z, last_z = (int(word) for word in image.get("WholeExtent").split())
    shape = (last_z - first_z + 1, last_y - first_y + 1, last_x - first_x + 1)
    values = found.volume or {name: one[:, None, :] for name, one in found.section.items()}
    assert shape == values["zz"].shape
    origin, spacing = ([float(word) for word in image.get(name).split()] for name in ("Origin", "Spacing"))
    assert origin == pytest.approx([SPACING / 2, SPACING / 2 if volume else found.section_y, found.depth[0]])
    assert spacing == pytest.approx([SPACING, SPACING, found.depth[1]])
    arrays = {}
    for item in piece.find("PointData"):
        assert (item.tag, item.get("type"), item.get("NumberOfComponents"), item.get("format")) == ("DataArray", "Float32", "1", "binary")
        data = base64.b64decode(item.text, validate=True)
        assert int.from_bytes(data[:8], "little") == len(data) - 8 == 4 * np.prod(shape)
        arrays[item.get("Name")] = np.frombuffer(data[8:], "<f4").reshape(shape)
    expected = {f"stress {name} (GPa)": one for name, one in values.items()}
    expected |= {"von Mises (GPa)": von_mises(values), "largest tension (GPa)": largest_tension(values)}
    assert set(arrays) == set(expected)
    for name, one in expected.items():
        assert (arrays[name] == np.asarray(one, "<f4")).all(), name
    with h5py.File(rough.file.path) as kept:
        written = kept["stress/relaxed/volume"][2] if volume else kept["stress/relaxed/section"][0, 2][:, None, :]
    assert (arrays["stress zz (GPa)"] == written).all()


def test_friction_raises_the_stress(rough, tmp_path):
    without, with_friction = (asperity.stress(rough, friction=f, out=tmp_path / str(f)) for f in (0.0, 0.5))
    assert with_friction.of("von_mises").value > without.of("von_mises").value
    sheared = with_friction.section["xz"][0]
    normal = with_friction.section["zz"][0]
    np.testing.assert_allclose(sheared, 0.5 * np.maximum(-normal, 0), atol=1e-4 * np.abs(normal).max())  # the block slides to +x
    with pytest.raises(asperity.SceneError, match="friction=3"):
        asperity.stress(rough, friction=3.0, out=tmp_path / "no")


def test_of_a_slide_bears_its_friction(tmp_path):
    """The mean shear at each depth is the lateral force of the series over the area."""
    rubber = {**ROUGH, "block": {"young": 0.5, "poisson": POISSON, "prony": [[3.0, 100.0]]},
              "drive": {"mode": "quasistatic", "path": ["load 100 MPa", "slide x 20 Å"], "velocity": 0.05},
              "interface": {**ROUGH["interface"], "adhesion": 0.1}}
    run = asperity.run(rubber, {"output.fields": ["segments"], **DEPTHS}, out=tmp_path / "run")
    found = {one.state: one for one in stresses_in(run)}["segment-1"]
    lateral = run.series["lateral_force_x"][-1] / run.edge**2 / GIGAPASCAL
    assert found.slid and lateral < 0  # the block slides to +x
    for shear in found.volume["xz"]:
        assert shear.mean() == pytest.approx(-lateral, rel=1e-5)
    computed = asperity.stress(run, out=tmp_path / "out")  # of the last state
    assert computed.slid and computed.of("von_mises").value == pytest.approx(found.of("von_mises").value, rel=1e-6)


@pytest.mark.parametrize("change, word", [
    ({"interface.kind": "atoms"}, "wall"),
    ({"drive.mode": "dynamic", "drive.path": ["approach"]}, "quasistatic"),
    ({"block.model": "lattice"}, "continuum"),
    ({"output.fields": []}, "output.fields"),
])
def test_what_has_no_stresses(change, word, tmp_path):
    plain = {key: value for key, value in ROUGH.items() if key != "interface"} if "interface.kind" in change else ROUGH
    with pytest.raises(asperity.SceneError, match=word):
        asperity.run(plain, {"output.stress": "section", **change}, out=tmp_path / "run")


def test_the_report_shows_what_was_recorded(rough):
    page = rough.report()
    assert "Stress of von Mises" in page.read_text()
