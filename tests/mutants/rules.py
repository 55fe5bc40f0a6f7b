# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Which mutants there are: one changed operator, comparison, sign, constant, function (min for max), condition,
or one deleted statement, in the code of the folders. Comments, texts, includes, errors and progress are left
out, and lines that end processes or remove files."""

import ast
import io
import random
import re
import subprocess
import tokenize
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Folder of the mutant: programs of the tests of its layer.
LAYERS = {"kernels": ["kernels", "engine"], "decomposition": ["decomposition", "mpi"], "theory": ["theory"],
          "engine": ["engine", "physics"], "python": ["python"]}
# Text for people, and code of machines that are not here.
TEXT = ("engine/run/summary.cpp", "engine/commands/", "kernels/device/cuda", "kernels/device/no_cuda",
        "python/asperity/reports/page.py", "python/asperity/reports/sentences.py", "python/asperity/terminal.py",
        "python/asperity/plots/style.py")
LEFT_ALONE = re.compile(r"kill|unlink|rmtree|remove|rename|fork|rlimit|signal|operator|virtual")
COMPARED = {"<": ("<=", ">="), ">": (">=", "<="), "<=": ("<", ">"), ">=": (">", "<"), "==": ("!=",), "!=": ("==",)}
SWAPPED = {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "&&": "||",
           "||": "&&", "and": "or", "or": "and", "//": "*", "**": "*"}
FUNCTIONS = {"min": "max", "max": "min", "floor": "ceil", "ceil": "floor", "sin": "cos", "cos": "sin", "any": "all",
             "all": "any", "any_of": "all_of", "all_of": "any_of", "min_element": "max_element",
             "max_element": "min_element", "abs": "", "sqrt": ""}
OLD = "\0"  # stands for what is changed
WORDS = {"true": "false", "false": "true", "True": "False", "False": "True"}


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int
    column: int
    old: str
    new: str

    @property
    def folder(self):
        return self.file.split("/")[0]

    def planted(self, text):
        lines = text.split("\n")
        line = lines[self.line - 1]
        assert line[self.column:].startswith(self.old), self
        lines[self.line - 1] = line[:self.column] + self.new + line[self.column + len(self.old):]
        return "\n".join(lines)

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column + 1}: {self.old.strip()} -> {self.new or 'nothing'}"


def blank(text, spans):
    """The text with these parts as blanks, line by line as it was."""
    for start, end in spans:
        text = text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]
    return text


def code_of_cpp(text):
    """Without comments, texts and directives, and without what is said to people."""
    texts = r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:\\\n|[^\n])*'
    text = blank(text, [m.span() for m in re.finditer(texts, text, re.S | re.M)])
    said = r"\bthrow\b[^;]*;|static_assert[^;]*;|(?:fmt::(?:print|format)|progress\.\w+|\bsay)\("
    spans = []
    for m in re.finditer(said, text):
        end = m.end() if text[m.end() - 1] == ";" else closing(text, m.end() - 1)
        spans.append((m.start(), end))
    return blank(text, spans)


def code_of_python(text):
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    spans, raised = [], None
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        start, end = (starts[row - 1] + column for row, column in (token.start, token.end))
        if token.type in (tokenize.STRING, tokenize.COMMENT):
            spans.append((start, end))
        if token.type == tokenize.NAME and token.string in ("raise", "print", "import", "assert") and raised is None:
            raised = start
        if token.type == tokenize.NEWLINE and raised is not None:
            spans.append((raised, end - 1))
            raised = None
    return blank(text, spans)


def closing(text, opening):
    """The place behind the parenthesis that closes this one; the end of the text if none does."""
    depth = 0
    for i in range(opening, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i + 1
    return len(text)


def constants(line):
    """(column, old, new) of numbers: 0 and 1 for each other, others one more, or twice as much."""
    for m in re.finditer(r"(?<![\w.'])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(f?)(?![\w.'])", line):
        number = m[1]
        if re.fullmatch(r"\d+", number):
            new = "1" if number == "0" else "0" if number == "1" else str(int(number) + 1)
        else:
            new = "1.0" if float(number) == 0.0 else repr(2.0 * float(number))
        yield m.start(), m[0], new + m[2]


def mutants_of_line(line, python):
    """(column, old, new) of everything to be changed in a line of code."""
    for m in re.finditer(r"(?<=\S) (<=|>=|==|!=|[-+*/]=|&&|\|\||//|\*\*|[-+*/<>]|and|or)(?= |$)", line):
        for new in COMPARED.get(m[1], ()) or (SWAPPED[m[1]],):
            yield m.start(1), m[1], new
    for m in re.finditer(r"(?:(?<=[(\[])|(?<=[,=?:*/<>(] )|(?<=return ))-(?=[\w(])", line):
        yield m.start(), "-", ""
    for m in re.finditer(r"\bnot (?=\S)" if python else r"!(?=[\w(])", line):
        yield m.start(), m[0], ""
    for m in re.finditer(r"(?<![\w.])((?:std::|np\.|math\.)?)(\w+)(?=\()", line):
        if m[2] in FUNCTIONS and (python or m[1]):
            new = FUNCTIONS[m[2]]
            yield m.start(), m[0], m[1] + new if new else ""
    for m in re.finditer(r"\b(true|false|True|False)\b", line):
        yield m.start(), m[0], WORDS[m[0]]
    yield from constants(line)
    if python:
        m = re.match(r"\s*(?:el)?(?:if|while) (.+):\s*$", line)
        if m:
            yield m.start(1), m[1], f"not ({OLD})"
    else:
        for m in re.finditer(r"\b(?:if|while) \(", line):
            end = closing(line, m.end() - 1)
            condition = line[m.end():end - 1]
            if line[end - 1] == ")" and " = " not in condition:
                yield m.end(), condition, f"!({OLD})"


def deleted(line, before, python):
    """(column, old, new) of a statement of its own: a call or an assignment."""
    name = r"[\w:]+(?:\.\w+|->\w+|\[[^\]]*\]|\([^()]*\))*"
    if python:
        m = re.match(rf"\s*((?:{name}\(.*\)|{name} (?:[-+*/]=|=(?!=)) .*))$", line)
        if m and m[1].count("(") == m[1].count(")") and before.rstrip().endswith((":", ")", "")):
            yield m.start(1), m[1], "pass"
        return
    m = re.match(rf"\s*((?:(?:\+\+|--){name}|{name} [-+*/|&]?= .*|{name}\(.*\)|break|continue);)\s*$", line)
    if m and m[1].count("(") == m[1].count(")") and not m[1].startswith(("return", "delete", "using")):
        if not before.strip() or before.rstrip()[-1] in ";{}:" or re.search(r"(^|\s)(else|if .*\)|for .*\))$", before):
            yield m.start(1), m[1], ";"


def mutants_of(name, text):
    python = name.endswith(".py")
    lines = (code_of_python(text) if python else code_of_cpp(text)).split("\n")
    found, before = [], ""
    for number, line in enumerate(lines, 1):
        unused = re.match(r"\s*(using|typedef|namespace|template|enum|public|private|def|class|from|import|@)\b", line)
        if not unused and not LEFT_ALONE.search(line):
            changes = list(mutants_of_line(line, python)) + list(deleted(line, before, python))
            for column, old, new in changes:
                # Members that are 0 until they are set.
                if re.search(r"\w \w+ = 0(\.0)?$", line[:column + len(old)]) and name.endswith(".hpp"):
                    continue
                old = text.split("\n")[number - 1][column:column + len(old)]  # with its texts
                found.append(Mutant(name, number, column, old, new.replace(OLD, old)))
        before = line if line.strip() else before
    if python:
        found = [m for m in found if parses(m.planted(text))]
    return found


def parses(text):
    try:
        ast.parse(text)
    except SyntaxError:
        return False
    return True


def sample(folders, seed):
    """All mutants of these folders, in the order of the seed."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", *folders], check=True, capture_output=True,
                            text=True).stdout
    found = []
    for name in sorted(listed.split()):
        if name.endswith((".cpp", ".hpp", ".py")) and not name.startswith(TEXT):
            found += mutants_of(name, (ROOT / name).read_text())
    random.Random(seed).shuffle(found)
    return found
