# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The benchmarks run, on tiny sizes: what they write is JSON, a page with its tables, and a plot that is XML.
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
    times += [entry["seconds"] for kind in ("strong", "weak", "single") for entry in found["scaling"][kind]]
    assert len(times) > 30 and all(math.isfinite(t) and t > 0 for t in times)
    # Kernels whose operations are counted have a limit, and what sets it.
    bounds = {row["key"]: row["bound"] for row in kernels if row.get("limit", 0) > 0}
    assert set(bounds.values()) <= {"arithmetic", "division", "memory"}
    assert os.uname().machine != "x86_64" or sum(key.endswith("observed:0") for key in bounds) == 4
    for step in found["steps"]:  # no phase is longer than its step, and together they are most of it
        assert 0.5 * step["seconds"] < sum(step["phases"].values()) <= 1.01 * step["seconds"]
    reports = Path("page/reports")
    page = (reports / "performance.md").read_text()
    tables = re.findall(r"^<!-- table: (.*\.csv)(?: columns=[\d,]+)? -->$", page, re.M)
    assert len(tables) >= 10 and len(set(tables)) == len(tables)
    for table in tables:
        assert f"({table})" in page  # a link to the numbers
        assert len(list(csv.reader((reports / table).read_text().splitlines()))) > 1
    xml.dom.minidom.parse(str(reports / "../gallery/perf/limits.svg"))
    # Halos as the model counts them are what was sent, and the script by itself prints the same tables.
    alone = subprocess.run([sys.executable, ROOT / "perf/extrapolate.py", "numbers.json"], capture_output=True, text=True)
    sent = re.search(r"halo counted, kB\n +32 .* (\S+) +(\S+)$", alone.stdout, re.M)
    assert sent and sent[1] == sent[2] and float(sent[1]) > 0 and "Larger machines" in alone.stdout
    # The same numbers make the same page.
    bench("--from", "numbers.json", "--page", "page", "--quick")
    assert (reports / "performance.md").read_text() == page


def test_mistakes(place):
    Path("empty.json").write_text("{}\n")
    assert "holds no numbers" in bench("--from", "empty.json", expect=1)
    bench("--from", "gone.json", expect=1)
    bench("--quick", "--save-baseline", expect=2)
    bench("--nonsense", expect=2)


def test_blocks_are_counted_as_they_are_cut():
    """Volumes worked out by hand: 64 sites, 62 layers, of levels of 4, 4, 4 and 4 cells (and one more where the rest is odd)."""
    sys.path.append(str(ROOT / "perf"))
    from extrapolate import level_cells, process_grid, volumes

    assert level_cells(32, 62) == [4, 5, 4, 4] and level_cells(33, 62) == [62]
    assert process_grid(64, 8, 4) == (2, 4, 3) and process_grid(64, 1, 4) == (1, 1, 3)
    two = volumes(32, 62, 2)  # 2 ranks along y
    assert two["nodes"] == 512 * 4 + 128 * 5 + 32 * 4 + 8 * 4 and two["sites"] == 512 and two["x"] == 0
    assert two["y"] == 2 * 24 * (36 * 4 + 20 * 5 + 12 * 4 + 8 * 4)
