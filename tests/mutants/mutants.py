#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Plants random bugs and counts how many of them the tests see.

    mutants.py --build build/mutants --count 40 --seed 1         a sample of all folders
    mutants.py --build build/mutants --folder theory --count 10  of one
    mutants.py --list --count 40 --seed 1                        what would be planted, and nothing else

What a mutant is, rules.py says. All that there are in the folders are shuffled by the seed; the first COUNT that
can be planted are taken. They stand together in one copy of the sources (planting.py), in BUILD/source, which is
built there once; the environment says which one is on. Left out is what does not compile and what the compiler
computes itself (constants of array sizes, static tables).

The short tests (all without the label "long") run once without a mutant and leave behind which mutants they come
to. Each mutant then meets the tests that come to it, first those of its layer, until one sees it: it fails, or
takes ten times as long (of a processor) as without it. Tests that fail without a mutant are named and left out.
Outcomes are kept in BUILD/outcomes.jsonl: started again with the same sources and options, it goes on from there.
Survivors are to be looked at one by one: some change nothing that anyone could see. Exit code 1 if a smaller
fraction than --least is killed.
"""

import argparse
import hashlib
import json
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from planting import plant
from rules import LAYERS, ROOT, sample

PLACES = 4096  # planted.hpp


class Copy:
    """The files of the working tree with mutants in them, in a folder of their own, with a build."""

    def __init__(self, place, mutants, count, jobs):
        # The build is as deep below the sources as that of the preset, so that a compiler cache serves both.
        self.source, self.build = place / "source", place / "source/build/release"
        self.place, self.jobs = place, jobs
        self.copy_files()
        self.planted = self.plant_all(mutants, count)
        (place / "planted.json").write_text(json.dumps({n: str(m) for n, m in self.planted.items()}, indent=0))
        self.tests = self.short_tests()
        text = json.dumps([[n, str(m), (ROOT / m.file).read_text()] for n, m in self.planted.items()])
        self.key = hashlib.sha256(text.encode()).hexdigest()[:12]

    def copy_files(self):
        self.source.mkdir(parents=True, exist_ok=True)
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "-z"], check=True,
                                capture_output=True, text=True).stdout
        self.files = {name for name in listed.split("\0") if name and (ROOT / name).is_file()}
        for old in [p for p in self.source.rglob("*") if p.is_file() and self.build not in p.parents]:
            if str(old.relative_to(self.source)) not in self.files:
                old.unlink()

    def write(self, files):
        """What has not changed keeps its time, and is not compiled again."""
        for name, text in files.items():
            to = self.source / name
            if not to.is_file() or to.read_bytes() != text:
                to.parent.mkdir(parents=True, exist_ok=True)
                to.write_bytes(text)
                to.chmod((ROOT / name).stat().st_mode)

    def plant_all(self, mutants, count):
        """The first so many that compile, by number."""
        file = self.place / "dropped.json"  # from one start to the next
        dropped = set(json.loads(file.read_text())) if file.exists() else set()
        candidates = {i: m for i, m in enumerate(mutants[:2 * count]) if str(m) not in dropped}
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DASPERITY_TESTS=ON", "-DASPERITY_PERF=OFF", "-DASPERITY_CUDA=OFF"]
        while True:
            planted, lines = {}, {}
            files = {name: (ROOT / name).read_bytes() for name in self.files}
            for number, mutant in candidates.items():
                if len(planted) == count:
                    break
                together = {n: m for n, m in planted.items() if m.file == mutant.file} | {number: mutant}
                text, where = plant(mutant.file, (ROOT / mutant.file).read_text(), together)
                if number in where:
                    planted[number] = mutant
                    files[mutant.file] = text.encode()
                    lines |= where
            self.write(files)
            (self.build / "CMakeCache.txt").unlink(missing_ok=True)  # options of another start
            subprocess.run(["cmake", "-G", "Ninja", "-S", self.source, "-B", self.build, *options], check=True,
                           stdout=subprocess.DEVNULL)
            log = self.place / "build.log"
            with log.open("w") as out:
                made = subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), "-k", "0"], stdout=out)
            if made.returncode == 0:
                return planted
            # Of sources, and of headers as a layer's tests and dependants see them.
            error = r"^(?:\.\./\.\./|.*layers/\w+/)(\w+/[\w/]+\.[ch]pp):(\d+):\d+: error"
            places = set(re.findall(error, log.read_text(), re.M))
            wrong = {n for n in planted if any(planted[n].file == f and int(line) in lines[n] for f, line in places)}
            if not wrong:
                sys.exit(f"the copy does not build: {log}")
            print(f"{len(wrong)} of {len(planted)} do not compile", flush=True)
            candidates = {n: m for n, m in candidates.items() if n not in wrong}
            dropped |= {str(planted[n]) for n in wrong}
            file.write_text(json.dumps(sorted(dropped), indent=0))

    def short_tests(self):
        shown = subprocess.run(["ctest", "--test-dir", self.build, "--show-only=json-v1"], check=True,
                               capture_output=True, text=True).stdout
        tests = {test["name"]: test | {p["name"]: p["value"] for p in test["properties"]}
                 for test in json.loads(shown)["tests"]}
        return {name: test for name, test in tests.items() if "long" not in test.get("LABELS", [])}

    def program(self, test):
        """The last part of the name of its program; python for those of the package."""
        programs = [Path(word).name for word in self.tests[test]["command"] if Path(word).name.startswith("test_")]
        return "python" if "python" in self.tests[test].get("LABELS", []) else programs[0][5:] if programs else ""

    def run(self, test, limit, **environment):
        """Whether it passes (or is skipped) within so many seconds of a processor, and how long it took.

        Not by the clock: what else runs here may hold it up."""
        def limits():
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # which a shell's job in the background ignores
            resource.setrlimit(resource.RLIMIT_FSIZE, (2**31, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 5))
        properties = self.tests[test]
        env = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "GTEST_FAIL_FAST": "1", "PYTEST_ADDOPTS": "-x",
               **environment, **dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))}
        start = time.monotonic()
        process = subprocess.Popen(properties["command"], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT,
                                   cwd=properties.get("WORKING_DIRECTORY", self.build), start_new_session=True,
                                   preexec_fn=limits)
        try:
            code = process.wait(20.0 * limit)  # what waits for ever takes no processor
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


class Lines:
    """Records of a file, one a line, added as they come."""

    def __init__(self, file):
        self.file, self.lock = file, threading.Lock()
        self.records = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []

    def add(self, record):
        with self.lock, self.file.open("a") as file:
            file.write(json.dumps(record) + "\n")
            self.records.append(record)


class Bench:
    def __init__(self, copy):
        self.copy, self.kills = copy, {}
        self.busy = {test: threading.Lock() for test in copy.tests}  # a test never runs twice at a time
        self.reach, self.seconds = {}, {}
        self.outcomes = {}

    def look_at_tests(self):
        """Without a mutant: which mutants each test comes to, and its time."""
        lines = Lines(self.copy.place / f"reach-{self.copy.key}.jsonl")

        def look(test):
            marks = self.copy.place / f"{test}.reached"
            marks.write_bytes(bytes(PLACES))
            passed, seconds = self.copy.run(test, 1800, MUTANTS_REACHED=str(marks))
            reached = [n for n, mark in enumerate(marks.read_bytes()) if mark]
            marks.unlink()
            lines.add({"test": test, "seconds": seconds if passed else -1.0, "reached": reached})
        known = {r["test"] for r in lines.records}
        with ThreadPoolExecutor(self.copy.jobs) as pool:
            list(pool.map(look, [t for t in self.copy.tests if t not in known]))
        for record in lines.records:
            if record["seconds"] < 0.0:
                print(f"left out, for it fails without a mutant: {record['test']}", flush=True)
            else:
                self.seconds[record["test"]] = record["seconds"]
                self.reach[record["test"]] = set(record["reached"])

    def killer(self, number, tests):
        """The first of these that sees it: those of its name, what saw the most so far, the quick ones."""
        stem = self.copy.planted[number].file.rsplit("/", 1)[-1].split("_")[0].split(".")[0]
        for test in sorted(tests, key=lambda t: (stem not in t, self.seconds[t] / (1 + self.kills.get(t, 0)))):
            with self.busy[test]:
                passed, _ = self.copy.run(test, 10.0 * self.seconds[test] + 20.0, MUTANT_ON=str(number))
            if not passed:
                self.kills[test] = self.kills.get(test, 0) + 1
                return test
        return None

    def meet(self, minutes):
        """All mutants the tests of their layers, then those that are left the others, the quick ones first."""
        lines = Lines(self.copy.place / f"outcomes-{self.copy.key}.jsonl")
        self.outcomes = {r["number"]: r["outcome"] for r in lines.records}
        end = time.monotonic() + 60.0 * minutes
        layer, rest = {}, {}
        for number, mutant in self.copy.planted.items():
            reaching = [t for t in self.seconds if number in self.reach[t]]
            layer[number] = [t for t in reaching if self.copy.program(t) in LAYERS[mutant.folder]]
            rest[number] = [t for t in reaching if t not in layer[number]]

        def one(number, tests, otherwise):
            if time.monotonic() > end:
                return
            killer = self.killer(number, tests)
            self.outcomes[number] = f"killed by {killer}" if killer else otherwise
            lines.add({"number": number, "mutant": str(self.copy.planted[number]), "outcome": self.outcomes[number]})
            print(f"{self.copy.planted[number]}    {self.outcomes[number]}", flush=True)
        with ThreadPoolExecutor(self.copy.jobs) as pool:
            list(pool.map(lambda n: one(n, layer[n], "SURVIVES ITS LAYER" if rest[n] else "SURVIVES"),
                          [n for n in self.copy.planted if n not in self.outcomes]))
            left = [n for n, outcome in self.outcomes.items() if outcome == "SURVIVES ITS LAYER"]
            left.sort(key=lambda n: sum(self.seconds[t] for t in rest[n]))
            list(pool.map(lambda n: one(n, rest[n], "SURVIVES"), left))

    def score(self):
        print(f"\n{'folder':<16}{'mutants':>9}{'killed':>9}{'survive':>9}")
        for folder in [*LAYERS, "all"]:
            own = [o for n, o in self.outcomes.items() if folder in (self.copy.planted[n].folder, "all")]
            killed = sum(o.startswith("killed") for o in own)
            if own:
                print(f"{folder:<16}{len(own):>9}{killed:>9}{len(own) - killed:>9}")
        for number, outcome in sorted(self.outcomes.items()):
            if outcome.startswith("SURVIVES"):
                print(f"{self.copy.planted[number]}    {outcome}")
        return killed / max(1, len(own))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", action="append", choices=LAYERS)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--minutes", type=float, default=1e9, help="no further mutant is begun after so many")
    parser.add_argument("--least", type=float, default=0.0, help="fraction of the mutants to be killed")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    mutants = sample(options.folder or list(LAYERS), options.seed)
    if options.list:
        print(*mutants[:options.count], f"of {len(mutants)}", sep="\n")
        return 0
    if not 0 < 2 * options.count < PLACES:
        parser.error(f"--count: 1 to {PLACES // 2 - 1}")
    bench = Bench(Copy(options.build.resolve(), mutants, options.count, options.jobs))
    bench.look_at_tests()
    bench.meet(options.minutes)
    return 1 if bench.score() < options.least else 0


if __name__ == "__main__":
    sys.exit(main())
