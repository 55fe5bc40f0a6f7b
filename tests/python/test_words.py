# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The words that users meet are those of the glossary: what it has replaced occurs in no page, message or report."""

import ast
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
GONE = {
    r"without time": "quasi-static", r"\bin time\b": "dynamic", r"\bsame bits\b": "bitwise identical",
    r"out of reach": "beyond the interaction range", r"\bsnaps\b": "jumps, instabilities",
    r"\breadings?\b": "definitions, values", r"\bjudges?d?\b": "decides, tells",
    r"zero-load": "relax, relaxed", r"work_of_adhesion": "work_of_interface",
}
# Names that the program refuses with the new one, and the sentences that do so.
REFUSED = {"engine/scene/scene.cpp", "engine/scene/parse_path.cpp"}


def files(*patterns):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout.split()
    return [name for name in listed if (ROOT / name).is_file()]


def strings_of_c(text):
    """String literals, those that follow each other as one."""
    text = re.sub(r"//[^\n]*|^#include.*$", "", text, flags=re.M)
    text = re.sub(r'"\s*\n\s*"', "", text)
    return re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)


def strings_of_python(text):
    return [node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Constant) and isinstance(node.value, str)]


def texts():
    for name in files("README.md", "ARCHITECTURE.md", "docs/*.md", "docs/data/tables/*.csv", "scenes/*.toml", "asperity",
                      "python/asperity/reports/templates/*"):
        yield name, (ROOT / name).read_text(encoding="utf-8")
    for name in files("engine/*.cpp", "engine/*.hpp", "io/*.cpp", "io/*.hpp", "kernels/*.hpp", "python/binding/*.cpp"):
        if name not in REFUSED:
            yield name, "\n".join(strings_of_c((ROOT / name).read_text(encoding="utf-8")))
    for name in files("python/asperity/*.py", "docs/gallery/*.py", "examples/*.py"):
        yield name, "\n".join(strings_of_python((ROOT / name).read_text(encoding="utf-8")))


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="the files are listed by git")
def test_replaced_words_do_not_come_back():
    read, found = 0, []
    for name, text in texts():
        read += 1
        text = re.sub(r"\s+", " ", text)
        found += [f"{name}: '{text[max(0, at.start() - 30):at.end() + 30]}': say {instead}"
                  for word, instead in GONE.items() for at in re.finditer(word, text, re.I)]
    assert read > 150 and not found, "\n".join(found)


def test_the_words_of_the_pages_are_in_the_glossary():
    glossary = (ROOT / "docs/reference/glossary.md").read_text(encoding="utf-8")
    for word in ("sites", "layers", "scene", "state", "path", "dynamic path", "quasi-static path", "bitwise identical",
                 "interaction range", "work of the interface", "work of adhesion"):
        assert re.search(rf"^- \*\*{word}\*\*", glossary, re.M), word


FRAGMENT = re.compile(r"(the same|its|it|of|such|this|that|those|these|at its|on the way|whether|why|what|how|where|when)\b|"
                      r".*\b(the same of|so many|whatever|as it is|as the scene has)\b", re.I)


def descriptions():
    """Name and description of every key of a scene and of every value of a result, from the tables of the references."""
    for page in ("result", "scene"):
        for line in (ROOT / f"docs/reference/{page}.md").read_text(encoding="utf-8").splitlines():
            cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")]
            if line.startswith("| `") and len(cells) > 3:
                yield cells[0], cells[-1].strip()


def test_a_description_is_understood_without_the_one_above():
    read = list(descriptions())
    found = [f"{name}: {text}" for name, text in read if FRAGMENT.match(text)]
    assert len(read) > 250 and not found, "\n".join(found)


def test_a_description_that_needs_the_one_above_is_found():
    for text in ("the same of the pull-off", "its largest", "of the thermal noise", "at its end", "largest force, whatever the load"):
        assert FRAGMENT.match(text), text
