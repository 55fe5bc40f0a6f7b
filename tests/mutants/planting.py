# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Writes many mutants into one copy of the sources; planted.hpp and planted.py choose one at run time.

A changed expression becomes `(planted::mutant(7) ? CHANGED : AS IT WAS)`, a deleted statement
`{ if (!planted::mutant(7)) { AS IT WAS } }`. In C++ the expression is found by its brackets, commas and
semicolons: what goes wrong with that does not compile, and the caller drops it. In Python by the syntax tree."""

import ast
import re
from pathlib import Path

from rules import blank, closing, code_of_cpp

HEADER, RUNTIME = (Path(__file__).resolve().parent / name for name in ("planted.hpp", "planted.py"))
OPENING, CLOSING = "([{", ")]}"
ASSIGNMENT = re.compile(r"(?<![=<>!])(?:[-+*/%|&^]|<<|>>)?=(?!=)")
CONSTANT = re.compile(r"\s*(?:static |inline )*constexpr\b[^()]*=")  # the compiler's own
CONTROL = re.compile(r"\s*(?:else\b|(?:if|for|while)\s*(?=\())")


def without_comments(text):
    """Line by line as it was."""
    parts = re.finditer(r'(//[^\n]*|/\*.*?\*/)|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', text, re.S)
    return blank(text, [m.span() for m in parts if m[1]])


def expression(code, start, end):
    """(start, end) of the expression around code[start:end]: up to a bracket, comma, semicolon or colon."""
    depth, left = 0, start
    while left > 0:
        c = code[left - 1]
        if c == "}" and depth == 0 and re.match(r"\s*\n", code[left:]):  # a block has ended
            break
        if c in CLOSING:
            depth += 1
        elif c in OPENING:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0 and c in ":?" and code[left - 2:left] != "::":
            break
        elif depth == 0 and (c in ",;" or code[left - 2:left] == "&&" or code[left - 2:left] == "||"):
            break
        left -= 2 if code[left - 2:left] == "::" else 1
    depth, right = 0, end
    while right < len(code):
        c = code[right]
        if c in OPENING:
            depth += 1
        elif c in CLOSING:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0 and (c in ",;?" or code[right:right + 2] in ("&&", "||")):
            break
        elif depth == 0 and c == ":":
            if code[right:right + 2] != "::":
                break
            right += 1
        right += 1
    return left, right


def slot(code, mutant, start, end):
    """Where the choice is written: (start, end, its kind)."""
    if mutant.new == ";":
        return start, end, "statement"
    if mutant.new.startswith("!("):
        return start, end, "condition"
    left, right = expression(code, start, end)
    while m := CONTROL.match(code, left, start):  # if (...) x += y
        left = closing(code, m.end()) if "else" not in m[0] else m.end()
    if mutant.old not in ("+=", "-=", "*=", "/="):
        depth, after = 0, left
        for m in re.finditer(r"[(\[{]|[)\]}]|" + ASSIGNMENT.pattern + r"|\breturn\b", code[left:start]):
            depth += (m[0] in OPENING) - (m[0] in CLOSING)
            if depth == 0 and m[0] not in CLOSING:
                after = left + m.end()
        left = after
    while code[left].isspace():
        left += 1
    while code[right - 1].isspace():
        right -= 1
    return left, right, "expression"


def chosen(kind, number, changed, old):
    if kind == "statement":
        return f"{{ if (!planted::mutant({number})) {{ {old} }} }}"
    if kind == "condition":
        return f"(static_cast<bool>({old}) != planted::mutant({number}))"
    return f"(planted::mutant({number}) ? ({changed}) : ({old}))"


def plant_cpp(text, mutants):
    """The text with those of mutants {number: mutant} that have a place of their own, and {number: its lines}."""
    code, plain = code_of_cpp(text), without_comments(text)
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    places = {}
    for number, m in mutants.items():
        start = starts[m.line - 1] + m.column
        left, right, kind = slot(code, m, start, start + len(m.old))
        changed = plain[left:start] + m.new + plain[start + len(m.old):right]
        if any(CONSTANT.match(code, max(code.rfind(c, 0, left) for c in ends) + 1, left) for ends in (";}", ";}{")):
            continue
        if all((left, right) == p[:2] or right <= p[0] or p[1] <= left for p in places.values()):
            places[number] = (left, right, kind, changed)
    by_slot = {}
    for number, (left, right, kind, changed) in places.items():
        by_slot.setdefault((left, right), []).append((number, kind, changed))
    for (left, right), choices in sorted(by_slot.items(), reverse=True):
        new = plain[left:right]
        for number, kind, changed in choices:
            new = chosen(kind, number, changed, new)
        text = text[:left] + new + text[right:]
    text = re.sub(r"^//[^\n]*", f'#include "{HEADER}"', text, count=1)
    lines = {}
    for number in places:
        at = text.index(f"planted::mutant({number})")
        first = text.count("\n", 0, at) + 1
        left, right = places[number][:2]
        lines[number] = range(first, first + 2 * plain[left:right].count("\n") + 1)
    return text, lines


def changed_node(old, new):
    """Path of the smallest expression or statement in which two syntax trees differ."""
    path, best = [], []
    while True:
        differing = []
        if type(old) is not type(new):
            return best
        for field, value in ast.iter_fields(old):
            other = getattr(new, field)
            pairs = [(None, value, other)] if not isinstance(value, list) else \
                [(i, *pair) for i, pair in enumerate(zip(value, other))] if len(value) == len(other) else [(-1, 0, 1)]
            for i, a, b in pairs:
                if (ast.dump(a) != ast.dump(b)) if isinstance(a, ast.AST) and isinstance(b, ast.AST) else a != b:
                    differing.append((field, i, a, b))
        if len(differing) != 1:
            return best
        field, i, a, b = differing[0]
        if not (isinstance(a, ast.AST) and isinstance(b, ast.AST)):
            return best
        path = path + [(field, i)]
        if isinstance(a, (ast.expr, ast.stmt)) and isinstance(b, (ast.expr, ast.stmt)):
            best = path
        old, new = a, b


def at_path(tree, path):
    for field, i in path:
        tree = getattr(tree, field) if i is None else getattr(tree, field)[i]
    return tree


def plant_python(text, mutants):
    """As plant_cpp; the lines are of no use here."""
    tree, paths = ast.parse(text), {}
    for number, m in mutants.items():
        path = changed_node(tree, ast.parse(m.planted(text)))
        if path and all(path == p or path[:len(p)] != p and p[:len(path)] != path for p in paths.values()):
            paths[number] = path
    for number, path in paths.items():
        new = at_path(ast.parse(mutants[number].planted(text)), path)
        parent, (field, i) = at_path(tree, path[:-1]), path[-1]
        old = at_path(parent, path[-1:])
        test = ast.Call(ast.Name("_mutant", ast.Load()), [ast.Constant(number)], [])
        choice = ast.IfExp(test, new, old) if isinstance(old, ast.expr) else ast.If(test, [new], [old])
        if i is None:
            setattr(parent, field, choice)
        else:
            getattr(parent, field)[i] = choice
    # Behind the imports from __future__. By its path: tests set the module path themselves.
    first = 1 + max((i for i, node in enumerate(tree.body) if getattr(node, "module", "") == "__future__"),
                    default=0 if ast.get_docstring(tree) else -1)
    tree.body[first:first] = ast.parse(f"_mutant = __import__('runpy').run_path({str(RUNTIME)!r})['mutant']").body
    return ast.unparse(ast.fix_missing_locations(tree)) + "\n", dict.fromkeys(paths, ())


def plant(name, text, mutants):
    return (plant_python if name.endswith(".py") else plant_cpp)(text, mutants)
