# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The catalogue of messages: every text in the sources that says what to do about an error.

It is read from the sources, so that a new message is in it without being entered. An entry is a string in the place of a
fix: the last argument of what makes a Problem or an Error, or what is assigned to a variable called fix or remedy. Said
is it where a message contains the longest part of it that is not filled in, and of the other arguments of the same call
that have strings one each."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADVISING = ("case_surface.cpp", "pair.cpp", "surface_atoms.cpp", "potential_table.cpp", "process_grid.cpp")
"""Files whose invalid_argument is a message with its advice."""
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<d>\w*)\(.*?\)(?P=d)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\]|\\.)\'|\w+|\s+|.', re.S)
MAKERS = {"Problem": 4, "FileError": 4, "PhysicsError": 3, "add": 4, "removed": 4, "SceneError": 4, "refuse": 0, "refuse_number": 4,
          "cannot": 2, "fail": 4, "Part": 4, "return": 4}
"""What makes a message in C++, and how many arguments it has with a fix; 0: the last of two or more."""


@dataclass(frozen=True)
class Message:
    """A fix in the sources: where it is, and the words by which it is known in what is printed."""

    place: str
    fix: str
    others: tuple[tuple[str, ...], ...]

    def is_said(self, text: str) -> bool:
        """Returns whether a message is this one."""
        return self.fix in text and all(any(word in text for word in words) for words in self.others)

    def __str__(self) -> str:
        return f"{self.place}: {' ... '.join(words[0] for words in self.others)} ... {self.fix}"


def part_of(text: str) -> str:
    """Returns the longest part of a format that is not filled in, in one line."""
    return max((part.strip() for part in re.split(r"\{[^{}]*\}|\n", text.replace("{{", "").replace("}}", ""))), key=len)


def known_by(texts: list[str]) -> tuple[str, ...]:
    return tuple(part for text in texts if len(part := part_of(text)) > 2)


def entries(place: str, fixes: list[str], others: list[list[str]]) -> list[Message]:
    there = tuple(words for words in map(known_by, others) if words)
    return [Message(place, fix, there) for fix in known_by(fixes)]


def tokens_of(path: Path) -> list[tuple[str, str | None, int]]:
    """Returns the tokens of a C++ file, strings beside one another joined: token, its text if it is a string, line."""
    found: list[tuple[str, str | None, int]] = []
    source = path.read_text()
    line = 1
    for match in TOKEN.finditer(source):
        token, text = match[0], match["text"]
        if text is not None:
            text = re.sub(r"\\(.)", lambda c: {"n": "\n"}.get(c[1], c[1]), text)
            if found and found[-1][1] is not None:
                found[-1] = (found[-1][0], found[-1][1] + text, found[-1][2])
            else:
                found.append((token, text, line))
        elif not token.isspace() and not token.startswith(("//", "/*")):
            found.append((token, None, line))
        line += token.count("\n")
    return found


def arguments(tokens: list[tuple[str, str | None, int]], at: int, named: dict[str, str]) -> list[list[str]]:
    """Returns the strings of each argument behind an opening bracket; those of constants by their names. Of one of several,
    before the last argument, none is returned."""
    depth, found, chosen = 0, [[]], set()
    for k in range(at, len(tokens)):
        token, text, _ = tokens[k]
        if text is not None:
            if tokens[k - 2][0] + tokens[k - 1][0] not in ("==", "!="):
                found[-1].append(text)
        elif token in named and tokens[k + 1][0] in ",)}":
            found[-1].append(named[token])
        elif token == "?" and depth == 1:
            chosen.add(len(found) - 1)
        elif token in "([{":
            depth += 1
        elif token in ")]}":
            depth -= 1
            if depth == 0:
                break
        elif token == "," and depth == 1:
            found.append([])
    return [texts if k == len(found) - 1 or k not in chosen else [] for k, texts in enumerate(found)]


def messages_of_cpp(path: Path) -> list[Message]:
    tokens, found, source = tokens_of(path), [], path.relative_to(ROOT)
    named = {tokens[i][0]: tokens[i + 2][1] for i in range(len(tokens) - 2)
             if tokens[i + 1][0] == "=" and tokens[i + 2][1] is not None and tokens[i - 1][0] == "*"}
    for i, (token, _, line) in enumerate(tokens[:-2]):
        place = f"{source}:{line}"
        if token in MAKERS and tokens[i + 1][0] in "({":
            given = arguments(tokens, i + 1, named)
            if token in ("removed", "SceneError"):
                given = arguments(tokens, i + 2, named)
            if token == "add" and len(given) == 1:
                continue  # of a Problem, which is an entry itself
            if len(given) == (MAKERS[token] or max(2, len(given))):
                found += entries(place, given[-1], given[:-1])
        elif token == "invalid_argument" and path.name in ADVISING and tokens[i + 1][0] == "(":
            found += entries(place, [text for texts in arguments(tokens, i + 1, named) for text in texts], [])
        elif re.fullmatch(r"\w*(fix|remedy)", token) and tokens[i + 1][0] in ("=", "+") and tokens[i + 1][1] is None:
            end = next(k for k in range(i, len(tokens)) if tokens[k][0] in (";", ")"))
            found += entries(place, [text for _, text, _ in tokens[i:end] if text is not None], [])
        elif token.endswith("_advice") and tokens[i - 1][0] == "string":
            end = next(k for k in range(i, len(tokens)) if tokens[k][0] == "class")
            found += [entry for k in range(i, end) if tokens[k][0] == "return"
                      for entry in entries(place, [next((t for _, t, _ in tokens[k:k + 8] if t is not None), "")], [])]
    return found


def texts_of(node: ast.expr) -> list[str]:
    """Returns the strings of an expression of Python; what an f-string fills in is {}."""
    if isinstance(node, (ast.Compare, ast.Subscript)):
        return []
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if isinstance(node, ast.JoinedStr):
        whole = "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        inner = [text for part in node.values if isinstance(part, ast.FormattedValue) for text in texts_of(part.value)]
        return [whole, *inner]
    return [text for child in ast.iter_child_nodes(node) if isinstance(child, ast.expr) for text in texts_of(child)]


def messages_of_python(path: Path) -> list[Message]:
    found, source = [], path.relative_to(ROOT)
    for node in ast.walk(ast.parse(path.read_text())):
        place = f"{source}:{getattr(node, 'lineno', 0)}"
        if isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if not re.search(r"Error$|^Stopped$|^refuse\w*$|^fail$", name) or name in ("ValueError", "KeyError", "AttributeError"):
                continue
            given = {str(k): argument for k, argument in enumerate(node.args)}
            given.update({keyword.arg or "": keyword.value for keyword in node.keywords})
            fix = given.pop("fix", None) or (given.pop(str(len(node.args) - 1)) if len(node.args) > (1 if "refuse" in name else 3) else None)
            if fix is not None:
                found += entries(place, texts_of(fix), [texts_of(other) for other in given.values() if not any(isinstance(n, ast.IfExp) for n in ast.walk(other))])
        elif isinstance(node, (ast.Assign, ast.AugAssign)) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if any(isinstance(t, ast.Name) and re.fullmatch(r"\w*(fix|remedy)", t.id) for t in targets):
                found += entries(place, texts_of(node.value), [])
    return found


def catalogue() -> list[Message]:
    """Returns all messages with a fix."""
    found: list[Message] = []
    for pattern in ("engine/**/*.cpp", "io/*.cpp", "engine/**/*.hpp", "io/*.hpp", "python/asperity/**/*.cpp"):
        for path in sorted(ROOT.glob(pattern)):
            found += messages_of_cpp(path)
    for path in sorted(ROOT.glob("python/asperity/**/*.py")):
        found += messages_of_python(path)
    return sorted(set(found), key=lambda message: (message.place.partition(":")[0], int(message.place.rpartition(":")[2])))
