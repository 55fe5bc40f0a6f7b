# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Branches from a master curve: exports of several forms give the same numbers, known branches are found again, and what is no
curve of a solid is refused with what to do about it."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.theories.viscoelastic import modulus
from conftest import command

BRANCHES = [(300 * 10 ** (-0.5 * k), 1e12 * 3.3e-8 * 10 ** (1.3 * k)) for k in range(7)]  # times between those of a first look
OMEGA = np.geomspace(1e-2, 1e8, 41)
MODULI = 2.0 * modulus(BRANCHES, 1e-12 * OMEGA)  # MPa


def text(names="frequency (rad/s), E' (MPa), E'' (MPa)", scale=(1.0, 1.0), separator=", ", decimal=".", moduli=MODULI, omega=OMEGA, extra=()):
    rows = [[w * scale[0], m.real * scale[1], m.imag * scale[1], *extra] for w, m in zip(omega, moduli)]
    return names + "\n" + "\n".join(separator.join(f"{number:.12g}".replace(".", decimal) for number in row) for row in rows) + "\n"


def fitted(content, place=Path("curve.csv"), encoding="utf-8", **options):
    place.write_bytes(content.encode(encoding))
    return asperity.prony(place, **options)


def difference(found, omega=np.geomspace(1e-2, 1e8, 301), scale=1.0):
    """Largest relative difference from the moduli of the known branches."""
    known = 2e-3 * scale * modulus(BRANCHES, 1e-12 * omega)
    return np.abs(found.modulus(omega) / known - 1).max()


EXPORTS = {
    "commas": {},
    "hertz": {"names": "f [Hz], E' [MPa], E'' [MPa]", "scale": (1 / (2 * math.pi), 1.0)},
    "units in the next line": {"names": "Sample: SBR 1, 20 °C\nAngular frequency\tStorage modulus E'\tLoss modulus E''\nrad/s\tPa\tPa",
                               "separator": "\t", "scale": (1.0, 1e6)},
    "decimal commas": {"names": "Frequenz (Hz);Speichermodul E′ (GPa);Verlustmodul E″ (GPa)", "separator": ";", "decimal": ",",
                       "scale": (1 / (2 * math.pi), 1e-3)},
    "decimal commas between blanks": {"names": "omega (rad/s)  E' / MPa  E'' / MPa", "separator": "  ",
                                      "decimal": ","},
    "units behind a stroke": {"names": "#f_red/Hz;E'/MPa;E''/MPa;tan(d)", "separator": ";", "scale": (1 / (2 * math.pi), 1.0), "extra": (0.5,)},
    "quotes": {"names": '"Frequency (rad/s)","Storage Modulus - E\' (MPa)",E" (MPa)', "separator": ","},
    "a unit behind each name": {"names": "w (rad/s) E' (MPa) E'' (MPa)", "separator": " "},
    "a comment": {"names": "# T = 20 °C\n# omega (rad/s)   E' (kPa)   E\" (kPa)", "separator": " ", "scale": (1.0, 1e3)},
    "shift factors": {"names": "Temp. (°C); Frequency (rad/s); E' (MPa); E'' (MPa); aT", "extra": ()},
}


@pytest.mark.parametrize("name", EXPORTS)
def test_exports_of_several_forms_give_the_same_branches(place, name):
    given = dict(EXPORTS[name])
    if name == "shift factors":
        rows = "\n".join(f"{20 + k}; {w / 10**(k - 20)}; {m.real}; {m.imag}; {10.0**(k - 20)}" for k, (w, m) in enumerate(zip(OMEGA, MODULI)))
        content = given["names"] + "\n" + rows
    else:
        content = text(**given)
    found = fitted(content, encoding="utf-16" if name == "decimal commas" else "utf-8")
    assert found.rms_error < 1e-6 and difference(found) < 1e-6
    assert found.young == pytest.approx(2e-3, rel=1e-6)


def test_known_branches_are_found_again(place):
    found = fitted(text())
    assert [time for _, time in found.prony] == pytest.approx([time for _, time in BRANCHES], rel=1e-6)
    tan = fitted(text("omega (rad/s), E' (MPa), tan δ", moduli=MODULI.real + 1j * MODULI.imag / MODULI.real))
    assert difference(tan) < 1e-6 and "tan δ" in tan.notes[0]
    logarithms = fitted(text("log omega (rad/s), log E' (MPa), log E'' (MPa)", omega=np.log10(OMEGA),
                             moduli=np.log10(MODULI.real) + 1j * np.log10(MODULI.imag)))
    assert difference(logarithms) < 1e-6


def test_hertz_and_radians_differ_by_a_whole_turn(place):
    turned = fitted(text("f (Hz), E' (MPa), E'' (MPa)"))
    assert [time for _, time in turned.prony] == pytest.approx([time / (2 * math.pi) for _, time in BRANCHES], rel=1e-6)


def test_shear_moduli_become_youngs_by_poissons_ratio(place):
    content = text("omega (rad/s), G' (MPa), G'' (MPa)")
    assert difference(fitted(content, nu=0.49), scale=2 * 1.49) < 1e-6
    with pytest.raises(asperity.SceneError, match="--poisson"):
        fitted(content)


def test_noise_is_the_error_of_the_fit(place):
    noise = 0.02 * np.random.default_rng(3).standard_normal((2, 201))
    omega = np.geomspace(1e-2, 1e8, 201)
    exact = 2.0 * modulus(BRANCHES, 1e-12 * omega)
    found = fitted(text(moduli=exact.real * (1 + noise[0]) + 1j * exact.imag * (1 + noise[1]), omega=omega))
    assert found.rms_error == pytest.approx(0.02, rel=0.15) and difference(found) < 0.03
    few = fitted(text(), branches=5)
    assert len(few.prony) <= 5 and few.rms_error > 0.05 and "take more branches" in few.notes[-1]


FALLING = MODULI.real[::-1] + 1j * MODULI.imag
TWO = text("f (Hz), E' (MPa), E'' (MPa), omega (rad/s)", scale=(1 / (2 * math.pi), 1.0)).splitlines()
TWO = "\n".join([TWO[0], *(f"{line}, {w:.12g}" for line, w in zip(TWO[1:], OMEGA))]) + "\n"
REFUSED = {
    "is no master curve": "nothing\n", "does not say what its columns are": text("a, b, c"), "has too few points": text(omega=OMEGA[:4]),
    "does not say the unit of 'frequency'": text("frequency, E' (MPa), E'' (MPa)"),
    "does not say the unit of 'E''": text("frequency (Hz), E', E'' (MPa)"), "has no loss modulus": text("frequency (Hz), E' (MPa), x"),
    "the storage modulus falls by": text(moduli=FALLING), "the loss modulus is -": text(moduli=MODULI.conj()),
    "may be": text("frequency (Hz), storage modulus (MPa), loss modulus (MPa)"),
    "is not described by branches": text(moduli=2 + 1j * np.ones(41)), "has no relaxed modulus": text(moduli=MODULI - 2),
    "several temperatures": "T (°C); f (Hz); E' (MPa); E'' (MPa)\n" + "\n".join(f"{20 + k};{k + 1};{10 + k};1" for k in range(9)),
    "the commas may be decimal points": text(separator=",", decimal=","), "is no row of numbers": text() + "1, two, 3\n",
    "the line has too few numbers": text() + "1, 2\n", "two frequencies that differ": TWO.replace("f (Hz)", "f (kHz)")}


@pytest.mark.parametrize("says", REFUSED)
def test_what_is_no_curve_of_a_solid_is_refused(place, says):
    with pytest.raises(asperity.InputOutputError) as refused:
        fitted(REFUSED[says])
    assert says in str(refused.value) and "fix: " in str(refused.value)


def test_what_the_messages_advise_works(place):
    assert difference(fitted(text("a, b, c"), frequency_unit="rad/s", modulus_unit="MPa", modulus="E")) < 1e-6
    assert difference(fitted(text("frequency, E' (MPa), E'' (MPa)"), frequency_unit="rad/s")) < 1e-6
    assert difference(fitted(text("omega (rad/s), storage modulus (MPa), loss modulus (MPa)"), modulus="E")) < 1e-6
    assert difference(fitted(text("omega (rad/s), E', E''"), modulus_unit="MPa")) < 1e-6


def test_a_scene_takes_the_file(place):
    """Its numbers are those of the scene from then on: the file may be gone."""
    Path("curve.csv").write_text(text())
    command("prony", "curve.csv", "rubber.toml", says=["7 branches", "young          2 MPa", "rms error", 'block.prony = "rubber.toml"'])
    assert Path("rubber.svg").exists()
    command("prony", "curve.csv", "rubber.toml", expect=2, says="rubber.svg")
    told = json.loads(command("prony", "curve.csv", "again.toml", "--json", "--branches", "9"))
    assert told["block"]["young"] == pytest.approx(2e-3) and told["fit"]["rms_error"] < 1e-6
    scene = '[surface]\nsites = 16\nrms = 0\n[block]\nprony = "rubber.toml"\nthickness = 8\n[interface]\nkind = "wall"\nadhesion = 0\n' \
            '[drive]\nmode = "quasistatic"\ncontrol = "mean-height"\nload = "1 kPa"\npath = ["approach", "hold 1 ns"]\n'
    Path("scene.toml").write_text(scene)
    checked = asperity.check("scene.toml")
    assert checked.scene.block.young == pytest.approx(2e-3) and len(checked.scene.block.prony) == 7
    assert np.array(checked.scene.block.prony)[:, 1] == pytest.approx([time for _, time in BRANCHES], rel=1e-6)
    assert any('block.prony: "rubber.toml" is a fit of curve.csv' in note for note in checked.notes)
    other = asperity.check("scene.toml", {"block.young": "3 MPa"})
    assert other.scene.block.young == pytest.approx(3e-3) and any("holds over the 0.002 GPa" in note for note in other.notes)
    run = asperity.run("scene.toml", out="run")
    assert run.block.prony_file == "rubber.toml" and run.block.prony_error < 1e-6
    Path("rubber.toml").write_text("[block]\nyoung = 0.002\nprony = [[1.0, 0]]\nfrequency = 1\n")
    with pytest.raises(asperity.SceneError) as refused:
        asperity.check("scene.toml")
    assert "rubber.toml:3:9" in str(refused.value) and "rubber.toml:4:1" in str(refused.value)
    Path("rubber.toml").write_text("[block]\nprony = [[1.0, 10]]\n")
    with pytest.raises(asperity.SceneError, match="has no block.young"):
        asperity.check("scene.toml")
    Path("rubber.toml").unlink()
    with pytest.raises(asperity.SceneError, match="there is no such file"):
        asperity.check("scene.toml")


def test_the_plot_has_measured_and_fitted_moduli(place):
    axes = fitted(text()).plot()
    assert axes.get_xscale() == axes.get_yscale() == "log" and len(axes.lines) == 4
