# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The factor of Persson and Brener against its closed form for one branch, and its limits."""

import subprocess
import sys

import numpy as np
import pytest

from asperity import SceneError
from asperity.crack import modulus, opening_factor
from conftest import ROOT


@pytest.mark.parametrize("ratio", [0.1, 2.0, 99.0])
def test_one_branch_has_a_closed_form(ratio):
    """∫ √(1 - y²) / (1 + b²y²) dy = (π/2) (√(1 + b²) - 1)/b², so G0/G = 1 - (r/R) (√(1 + b²) - 1)/b, b = R ω_c τ, R = 1 + r."""
    time, tip, whole = 3.0, 0.2, 1 + ratio
    cut = np.geomspace(1e-3, 1e3, 25) / time
    b = whole * cut * time
    factor = 1 / (1 - ratio / whole * (np.sqrt(1 + b * b) - 1) / b)
    velocity = tip * factor * cut / (2 * np.pi) * 100  # 1 Å/ps is 100 m/s
    assert opening_factor([(ratio, time)], velocity, tip) == pytest.approx(factor, rel=2e-4)


def test_limits_of_slow_and_fast():
    prony = [(9.0, 1.0), (1.5, 20.0)]
    slow, fast = opening_factor(prony, [1e-7, 1e9], 1.0)
    assert slow == pytest.approx(1, abs=1e-4)
    assert fast == pytest.approx(11.5, rel=1e-3)
    factors = opening_factor(prony, np.geomspace(1e-4, 1e8, 50), 1.0)
    assert (np.diff(factors) > 0).all()
    assert modulus(prony, 1e9) == pytest.approx(11.5)


@pytest.mark.parametrize("prony, tip", [([], 1.0), ([(-1.0, 1.0)], 1.0), ([(1.0, 0.0)], 1.0), ([(1.0, 1.0)], 0.0)])
def test_nonsense_is_refused(prony, tip):
    with pytest.raises(ValueError, match="above 0"):
        opening_factor(prony, 1.0, tip)


def test_units_are_texts_or_those_of_the_package():
    plain = opening_factor([(9.0, 1000.0), (1.5, 20000.0)], [1.0, 10.0], 20.0)
    assert (opening_factor([(9.0, "1 ns"), (1.5, "20 ns")], ["1 m/s", "0.01 km/s"], "2 nm") == plain).all()
    assert opening_factor([(9.0, "1 ns"), (1.5, "20 ns")], "1 m/s", "2 nm") == plain[0]
    assert modulus([(9.0, "1 ns")], "1 1/ns") == modulus([(9.0, 1000.0)], 1e-3)
    for prony, velocity, tip in (([(1.0, "1 nm")], 1.0, 1.0), ([(1.0, 1.0)], "1 nm", 1.0), ([(1.0, 1.0)], 1.0, "1 m/s")):
        with pytest.raises(SceneError, match="is needed"):
            opening_factor(prony, velocity, tip)


def test_pages_find_what_they_name_after_import_asperity():
    """Every asperity.x.y of a page, in a process of its own that has imported asperity alone."""
    import re

    pages = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("*.md"), *ROOT.glob("examples/*.py"), *ROOT.glob("docs/gallery/*.py")]
    dotted = re.compile(r"(?<![\w./-])asperity(?:\.[A-Za-z_]\w*)+")
    names = {found.split("(")[0] for page in pages for line in page.read_text().splitlines()
             if not re.match(r"\s*(from|import) ", line) for found in dotted.findall(line)}
    names = {n for n in names if not re.search(r"\.(toml|h5|json|readthedocs|org|md|py|sh|html|git|def)$|_engine", n)}
    assert {"asperity.crack.opening_factor", "asperity.plots.style.style", "asperity.run"} <= names
    for name in sorted(names):
        done = subprocess.run([sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT / 'python')!r})\nimport asperity\n{name}"],
                              capture_output=True, text=True)
        assert done.returncode == 0, f"{name}: {done.stderr.splitlines()[-1]}"
