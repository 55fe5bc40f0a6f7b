#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Plants random bugs one at a time and counts how many of them the tests see.

    mutants.py --build build/mutants --count 40 --seed 1         a sample of all folders
    mutants.py --build build/mutants --folder theory --count 10  of one
    mutants.py --list --count 40 --seed 1                        what would be planted, and nothing else

A mutant is one changed operator, comparison, sign, constant, function (min for max), condition or one
deleted statement. All that the rules below find in the folders' code are shuffled by the seed and taken
in that order. Left out are comments, texts, includes, errors and progress, and lines that end processes or
remove files. What does not compile (warnings are errors), or compiles to the same object code, does not
count and is replaced by the next one.

The sources are copied to BUILD/source and built there; the working tree is not touched. Each mutant meets
the tests of its layer first; those that survive, the rest of the short suite (all without the label
"long") at the end. A test sees a mutant if it fails, or takes ten times as long (of a processor) as without it. Tests that
fail without a mutant are named and left out. Outcomes are kept in BUILD/outcomes.jsonl: started again, it
goes on from there. Survivors are to be looked at one by one: some change nothing that anyone could see.
Exit code 1 if a smaller fraction than --least is killed.
"""

import argparse
import ast
import hashlib
import io
import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
import tokenize
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Folder of the mutant: programs of the tests of its layer.
LAYERS = {"kernels": ["kernels", "engine"], "decomposition": ["decomposition", "mpi"], "theory": ["theory"],
          "engine": ["engine", "physics"], "python": ["python"]}
# Text for people, and code of machines that are not here.
TEXT = ("engine/run/summary.cpp", "engine/commands/", "kernels/device/cuda", "kernels/device/no_cuda",
        "python/asperity/page.py", "python/asperity/sentences.py", "python/asperity/terminal.py",
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
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", *folders], check=True, capture_output=True, text=True).stdout
    found = []
    for name in sorted(listed.split()):
        if name.endswith((".cpp", ".hpp", ".py")) and not name.startswith(TEXT):
            found += mutants_of(name, (ROOT / name).read_text())
    random.Random(seed).shuffle(found)
    return found


class Copy:
    """The files of the working tree in a folder of their own, with a build."""

    def __init__(self, place, jobs):
        # The build is as deep below the sources as that of the preset, so that a compiler cache serves both.
        self.source, self.build = place / "source", place / "source/build/release"
        self.jobs, self.times = jobs, place / "times.json"
        self.seconds = json.loads(self.times.read_text()) if self.times.exists() else {}
        self.source.mkdir(parents=True, exist_ok=True)
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "-z"], check=True,
                                capture_output=True, text=True).stdout
        files = {name for name in listed.split("\0") if name and (ROOT / name).is_file()}
        for old in [p for p in self.source.rglob("*") if p.is_file() and self.build not in p.parents]:
            if str(old.relative_to(self.source)) not in files:
                old.unlink()
        for name in files:  # what has not changed keeps its time, and is not compiled again
            to, text = self.source / name, (ROOT / name).read_bytes()
            if not to.is_file() or to.read_bytes() != text:
                to.parent.mkdir(parents=True, exist_ok=True)
                to.write_bytes(text)
                to.chmod((ROOT / name).stat().st_mode)
        # Kernels once: each mutant compiles a third of them.
        subprocess.run(["cmake", "-G", "Ninja", "-S", self.source, "-B", self.build, "-DCMAKE_BUILD_TYPE=Release",
                        "-DASPERITY_TESTS=ON", "-DASPERITY_PERF=OFF", "-DASPERITY_WERROR=ON", "-DASPERITY_CUDA=OFF",
                        "-DASPERITY_ONE_VARIANT=ON",
                        "-DASPERITY_KERNEL_OPTIONS=-march=x86-64-v3"], check=True, stdout=subprocess.DEVNULL)
        self.tests = {}

    def build_and_measure(self, targets, wanted):
        """Without a mutant: builds these (nothing named: all), and takes the time of the short tests that are wanted."""
        if (made := self.make(targets)).returncode:
            sys.exit(made.stdout[-3000:])
        shown = subprocess.run(["ctest", "--test-dir", self.build, "--show-only=json-v1"], check=True,
                               capture_output=True, text=True).stdout
        for test in json.loads(shown)["tests"]:
            test.update({p["name"]: p["value"] for p in test["properties"]})
            if "command" in test and "long" not in test.get("LABELS", []):  # none: its program is not built
                self.tests[test["name"]] = test
        self.measure([t for t in self.tests if wanted(t)])

    def make(self, targets):
        return subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), *targets], capture_output=True, text=True)

    def program(self, test):
        """The last part of the name of its program; python for those of the package."""
        labels = self.tests[test].get("LABELS", [])
        programs = [Path(word).name for word in self.tests[test]["command"] if Path(word).name.startswith("test_")]
        return "python" if "python" in labels else programs[0][5:] if programs else ""

    def of_layer(self, folder):
        return [t for t in self.tests if self.program(t) in LAYERS[folder]]

    def targets(self, program):
        return [f"tests/test_{program}"] if program not in ("", "python") else ["engine/asperity"]

    def run(self, test, limit):
        """Whether it passes (or is skipped) within so many seconds of a processor, and how long it took.

        Not by the clock: what else runs here may hold it up."""
        limit = int(limit)

        def limits():
            resource.setrlimit(resource.RLIMIT_FSIZE, (2**31, 2**31))
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
        properties = self.tests[test]
        env = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1",
               **dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))}
        start = time.monotonic()
        process = subprocess.Popen(properties["command"], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT,
                                   cwd=properties.get("WORKING_DIRECTORY", self.build), start_new_session=True,
                                   preexec_fn=limits)
        try:
            code = process.wait(60.0 * limit)  # what waits for ever takes no processor
        except subprocess.TimeoutExpired:
            code = -1
            for how in (signal.SIGTERM, signal.SIGKILL):  # the test's own session; mpiexec ends its ranks on the first
                os.killpg(process.pid, how)
                try:
                    process.wait(10)
                    break
                except subprocess.TimeoutExpired:
                    pass
        passed = code == 0 or code == properties.get("SKIP_RETURN_CODE")
        return passed, time.monotonic() - start

    def measure(self, tests):
        """How long these take without a mutant. What fails then is left out from here on."""
        for test in tests:
            if test in self.seconds:
                continue
            passed, seconds = self.run(test, 1800)
            self.seconds[test] = seconds if passed else -1.0
            self.times.write_text(json.dumps(self.seconds, indent=0))
        for test in [t for t in tests if self.seconds[t] < 0.0]:
            print(f"left out, for it fails without a mutant: {test}", flush=True)
            del self.tests[test]

    def objects(self):
        return {p: p.stat().st_mtime_ns for p in self.build.rglob("*.o")}


class Bench:
    def __init__(self, copy, outcomes):
        self.copy, self.file = copy, outcomes
        self.kills = {}
        self.known = {}
        if outcomes.exists():
            for line in outcomes.read_text().splitlines():
                record = json.loads(line)
                self.known[Mutant(**record["mutant"])] = record["outcome"]

    def keep(self, mutant, outcome):
        self.known[mutant] = outcome
        with self.file.open("a") as file:
            file.write(json.dumps({"mutant": mutant.__dict__, "outcome": outcome}) + "\n")
        print(f"{mutant}    {outcome}", flush=True)

    def killer(self, mutant, tests):
        """The first test that sees it: those that say so in their name first, then what saw the most so far, then the quick ones."""
        stem = Path(mutant.file).stem.split("_")[0]
        tests = sorted((t for t in tests if t in self.copy.tests),
                       key=lambda t: (stem not in t, -self.kills.get(t, 0), self.copy.seconds[t]))
        made = set()
        for test in tests:
            program = self.copy.program(test)
            if program not in made and self.copy.make(self.copy.targets(program)).returncode:
                return "does not compile"
            made.add(program)
            passed, _ = self.copy.run(test, 10.0 * self.copy.seconds[test] + 20.0)
            if not passed:
                self.kills[test] = self.kills.get(test, 0) + 1
                return f"killed by {test}"
        return None

    def plant(self, mutant, look):
        file = self.copy.source / mutant.file
        text = file.read_text()
        file.write_text(mutant.planted(text))
        try:
            return look()
        finally:
            file.write_text(text)

    def against_layer(self, mutant, objects):
        def look():
            tests = self.copy.of_layer(mutant.folder)
            if mutant.folder != "python":
                if self.copy.make(self.copy.targets(LAYERS[mutant.folder][0])).returncode:
                    return "does not compile"
                changed = [p for p, stamp in self.copy.objects().items() if stamp != objects[0].get(p)]
                objects[0] = self.copy.objects()
                if all(digest(p) == objects[1].get(p) for p in changed):
                    return "same object code"
            return self.killer(mutant, tests) or "survives its layer"
        return self.plant(mutant, look)

    def against_the_rest(self, mutant):
        rest = [t for t in self.copy.tests if t not in self.copy.of_layer(mutant.folder)]
        def look():
            if self.copy.make([]).returncode:
                return "does not compile"
            return self.killer(mutant, rest) or "SURVIVES"
        return self.plant(mutant, look)


def digest(path):
    return hashlib.sha256(path.read_bytes()).digest()


def counts(outcome):
    return outcome not in ("does not compile", "same object code")


def score(outcomes):
    print(f"\n{'folder':<16}{'mutants':>9}{'killed':>9}{'survive':>9}")
    for folder in [*LAYERS, "all"]:
        own = [o for m, o in outcomes.items() if counts(o) and folder in (m.folder, "all")]
        if own:
            killed = sum(o.startswith("killed") for o in own)
            print(f"{folder:<16}{len(own):>9}{killed:>9}{len(own) - killed:>9}")
    for mutant, outcome in outcomes.items():
        if outcome.lower().startswith("survives"):
            print(f"{mutant}    {outcome}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", action="append", choices=LAYERS)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--minutes", type=float, default=1e9, help="no further mutant is begun after so many")
    parser.add_argument("--layer-only", action="store_true", help="without the rest of the short suite")
    parser.add_argument("--least", type=float, default=0.0, help="fraction of the mutants to be killed")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    folders = options.folder or list(LAYERS)
    mutants = sample(folders, options.seed)
    if options.list:
        print(*mutants[:options.count], f"of {len(mutants)}", sep="\n")
        return 0
    end = time.monotonic() + 60.0 * options.minutes
    copy = Copy(options.build.resolve(), options.jobs)
    bench = Bench(copy, options.build / "outcomes.jsonl")
    programs = {p for f in folders for p in LAYERS[f]}
    copy.build_and_measure(sorted({t for p in programs for t in copy.targets(p)}), lambda t: copy.program(t) in programs)
    objects = [copy.objects(), {p: digest(p) for p in copy.objects()}]
    taken = []
    for mutant in mutants:
        if len(taken) >= options.count or time.monotonic() > end:
            break
        if mutant not in bench.known:
            bench.keep(mutant, bench.against_layer(mutant, objects))
        if counts(bench.known[mutant]):
            taken.append(mutant)
    left = [m for m in taken if bench.known[m] == "survives its layer"]
    if left and not options.layer_only:
        copy.build_and_measure([], lambda test: True)
        for mutant in left:
            if time.monotonic() > end:
                break
            bench.keep(mutant, bench.against_the_rest(mutant))
    score({m: bench.known[m] for m in taken})
    killed = sum(bench.known[m].startswith("killed") for m in taken)
    return 1 if killed < options.least * len(taken) else 0


if __name__ == "__main__":
    sys.exit(main())
