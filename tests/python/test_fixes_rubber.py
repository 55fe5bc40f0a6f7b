# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whoever follows the fix of a message about a master curve, its fit, or the file of block.prony has branches."""

import re
from pathlib import Path

import numpy as np
import pytest

import asperity
from following import followed, not_followed
from test_prony import MODULI, OMEGA, REFUSED, TWO, fitted, text

SOURCES = ("maps/master_curve.py", "maps/columns.py", "studies/prony.py", "scene/scene_files")
EXCUSED = {"cannot be read...check the path and its permissions": "whoever tests may read all files, and finds those that he names"}
NAMES, SHEAR = "omega (rad/s), E' (MPa), E'' (MPa)", "omega (rad/s), G' (MPa), G'' (MPa)"
FEW = text(omega=OMEGA[:7], moduli=MODULI[:7])
CUT = text(omega=OMEGA[10:], moduli=MODULI[10:])
BENT = text(moduli=np.where(np.arange(41) == 20, 1.5, MODULI.real) + 1j * MODULI.imag)

CASES = (  # what is said, the bad call, the good one
    ("take it out, or put a # before it", (text() + "1, two, 3\n", {}), (text() + "# 1, two, 3\n", {})),
    ("fill the row, or take it out", (text() + "1, 2\n", {}), (text(), {})),
    ("separate the cells by tabs or semicolons", (text(separator=",", decimal=","), {}),
     (text(NAMES.replace(",", ";"), separator=";", decimal=","), {})),
    ("give a text of columns: frequency, E', E''", ("nothing\n", {}), (text(), {})),
    ("name them: ", (text("a, b, c"), {}), (text("frequency (Hz), E' (MPa), E'' (MPa)"), {})),
    ("--frequency-unit Hz --modulus-unit MPa --modulus E", (text("a, b, c"), {}),
     (text("a, b, c"), {"frequency_unit": "Hz", "modulus_unit": "MPa", "modulus": "E"})),
    ("export it, too", (REFUSED["has no loss modulus"], {}), (text(), {})),
    ("for example (Hz)", (text(), {"frequency_unit": "rpm"}), (text(), {"frequency_unit": "{0}"})),
    ("for example (MPa)", (text(), {"modulus_unit": "m"}), (text(), {"modulus_unit": "{0}"})),
    (r"write it behind the name, as in '(.*)', or say", (text("omega, E' (MPa), E'' (MPa)"), {}), (text("{0}, E' (MPa), E'' (MPa)"), {})),
    ("--frequency-unit (Hz)", (text("omega, E' (MPa), E'' (MPa)"), {}), (text("omega, E' (MPa), E'' (MPa)"), {"frequency_unit": "{0}"})),
    ("take the row out, or export it again", (text() + "0, 1, 1\n", {}), (text(), {})),
    ("export the master curve, or its shift factors with it", (REFUSED["several temperatures"], {}), (text(), {})),
    ("take one of the two columns out, or correct its unit", (REFUSED["two frequencies that differ"], {}), (TWO, {})),
    ("measure more", (REFUSED["has too few points"], {}), (text(), {})),
    ("take these rows out", (BENT, {}), ("".join(BENT.splitlines(True)[:21] + BENT.splitlines(True)[22:]), {})),
    ("say --modulus (E)", (text("omega (rad/s), storage modulus (MPa), loss modulus (MPa)"), {}),
     (text("omega (rad/s), storage modulus (MPa), loss modulus (MPa)"), {"modulus": "{0}"})),
    ("say --poisson (0.49)", (text(SHEAR), {}), (text(SHEAR), {"poisson": 0.49})),
    ("for example --poisson 0.49", (text(SHEAR), {"poisson": 0.5}), (text(SHEAR), {"poisson": 0.49})),
    ("for example --branches 8", (text(), {"branches": 31}), (text(), {"branches": 8})),
    (r"say --branches (\d+), or less", (FEW, {"branches": 9}), (FEW, {"branches": 3})),
    ("look whether the columns are what their names say", (REFUSED["is not described by branches"], {}), (text(), {})),
    ("leave out the rows that flow", (text(moduli=MODULI - 2), {}), (text(), {})),
    (r"for example --relaxed (\S+): within", (CUT, {}), (CUT, {"relaxed": "{0}"})),
    (r"for example --relaxed (2MPa)", (CUT, {"relaxed": "2"}), (CUT, {"relaxed": "{0}"})),
    (r"say --relaxed (\S+), or less", (CUT, {"relaxed": "9 MPa"}), (CUT, {"relaxed": "{0}"})),
    ("say E of Young's moduli, G of shear moduli", (text(), {"modulus": "Y"}), (text(), {"modulus": "E"})),
    (r"for example (\S+\.toml)", (text(), {"target": "rubber.dat"}), (text(), {"target": "{0}"})))


@pytest.mark.parametrize("says, bad, good", CASES, ids=[case[0][:40] for case in CASES])
def test_a_fix_of_a_master_curve(place, says, bad, good):
    with pytest.raises(asperity.Error) as error:
        fitted(bad[0], **bad[1])
    said = str(error.value)
    found = re.search(says, said)
    assert found, said

    def put(value):
        return value.replace("{0}", found[1]) if isinstance(value, str) and "{0}" in value else value

    assert fitted(put(good[0]), **{name: put(value) for name, value in good[1].items()}).prony
    followed(said)


def test_the_file_of_a_scene(place):
    Path("scene.toml").write_text('[block]\nprony = "rubber.toml"\n[interface]\nkind = "wall"\n[drive]\nmode = "quasistatic"\n')
    for content in (None, "[block]\nprony = [[1.0, 10]]\n"):
        Path("rubber.toml").unlink(missing_ok=True)
        if content is not None:
            Path("rubber.toml").write_text(content)
        with pytest.raises(asperity.SceneError, match="`asperity prony`") as error:
            asperity.check("scene.toml")
        Path("rubber.toml").unlink(missing_ok=True)
        fitted(text(), target="rubber.toml")
        assert len(asperity.check("scene.toml").scene.block.prony) == 7
        followed(str(error.value))


def test_every_message_is_followed():
    left = not_followed(SOURCES, EXCUSED)
    assert not left, "\n".join(left)
