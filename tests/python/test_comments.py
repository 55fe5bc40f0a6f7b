# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Comments of the program and docstrings are sentences: a function's begins with a verb in the third person, none with a word
that only an earlier sentence would explain. Every type and function that a header declares has a comment."""

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
# Prepositions and the like with which no documentation begins: its noun would be another comment's.
DANGLING = ("above after at because before behind beside between beyond by during except for if in instead less more on only otherwise over "
            "per since so to towards until with within without").split()
VERBS = set("""
adds allocates allows appends asks begins brings builds calls catches checks claims clears closes collects combines compares computes
continues converts copies counts creates cuts deletes derives displaces draws drifts ends estimates exchanges explains
fills finds frees gathers gives holds interpolates joins keeps kicks leads loads looks makes measures moves multiplies opens
parses passes places plans prints puts reads records refuses relaxes removes renames replaces resets resolves restores
resumes returns rounds runs saves searches selects sends sets shifts shows simulates solves starts stops stores sums sweeps takes tells throws
transfers transforms unrolls updates waits writes
advances binds carries completes concludes follows goes indents integrates limits notes prepares spells
averages chooses escapes exports folds rehearses releases separates splits subtracts yields
aborts decides fits flushes forgets lists raises resamples installs locks overwrites prescribes recomputes registers
""".split())

# A verb whose object is in another comment.
POINTING = re.compile(r"\w+ (that|those|it|them|likewise|the same)( (of|to|with|as|be|for)\b|[.,;]|$)")
# A sentence, not only the first one, without its subject; a parameter without its noun ("area: of the interface"); and turns of
# phrase that say less than a noun or a verb would.
HEADLESS_SENTENCE = re.compile(r"(?<=[.:;] )(Of|Whether|What|As|Told|Both|Such|Like|Likewise)\b(?! (far as|are|is)\b)")
NAMELESS_PARAMETER = re.compile(r"(?:^|[.;] )\w+: of\b")
SHORTHAND = re.compile(r"\b(the same of|so many|as (it is|they are)(?! \w)|whatever|whichever|but for|all but|on (its|their) way|"
                       r"the way (in|out|up|down|there|back))\b")
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
        if word in REFUSED or documents and word in DANGLING:
            yield f"{name}:{line}: begins with '{first[1]}': {words[:70]}"
        elif documents and word in VERBS and POINTING.match(words):
            yield f"{name}:{line}: points to another comment: {words[:70]}"
        elif documents and declaration and is_function(declaration) and word not in VERBS:
            yield f"{name}:{line}: begins with no verb: {words[:70]} | {declaration[:60]}"
        if "SPDX" not in words and (found := SHORTHAND.search(words)):
            yield f"{name}:{line}: says '{found[0]}': {words[:70]}"
        if documents and (found := HEADLESS_SENTENCE.search(words) or NAMELESS_PARAMETER.search(words)):
            yield f"{name}:{line}: has no subject in '{words[found.start():found.start() + 40]}': {words[:70]}"
    if name.endswith(".hpp"):
        yield from (f"{name}:{line}: has no comment: {declaration[:90]}" for line, declaration in undocumented(text))


NOT_A_DECLARATION = re.compile(r"\s*(return|if|for|while|v\(|static_assert|using|throw|typedef|else|case|friend|delete|asm|std::|[\w.]+\()")


def undocumented(text):
    """Line and text of every type, and of every function without its body, that a header declares in public without a comment.
    One comment serves the declarations up to the next empty line or comment. Left out are operators, destructors, overriding functions
    and specialisations of templates."""
    scopes, group, open_parentheses = [], False, 0
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        if stripped.startswith("//"):
            group = True
            continue
        if not stripped:
            group = False
            continue
        if access := re.fullmatch(r"(public|private|protected):", stripped):
            scopes[-1:] = [access[1]]
            group = False
            continue
        code = re.sub(r"//.*", "", re.sub(r'"[^"]*"', '""', line))
        public = all(scope in ("public", "namespace") for scope in scopes) and open_parentheses == 0
        if public and not group and not stripped.startswith("#") and not re.search(r"///?<", line):
            kind = re.match(r"\s*(?:template.*>\s*)?(struct|class|enum class|enum)\s+\w+[^;=()<]*\{", code)
            function = re.match(r"\s*[\w:<>,*&\[\] ~]+\b\w+\([^={]*\)[^={]*;\s*$", code)
            if kind or function and not re.search(r"override|operator|~", code) and not NOT_A_DECLARATION.match(code):
                yield number, stripped
        if "{" in code and "}" not in code.partition("{")[2]:
            scope = re.search(r"\b(namespace|class|struct|enum|union)\b(?!.*\()", code)
            scopes.append({"namespace": "namespace", "class": "private"}.get(scope[1], "public") if scope else "body")
            for _ in range(code.count("{") - code.count("}") - 1):
                scopes.append("body")
        else:
            for brace in re.findall(r"[{}]", code):
                if brace == "{":
                    scopes.append("body")
                elif scopes:
                    scopes.pop()
        open_parentheses += code.count("(") - code.count(")")


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
    "struct A {\n    bool made; ///< by this object\n};",
    "/// Returns the same to be written to.\nint* arrays();",
    "/// For a base unit, a value of it.\nconstexpr int examples[] = {};",
    "// Below the floor.\nint x = 0;",
    "/// Begins a segment. area: of the interface, Å^2.\nvoid begin(double area);",
    "/// Returns the energy. Of several cycles, the last counts.\ndouble energy();",
    "struct A {\n    double b; ///< energy lost, the same of the pull-off\n};",
    "/// Returns a table of so many rows.\nint rows(int n);",
    "/// Sets the state as it is.\nvoid set(int n);",
    "class Relaxation {\npublic:\n    int n;\n};",
    "void hold(double load);",
    "class A;\n/// A holder.\nclass B {\npublic:\n    /// Holds a load, eV/Å.\n    void hold(double load);\n\n    void release(double load);\n};"])
def test_a_comment_that_is_no_sentence_is_refused(text):
    assert list(problems_of(text, "planted.hpp"))


@pytest.mark.parametrize("text", [
    "/// Returns the velocity of the top plane along z, Å/fs.\ndouble velocity(double t) const;",
    "/// A box.\nstruct A {\n    double edge = f(2); ///< edge of the box, Å\n    std::function<void(int)> look; ///< watch of the path\n};",
    "/// Properties of a wall.\ntemplate <class T>\nstruct Wall {",
    "/// A holder.\nclass B {\npublic:\n    /// Holds a load, eV/Å.\n    void hold(double load);\n    void hold(int load);\n\n"
    "    double load() const { return load_; }\n    void release(); ///< frees the load\n\nprivate:\n    void begin();\n};",
    "/// Returns the path, as far as is known.\nint path();"])
def test_a_sentence_is_accepted(text):
    assert not list(problems_of(text, "planted.hpp"))


# Docstrings of the Python package. Everything without an underscore before its name has one that begins with a verb, or with a
# noun for classes and properties. Functions that users call have the sections Parameters, Returns or Yields of NumPy's style; one of no
# or one argument that returns no tuple may do with its sentence, as others do. What a function raises itself is named.

IN_DOCSTRINGS = re.compile(r"\b((that|which) (are|is) there\b|in the way\b|side by side\b|as of \w+\(\))", re.I)
SECTION = re.compile(r"^(\w+)\n-{3,}\n(.*?)(?=^\w+\n-{3,}$|\Z)", re.M | re.S)


def is_property(function):
    return any(re.search(r"property|setter", ast.unparse(decorator)) for decorator in function.decorator_list)


def public(body, inside=""):
    """Every public class, function and method of a module with its name; overloads and setters have their text elsewhere."""
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_"):
            if not re.search(r"overload|setter", " ".join(ast.unparse(d) for d in node.decorator_list)):
                yield inside + node.name, node
                if isinstance(node, ast.ClassDef):
                    yield from public(node.body, f"{node.name}.")


def raised_by(function):
    """Errors that a function raises itself, not those of functions within it or that it catches."""
    inner = {id(n) for f in ast.walk(function) if isinstance(f, (ast.FunctionDef, ast.Lambda)) and f is not function for n in ast.walk(f)}
    caught = {id(n) for t in ast.walk(function) if isinstance(t, ast.Try) for child in t.body for n in ast.walk(child)}
    for node in ast.walk(function):
        if isinstance(node, ast.Raise) and node.exc is not None and id(node) not in inner | caught:
            if found := re.match(r"(\w+Error|Stopped)\b", ast.unparse(node.exc)):
                yield found[1]


def of_users(tree):
    """Functions and methods that users call: those whose call is checked."""
    for node in tree.body:
        checked = "checks_call" in " ".join(ast.unparse(d) for d in getattr(node, "decorator_list", ()))
        if isinstance(node, ast.ClassDef) and checked:
            yield from (child for child in node.body if isinstance(child, ast.FunctionDef))
        elif checked:
            yield node


def problems_of_docstring(thing, of_user=True):
    text = ast.get_docstring(thing)
    if not text:
        yield "has no docstring"
        return
    word = re.match(r"\W*(\w*)", text)[1].lower()
    if word in REFUSED:
        yield f"begins with '{word}'"
    if isinstance(thing, ast.ClassDef) or is_property(thing):
        return
    if word not in VERBS:
        yield f"begins with no verb: {text[:50]}"
    of = thing.args
    arguments = [a.arg for a in (*of.posonlyargs, *of.args, of.vararg, *of.kwonlyargs, of.kwarg) if a and a.arg not in ("self", "cls")]
    given = "" if thing.returns is None else ast.unparse(thing.returns)
    sections = dict(SECTION.findall(text))
    if of_user and (len(arguments) > 1 or "tuple[" in given.partition("|")[0]) or sections:
        for argument in arguments:
            if not re.search(rf"^(\**\w+, )*\**{argument}(, \w+)* : ", sections.get("Parameters", ""), re.M):
                yield f"does not list {argument} under Parameters"
        if given not in ("", "None", "Iterator[None]") and not sections.keys() & {"Returns", "Yields"}:
            yield "has no Returns"
    if found := SHORTHAND.search(text) or IN_DOCSTRINGS.search(text):
        yield f"says '{found[0]}'"
    for entry in re.findall(r"^ {4,}(\w+)\b(?![ ,]*:)", "\n".join(sections.values()), re.M):
        if entry.lower() in REFUSED and entry[0].isupper():
            yield f"describes an argument by '{entry} ...'"
    for error in set(raised_by(thing)):
        if error not in (sections.get("Raises", "") if sections else text):
            yield f"does not say that it raises {error}"


def test_docstrings_of_the_package_have_numpy_sections():
    found, functions, sections = [], 0, 0
    for path in sorted((ROOT / "python/asperity").rglob("*.py")):
        module = str(path.relative_to(ROOT / "python/asperity").with_suffix(""))
        tree = ast.parse(path.read_text(encoding="utf-8"))
        users = {*of_users(tree)}
        for name, thing in public(tree.body):
            functions += isinstance(thing, ast.FunctionDef)
            sections += "\n---" in (ast.get_docstring(thing) or "")
            found += [f"{module}.py:{thing.lineno} {name} {problem}" for problem in problems_of_docstring(thing, thing in users)]
    assert functions > 400 and sections > 60 and not found, f"{len(found)} docstrings\n" + "\n".join(found)


@pytest.mark.parametrize("text", [
    'def load(directory: str, name: str) -> dict:\n    """The result in a directory."""',
    'def load(directory: str, name: str) -> dict:\n    """Loads the result in a directory."""',
    'def load(directory: str) -> tuple[int, int]:\n    """Loads the result in a directory."""',
    'def load(directory: str) -> None:\n    """Loads the result in a directory."""\n    raise KeyError(directory)',
    'def load(directory: str) -> dict:\n    pass',
    'def load(directory) -> dict:\n    """Loads it.\n\n    Returns\n    -------\n    dict\n        Result.\n    """',
    'def load(directory: str) -> dict:\n    """Loads whatever a directory holds."""',
    'def load(directory: str) -> dict:\n    """Loads the runs that are there."""',
    'def load(directory: str, name: str) -> None:\n    """Loads a result.\n\n    Parameters\n    ----------\n'
    '    directory : str\n        Directory.\n    name : str\n        Its name.\n    """',
    'class Load:\n    """What a machine carries."""'])
def test_a_docstring_without_verb_or_sections_is_refused(text):
    (_, thing), = public(ast.parse(text).body)
    assert list(problems_of_docstring(thing))


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
