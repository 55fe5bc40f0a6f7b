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
    "pyvisco": {"names": "f_set,E_stor,E_loss\nHz,MPa,MPa", "separator": ",", "scale": (1 / (2 * math.pi), 1.0)},
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
    reptate = text("Mw=1.0;Mw2=1.0;phi=0;isof=0;T0=25.0;", (1.0, 1e6), "\t")  # ω in rad/s, G' and G'' in Pa
    assert difference(fitted(reptate, Path("curve.tts"), nu=0.49), scale=2 * 1.49) < 1e-6
    with pytest.raises(asperity.SceneError, match="say poisson=0.49"):
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
    command("prony", "curve.csv", "rubber.toml", says=["7 branches", "young          2.00 MPa (1.9", "rms error", 'block.prony = "rubber.toml"'])
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


def branched(relaxed, *branches):
    return lambda omega: relaxed * modulus([(ratio, 1e12 * time) for ratio, time in branches], 1e-12 * omega)


def power(relaxed, factor, exponent, most=1e9):
    """A power law ω^n that ends at most times the relaxed modulus, as Cole and Cole have it."""
    return lambda omega: relaxed * (1 + most / (1 + most / (factor * (1j * omega) ** exponent)))


DECADES = [(30 * 10 ** (-0.4 * k), 1e-6 * 10**k) for k in range(9)]
HALVES = [(300 * 10 ** (-0.5 * k), 3.3e-8 * 10 ** (1.3 * k)) for k in range(7)]
OWN = {  # modulus, MPa, over frequency, rad/s; its relaxed value; lowest frequency; noise; what is expected
    "branches a decade apart, plateau": (branched(1.0, *DECADES), 1.0, 1e-4, 0.02, "stated"),
    "branches a decade apart, cut at the slowest": (branched(1.0, *DECADES), 1.0, 1e-2, 0.02, ""),
    "branches a decade apart, cut in the middle": (branched(1.0, *DECADES), 1.0, 1.0, 0.02, "refused"),
    "uneven branches, plateau": (branched(2.0, *HALVES), 2.0, 1e-2, 0.01, "stated"),
    "uneven branches, cut": (branched(2.0, *HALVES), 2.0, 1e-1, 0.01, ""),
    "four branches two decades apart": (branched(2.0, (5, 1e-6), (3, 1e-4), (1, 1e-2), (0.5, 1)), 2.0, 1e-3, 0.02, "stated"),
    "four branches, cut between two": (branched(2.0, (5, 1e-6), (3, 1e-4), (1, 1e-2), (0.5, 1)), 2.0, 10.0, 0.02, "refused"),
    "square root, plateau": (power(1.0, 10.0, 0.5, 1000.0), 1.0, 1e-8, 0.02, "stated"),
    "square root, cut at a loss tangent of 0.07": (power(1.0, 10.0, 0.5, 1000.0), 1.0, 1e-4, 0.02, ""),
    "square root, cut at a loss tangent of 0.9": (power(1.0, 10.0, 0.5, 1000.0), 1.0, 63.0, 0.02, "refused"),
    "slow power law": (power(1.0, 0.3, 0.2), 1.0, 1e-6, 0.0, ""),
    "very slow power law": (power(60.0, 1.0, 0.1), 60.0, 1e-3, 0.03, "refused"),
    "a liquid": (lambda omega: branched(1.0, *HALVES)(omega) - 1.0, 0.0, 1e-2, 0.01, "refused")}


@pytest.mark.parametrize("name", OWN)
def test_the_interval_of_the_relaxed_modulus_covers_it(place, name):
    """A curve that does not determine the relaxed modulus is refused with the reason; with the modulus stated it has branches."""
    curve, relaxed, lowest, noise, expected = OWN[name]
    omega = np.geomspace(lowest, 1e6, round(5 * math.log10(1e6 / lowest)) + 1)
    draw = np.random.default_rng(7).standard_normal((2, len(omega)))
    moduli = curve(omega).real * (1 + noise * draw[0]) + 1j * curve(omega).imag * (1 + noise * draw[1])
    content = text(moduli=moduli, omega=omega)
    try:
        found = fitted(content)
    except asperity.InputOutputError as refused:
        assert expected != "stated" and "relaxed modulus" in str(refused), refused
        assert "relaxed=" in str(refused) or "flow" in str(refused)
        if not relaxed:
            return
        found = fitted(content, relaxed=f"{relaxed} MPa")
        assert found.stated and found.young == pytest.approx(1e-3 * relaxed) and found.rms_error < max(0.06, 1.5 * noise)
        return
    low, high = found.young_range
    assert expected != "refused" and low <= 1e-3 * relaxed <= high <= 2 * low and low <= found.young <= high
    assert any("(relaxed)" in note for note in found.notes) == (found.loss[0] > 0.02 * found.storage[0])


def test_cuts_of_one_curve_state_intervals_that_meet(place):
    """Wherever a curve is cut, what is stated covers the same modulus: no cut states a number that another one denies."""
    for lowest in np.geomspace(1e-9, 1e2, 9):
        omega = np.geomspace(lowest, 1e6, round(4 * math.log10(1e6 / lowest)) + 1)
        try:
            low, high = fitted(text(moduli=power(1.0, 10.0, 0.5, 1000.0)(omega), omega=omega), branches=8).young_range
        except asperity.InputOutputError as refused:
            assert "relaxed=" in str(refused)
            continue
        assert low <= 1e-3 <= high


def test_a_stated_modulus_leaves_the_measured_moduli_alone(place):
    """What the data cannot know does not change what they say."""
    omega = np.geomspace(1.0, 1e8, 41)
    content = text(moduli=2.0 * modulus(BRANCHES, 1e-12 * omega), omega=omega)
    found = [fitted(content, relaxed=one) for one in ("2 MPa", "1 MPa")]
    assert np.abs(found[0].modulus(omega) / found[1].modulus(omega) - 1).max() < 0.05
    assert "1 MPa, as stated (0 to" in found[1].toml


def test_the_fast_end_has_its_word(place):
    whole, cut = (fitted(text(moduli=2.0 * modulus(BRANCHES, 1e-12 * omega), omega=omega)).notes
                  for omega in (np.geomspace(1e-2, 1e11, 53), OMEGA))
    assert not any("at once" in note for note in whole)
    assert any("at the highest frequency" in note and "at once" in note for note in cut)


def test_the_plot_has_measured_and_fitted_moduli(place):
    axes = fitted(text()).plot()
    assert axes.get_xscale() == axes.get_yscale() == "log" and len(axes.lines) == 4
