# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pages are a site: Sphinx warns of nothing (links and their anchors, pages that no table of contents has,
docstrings, files of tables and pictures), and the generated parts of the reference are in it. Links between all
Markdown files lead somewhere."""

import importlib.util
import os
import re
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
                        "python": ['id="asperity.load_sweep"', 'id="asperity.Statics'],
                        "cpp": ["set_top_velocity", 'id="statics"']}.items():
        html = Path(f"site/reference/{page}.html").read_text()
        assert [text for text in texts if text not in html] == [], page
    assert "inside_" not in Path("site/reference/cpp.html").read_text()  # what is private


def headings(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for title in re.findall(r"^#+ +(.*)", text, re.M):
        title = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title).replace("`", "")
        yield re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def test_links_between_markdown_files():
    links, wrong = 0, []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [f for f in folders if f not in ("results", "node_modules") and not f.startswith(("build", "."))]
        for file in (Path(folder, name) for name in names if name.endswith(".md")):
            for target, anchor in re.findall(r"\]\((?!\w+:)([^)#\s]*)(?:#([^)]*))?\)", file.read_text()):
                links += 1
                path = file.parent / target if target else file
                if not path.exists() or anchor and anchor not in headings(path.read_text()):
                    wrong.append(f"{file}: {target}#{anchor} leads nowhere")
    assert not wrong and links > 100
