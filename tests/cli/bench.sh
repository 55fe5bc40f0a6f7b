#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The benchmarks run, on tiny sizes: what they write is JSON, a page whose tables are tables, and plots that are
# XML. How fast anything is, is not asked.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

python=${ASPERITY_PYTHON:-/usr/bin/python3}
if [ ${#mpirun[@]} -eq 0 ] || ! "$python" -c 'import matplotlib'; then
    echo "mpirun or matplotlib is not installed: the benchmarks are not run"
    exit 77
fi
bench() { # CODE ARGUMENTS...
    local code=$1
    shift
    out=$("$python" "$source/perf/suite.py" --build "$(dirname "$asperity")/.." "$@" 2>&1)
    local got=$?
    [ $got -eq "$code" ] || fail "exit code $got instead of $code: bench $*
$out"
}

bench 0 --quick --page page --out numbers.json
says "lattice, double, forces"
says "other programs used"
python3 - <<'END' || fail "what was written is not well formed"
import csv, json, math, os, re, xml.dom.minidom
r = json.load(open("numbers.json"))
times = [x["ns"] for g in r["kernels"] for x in g["rows"]] + [s["seconds"] for s in r["steps"]]
times += [e["seconds"] for kind in ("strong", "weak", "larger") for e in r["scaling"][kind]]
assert len(times) > 40 and all(math.isfinite(t) and t > 0 for t in times), times
# Kernels whose operations are counted have a limit, and what sets it.
bounds = {x["key"]: x["bound"] for g in r["kernels"] for x in g["rows"] if x.get("limit", 0) > 0}
assert set(bounds.values()) <= {"arithmetic", "division", "memory"}, bounds
assert os.uname().machine != "x86_64" or sum(k.endswith("observed:0") for k in bounds) == 6, bounds
# What the model counts is what the halos sent.
for c in r["scaling"]["check"]:
    assert c["halo_bytes"] == c["predicted_halo_bytes"] > 0, c
# No phase is longer than its step, and together they are most of it.
for s in r["steps"]:
    assert 0.5 * s["seconds"] < sum(s["phases"].values()) <= 1.01 * s["seconds"], s
page = open("page/reports/performance.md").read()
tables = re.findall(r"^:file: (.*\.csv)$", page, re.M)
assert len(tables) >= 10 and len(set(tables)) == len(tables), tables
for table in tables:
    assert f"({table})" in page, table # a link for readers of the Markdown
    rows = list(csv.reader(open("page/reports/" + table)))
    assert len(rows) > 1 and len({len(row) for row in rows}) == 1, table
plots = re.findall(r"\]\((.*\.svg)\)", page)
assert len(plots) == 3
for plot in plots:
    xml.dom.minidom.parse("page/reports/" + plot)
END
cp page/reports/performance.md first.md
bench 0 --from numbers.json --page page --quick
cmp -s first.md page/reports/performance.md || fail "the same numbers made another page"
echo '{}' >empty.json
bench 1 --from empty.json
says "holds no numbers"
bench 1 --from gone.json
bench 2 --quick --save-baseline
bench 2 --nonsense
finish
