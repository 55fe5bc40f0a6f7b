# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pages are a site: Sphinx warns of nothing (links and their anchors, pages that no table of contents has,
pictures), and the navigation has what the front page lists."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT

for module, package in {"sphinx": "python3-sphinx", "myst_parser": "python3-myst-parser", "furo": "furo"}.items():
    if not importlib.util.find_spec(module):
        pytest.skip(f"no {module}: apt-get install {package}", allow_module_level=True)


def test_the_site(place):
    done = subprocess.run([sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", "doctrees",
                           ROOT / "docs", "site"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    for page in (ROOT / "docs").rglob("*.md"):
        assert (place / "site" / page.relative_to(ROOT / "docs").with_suffix(".html")).stat().st_size > 0
    for page, texts in {"command-line": ["wall-limit", 'id="sweep"'], "scene": ["lattice_ratio"],
                        "python": ['id="asperity-load-sweep"', 'id="asperity-statics"', "toctree-l1"]}.items():
        html = Path(f"site/reference/{page}.html").read_text()
        assert [text for text in texts if text not in html] == [], page
