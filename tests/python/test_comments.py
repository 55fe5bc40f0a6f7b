# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Comments of the program and docstrings are sentences: a function's begins with a verb in the third person, none with a word
that only an earlier sentence would explain."""

import ast
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("engine", "decomposition", "kernels", "io", "theory")
REFUSED = ("of whether what where below from under as told both like likewise none not "
           "it its this that these those they which who why when how").split()
# Words with which no paragraph at the head of a file begins.
HEADLESS = "of whether what where below from under as whose which why how when".split()
VERBS = set("""
adds allocates allows appends asks begins brings builds calls catches checks claims clears closes collects combines compares computes
continues converts copies counts creates cuts deletes derives displaces draws drifts ends estimates exchanges explains
fills finds frees gathers gives holds interpolates joins keeps kicks leads loads looks makes measures moves multiplies opens
parses passes places plans prints puts reads records refuses relaxes removes renames replaces resets resolves restores
resumes returns rounds runs saves searches selects sends sets shifts shows simulates solves starts stops stores sums sweeps takes tells throws
transfers transforms unrolls updates waits writes
advances binds carries completes concludes follows goes indents integrates limits notes prepares spells
averages escapes exports subtracts yields
""".split())

COMMENT = re.compile(r"^\s*//(/?<?)(?!/)\s?(.*)$")


def written_files():
    """Headers and sources of the program."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard",
                             *(f"{folder}/*.{ending}" for folder in FOLDERS for ending in ("hpp", "cpp", "cu"))],
                            cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in listed if (ROOT / name).is_file()]


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


def paragraphs_of_head(text):
    """Line and text of each paragraph of the comment at the head of a file."""
    lines = text.split("\n")
    head = [line[2:] for line in lines[:next((n for n, line in enumerate(lines) if not line.startswith("//")), 0)]]
    starts = [n for n, line in enumerate(head) if line.strip() and (n == 0 or not head[n - 1].strip())]
    return [(n + 1, head[n].strip()) for n in starts if not head[n].startswith("  ")]  # not a formula


def problems_of(text, name):
    for line, words in paragraphs_of_head(text):
        if words[0].isupper() and words.split()[0].lower().strip(":,") in HEADLESS:
            yield f"{name}:{line}: a paragraph begins with '{words.split()[0]}': {words[:70]}"
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
def test_comments_of_headers_and_sources_are_sentences():
    read, found = 0, []
    for name in written_files():
        read += 1
        found += problems_of((ROOT / name).read_text(encoding="utf-8"), name)
    assert read > 220 and not found, f"{len(found)} comments\n" + "\n".join(found)


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


# Docstrings of the Python package: what asperity.NAME reaches, and the functions of asperity.crack.

PUBLIC = {
    "running/runs": ("run",), "results/result": ("Values", "Result", "load"), "studies/sweeps": ("Sweep", "sweep", "load_sweep"),
    "running/engine": ("Top", "Substrate", "Simulation", "Statics"), "crack": ("modulus", "opening_factor"),
    "forms": ("_plot_of_sweep", "_report_of_run", "_report_of_sweep", "_plot_of_estimate", "_quote", "_report_of_estimate"),
    "studies/estimates": ("Estimate", "estimate", "load_estimate"), "commands/adhesion": ("Adhesion", "adhesion"),
    "studies/states": ("states",),
    "errors": ("Error", "SceneError", "SceneWarning", "PhysicsError", "InputOutputError", "Stopped", "InternalError"),
}


def documented(text, names):
    """Every public class, function, method and property of a module that has a docstring."""
    for node in ast.parse(text).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name in names:
            for thing in (node, *(node.body if isinstance(node, ast.ClassDef) else ())):
                if isinstance(thing, (ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(thing):
                    if thing is node or not thing.name.startswith("_"):
                        yield thing


def problems_of_docstring(thing):
    text = ast.get_docstring(thing)
    word = re.match(r"\W*(\w*)", text)[1].lower()
    if word in REFUSED:
        yield f"begins with '{word}'"
    if isinstance(thing, ast.ClassDef) or any(re.search(r"property|setter", ast.unparse(d)) for d in thing.decorator_list):
        return
    if word not in VERBS:
        yield f"begins with no verb: {text[:50]}"
    sections = {name: body for name, body in re.findall(r"^(\w+)\n-{3,}\n(.*?)(?=^\w+\n-{3,}$|\Z)", text, re.M | re.S)}
    for argument in (a.arg for a in (*thing.args.args, *thing.args.kwonlyargs) if a.arg not in ("self", "cls")):
        if not re.search(rf"^(\w+, )*{argument}(, \w+)* : ", sections.get("Parameters", ""), re.M):
            yield f"does not list {argument} under Parameters"
    if thing.returns is not None and ast.unparse(thing.returns) != "None" and "Returns" not in sections:
        yield "has no Returns"


def test_docstrings_of_the_package_have_numpy_sections():
    found = []
    for module, names in PUBLIC.items():
        things = list(documented((ROOT / f"python/asperity/{module}.py").read_text(encoding="utf-8"), names))
        assert set(names) <= {thing.name for thing in things}, module
        found += [f"{module}.py:{thing.lineno} {thing.name} {problem}" for thing in things for problem in problems_of_docstring(thing)]
    assert not found, "\n".join(found)


def test_public_names_are_all_held_by_this_test():
    lazy = re.findall(r'"(\w+)"', (ROOT / "python/asperity/__init__.py").read_text(encoding="utf-8").split("_LAZY = {")[1].split("}")[0])
    held = {name for names in PUBLIC.values() for name in names} | {"State"}  # which is compiled
    assert {name for name in lazy if not name.startswith("_")} <= held


@pytest.mark.parametrize("text", [
    'def load(directory: str) -> dict:\n    """The result in a directory."""',
    'def load(directory: str) -> dict:\n    """Loads the result in a directory."""',
    'def load(directory) -> dict:\n    """Loads it.\n\n    Returns\n    -------\n    dict\n        Of it.\n    """',
    'class Load:\n    """What a machine carries."""'])
def test_a_docstring_without_verb_or_sections_is_refused(text):
    assert any(problem for thing in documented(text, ("load", "Load")) for problem in problems_of_docstring(thing))


def test_docstrings_of_the_compiled_module_have_sections():
    engine = pytest.importorskip("asperity.running.engine")
    found = []
    for kind in (engine._engine.Simulation, engine._engine.Statics):
        for name, thing in vars(kind).items():
            if name.startswith("_") or not thing.__doc__:
                continue
            text = re.sub(r"^\w+\(self.*\n+", "", thing.__doc__)
            word = re.match(r"\W*(\w*)", text)[1].lower()
            if word in REFUSED or callable(thing) and word not in VERBS:
                found.append(f"{kind.__name__}.{name}: {text[:60]}")
            if callable(thing) and name != "save" and name != "restore" and "Returns\n---" not in text:
                found.append(f"{kind.__name__}.{name} has no Returns")
    assert not found, "\n".join(found)


def test_docstrings_of_all_modules_begin_with_a_verb():
    found, read = [], 0
    for path in sorted((ROOT / "python/asperity").rglob("*.py")):
        for thing in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(thing, (ast.FunctionDef, ast.ClassDef)) and (text := ast.get_docstring(thing)):
                read += 1
                word = re.match(r"\W*(\w*)", text)[1].lower()
                noun = isinstance(thing, ast.ClassDef) or any("property" in ast.unparse(d) for d in thing.decorator_list)
                if word in REFUSED or not noun and word not in VERBS:
                    found.append(f"{path.name}:{thing.lineno} {thing.name}: {text[:60]}")
    assert read > 300 and not found, "\n".join(found)
