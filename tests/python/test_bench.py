# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The benchmarks run, on tiny sizes: what they write is JSON, a page whose tables are tables, and plots that are XML.
How fast anything is, is not asked."""

import csv
import json
import math
import os
import re
import subprocess
import sys
import xml.dom.minidom
from pathlib import Path

import pytest
from conftest import ROOT

pytest.importorskip("matplotlib", reason="no Matplotlib: apt-get install python3-matplotlib")


def bench(*words, expect=0):
    build = Path(os.environ["ASPERITY_PROGRAM"]).parents[1]
    done = subprocess.run([sys.executable, ROOT / "perf/suite.py", "--build", build, *words], capture_output=True,
                          text=True)
    assert done.returncode == expect, done.stdout + done.stderr
    return done.stdout + done.stderr


def test_quick(place):
    said = bench("--quick", "--page", "page", "--out", "numbers.json")
    assert "lattice, double, forces" in said and "other programs used" in said
    found = json.loads(Path("numbers.json").read_text())
    kernels = [row for kernel in found["kernels"] for row in kernel["rows"]]
    times = [row["ns"] for row in kernels] + [step["seconds"] for step in found["steps"]]
    times += [entry["seconds"] for kind in ("strong", "weak", "larger") for entry in found["scaling"][kind]]
    assert len(times) > 40 and all(math.isfinite(t) and t > 0 for t in times)
    # Kernels whose operations are counted have a limit, and what sets it.
    bounds = {row["key"]: row["bound"] for row in kernels if row.get("limit", 0) > 0}
    assert set(bounds.values()) <= {"arithmetic", "division", "memory"}
    assert os.uname().machine != "x86_64" or sum(key.endswith("observed:0") for key in bounds) == 6
    for check in found["scaling"]["check"]:  # what the model counts is what the halos sent
        assert check["halo_bytes"] == check["predicted_halo_bytes"] > 0
    for step in found["steps"]:  # no phase is longer than its step, and together they are most of it
        assert 0.5 * step["seconds"] < sum(step["phases"].values()) <= 1.01 * step["seconds"]
    reports = Path("page/reports")
    page = (reports / "performance.md").read_text()
    tables = re.findall(r"^:file: (.*\.csv)$", page, re.M)
    assert len(tables) >= 10 and len(set(tables)) == len(tables)
    for table in tables:
        assert f"({table})" in page  # a link for readers of the Markdown
        rows = list(csv.reader((reports / table).read_text().splitlines()))
        assert len(rows) > 1 and len({len(row) for row in rows}) == 1, table
    plots = re.findall(r"\]\((.*\.svg)\)", page)
    assert len(plots) == 3
    for plot in plots:
        xml.dom.minidom.parse(str(reports / plot))
    # The same numbers make the same page.
    bench("--from", "numbers.json", "--page", "page", "--quick")
    assert (reports / "performance.md").read_text() == page


def test_mistakes(place):
    Path("empty.json").write_text("{}\n")
    assert "holds no numbers" in bench("--from", "empty.json", expect=1)
    bench("--from", "gone.json", expect=1)
    bench("--quick", "--save-baseline", expect=2)
    bench("--nonsense", expect=2)
