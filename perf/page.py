# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The suite's numbers for people: tables for the terminal, docs/reports/performance.md, its tables and plots."""
import csv
import math
import os
import re

import machine
import scaling as study


def _number(x):
    """Three digits."""
    if x == 0.0 or not math.isfinite(x):
        return "0" if x == 0.0 else "-"
    digits = 2 - math.floor(math.log10(abs(x)))
    return f"{round(x, digits):.{max(0, digits)}f}"


def _percent(x):
    return "-" if math.isnan(x) else f"{round(100.0 * x)} %"


def _against(time, known):
    """How many times the baseline's speed; what is more than 10 % off is marked."""
    if not known:
        return "-"
    ratio = known / time
    return f"{ratio:.2f}" + (" SLOWER" if ratio < 1.0 / 1.1 else " faster" if ratio > 1.1 else "")


def _table(title, note, header, rows):
    return {"title": title, "note": note, "header": header, "rows": rows}


def tables(results, baseline, phases):
    """All tables of the suite, in the order in which they are read."""
    known = baseline.get("ns", {})
    compare = ["against baseline"] if known else []
    def against(time, key):
        return [_against(time, known.get(key))] if known else []
    out = []
    rows = [[name, _number(value), "GB/s" if "stream" in name else "GFLOP/s a core"]
            for name, value in results["limits"].items()]
    out.append(_table("Limits of this machine",
                      "A loop of fused multiply-adds in registers, and a stream triad a = b + s c from memory.",
                      ["loop", "rate", ""], rows))
    units = ("GB/s", "of stream", "GFLOP/s", "of fused", "limit", "of limit", "bound")
    names = {"limit": "limit, ns"}
    def cell(r, u):
        if u not in r:
            return ""
        return r[u] if u == "bound" else _percent(r[u]) if u.startswith("of") else _number(r[u])
    for group in results["kernels"]:
        used = [u for u in units if any(u in r for r in group["rows"])]
        header = ["kernel", f"ns/{group['item']}", f"M {group['item']}s/s"] + [names.get(u, u) for u in used] + compare
        rows = [[r["label"], _number(r["ns"]), _number(r["rate"])] +
                [cell(r, u) for u in used] +
                against(r["ns"], r["key"]) for r in group["rows"]]
        out.append(_table(group["question"], group["note"], header, rows))
    threads = results["steps"][0]["threads"]
    rows = [[s["label"], _number(1e3 * s["seconds"]), _number(1.0 / s["seconds"])] +
            [_percent(s["phases"].get(p, 0.0) / s["seconds"]) for p in phases] +
            against(1e9 * s["seconds"], s["key"]) for s in results["steps"]]
    out.append(_table("Steps of a scene, by phase",
                      f"Multiscale block, one rank of {threads} threads; in contact every site has all of its pairs.",
                      ["scene", "ms/step", "steps/s", *phases, *compare], rows))
    if "scaling" in results:
        out += _scaling_tables(results["scaling"], results["limits"], phases)
    return out


def study_tables(scaling, phases):
    """Those of the scaling study that were measured."""
    return [t for t in _scaling_tables(scaling, {}, phases) if not t["title"].startswith("Larger")]


def _scaling_tables(scaling, limits, phases):
    out = []
    stream = ", ".join(f"{_number(rate)} GB/s on {name[8:]}" for name, rate in limits.items() if name.startswith("stream"))
    stream = f" Stream: {stream}." if stream else ""
    def cells(e):
        return [f"{e['sites']}", e["place"], f"{e['ranks']} x {e['threads']}", _number(1e3 * e["seconds"])] + \
            [_number(1e3 * e["phases"].get(p, 0.0)) for p in phases] + \
            [_percent(e["communication"]), f"{e['efficiency']:.2f}"]
    header = ["sites", "place", "ranks x threads", "ms/step", *phases, "exchange and sums", "efficiency"]
    out.append(_table("Two cores on the same block",
                      f"Phases in ms a step, of rank 0; waiting for the other rank is part of exchange and sums.{stream}",
                      header, [cells(e) for e in scaling["strong"]]))
    out.append(_table("Two cores on a block twice as large",
                      f"{scaling['weak'][0]['layers']} layers; efficiency by node.",
                      header, [cells(e) for e in scaling["weak"]]))
    m = scaling["messages"]
    out.append(_table("Messages between two ranks",
                      f"Within this machine. Swap: two messages each way at once, as halos go. The step's reduction: "
                      f"{_number(1e6 * m['sum'])} µs.",
                      ["bytes", "one way, µs", "GB/s", "swap, µs"],
                      [[str(p["bytes"]), _number(1e6 * p["seconds"]), _number(1e-9 * p["bytes"] / p["seconds"]),
                        _number(1e6 * s["seconds"])] for p, s in zip(m["ping"], m["swap"])
                       if math.log2(p["bytes"]) % 3.0 == 0.0]))
    out.append(_table("The model compared with two ranks",
                      "In contact. The model uses measurements on one core and of the messages, and no run on two ranks.",
                      ["sites", "ms/step", "model", "model / measured", "communication, ms", "model", "halo, kB a step", "model"],
                      [[str(c["sites"]), _number(1e3 * c["measured"]), _number(1e3 * c["predicted"]),
                        f"{c['predicted'] / c['measured']:.2f}", _number(1e3 * c["measured_communication"]),
                        _number(1e3 * c["predicted_communication"]), _number(1e-3 * c["halo_bytes"]),
                        _number(1e-3 * c["predicted_halo_bytes"])] for c in scaling["check"]]))
    network = scaling["network"]
    by = {(e["sites"], e["ranks"], e["messages"]): e for e in scaling["larger"]}
    rows = [[str(n), str(r), _number(1.0 / by[n, r, "measured"]["seconds"]), f"{by[n, r, 'measured']['efficiency']:.2f}",
             _percent(by[n, r, "measured"]["communication"]), _number(1.0 / by[n, r, "network"]["seconds"]),
             f"{by[n, r, 'network']['efficiency']:.2f}", _percent(by[n, r, "network"]["communication"]),
             _percent(by[n, r, "measured"]["held"]), _percent(by[n, r, "network"].get("shared", math.nan))]
            for n, r, kind in by if kind == "measured"]
    out.append(_table("Larger machines, predicted",
                      "In contact, as many layers as sites, ranks of one thread. First with messages as measured here, then over a "
                      f"network of {1e6 * network['latency']:g} µs and {1e-9 * network['bandwidth']:g} GB/s a rank (assumed, "
                      "not measured; messages over 64 kB wait for two more latencies). Held by all: fraction of a rank's nodes "
                      f"that every rank computes alike. If shared: steps/s gained over this network if {study.SHARED_AMONG} ranks "
                      "together held these nodes, for two more swaps a step.",
                      ["sites", "ranks", "steps/s", "efficiency", "communication", "network: steps/s", "efficiency",
                       "communication", "held by all", "if shared"], rows))
    return out


def processors_table(results, baselines):
    """The kernels' and steps' times on every processor with a baseline; None for fewer than two."""
    if len(baselines) < 2:
        return None
    labels = [(r["key"], f"{r['label']}, ns/{g['item']}", 1.0) for g in results["kernels"] for r in g["rows"]]
    labels += [(s["key"], f"step: {s['label']}, ms", 1e-6) for s in results["steps"]]
    rows = [[label] + [_number(b["ns"][key] * unit) if key in b["ns"] else "" for b in baselines]
            for key, label, unit in labels]
    return _table("Processors with a baseline",
                  "From `perf/baselines/`; each measured on its own, with two threads where a step takes two: " +
                  "; ".join(f"{machine.short(b['machine'])} on {b['date']}, commit {b['commit']}" for b in baselines) + ".",
                  ["kernel"] + [machine.short(b["machine"]) for b in baselines], rows)


def network_table(rows):
    """Two hosts: measured, and by the model."""
    def cells(r):
        name = f"{r['microseconds']} µs, {r['gigabits']:g} Gbit/s" if r["microseconds"] else "veth"
        c = r["measured_communication"], r["predicted_communication"]
        return [name, _number(1e6 * r["latency"]), _number(1e6 * r["sum"]), str(r["sites"]),
                _number(1e3 * r["measured"]), _number(1e3 * r["predicted"]), f"{r['predicted'] / r['measured']:.2f}",
                _number(1e3 * c[0]), _number(1e3 * c[1]), f"{c[1] / c[0]:.2f}"]
    return _table("Two hosts over TCP",
                  "In contact, one rank a host. The model uses steps of one rank and the messages between these hosts.",
                  ["network", "short message, µs", "reduction, µs", "sites", "ms/step", "model", "model / measured",
                   "communication, ms", "model", "model / measured"], [cells(r) for r in rows])


def baseline_words(baseline):
    """What the numbers are compared with."""
    if not baseline:
        return "There is no baseline for this processor; --save-baseline makes one."
    if "ns" not in baseline:
        return "These numbers are the baseline of this processor."
    return f"Baseline of {baseline['date']}, commit {baseline.get('commit', 'unknown')}: " + machine.words(baseline["load"])


def terminal(table):
    widths = [max(len(r[i]) for r in [table["header"]] + table["rows"]) for i in range(len(table["header"]))]
    def line(cells):
        return "  " + "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(cells, widths))).rstrip()
    return "\n".join([table["title"], "  " + table["note"], "", line(table["header"]),
                      "  " + "─" * (sum(widths) + 2 * (len(widths) - 1))] + [line(r) for r in table["rows"]] + [""])


def published(table, folder):
    """A table as a file of its own, data/performance/TITLE.csv, and as the part of the page that shows it."""
    name = re.sub(r"[^a-z0-9]+", "-", table["title"].lower()).strip("-")
    with open(os.path.join(folder, "data", "performance", name + ".csv"), "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([table["header"], *table["rows"]])
    file = f"../data/performance/{name}.csv"
    return (f"### {table['title']}\n\n{table['note']} ([table]({file}))\n\n"
            f"```{{csv-table}}\n:file: {file}\n:header-rows: 1\n```\n")


# --- plots -----------------------------------------------------------------------------------------------------


def limits_plot(results, plt):
    """Each kernel's fraction of the limits, in percent."""
    kinds = (("of limit", "of its bound: arithmetic, division or memory"), ("of fused", "of the fused multiply-add loop"),
             ("of stream", "of the memory's stream"))
    rows = [r for g in results["kernels"] for r in g["rows"] if any(key in r for key, _ in kinds)]
    figure, ax = plt.subplots(figsize=(7.2, 1.2 + 0.26 * len(rows)), layout="constrained")
    for number, (key, label) in enumerate(kinds):
        there = [i for i, r in enumerate(rows) if key in r]
        ax.barh([i + 0.27 * (number - 1) for i in there], [100.0 * rows[i][key] for i in there], 0.27, label=label)
    ax.set_yticks(range(len(rows)), [r["label"] for r in rows])
    ax.invert_yaxis()
    ax.set_xlabel("fraction of the limit measured in the same run, %")
    ax.legend(loc="lower center", bbox_to_anchor=(0.3, 1.0))
    return figure


def phases_plot(strong, phases, plt):
    """Stacked bars: where a step's time goes on one and two cores."""
    largest = max(e["sites"] for e in strong)
    chosen = [e for e in strong if e["sites"] == largest]
    figure, ax = plt.subplots(figsize=(7.2, 1.2 + 0.3 * len(chosen)), layout="constrained")
    done = [0.0] * len(chosen)
    for p in phases:
        times = [1e3 * e["phases"].get(p, 0.0) for e in chosen]
        ax.barh(range(len(chosen)), times, left=done, label=p)
        done = [a + b for a, b in zip(done, times)]
    ax.set_yticks(range(len(chosen)), [f"{e['place']}, {e['ranks']} x {e['threads']}" for e in chosen])
    ax.invert_yaxis()
    ax.set_xlabel(f"ms a step at {largest} sites and layers, by ranks x threads")
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncol=3)
    return figure


def predicted_plot(larger, network, plt):
    """Steps a second against ranks, both kinds of messages."""
    figure, ax = plt.subplots(figsize=(6.0, 4.4), layout="constrained")
    for number, n in enumerate(sorted({e["sites"] for e in larger})):
        for kind, line in (("measured", "-"), ("network", "--")):
            points = [e for e in larger if e["sites"] == n and e["messages"] == kind]
            ax.loglog([e["ranks"] for e in points], [1.0 / e["seconds"] for e in points], line, color=f"C{number}",
                      label=f"N = {n}" if kind == "measured" else None)
    ranks = sorted({e["ranks"] for e in larger})
    ax.set_xticks(ranks, map(str, ranks))
    ax.minorticks_off()
    ax.set_xlabel("ranks of one thread; solid: messages as measured within this machine\n"
                  f"dashed: an assumed network of {1e6 * network['latency']:g} µs and {1e-9 * network['bandwidth']:g} GB/s a rank")
    ax.set_ylabel("steps/s, predicted")
    ax.legend()
    return figure


# --- the page --------------------------------------------------------------------------------------------------


def summary(results):
    """What the tables say, in sentences."""
    rows = {r["label"]: r for g in results["kernels"] for r in g["rows"]}
    double, mixed = rows["lattice, double, forces"], rows["lattice, mixed, forces"]
    name = [label for label in rows if re.fullmatch(r"pass of [\dx ]+, [\d.]+ MB", label)][-1]
    node, finite = rows[name], rows[name + ", finite strain, ν = 1/4"]
    contact = [s for s in results["steps"] if s["place"] == "contact"]
    n = max(s["sites"] for s in contact)
    step = {s["precision"]: s for s in contact if s["sites"] == n}
    def part(phase):
        return _percent(step["double"]["phases"][phase] / step["double"]["seconds"])
    scaling = results["scaling"]
    wide = max(e["sites"] for e in scaling["strong"])
    two = {e["ranks"]: e["efficiency"] for e in scaling["strong"]
           if e["sites"] == wide and e["place"] == "contact" and e["ranks"] * e["threads"] == 2}
    ratios = [c["predicted"] / c["measured"] for c in scaling["check"]]
    larger = [e for e in scaling["larger"] if e["messages"] == "network"]
    small = max((e for e in larger if e["sites"] == larger[0]["sites"] and e["ranks"] <= 256), key=lambda e: e["ranks"])
    network = scaling["network"]
    return "\n".join([
        f"- A pair of atoms of one lattice takes {_number(double['ns'])} ns in double and {_number(mixed['ns'])} ns in mixed precision: "
        f"{_percent(double['of limit'])} and {_percent(mixed['of limit'])} of the limit of this processor.",
        f"- A node of the elastic block takes {_number(node['ns'])} ns ({name}), {_percent(node['of limit'])} of the limit "
        f"({node['bound']}), and {_number(finite['ns'])} ns at finite strain.",
        f"- A step of {n} sites and layers in contact takes {_number(1e3 * step['double']['seconds'])} ms in double "
        f"({part('interface')} interface, {part('advance')} block) and {_number(1e3 * step['mixed']['seconds'])} ms in mixed precision.",
        f"- At {wide} sites in contact two threads have an efficiency of {two[1]:.2f}, two ranks of {two[2]:.2f}.",
        f"- The model below gives {min(ratios):.2f} to {max(ratios):.2f} of the measured time of a step on two ranks. For a network of "
        f"{1e6 * network['latency']:g} µs and {1e-9 * network['bandwidth']:g} GB/s a rank it predicts "
        f"{_number(1.0 / small['seconds'])} steps/s for {small['sites']} sites on {small['ranks']} ranks (efficiency "
        f"{small['efficiency']:.2f}) and {_number(1.0 / larger[-1]['seconds'])} for {larger[-1]['sites']} sites on "
        f"{larger[-1]['ranks']} (efficiency {larger[-1]['efficiency']:.2f})."])


def write(results, baseline, baselines, phases, folder):
    """reports/performance.md in the folder, its tables in data/performance, its plots in gallery/perf; baselines: of all processors."""
    plots = os.path.join(folder, "gallery", "perf")
    for place in (plots, os.path.join(folder, "data", "performance"), os.path.join(folder, "reports")):
        os.makedirs(place, exist_ok=True)
    scaling, m = results["scaling"], results["machine"]
    import matplotlib  # only the page needs it

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    matplotlib.rcParams.update({"font.size": 9, "svg.hashsalt": "asperity", "svg.fonttype": "none"})
    for name, figure in (("limits", limits_plot(results, plt)), ("phases", phases_plot(scaling["strong"], phases, plt)),
                         ("larger", predicted_plot(scaling["larger"], scaling["network"], plt))):
        figure.savefig(os.path.join(plots, name + ".svg"), metadata={"Date": None})
    all_tables = tables(results, baseline, phases)
    first = next(i for i, t in enumerate(all_tables) if t["title"].startswith("Two cores"))
    compared = processors_table(results, baselines)
    c = scaling["coefficients"]
    costs = _table("Costs in the model", "By the number of nodes of a rank, ns.", ["item", *map(str, c["nodes"])],
                   [[name, *map(_number, c["ns"][key])] for key, name in
                    (("node", "node"), ("site", "site in contact"), ("constrained", "constrained node"), ("byte", "byte copied"))])
    def parts(some):
        return "\n".join(published(t, folder) for t in some)
    text = f"""# Performance

![fraction of the limits](../gallery/perf/limits.svg)

Written by `./asperity bench --page`; do not edit. {m['processor']} (family {m['family']}, model {m['model']}), {m['cores']} cores,
kernels {m['kernels']}; {results['date']}, commit {results.get('commit', 'unknown')}. {machine.words(results['load'])} {baseline_words(baseline)}

{summary(results)}

Commands:

    ./asperity bench                           # the kernels and the steps, a minute
    ./asperity bench --scaling                 # and the scaling study
    ./asperity bench --page --save-baseline    # on a quiet machine: this page, and what later runs are compared with

## Kernels and steps

Every time is the shortest of repeats that alternate with each other; fractions are of limits measured in the same run: *of
fused* of a loop of fused multiply-adds, *of stream* of a stream triad on as many threads. *Limit* is the time of an item at
best, and *bound* what sets it: its multiplications, additions, divisions and shifts in a loop without dependences and loads
(arithmetic, or division alone), or u and v read and written once (memory).

{parts(all_tables[:first] + ([compared] if compared else []))}
## Scaling

![a step by phase](../gallery/perf/phases.svg)

{parts(all_tables[first:first + 2])}
## Larger machines: a model

![larger machines](../gallery/perf/larger.svg)

A step of the most loaded rank takes

    nodes x t_node + sites x t_site + constrained nodes x t_constrained     work
    + (bytes wrapped + 2 x bytes sent) x t_byte                             copies into and out of halos
    + swap(x) + swap(y)                                                     messages to neighbours
    + log2(ranks) x t_sum                                                   the reduction
    + log2(ranks) x latency + bytes gathered x t_gathered                   where coarse levels are held by all

with volumes of the decomposition (`perf/volumes.cpp`) and times measured here: a reduction {_number(c['us a reduction'])} µs, a short
message {_number(c['us a short message'])} µs, a long one {_number(c['GB/s of a long message'])} GB/s. A node costs less where the block
of a rank fits into its cache, so efficiencies above 1 can occur. Not included: waiting for late ranks, memory shared by more
cores than here, and effects of a network other than latency and bandwidth.

{parts([costs, *all_tables[first + 2:]])}"""
    with open(os.path.join(folder, "reports", "performance.md"), "w") as file:
        file.write(text)
