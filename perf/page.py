# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The suite's numbers for people: tables for the terminal, docs/reports/performance.md, its tables and its plot."""
import csv
import math
import os
import re
import sys
from pathlib import Path

import extrapolate
import machine

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))  # a package is called tables, too
from tables import block


def _number(x):
    """Three digits."""
    if x == 0.0 or not math.isfinite(x):
        return "0" if x == 0.0 else "-"
    digits = 2 - math.floor(math.log10(abs(x)))
    return f"{round(x, digits):.{max(0, digits)}f}"


def _percent(x):
    return f"{round(100.0 * x)} %"


def _against(time, known):
    """How many times the baseline's speed; what is more than 10 % off is marked."""
    if not known:
        return "-"
    ratio = known / time
    return f"{ratio:.2f}" + (" SLOWER" if ratio < 1.0 / 1.1 else " faster" if ratio > 1.1 else "")


def tables(results, baseline, phases):
    """(title, note, header, rows) of the suite, in the order in which they are read."""
    known = baseline.get("ns", {})
    compare = ["against baseline"] if known else []

    def against(time, key):
        return [_against(time, known.get(key))] if known else []

    yield ("Limits of this machine", "A loop of fused multiply-adds in registers, and a stream triad a = b + s c from memory.",
           ["loop", "rate", "unit"], [[name, _number(value), "GB/s" if "stream" in name else "GFLOP/s a core"]
                                      for name, value in results["limits"].items()])
    units = ("GB/s", "of stream", "GFLOP/s", "of fused", "limit", "of limit", "bound")

    def cell(r, u):
        if u not in r:
            return ""
        return r[u] if u == "bound" else _percent(r[u]) if u.startswith("of") else _number(r[u])

    for group in results["kernels"]:
        used = [u for u in units if any(u in r for r in group["rows"])]
        heads = ["limit, ns" if u == "limit" else u for u in used]
        yield (group["question"], group["note"],
               ["kernel", f"ns/{group['item']}", f"M {group['item']}s/s", *heads, *compare],
               [[r["label"], _number(r["ns"]), _number(r["rate"]), *(cell(r, u) for u in used), *against(r["ns"], r["key"])]
                for r in group["rows"]])
    yield ("Steps of a scene, by phase",
           f"Multiscale block, one rank of {results['steps'][0]['threads']} threads; in contact every site has all of its pairs.",
           ["scene", "ms/step", "steps/s", *phases, *compare],
           [[s["label"], _number(1e3 * s["seconds"]), _number(1.0 / s["seconds"]),
             *(_percent(s["phases"].get(p, 0.0) / s["seconds"]) for p in phases), *against(1e9 * s["seconds"], s["key"])]
            for s in results["steps"]])


def scaling_tables(scaling, limits, phases):
    """Those of the study that were measured; extrapolate.tables() makes the others."""
    stream = ", ".join(f"{_number(rate)} GB/s on {name[8:]}" for name, rate in limits.items() if name.startswith("stream"))
    header = ["sites", "place", "ranks x threads", "ms/step", *phases, "exchange and sums", "efficiency"]

    def cells(e):
        return [f"{e['sites']}", e["place"], f"{e['ranks']} x {e['threads']}", _number(1e3 * e["seconds"]),
                *(_number(1e3 * e["phases"].get(p, 0.0)) for p in phases), _percent(e["communication"]),
                f"{e['efficiency']:.2f}"]

    yield ("Two cores on the same block",
           "Phases in ms a step, of rank 0; waiting for the other rank is part of exchange and sums." + f" Stream: {stream}." * bool(stream),
           header, [cells(e) for e in scaling["strong"]])
    yield ("Two cores on a block twice as large", f"{scaling['weak'][0]['layers']} layers; efficiency by node.",
           header, [cells(e) for e in scaling["weak"]])
    m = scaling["messages"]
    yield ("Messages between two ranks",
           "Within this machine. Swap: two messages each way at once, as halos go. The step's reduction: "
           f"{_number(1e6 * m['sum'])} µs.", ["bytes", "one way, µs", "GB/s", "swap, µs"],
           [[str(p["bytes"]), _number(1e6 * p["seconds"]), _number(1e-9 * p["bytes"] / p["seconds"]), _number(1e6 * s["seconds"])]
            for p, s in zip(m["ping"], m["swap"]) if math.log2(p["bytes"]) % 3.0 == 0.0])


def processors_table(results, baselines):
    """The kernels' and steps' times on every processor with a baseline; none for fewer than two."""
    if len(baselines) < 2:
        return
    labels = [(r["key"], f"{r['label']}, ns/{g['item']}", 1.0) for g in results["kernels"] for r in g["rows"]]
    labels += [(s["key"], f"step: {s['label']}, ms", 1e-6) for s in results["steps"]]
    yield ("Processors with a baseline",
           "From `perf/baselines/`; each measured on its own, with two threads where a step takes two: " +
           "; ".join(f"{machine.short(b['machine'])} on {b['date']}, commit {b['commit']}" for b in baselines) + ".",
           ["kernel", *(machine.short(b["machine"]) for b in baselines)],
           [[label, *(_number(b["ns"][key] * unit) if key in b["ns"] else "" for b in baselines)] for key, label, unit in labels])


def baseline_words(baseline):
    """What the numbers are compared with."""
    if not baseline:
        return "There is no baseline for this processor; --save-baseline makes one."
    if "ns" not in baseline:
        return "These numbers are the baseline of this processor."
    return f"Baseline of {baseline['date']}, commit {baseline.get('commit', 'unknown')}: " + machine.words(baseline["load"])


def terminal(table):
    title, note, header, rows = table
    widths = [max(map(len, column)) for column in zip(header, *rows)]

    def line(cells):
        return "  " + "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(cells, widths))).rstrip()

    rule = "  " + "─" * (sum(widths) + 2 * (len(widths) - 1))
    return "\n".join([title, "  " + note, "", line(header), rule, *map(line, rows), ""])


# Columns that a page leaves to the file, in this order, until eight are left.
LEFT_TO_THE_FILE = ("M nodes/s", "GFLOP/s", "steps/s", "here: communication", "sums", "observe", "interpolate", "exchange and sums")


def columns_shown(header):
    """Returns the numbers, from 1, of the columns that a page shows."""
    shown = list(header)
    for name in LEFT_TO_THE_FILE:
        if len(shown) > 8 and name in shown:
            shown.remove(name)
    return [number for number, name in enumerate(header, 1) if name in shown]


def published(some, folder):
    """Tables as files, data/performance/TITLE.csv, and as parts of the page."""
    parts = []
    for title, note, header, rows in some:
        name = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")
        with open(folder / "data/performance" / f"{name}.csv", "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])
        link = f"../data/performance/{name}.csv"
        shown = columns_shown(header)
        some_columns = "" if len(shown) == len(header) else " columns=" + ",".join(map(str, shown))
        parts.append(f"### {title}\n\n{note} ([CSV]({link}))\n\n{block(link + some_columns, folder / 'reports/performance.md')}\n")
    return "\n".join(parts)


def limits_plot(results, file):
    """Each kernel's fraction of the limits, in percent."""
    sys.path.append(str(Path(__file__).resolve().parents[1] / "python"))
    import matplotlib  # only the page needs it

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    from asperity.plots.style import BLUE, GREEN, YELLOW, style

    kinds = (("of limit", "of its bound: arithmetic, division or memory", BLUE),
             ("of fused", "of the fused multiply-add loop", YELLOW), ("of stream", "of the memory's stream", GREEN))
    rows = [r for g in results["kernels"] for r in g["rows"] if any(key in r for key, *_ in kinds)]
    with style():
        figure, ax = plt.subplots(figsize=(7.2, 1.0 + 0.24 * len(rows)), layout="constrained")
        for number, (key, label, colour) in enumerate(kinds):
            there = [i for i, r in enumerate(rows) if key in r]
            ax.barh([i + 0.27 * (number - 1) for i in there], [100.0 * rows[i][key] for i in there], 0.27, color=colour, label=label)
        ax.set_yticks(range(len(rows)), [r["label"] for r in rows])
        ax.tick_params(axis="y", which="both", left=False, right=False)
        ax.set_ylim(len(rows) - 0.4, -0.6)
        ax.axvline(100.0, color="0.5", lw=0.7, zorder=0)
        ax.set_xlabel("fraction of the limit measured in the same run, %")
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0))
        figure.savefig(file, metadata={"Date": None})


PAGE = """# Performance

![fraction of the limits](../gallery/perf/limits.svg)

Written by `./asperity bench --page`; do not edit. {processor} (family {family}, model {model}), {cores} cores,
kernels {kernels}; {date}, commit {commit}. {load} {baseline}

    ./asperity bench                           # the kernels and the steps, a minute
    ./asperity bench --scaling                 # and the scaling study
    ./asperity bench --page --save-baseline    # on a quiet machine: this page, and what later runs are compared with

## Kernels and steps

Every time is the shortest of several repeats; repeats of different kernels alternate. *Of fused* is the speed over that of a
loop of fused multiply-adds, *of stream* over that of a stream triad on as many threads, both measured in the same run.
*Limit* is the shortest possible time of an item, and *bound* is what sets it: its operations in a loop without dependences
and loads (arithmetic, or division alone), or moving u and v once to the processor and back (memory).

{suite}
## Scaling

{scaling}
## Tried: two steps for one trip to memory

A pass reads and writes u and v of every node once a step. Two steps can share a trip through the finest level, which has three
quarters of the nodes: a band of rows makes step n, level 1 makes step n behind it, and rows that lie a band further behind
make step n + 1. No other level takes part, because step n + 1 of level 0 needs the lowest plane of level 1 alone. Eight rows
on both sides of the cuts between threads, tiles and the periodic boundary wait for the halos of step n + 1. The trial, outside the program,
used the kernels of the program on the multiscale block, damped and without an interface; its states were bitwise identical to
those of single steps. Ratios of the times of the elastic passes with halos, alternating in one process (least of 4 to 11
repeats), Intel Xeon of 2 MB of L2 cache a core and a shared L3 cache of 260 MB, 2026-11-27:

| sites | 1 thread | 2 threads | 2 processes of 1 thread, each a block |
|---|---|---|---|
| 128 | 0.96 | 1.00 | |
| 256 | 0.97 | 1.02 | 0.98 |
| 512 | 1.05 | 1.02 | 1.06 |
| 1024 | 0.91 | 0.93 | 0.91 |

The block of 512 sites (68 MB) lies in the L3 cache there: a node takes as long as with 128 sites (6.6 ns), and there is
nothing to gain. With 1024 sites it takes 8.3 ns. Where memory is slow, a pass can gain at most what a cache gains: on AMD EPYC
26/2 two threads take 6.21 ns a node with 512 sites and 4.36 ns with 256, a ratio of 0.70 of the pass and, with 60 % of a
step in the pass, 0.82 of the step. Steps in pairs were to be adopted at 0.80 of the step, and are not.

Two ranks of that processor, 512 sites: of a step of 7.4 ms the exchange of halos takes 1.1 to 1.7 ms, of which 0.66 to 1.2
ms are waiting for the other rank.

## Tried: fewer iterations on a path over atoms

The paths of Fig. 2 (`scenes/paper/fig2-quasistatic.toml`) at rms 4 Å and 512 sites: 227 points, 253 relaxations. Newton's method makes
1307 steps, whose equations take 22 528 products, and heavy balls make 14 409 iterations where the curvature is negative. Of products
and iterations 70 % and 52 % go into points in which no instability is told from the others, 24 % and 33 % into instabilities, and 6 % and
14 % into steps that are tried again. At 128 sites and rms 1 Å 40 % of the processor time are sweeps of the interface (four in a step
of Newton's method, one in an iteration of the balls) and 25 % Fourier transforms. The preconditioned stiffness has eigenvalues from
0.1 to 5, and one to three below, down to 0.015: patches close to an instability. Trials there:

| trial | Newton's steps | products | heavy balls |
|---|---|---|---|
| as it is | 1273 | 11 696 | 4940 |
| the direction found is used up to a negative curvature | 1315 | 11 786 | 5158 |
| start on the line through the last two points | 1143 | 11 244 | 4594 |
| stiffness of the interface measured every third step at most | 1329 | 13 319 | 5443 |
| the same, every fifth step | 1347 | 13 914 | 6090 |
| equations solved to 0.003 in place of 0.3 | 831 | 25 170 | 5878 |

Also tried, by a cost that counts products, 1.6 times the iterations of the balls and 4.4 times the steps of Newton's method: equations solved
the closer the faster the residual falls, 1.08 times the cost; steps cut at each site that would move too far, not as a whole, 1.04; both, 0.95;
balls that hand over at twelve times the distance, 1.22; steps up to twice as long, 0.98.

None is adopted; the start on a line saves about 6 % for 24 bytes a site. A product costs two transforms of three components, and so would any
preconditioner that knows the stiffness of each site, on top of those that it has.

## Larger machines: a model

`perf/extrapolate.py` predicts the step of the most loaded rank from volumes of the decomposition and times measured here on
one core and between two ranks:

    nodes x t_node + sites x t_site + constrained nodes x t_constrained     work
    + (bytes wrapped + 2 x bytes sent) x t_byte                             copies into and out of halos
    + swap(x) + swap(y)                                                     messages to neighbours
    + log2(ranks) x t_sum                                                   the reduction
    + log2(ranks) x latency + bytes gathered x t_gathered                   where coarse levels are held by all

A node costs less where the block of a rank fits into its cache, so efficiencies above 1 can occur. The model leaves out
waiting for late ranks, memory that more cores share than here, and all of a network but latency and bandwidth.

{larger}"""


def write(results, baseline, baselines, phases, folder):
    """reports/performance.md in the folder, its tables in data/performance, its plot in gallery/perf."""
    folder = Path(folder)
    for place in ("gallery/perf", "data/performance", "reports"):
        os.makedirs(folder / place, exist_ok=True)
    limits_plot(results, folder / "gallery/perf/limits.svg")
    (folder / "reports/performance.md").write_text(PAGE.format(
        **results["machine"], date=results["date"], commit=results.get("commit", "unknown"),
        load=machine.words(results["load"]), baseline=baseline_words(baseline),
        suite=published([*tables(results, baseline, phases), *processors_table(results, baselines)], folder),
        scaling=published(scaling_tables(results["scaling"], results["limits"], phases), folder),
        larger=published(extrapolate.tables(results["scaling"]), folder)))
