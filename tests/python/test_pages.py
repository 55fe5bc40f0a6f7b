# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The Markdown pages as a code host shows them: by a CommonMark renderer with tables, nothing of Sphinx is left in the
text and every link leads somewhere. What is generated (tables, the references) is current."""

import os
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

import pytest

from asperity.commands.scenes import title
from conftest import ROOT

markdown_it = pytest.importorskip("markdown_it", reason="no markdown_it: apt-get install python3-markdown-it")
RENDERER = markdown_it.MarkdownIt("commonmark").enable("table")


def pages():
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [f for f in folders if f not in ("results", "node_modules") and not f.startswith(("build", "."))]
        yield from (Path(folder, name) for name in names if name.endswith(".md"))


PAGES = sorted(pages())


def anchors(page):
    """Of the headings, as code hosts make them."""
    tokens = RENDERER.parse(page.read_text())
    for opening, inline in zip(tokens, tokens[1:]):
        if opening.type == "heading_open":
            title = "".join(part.content for part in inline.children if part.type in ("text", "code_inline"))
            yield re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def links(tokens):
    for token in tokens:
        yield from (value for name, value in token.attrs.items() if name in ("href", "src"))
        yield from links(token.children or [])


def formulas(text):
    """Of a paragraph: each with the character before and behind it."""
    text = re.sub(r"`[^`]*`", lambda code: "x" * len(code[0]), text)
    for found in re.finditer(r"(?s)(\$\$?)(.+?)\1", text):
        yield text[:found.start()][-1:], found[0], text[found.end():][:1]


def words_of_sphinx(text):
    """Directives, their options and roles in what a reader sees, and formulas that a code host does not show."""
    for token in RENDERER.parse(text):
        if token.type == "fence" and (token.info.startswith("{") or re.search(r"^:[\w-]+:", token.content, re.M)):
            yield token.info
        if token.type == "inline":
            shown = "".join("\n" if "break" in part.type else part.content if part.type == "text" else "`" * (part.type == "code_inline")
                            for part in token.children)
            yield from re.findall(r"^:{3,}.*|^:[\w-]+:.*|\{[\w:]+\}`|^\.\. \w+::.*", shown, re.M)
            for before, formula, behind in formulas(token.content):
                inner = formula.strip("$")
                if formula not in shown:  # an emphasis or an escape to CommonMark
                    yield formula
                if not formula.startswith("$$") and (inner != inner.strip() or re.match(r"\w", before) or re.match(r"\w", behind)):
                    yield before + formula + behind


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_a_page_reads_anywhere(page):
    text = page.read_text()
    assert list(words_of_sphinx(text)) == []
    for target in links(RENDERER.parse(text)):
        if re.match(r"\w+:", target):
            continue
        file, _, anchor = unquote(target).partition("#")
        there = page.parent / file if file else page
        assert there.exists(), f"{target} leads nowhere"
        assert not anchor or anchor in anchors(there), f"{target}: there is no such heading"


@pytest.mark.parametrize("text", ["```{csv-table}\n:file: a.csv\n```\n", ":::{note}\nx\n:::\n", "a {math}`x` b\n",
                                  "half$x$\n", ".. automodule:: asperity\n"])
def test_what_a_code_host_would_not_show_is_found(text):
    assert list(words_of_sphinx(text))


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_a_table_has_eight_columns_at_most(page):
    tokens = RENDERER.parse(page.read_text())
    heads = [i for i, token in enumerate(tokens) if token.type == "thead_open"]
    wide = [tokens[i].map[0] + 1 for i in heads if sum(t.type == "th_open" for t in tokens[i:tokens.index(next(
        t for t in tokens[i:] if t.type == "thead_close"))]) > 8]
    assert wide == [], f"{page.name}: lines of tables of more than eight columns"


def test_tables_are_those_of_their_files():
    done = subprocess.run([sys.executable, ROOT / "docs/tables.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_table_takes_some_rows_and_columns(tmp_path):
    (tmp_path / "a.csv").write_text("x,y,z\n1,2,3\n4,5,6\n7,8,9\n10,11,12\n")
    page = tmp_path / "a.md"

    def written(mark, *options):
        page.write_text(f"above\n\n<!-- table: {mark} -->\n<!-- end of table -->\n\nbelow\n")
        return subprocess.run([sys.executable, ROOT / "docs/tables.py", *options, page], capture_output=True, text=True)

    assert written("a.csv rows=1,3-4 columns=3,1").returncode == 0
    assert re.findall(r"^\|.*", page.read_text(), re.M) == ["| z | x |", "|---|---|", "| 3 | 1 |", "| 9 | 7 |", "| 12 | 10 |"]
    assert page.read_text().startswith("above\n\n<!-- table: a.csv rows=1,3-4 columns=3,1 -->\n")
    assert written("a.csv rows=2", "--check").returncode == 1 and "a.md" in written("a.csv", "--check").stderr
    for mark in ("a.csv rows=5", "a.csv rows=0", "a.csv columns=2-4", "a.csv row=1", "a.csv rows=a", "a.csv rows=3-2"):
        assert written(mark).returncode == 1 and page.read_text().count("|") == 0, mark


WORDS_OF_THE_FIELD = ("adhesion", "contact mechanics", "rough surface", "friction", "rubber", "viscoelastic", "AFM", "tip", "sphere",
                      "JKR", "Persson", "pull-off", "contact area", "hysteresis", "atomistic", "continuum", "periodic", "molecular dynamics",
                      "elastic", "quasi-static", "GPU", "CUDA", "MPI", "SLURM", "memory", "wheel", "Python", "load", "spectrum",
                      "Contact-Mechanics Challenge")


def test_a_search_finds_the_words_of_the_field():
    """Each is in a heading, or in the first lines of a page."""
    found = ""
    for page in PAGES:
        lines = page.read_text().splitlines()
        found += "\n".join(lines[:12] + [line for line in lines if line.startswith("#")]).lower() + "\n"
    assert len(WORDS_OF_THE_FIELD) == 30
    assert [word for word in WORDS_OF_THE_FIELD if word.lower() not in found] == []


def test_every_scene_is_in_the_index():
    index = (ROOT / "scenes/README.md").read_text()
    scenes = {str(file.relative_to(ROOT / "scenes")) for file in (ROOT / "scenes").rglob("*.toml") if "results" not in file.parts}
    assert set(re.findall(r"\]\((.*?\.toml)\)", index)) == scenes
    for scene, words in re.findall(r"\]\((.*?\.toml)\) \| (.*?) \|", index):
        assert words == title(ROOT / "scenes" / scene) and words.count("(") == words.count(")")  # no citation is cut


def test_references_are_current():
    done = subprocess.run([sys.executable, ROOT / "docs/reference.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_loop_and_the_step_are_those_of_the_code():
    page = (ROOT / "ARCHITECTURE.md").read_text()
    code = " ".join(" ".join((ROOT / file).read_text().split())
                    for file in ("engine/run/run.cpp", "engine/dynamics/simulation.cpp"))
    quoted = re.findall(r"(?:^    .*\n)+", page[page.index("## The main loop"):page.index("## Three walks")], re.M)
    assert len(quoted) == 2
    for part in quoted:
        assert " ".join(part.split()) in code, part
