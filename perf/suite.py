# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How fast is it, and how near to what the machine can do? What `./asperity bench` runs.

Kernels (Google Benchmark programs of this folder), whole steps (step_bench), and on demand the scaling
study. Every number is the least of repeats that take turns; every limit comes from the same run.
"""
import argparse
import datetime
import json
import os
import subprocess
import sys

import extrapolate
import machine
import page
import scaling

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RATES = ("GB/s", "of_stream", "GFLOP/s", "of_fused")
PHASES = ("interface", "advance", "interpolate", "exchange", "observe", "sums")


def say(text=""):
    print(text, flush=True)


def programs(args):
    folder = os.path.join(args.build, "perf")
    for name in ("interface_bench", "elastic_bench", "step_bench", "message_bench"):
        if not os.access(os.path.join(folder, name), os.X_OK):
            sys.exit(f"bench: {folder} lacks {name}\n    fix: run ./asperity bench, which builds it")
    return folder


def google(program, pattern, quick):
    """Name -> counters of the fastest repeat; by the processor's time where one thread works."""
    options = [f"--benchmark_filter={pattern}", "--benchmark_out_format=json", "--benchmark_format=json"]
    options += (["--benchmark_min_time=0.001"] if quick else
                ["--benchmark_min_time=0.05", "--benchmark_repetitions=10",
                 "--benchmark_enable_random_interleaving=true"])
    run = subprocess.run([program] + options, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"bench: {program} failed:\n{run.stderr}")
    best = {}
    for entry in json.loads(run.stdout)["benchmarks"]:
        if entry["run_type"] != "iteration":
            continue
        if "ns/node/core" in entry:
            ns = entry["ns/node/core"]
            if "threads:" not in entry["run_name"] or "threads:1/" in entry["run_name"]:
                waited = entry["real_time"] / entry["cpu_time"]
                ns /= waited
                entry.update({rate: entry[rate] * waited for rate in RATES if rate in entry})
        else: # these programs take the processor's time themselves
            ns = 1e9 * entry["s/pair" if "s/pair" in entry else "s/site"]
        if entry["run_name"] not in best or ns < best[entry["run_name"]]["ns"]:
            best[entry["run_name"]] = {**entry, "ns": ns}
    return best


def row(key, label, entry, stream=True, in_memory=False):
    """ns an item and core, rates, and shares of the limits; in_memory: its data come from there."""
    threads = entry.get("threads_used", 1)
    r = {"key": key, "label": label, "ns": entry["ns"], "rate": 1e3 * threads / entry["ns"]}
    if "GB/s" in entry:
        r["GB/s"] = entry["GB/s"]
        if stream:
            r["of stream"] = entry["of_stream"]
    if "GFLOP/s" in entry:
        r["GFLOP/s"] = entry["GFLOP/s"]
        r["of fused"] = entry["of_fused"]
    if entry.get("arithmetic", 0.0) > 0.0: # no loop has been written for this processor otherwise
        bounds = {"arithmetic": 1e9 * entry["arithmetic"], "division": 1e9 * entry["slow"]}
        if in_memory:
            bounds["memory"] = entry["ns"] * entry["of_stream"]
        # The loop of all operations holds the divisions, too: if these alone take as long, they are the limit.
        r["bound"] = max(bounds, key=lambda name: bounds[name] * (1.1 if name == "division" else 1.0))
        r["limit"] = max(bounds.values())
        r["of limit"] = r["limit"] / r["ns"]
    return r


def kernels(folder, quick):
    """The groups of rows on kernels, and the limits they were held against."""
    pairs = google(os.path.join(folder, "interface_bench"), "lattice|rows|cells|out_of_reach|partial", quick)
    sizes, blocks, threads = ((32,), (128,), (1,)) if quick else ((64, 512), (256, 512), (1, 2))
    transfer = 128 if quick else 512
    few = "|".join(map(str, sizes))
    pattern = (f"kick_and_drift/sites:({few})/|kick_and_drift_finite/sites:({few})/|level_transfer/sites:{transfer}/|"
               f"block_step/sites:({'|'.join(map(str, blocks))})/threads:({'|'.join(map(str, threads))})/damped:1")
    elastic = google(os.path.join(folder, "elastic_bench"), pattern, quick)

    rows = []
    for sweep in ("lattice", "rows", "cells"):
        for mixed in (0, 1) if sweep == "lattice" else (0,):
            for observed in (0, 1):
                name = f"{sweep}/mixed:{mixed}/observed:{observed}"
                label = f"{sweep}, {'mixed' if mixed else 'double'}, {'with energies' if observed else 'forces'}"
                if observed: # the operations of a force are counted, those of its energy are not
                    del pairs[name]["arithmetic"]
                rows.append(row(name, label, pairs[name]))
    groups = [{"question": "Pairs of atoms across the interface", "item": "pair",
               "note": "128 x 128 sites in contact, one core; with energies: those are not counted as GFLOP.",
               "rows": rows}]
    names = {"out_of_reach": "beyond the interaction range of the substrate", "partial_contact/skip:0": "partial contact, all atoms",
             "partial_contact/skip:1": "partial contact, far ones skipped"}
    groups.append({"question": "Sites with few pairs or none", "item": "site",
                   "note": "128 x 128 sites, one core, double; partial contact: rms 9 Å, the highest atom 4 Å deep.",
                   "rows": [row(k, label, pairs[k]) for k, label in names.items()]})
    rows = []
    for n in sizes:
        where = f"{n * n * 4 * 48 / 1e6:.1f} MB"
        for damped in (0, 1):
            name = f"kick_and_drift/sites:{n}/damped:{damped}/real_time"
            label = f"pass of {n} x {n} x 4, {where}{', damped' if damped else ''}"
            rows.append(row(name, label, elastic[name], in_memory=n == max(sizes)))
        for dilatation in (0, 1):
            name = f"kick_and_drift_finite/sites:{n}/dilatation:{dilatation}/real_time"
            if dilatation: # its operations are not counted
                del elastic[name]["arithmetic"]
            label = f"pass of {n} x {n} x 4, {where}, finite strain{'' if dilatation else ', ν = 1/4'}"
            rows.append(row(name, label, elastic[name], in_memory=n == max(sizes)))
    groups.append({"question": "Nodes of the elastic block, in cache and out of it", "item": "node",
                   "note": "Force, kick and drift, one core. Bytes: u and v read and written once. The stream is that of memory.",
                   "rows": rows})
    rows = []
    for up in (0, 1):
        name = f"level_transfer/sites:{transfer}/up:{up}/real_time"
        what = "forces to the coarse level" if up else "displacements to the fine level"
        rows.append(row(name, what, elastic[name], stream=False))
    groups.append({"question": "Transfer between two levels", "item": "fine node",
                   "note": f"{transfer} x {transfer} fine nodes, in cache, one core.", "rows": rows})
    rows = []
    for n in blocks:
        for t in threads:
            name = f"block_step/sites:{n}/threads:{t}/damped:1/real_time"
            rows.append(row(name, f"block of {n} sites and layers, {t} thread{'s' if t > 1 else ''}",
                            {**elastic[name], "threads_used": t}))
    groups.append({"question": "The whole block: levels, transfers, halos", "item": "node",
                   "note": "Multiscale, damped; nanoseconds a node and core.", "rows": rows})
    limits = {"fused, double": pairs["lattice/mixed:0/observed:0"]["fused_GFLOP/s"],
              "fused, single": pairs["lattice/mixed:1/observed:0"]["fused_GFLOP/s"]}
    for t in threads:
        some = next(e for name, e in elastic.items() if name.startswith("block_step") and f"threads:{t}/" in name)
        limits[f"stream, {t} thread{'s' if t > 1 else ''}"] = some["stream_GB/s"]
    return groups, limits, next(iter(pairs.values()))["label"]


def steps(folder, quick):
    """Whole steps of a scene, by phase."""
    sizes = (32,) if quick else (128, 256)
    threads = len(os.sched_getaffinity(0))
    cases = [(n, place, precision) for n in sizes for place in ("contact", "away")
             for precision in ("double", "mixed") if (place, precision) != ("away", "mixed")]
    best = {}
    for _ in range(1 if quick else 3):
        for n, place, precision in cases:
            result = scaling.step(folder, place, n, n, 1, threads, 0.05 if quick else 1.0, precision)
            key = f"step/sites:{n}/{place}/{precision}/threads:{threads}"
            if key not in best or result["seconds"] < best[key]["seconds"]:
                best[key] = {"key": key, "label": f"{n} sites and layers, {place}, {precision}",
                             "threads": threads, **result}
    return list(best.values())


def commit():
    """Of the source tree; "-dirty" if it has changes, "unknown" outside git."""
    found = subprocess.run(["git", "-C", SOURCE, "describe", "--always", "--dirty", "--abbrev=8", "--exclude=*"],
                           capture_output=True, text=True)
    return found.stdout.strip() or "unknown"


def all_times(results):
    """Key -> time, of everything that is compared with a baseline."""
    times = {r["key"]: r["ns"] for g in results["kernels"] for r in g["rows"]}
    times.update({s["key"]: 1e9 * s["seconds"] for s in results["steps"]})
    return times


def main():
    parser = argparse.ArgumentParser(prog="./asperity bench", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(SOURCE, "build", "release"), help=argparse.SUPPRESS)
    parser.add_argument("--scaling", action="store_true", help="the scaling study on two cores and its extrapolation, too (2 minutes more)")
    parser.add_argument("--study", action="store_true", help="nothing but a short scaling study (a quarter of a minute)")
    parser.add_argument("--page", nargs="?", const=os.path.join(SOURCE, "docs"), metavar="DIR",
                        help="write reports/performance.md, its tables and plots there (default: docs); runs all of it")
    parser.add_argument("--out", metavar="FILE", help="JSON with all numbers (default: bench.json in the build)")
    parser.add_argument("--from", dest="earlier", metavar="FILE", help="measure nothing: take the numbers of such a JSON")
    parser.add_argument("--save-baseline", action="store_true", help="make these numbers the baseline of this processor")
    parser.add_argument("--quick", action="store_true", help="tiny sizes: to see that it works, not to measure")
    args = parser.parse_args()
    if args.quick and args.save_baseline:
        parser.error("--quick measures nothing that could be a baseline")

    if args.study:
        watch = machine.Watch()
        for table in page.scaling_tables(scaling.study(programs(args), "short"), {}, PHASES):
            say(page.terminal(table))
        say(machine.words(watch.report()))
        return
    if args.earlier:
        with open(args.earlier) as file:
            results = json.load(file)
        if "kernels" not in results:
            raise ValueError(f"{args.earlier} holds no numbers of ./asperity bench")
    else:
        folder = programs(args)
        watch = machine.Watch()
        say("Measuring; the numbers are worth something only while nothing else runs here." +
            (f" The load is {watch.load:.1f}: something does." if watch.load > 0.5 else ""))
        groups, limits, variant = kernels(folder, args.quick)
        results = {"date": datetime.date.today().isoformat(), "commit": commit(), "machine": {**machine.describe(), "kernels": variant},
                   "quick": args.quick, "limits": limits, "kernels": groups, "steps": steps(folder, args.quick)}
        if args.scaling or args.page:
            say("Scaling ...")
            results["scaling"] = scaling.study(folder, "tiny" if args.quick else "full")
        results["load"] = watch.report()
        out = args.out or os.path.join(args.build, "perf", "bench.json")
        with open(out, "w") as file:
            json.dump(results, file, indent=1)

    stored = os.path.join(SOURCE, "perf", "baselines",
                          f"{results['machine']['class']}-{results['machine']['kernels']}.json")
    baseline = {}
    if os.path.exists(stored) and not args.quick:
        with open(stored) as file:
            baseline = json.load(file)
    shown = list(page.tables(results, baseline, PHASES))
    if "scaling" in results:
        shown += page.scaling_tables(results["scaling"], results["limits"], PHASES)
        shown += extrapolate.tables(results["scaling"])
    for table in shown:
        say(page.terminal(table))
    say(machine.words(results["load"]))
    if not args.quick:
        say(page.baseline_words(baseline))
    if args.save_baseline:
        os.makedirs(os.path.dirname(stored), exist_ok=True)
        made = {key: results[key] for key in ("date", "commit", "machine", "load")}
        with open(stored, "w") as file:
            json.dump({**made, "ns": {k: float(f"{t:.4g}") for k, t in all_times(results).items()}}, file, indent=1)
            file.write("\n")
        say(f"Baseline: {stored}")
        baseline = made # the page does not compare these numbers with themselves
    if args.page:
        if "scaling" not in results:
            sys.exit("bench: --page needs the scaling study; this JSON was made without --scaling")
        every = []
        for name in sorted(os.listdir(os.path.dirname(stored))):
            with open(os.path.join(os.path.dirname(stored), name)) as file:
                every.append(json.load(file))
        page.write(results, baseline, every, PHASES, args.page)
        say(f"Page: {os.path.join(args.page, 'reports', 'performance.md')}")
    if not args.earlier:
        say(f"Numbers: {out}")


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError) as error: # files that cannot be read or written, or hold no JSON
        sys.exit(f"bench: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
