#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Plants bugs one at a time and runs the tests that should see them.

    mutants.py --build build/mutants              every mutant of mutants.toml
    mutants.py --build build/mutants gap tail     those whose names contain one of these words
    mutants.py --check                            only: does every mutant's text still exist, once?

The sources are copied to BUILD/source and built there, each mutant with the least that its tests need;
the working tree is not touched. First the tests run without a mutant and must pass. A mutant is killed
if one of its tests fails, or runs longer than ten times what it took without; one that does not
compile says nothing about the tests and counts as not killed. Exit code 1 if any is not killed.
"""

import argparse
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def read_list(words):
    mutants = tomllib.loads((HERE / "mutants.toml").read_text())["mutant"]
    names = [m["name"] for m in mutants]
    if len(set(names)) != len(names):
        sys.exit("mutants.toml: two mutants have the same name")
    chosen = [m for m in mutants if not words or any(w in m["name"] for w in words)]
    return chosen or sys.exit(f"no mutant's name contains {' or '.join(words)}")


def check(mutants):
    """The mutants whose text is not in its file exactly once."""
    lost = 0
    for m in mutants:
        file = ROOT / m["file"]
        count = file.read_text().count(m["old"]) if file.is_file() else 0
        if count != 1:
            lost += 1
            print(f"{m['name']}: its text is {count} times in {m['file']}; it must be there once:\n    {m['old']}")
    return lost


class Copy:
    """The tracked and new files of the working tree, in a folder of their own with a build."""

    def __init__(self, build):
        # The build is as deep below the sources as that of the preset, so that a compiler cache serves both.
        self.source, self.build = build / "source", build / "source/build/release"
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
        if not (self.build / "build.ninja").exists():
            subprocess.run(["cmake", "-G", "Ninja", "-S", self.source, "-B", self.build, "-DCMAKE_BUILD_TYPE=Release",
                            "-DASPERITY_PERF=OFF", "-DASPERITY_CUDA=OFF"], check=True, stdout=subprocess.DEVNULL)

    def make(self, programs):
        return subprocess.run(["ninja", "-C", self.build, *(f"tests/{p}" for p in programs)], capture_output=True,
                              text=True)

    def failure(self, suite, limit):
        """The test of program:file, or of program:file@ranks, that fails or does not end within so many seconds; None if all pass."""
        program, file, ranks = re.fullmatch(r"(\w+):(\w+)(?:@(\d+))?", suite).groups()
        command = [self.build / "tests" / program, file, "--gtest_fail_fast", "--gtest_brief=1"]
        if ranks:
            command = ["mpiexec", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", ranks, *command]
        env = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}
        run = subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", cwd=self.build, start_new_session=True)
        try:
            output, _ = run.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGTERM)
            run.wait()
            return f"{suite}, which does not end"
        if run.returncode == 2 and "no test" in output:
            sys.exit(f"{suite}: {output}")
        failed = re.search(r"\[  FAILED  \] (\w+\.\w+|\w+/\w+\.\w+/\w+)", output)
        return (f"{suite} {failed[1]}" if failed else f"{suite}, which stops") if run.returncode else None


def programs(mutants):
    return sorted({s.split(":")[0] for m in mutants for s in m["tests"]})


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("words", nargs="*")
    options = parser.parse_args()
    mutants = read_list(options.words)
    if check(mutants):
        return 2
    if options.check:
        print(f"{len(mutants)} mutants apply")
        return 0
    copy = Copy(options.build.resolve())
    made = copy.make(programs(mutants))
    if made.returncode:
        sys.exit(made.stdout[-3000:])
    limit = {}
    for suite in sorted({s for m in mutants for s in m["tests"]}):
        start = time.monotonic()
        if failed := copy.failure(suite, 3600):
            sys.exit(f"without a mutant: {failed}")
        limit[suite] = 10 * (time.monotonic() - start) + 10
    outcomes = {}
    for m in mutants:
        file = copy.source / m["file"]
        text = file.read_text()
        file.write_text(text.replace(m["old"], m["new"]))
        try:
            if copy.make(programs([m])).returncode:
                outcome = "does not compile"
            else:
                killer = next(filter(None, (copy.failure(s, limit[s]) for s in m["tests"])), None)
                outcome = f"killed by {killer}" if killer else "SURVIVED"
        finally:
            file.write_text(text)
        outcomes[m["name"]] = outcome
        print(f"{m['name']:<40} {outcome}", flush=True)
    bad = [n for n, o in outcomes.items() if not o.startswith("killed")]
    print(f"{len(outcomes) - len(bad)} of {len(outcomes)} killed" + (f"; not: {', '.join(bad)}" if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
