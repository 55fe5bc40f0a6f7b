#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Writes the generated part of docs/reference/command-line.md: docs/reference.py [--check]

It is what the program prints of itself, and stands behind a mark in the page. --check changes nothing and fails where the page
is not current. The program is that of $ASPERITY_PROGRAM or the build of this source tree. python() is what the site has of the
docstrings (conf.py).
"""

import inspect
import os
import re
import sys
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
    if not Path(program).is_file():
        raise SystemExit(f"{program}: there is no such program; build it (./asperity), or name one with ASPERITY_PROGRAM")
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


def main() -> None:
    page = ROOT / "docs/reference/command-line.md"
    text = page.read_text()
    new = text.partition(MARK)[0] + MARK + commands()
    if new == text:
        return
    if sys.argv[1:] == ["--check"]:
        sys.exit(f"not current: {page.name}; docs/reference.py writes it")
    page.write_text(new)


if __name__ == "__main__":
    main()
