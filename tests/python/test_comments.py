# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Comments of headers and docstrings are sentences: a function's begins with a verb in the third person, none with a word
that only an earlier sentence would explain."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("engine", "decomposition", "kernels", "io", "theory")
# Headers that are not written in this way yet.
OPEN = {
    "engine/block/spectral_block.hpp", "engine/block/block_memory.hpp", "decomposition/surface_transform.hpp",
    "engine/equilibrium/heavy_ball.hpp", "engine/equilibrium/newton.hpp", "engine/equilibrium/wall_minimiser.hpp",
    "engine/equilibrium/relaxation.hpp", "engine/equilibrium/quasistatic.hpp", "engine/equilibrium/step_decision.hpp",
    "io/result_directory.hpp", "engine/interface/potential_table.hpp",
}
REFUSED = ("of whether what where below from under as told both like likewise none not "
           "it its this that these those they which who why when how").split()
VERBS = set("""
adds allocates allows appends asks begins brings calls catches checks clears closes collects combines compares computes
continues converts copies counts creates cuts deletes derives displaces draws drifts ends estimates exchanges explains
fills finds frees gathers gives holds interpolates joins keeps kicks leads loads looks makes measures moves multiplies opens
parses passes places plans prints puts reads records refuses relaxes removes renames replaces resets resolves restores
resumes returns rounds runs saves selects sends sets shows solves starts stops stores sums sweeps takes tells throws
transfers transforms unrolls updates waits writes
""".split())

COMMENT = re.compile(r"^\s*//(/?<?)(?!/)\s?(.*)$")


def headers():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard",
                             *(f"{folder}/*.hpp" for folder in FOLDERS)],
                            cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in listed if (ROOT / name).is_file() and name not in OPEN]


def without_arguments_of_templates(text):
    while (shorter := re.sub(r"<[^<>()]*(?:\([^<>()]*\)[^<>()]*)*>", "", text)) != text:
        text = shorter
    return text


def is_function(declaration):
    """True for functions and pointers to functions; the text is what stands behind the comment, or before it."""
    text = re.sub(r'"[^"]*"|->|<=|>=|<<|>>', "", declaration)
    text = re.sub(r"^\s*#define\s+", "", text)
    text = without_arguments_of_templates(text)
    text = re.sub(r"^\s*(\[\[\w+\]\]|alignas\([^()]*\)|template|explicit|static|inline|constexpr|virtual|ASPERITY_\w+|extern)\s*", "", text)
    if re.match(r"\s*(struct|class|enum|union|namespace|using|typedef|friend|extern const)\b", text):
        return False
    return bool(re.match(r"[^=;{]*\(", text)) and not re.match(r"[^(=;{]*\boperator\b", text)


def comments(text):
    """Every comment as (number of its first line, text, declaration, of documentation?)."""
    lines = text.splitlines()
    at = 0
    while at < len(lines):
        line = lines[at]
        if alone := COMMENT.match(line):
            first, words = at, []
            while at < len(lines) and (part := COMMENT.match(lines[at])):
                words.append(part[2])
                at += 1
            declaration = []
            for following in lines[at:at + 8]:
                if COMMENT.match(following) or not following.strip():
                    break
                declaration.append(re.sub(r"//.*", "", following).strip())
                if re.search(r"[;{]\s*$", declaration[-1]) or following.startswith("#define"):
                    break
            yield first + 1, " ".join(words).strip(), " ".join(declaration), alone[1] == "/"
            continue
        if behind := re.match(r"^(\s*\S.*?)\s*//(/?<?)\s?(.*)$", line):
            yield at + 1, behind[3].strip(), behind[1].strip(), behind[2] == "/<"
        at += 1


def problems_of(text, name):
    for line, words, declaration, documents in comments(text):
        first = re.match(r"[\"'(`\[]*([A-Za-z_]+)\b(?!\()", words)
        if not first or "SPDX" in words:
            first = None
        word = first[1].lower() if first else ""
        if word in REFUSED:
            yield f"{name}:{line}: begins with '{first[1]}': {words[:70]}"
        elif documents and declaration and is_function(declaration) and word not in VERBS:
            yield f"{name}:{line}: begins with no verb: {words[:70]} | {declaration[:60]}"


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="the files are listed by git")
def test_comments_of_headers_are_sentences():
    read, found = 0, []
    for name in headers():
        read += 1
        found += problems_of((ROOT / name).read_text(encoding="utf-8"), name)
    assert read > 130 and not found, f"{len(found)} comments\n" + "\n".join(found)


@pytest.mark.parametrize("text", [
    "/// Of the top plane along z, Å/fs.\ndouble velocity(double t) const;",
    "/// The velocity of the top plane.\ndouble velocity(double t) const;",
    "/// From rest again; the step sizes are kept.\nvoid stop();",
    "/// Where the force matters, eV/Å.\nstruct Window {",
    "struct A {\n    double edge; ///< of the box, Å\n};",
    "/// A row of forces.\ntemplate <class T>\nASPERITY_INLINE void row(const T* from, std::array<double, 2> to) {",
    "/// Force on rows.\nvoid (*forces)(const Level& level, int y0);",
    "// Below the floor.\nint x = 0;"])
def test_a_comment_that_is_no_sentence_is_refused(text):
    assert list(problems_of(text, "planted.hpp"))


@pytest.mark.parametrize("text", [
    "/// Returns the velocity of the top plane along z, Å/fs.\ndouble velocity(double t) const;",
    "struct A {\n    double edge = f(2); ///< edge of the box, Å\n    std::function<void(int)> look; ///< watch of the path\n};",
    "/// Properties of a wall.\ntemplate <class T>\nstruct Wall {"])
def test_a_sentence_is_accepted(text):
    assert not list(problems_of(text, "planted.hpp"))
