#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Writes the generated parts of the reference, docs/reference/{command-line,python}.md, and the names of results for type
checkers, python/asperity/results/names.pyi: docs/reference.py [--check]

The commands and names are what the program prints of itself, the Python interface what its docstrings say; each stands behind
a mark in its page. --check changes nothing and fails where a page is not current. The program is that of
$ASPERITY_PROGRAM or the build of this source tree.
"""

import inspect
import json
import os
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "packaging")]
os.environ["COLUMNS"] = "100"
os.environ.setdefault("ASPERITY_PROGRAM", str(ROOT / "build/release/engine/asperity"))

from generate import commands_of, say  # noqa: E402

MARK = "<!-- What follows is written by docs/reference.py. -->\n"


def commands() -> str:
    """The help of every command of the program."""
    program = os.environ["ASPERITY_PROGRAM"]
    general = say(program, "--help")
    pages = [("asperity", general), *((name, say(program, name, "--help")) for name, _ in commands_of(general))]
    return "".join(f"\n## {title}\n\n```text\n{text.strip()}\n```\n" for title, text in pages)


def listed(text: str) -> str:
    """Returns the entries of a section of a NumPy docstring as a list: a line "name : type", and its indented meaning."""
    entries = re.findall(r"^(\S.*)\n((?: +.*(?:\n|$))*)", text + "\n", re.M)
    lines = []
    for head, meaning in entries:
        name, _, kind = head.partition(" : ")
        lines.append(f"- `{name}`{f' ({kind})' if kind else ''}: {escaped(' '.join(meaning.split()))}")
    return "\n".join(lines)


def escaped(text: str) -> str:
    """Returns a text with the signs escaped that Markdown would read."""
    return re.sub(r"`[^`]*`|[<*$]", lambda found: found[0] if found[0][0] == "`" else "\\" + found[0], text)


def prose(doc: str | None) -> str:
    """Returns a docstring as Markdown: indented examples as code, sections of NumPy's style as lists."""
    doc = re.sub(r"^\w+\(self.*\n+", "", doc or "")  # the signature that pybind11 writes
    parts = []
    for part in inspect.cleandoc(doc).split("\n\n"):
        if section := re.match(r"(\w+)\n-+\n", part):
            parts += [f"*{section[1]}*", listed(part[section.end():])]
        elif re.match(r" {4}", part):
            part = f"```{'python' if 'asperity' in part else 'text'}\n" + inspect.cleandoc("\n" + part) + "\n```"
            parts.append(part)
        elif re.match(r"\w+ {2,}\S", part):
            parts.append(f"```text\n{part}\n```")
        else:
            parts.append(escaped(part))
    return "\n\n".join(parts).strip() + "\n"


def called(name: str, thing: object) -> str:
    """A function with its arguments, without types."""
    try:
        given = inspect.signature(thing)
    except ValueError:  # compiled: the first line of its docstring
        words = re.match(r"\w+\(self: [\w.]+(?:, )?(.*)\) ->", thing.__doc__ or "")
        return f"{name}({re.sub(r': [^,=]+', '', words[1]) if words else ''})"
    some = [p.replace(annotation=inspect.Parameter.empty) for n, p in given.parameters.items() if n not in ("self", "cls")]
    return name + str(given.replace(parameters=some, return_annotation=inspect.Signature.empty))


def members(kind: type) -> list[tuple[str, str]]:
    """Members of a class that have a docstring, those of its bases first: as they are written, and what they are."""
    found = {}
    for base in (base for base in reversed(kind.__mro__) if base.__module__.startswith("asperity")):
        for name, thing in vars(base).items():
            if name.startswith("_"):
                continue
            thing = getattr(thing, "__func__", thing)
            if thing.__doc__ and (callable(thing) or isinstance(thing, property)):
                found[name] = called(name, thing) if callable(thing) else name, prose(thing.__doc__)
    return list(found.values())


def python() -> str:
    """The names of the package."""
    import asperity

    out = ["\n", prose(asperity.__doc__)]
    for name in (name for name in asperity._LAZY if name != "State"):
        thing = getattr(asperity, name)
        out += [f"\n## asperity.{name}\n\n", f"`{called(name, thing)}`\n\n", prose(thing.__doc__)]
        if isinstance(thing, type):
            for shown, doc in members(thing):
                out += [f"\n**`{shown}`**\n\n", doc]
    out += ["\n## asperity.crack\n\n", prose(asperity.crack.__doc__)]
    for name in asperity.crack.__all__:
        thing = getattr(asperity.crack, name)
        out += [f"\n**`{called(name, thing)}`**\n\n", prose(thing.__doc__)]
    out += ["\n## Errors\n\n", prose(asperity.errors.__doc__), "\n"]
    for name, kind in vars(asperity.errors).items():
        if isinstance(kind, type) and kind.__module__ == "asperity.errors":
            out += [f"- `{name}`({kind.__bases__[0].__name__}): ", " ".join(prose(kind.__doc__).split()), "\n"]
    return "".join(out)


WHOLE = ("exit_code", "segment", "events", "sites_moved", "atoms", "steps", "iterations", "ranks", "threads", "calls")
PAIRS = ("slide", "site", "dissipated.jumps[].mean_height", "dissipated.jumps[].force", "dissipated.jumps[].contact_fraction")
"""Numbers of result.json that are whole, and those that are lists of numbers."""


def kind_of(path: str, unit: str) -> str:
    """Returns the type of a value of result.json."""
    name = path.rpartition(".")[2]
    if name in ("on", "converged"):
        return "bool"
    if name in PAIRS or path in PAIRS:
        return "list[float]"
    return "int" if name in WHOLE else "float" if unit else "str"


def classes_of(tree: dict, name: str, out: list[str]) -> None:
    """Writes the class of an object, after those of its members; a leaf is a pair of type and meaning."""
    lines = []
    for key, value in tree.items():
        if isinstance(value, tuple):
            lines.append((key, *value))
            continue
        many, star = key.endswith("[]"), "*" in value
        inner = "".join(word.title() for word in key.removesuffix("[]").split("_"))
        inner = inner.removesuffix("s") if many or star else inner
        full = inner if name == "Numbers" else name + inner
        classes_of(value["*"] if star else value, full, out)
        lines.append((key.removesuffix("[]"), f"list[{full}]" if many else f"dict[str, {full}]" if star else full, ""))
    base = "" if name == "Numbers" or name.endswith(("Arrays", "Maps")) else "(Values)"
    out += [f"\nclass {name}{base}:"]
    for key, kind, meaning in lines:
        if (name, key) != ("Numbers", "segments"):  # a property of Result
            out += [f"    {key}: {kind}", *([f'    """{meaning}"""'] if meaning else [])]


def named(rows: list[tuple[str, str]]) -> dict:
    """Returns a tree of the paths of values, "." between its levels; a leaf is what stands beside its path."""
    tree: dict = {}
    for path, leaf in rows:
        *above, last = path.split(".")
        at = tree
        for part in above:
            at = at.setdefault(part, {})
        at.setdefault(last, leaf)
    return tree


def names() -> str:
    """Returns the stub with the names of results."""
    program = os.environ["ASPERITY_PROGRAM"]

    def said(unit: str, meaning: str) -> str:
        first = re.split("[;:(]", meaning)[0].strip('" ')  # the page has all of it
        return ": ".join(filter(None, ("" if unit == "1" else unit, textwrap.shorten(first.replace('"', "'"), 110, placeholder=" ..."))))

    results = json.loads(say(program, "defaults", "--results", "--json"))
    out: list[str] = []
    rows = [(path, (kind_of(path, q["unit"]), said(q["unit"], q["meaning"]))) for path, q in results.items()
            if not (path.endswith("[]"))]
    classes_of(named(rows), "Numbers", out)
    keys = json.loads(say(program, "defaults", "--json"))
    classes_of(named([(key, ("Any", said(q["unit"], q["doc"]))) for key, q in keys.items() if not key.startswith("sweep")]), "Scene", out)
    table = re.findall(r"^\| `(series|fields/\*|substrate)/(\w+)` \| (.*?) \| .*? \| (.*) \|$", say(program, "defaults", "--results"), re.M)
    for group, name in (("series", "SeriesArrays"), ("fields/*", "StateMaps"), ("substrate", "SubstrateMaps")):
        left_out = ("gap_edges", "gap_density", "atoms", "type", "spectrum_q", "spectrum", "spectrum_target")
        classes_of({key: ("np.ndarray", said(unit, meaning)) for of, key, unit, meaning in table if of == group and key not in left_out},
                   name, out)
    return ("# SPDX-FileCopyrightText: 2026 The Asperity authors\n# SPDX-License-Identifier: MIT\n#\n"
            "# Names of results and of scenes with their types and units, for type checkers and editors: what a run has not is not\n"
            "# there. Written by docs/reference.py from what the program says of itself; do not edit.\nfrom typing import Any\n\n"
            "import numpy as np\n\nfrom .values import Values\n\nclass Units(Values):\n    def __getattr__(self, name: str) -> Any: ...\n"
            + "\n".join(out) + "\n")


def main() -> None:
    stale = []
    stub = ROOT / "python/asperity/results/names.pyi"
    if not stub.exists() or stub.read_text() != (new := names()):
        stale.append(stub.name)
        if sys.argv[1:] != ["--check"]:
            stub.write_text(names())
    for name, make in (("command-line", commands), ("python", python)):
        page = ROOT / "docs/reference" / f"{name}.md"
        text = page.read_text()
        new = text.partition(MARK)[0] + MARK + make()
        if new != text:
            stale.append(page.name)
            if sys.argv[1:] != ["--check"]:
                page.write_text(new)
    if stale and sys.argv[1:] == ["--check"]:
        sys.exit(f"not current: {', '.join(stale)}; docs/reference.py writes them")


if __name__ == "__main__":
    main()
