# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A sample that yields: the sphere's closed forms, what an instrument reads from them, and the commands with a hardness."""

import math

import numpy as np
import pytest

import asperity
from asperity.reports import tip as report_tip
from asperity.studies.tip import Contact, plan_of
from asperity.theories.indentation import Indenter, path
from asperity.theories.yielding import EPSILON, YieldingSphere, oliver_pharr
from conftest import in_this_process
from test_tip import NOT_GIVEN

pytestmark = pytest.mark.usefixtures("light_module")

TIP = {"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "1 mJ/m2", "stiffness": "20 N/m", "range": "0.3 nm", "hardness": "0.1 GPa"}


def test_a_power_law_is_read_exactly():
    """P = B (h - h_f)^m has the slope m P/(h - h_f), from which the rest follows."""
    for exponent, end in ((1.2, 3.0), (1.5, 0.5), (2.0, 1.0)):
        depth = np.linspace(4.0, end, 200)
        force = 7.0 * (depth - end)**exponent
        read = oliver_pharr(50.0, depth, force)
        slope = exponent * force[0] / (4.0 - end)
        assert read.slope == pytest.approx(slope, rel=1e-5) and read.exponent == pytest.approx(exponent, rel=1e-4)
        assert read.fitted_depth == pytest.approx(end, abs=1e-4)
        contact = 4.0 - EPSILON * force[0] / slope
        area = math.pi * (100.0 * contact - contact**2)
        assert read.area == pytest.approx(area, rel=1e-5) and read.hardness == pytest.approx(force[0] / area, rel=1e-5)
        assert read.modulus == pytest.approx(0.5 * math.sqrt(math.pi / area) * slope, rel=1e-5)


def test_an_elastic_sphere_has_its_modulus_and_no_residual_depth():
    curve = path(Indenter("paraboloid", 500.0), "hertz", 70.0, 0.0, 300.0)
    read = oliver_pharr(500.0, curve.depth[::-1], curve.force[::-1])
    assert read.exponent == pytest.approx(1.5, rel=1e-3) and abs(read.fitted_depth) < 1e-3 * curve.depth[-1]
    assert read.modulus == pytest.approx(70.0, rel=5e-3) and read.contact_depth == pytest.approx(0.5 * curve.depth[-1], rel=1e-3)


@pytest.mark.parametrize("loads, hardness", [(30, 0.970), (100, 0.987), (300, 1.004)])
def test_a_contact_at_the_hardness_is_read_within_some_per_cent(loads, hardness):
    """The rule's depth of the edge, 0.75 P/S, is that of a paraboloid; of a uniform pressure it is (8/π²) P/S."""
    sphere = YieldingSphere(500.0, 94.7, 1.0)
    curve = sphere.unloading(loads * sphere.first_yield)
    read = oliver_pharr(500.0, curve.depth[::-1], curve.force[::-1])
    assert read.hardness == pytest.approx(hardness * sphere.hardness, rel=2e-3)
    assert read.modulus == pytest.approx(sphere.modulus, rel=0.02)
    # dF/d(depth) of a contact of radius r is 2 E* r.
    slope = np.gradient(curve.force, curve.depth)[100:-100]
    np.testing.assert_allclose(slope, 2 * sphere.modulus * curve.radius[100:-100], rtol=2e-3)


@pytest.mark.parametrize("om, pull_off", [(0.001, 0.00149), (0.01, 0.01453), (0.03, 0.0422), (0.1, 0.1305), (0.3, 0.3440), (1, 0.900)])
def test_the_pull_off_is_that_of_the_set(om, pull_off):
    load = math.pi * 50.0**2
    assert YieldingSphere(300.0, 80.0, 1.0, om * 50.0 / 80.0).pull_off(load) == pytest.approx(pull_off * load, rel=5e-3)


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    place = tmp_path_factory.mktemp("yielding") / "tip"
    return asperity.tip(**TIP, sites=24, out=place), place


def test_a_tip_leaves_its_set(pressed):
    """Numbers are those of a contact that is all at the hardness, within the errors of the mesh and 3 % for what the forms leave out:
    adhesion, slopes and the edge that is not at the hardness yet."""
    found, place = pressed
    contact, load = found.contact, float(found.force.max())
    sphere = YieldingSphere(contact.radius, contact.modulus, contact.hardness, contact.work)
    curve, radius = sphere.unloading(load), math.sqrt(load / (math.pi * contact.hardness))
    assert load == pytest.approx(30 * sphere.first_yield, rel=0.03)
    depth = float(curve.depth[-1])
    forms = {"largest_depth": depth, "largest_set": depth - 2 * contact.hardness * radius / contact.modulus, "hardness": contact.hardness,
             "modulus": contact.modulus, "plastic_work": load * depth - math.pi * contact.hardness * radius**4 / (4 * contact.radius)
             - 16 * contact.hardness**2 * radius**3 / (3 * contact.modulus)}
    for name, form in forms.items():
        number = found.number(name)
        assert abs(number.estimate - form) < 2 * number.error + 0.05 * form, (str(number), form)
        assert number.error < 0.1 * form, str(number)
    assert 0 < found.number("residual_depth").estimate < found.number("largest_depth").estimate
    assert found.fit.failed and found.unloading is not None and not found.unloading.failed
    again = asperity.load_tip(place)
    assert again.contact.hardness == contact.hardness and again.unloading.hardness == pytest.approx(found.unloading.hardness, rel=1e-6)
    text = report_tip.text_of(found)
    assert "Oliver and Pharr" in text and "a cap on the pressure" in text and "JKR fitted" not in text
    assert (place / "report/indentation.svg").exists()


def test_the_command_says_the_same(pressed):
    found, place = pressed
    words = [word for name, value in TIP.items() for word in (f"--{name}", str(value))]
    code, said, _ = in_this_process(["tip", *words, "--sites", "24", "-o", str(place), "--json"])
    assert code == 0 and f'"hardness": {found.contact.hardness}' in said
    assert f'"contact_depth": {found.unloading.contact_depth}' in said


def test_a_harder_load_is_steep_and_said(tmp_path):
    given = NOT_GIVEN | TIP
    plan = plan_of(None, tmp_path / "plan", given)
    assert plan.load == pytest.approx(30 * plan.contact.first_yield, rel=0.02) and plan.scenes[""].read_text().count("hardness = 0.1") == 1
    assert Contact(20.0, 3.3, 0.001, 0.3, 2.0, hardness=0.1).radius_at(5.7) == pytest.approx(math.sqrt(5.7 / (0.1 * math.pi)), rel=0.02)
    with pytest.raises(asperity.SceneError, match="gently sloped"):
        plan_of(None, tmp_path / "steep", given | {"load": "100 nN"})
    with pytest.raises(asperity.SceneError, match="those of a sphere"):
        plan_of(None, tmp_path / "cone", given | {"shape": "cone", "angle": 65.0})
    assert not (tmp_path / "steep").exists() and not (tmp_path / "cone").exists()


@pytest.mark.parametrize("value, words", [("1", "has no unit"), ("0 GPa", "hardness"), ("none", "no hardness above zero"), ("3 nm", "hardness"),
                                          ("stripes 1 GPa 2 GPa 3 nm", "no hardness above zero")])
@pytest.mark.parametrize("of", ["tip", "adhesion"])
def test_what_is_no_hardness_is_refused(tmp_path, of, value, words):
    np.save(tmp_path / "map.npy", np.random.default_rng(1).normal(size=(16, 16)))
    given = {**TIP, "hardness": value}
    with pytest.raises(asperity.SceneError) as refused:
        if of == "tip":
            asperity.tip(**given, out=tmp_path / "out")
        else:
            asperity.adhesion(tmp_path / "map.npy", young="5 GPa", poisson=0.3, adhesion="50 mJ/m2", size="10 nm", unit="Å", hardness=value,
                              out=tmp_path / "out")
    assert words in str(refused.value) and "fix:" in str(refused.value) and "interface." not in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_a_map_yields_under_its_attraction(tmp_path):
    """Share at the hardness, set, plastic work and pull-off with their errors; without a hardness none of the first three."""
    heights = asperity.run({"surface": {"sites": 16, "spacing": 5, "rms": 2.0, "q_max": 4, "seed": 3}, "block": {"thickness": 16},
                            "interface": {"kind": "wall"}, "drive": {"path": ["relax"]}}, out=tmp_path / "made").substrate["height"]
    np.save(tmp_path / "map.npy", heights)
    given = {"young": "5 GPa", "poisson": 0.3, "adhesion": "200 mJ/m2", "size": "8 nm", "unit": "Å", "range": "3 Å"}
    soft = asperity.adhesion(tmp_path / "map.npy", **given, hardness="0.5 GPa", out=tmp_path / "soft")
    share, largest, plastic = (soft.estimate.number(name) for name in ("yielding.largest_fraction", "yielding.largest_set",
                                                                      "dissipated_in_surface.cycle"))
    run = soft.result
    assert share.value == max(one["yielding_fraction"] for one in run["segments"]) > 0
    assert largest.value == run.number("yielding.largest_set") > 0 and plastic.value == run.number("dissipated_in_surface.cycle") > 0
    assert all(number.parts and number.error > 0 for number in (share, largest, plastic)) and "pull_off_stress" in soft.estimate.numbers
    assert "A_H/A₀" in str(soft.estimate)
    # A preload leaves a larger set, and a contact that sticks more strongly; its numbers say after which load.
    pressed = asperity.adhesion(tmp_path / "map.npy", **given, hardness="0.5 GPa", load="0.2 GPa", out=tmp_path / "pressed")
    assert max(one["pressure"] for one in pressed.result["segments"]) == pytest.approx(200, rel=1e-3)
    for name in ("yielding.largest_set", "dissipated_in_surface.cycle", "pull_off_stress"):
        assert pressed.estimate.number(name).value > 1.05 * soft.estimate.number(name).value, name
    assert pressed.estimate.number("pull_off_stress").condition == "for a range of 0.3 nm, after a load of 200 MPa"
    for load, words in (("0.6 GPa", "hardness"), ("3", "has no unit"), ("-1 MPa", "no pressure above zero"), ("5 nN", "no pressure above zero")):
        with pytest.raises(asperity.SceneError) as refused:
            asperity.adhesion(tmp_path / "map.npy", **given, hardness="0.5 GPa", load=load, out=tmp_path / "none")
        assert words in str(refused.value) and "drive." not in str(refused.value) and "interface." not in str(refused.value)
    assert any("more than the hardness" in note for note in soft.notes)  # 200 mJ/m² over 3 Å
