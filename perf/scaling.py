# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What do two cores gain, and what would many more? The scaling study, and a model for larger machines.

The model of a step, for the most loaded rank (volumes.cpp says what it holds and sends):

    nodes x t_node + sites x t_site + constrained x t_constrained              work
    (wrapped + 2 x sent) x t_byte                                      copies into and out of halos
    swap(x) + swap(y)                                                  messages to neighbours, in two goes
    log2(ranks) x t_sum                                                the step's one reduction
    log2(ranks) x latency + gathered x t_gathered                      the level that every rank holds

The times are measured: those of work and copies on one core, at several sizes (they depend on what fits
into the cache; in between they are interpolated by the number of nodes, outside they are constant), those of messages between two ranks by message_bench. It leaves out waiting for
ranks that are late, and takes it that each rank has as much of the memory's speed as here.
"""
import json
import math
import os
import shutil
import subprocess
import sys

import hosts

PREDICTED_SITES, PREDICTED_RANKS = (512, 2048, 8192), (1, 4, 16, 64, 256, 1024)
# What if ranks shared the levels that each of them holds now (Model.predict)?
SHARED_AMONG = 16
# A network, assumed, not measured here: seconds, bytes a second for each rank. Messages longer than `eager` bytes
# wait for the receiver, there and back: two latencies more. The limit is Open MPI's over TCP; networks() shows it.
NETWORK = {"latency": 2e-6, "bandwidth": 5e9, "eager": 65536.0}


def _run(command, threads, ranks=1):
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    if ranks > 1:
        launcher = hosts.mpirun()
        if hosts.is_open_mpi(launcher):
            enough = len(os.sched_getaffinity(0)) >= ranks * threads
            launcher += ["--bind-to", "core", "--map-by", f"slot:PE={threads}"] if enough else \
                ["--oversubscribe", "--bind-to", "none"]
        command = [*launcher, "-n", str(ranks), *command]
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
    if run.returncode != 0:
        sys.exit(f"bench: {' '.join(command)} failed:\n{run.stderr}")
    return json.loads(run.stdout)


def _step_bench(folder, place, sites, thickness, seconds, precision="double"):
    return [os.path.join(folder, "step_bench"), place, str(seconds), f"surface.sites={sites}",
            f"block.thickness={thickness}", f"numerics.precision={precision}"]


def step(folder, place, sites, thickness, ranks, threads, seconds, precision="double"):
    """A measured step (step_bench)."""
    return _run(_step_bench(folder, place, sites, thickness, seconds, precision), threads, ranks)


def volumes(folder, cases):
    """What ranks hold and send, for (sites, thickness, ranks) each."""
    return dict(zip(cases, _run([os.path.join(folder, "volumes")] + [":".join(map(str, c)) for c in cases], 1)))


def _between(points, x):
    """Straight lines through (x, y) points; constant before the first, the last line goes on."""
    points = sorted(points)
    if x <= points[0][0]:
        return points[0][1]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x <= x1 or x1 == points[-1][0]:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return points[-1][1]


class Model:
    """Seconds of a step from volumes."""

    def __init__(self, singles, volume_of, messages):
        """singles: measured steps in contact on one core, by sites."""
        self.cost = {"node": [], "site": [], "constrained": [], "byte": []}
        for n, s in sorted(singles.items()):
            v, p = volume_of(n), s["phases"]
            for name, seconds, many in (("node", p["advance"], v["nodes"]), ("byte", p["exchange"], v["wrapped"]),
                                        ("site", p["interface"] + p["observe"], v["sites"]),
                                        ("constrained", p.get("interpolate", 0.0), max(v["constrained"], 1.0))):
                self.cost[name].append((math.log(v["nodes"]), seconds / many))
        self.swap = [(m["bytes"], m["seconds"]) for m in messages["swap"]]
        ping = messages["ping"]
        self.latency, self.sum = ping[0]["seconds"], messages["sum"]
        self.gathered = ping[-1]["seconds"] / ping[-1]["bytes"]

    def over_network(self):
        """The same work, with messages over NETWORK."""
        other = Model.__new__(Model)
        other.__dict__.update(self.__dict__)
        latency, per_byte = NETWORK["latency"], 1.0 / NETWORK["bandwidth"]
        # Two messages leave and two arrive; the link goes both ways at once.
        eager = NETWORK["eager"]
        other.swap = [(bytes, waits * latency + 2.0 * bytes * per_byte)
                      for bytes, waits in ((0.0, 1), (eager, 1), (eager + 1.0, 3), (1e6, 3))]
        other.latency = other.sum = latency
        other.gathered = per_byte
        return other

    def predict(self, v, among=1):
        """Seconds of the parts of a step. among: as if that many ranks together, and not each of them, held the
        levels that are not cut, for another swap in x and in y with a rank that holds the next part."""
        # Beyond the largest block measured everything takes what it takes there.
        size = min(math.log(v["nodes"]), self.cost["node"][-1][0])
        t = {name: _between(points, size) for name, points in self.cost.items()}
        doublings = math.ceil(math.log2(v["ranks"]))
        sent = 2.0 * (v["x"] + v["y"])
        messages = sum(_between(self.swap, v[way]) for way in "xy" if v[way] > 0.0)
        if v["gathered"] > 0.0:
            messages += doublings * self.latency + v["gathered"] * self.gathered
        nodes = v["nodes"] - v["held"] * (1.0 - 1.0 / among)
        if among > 1 and v["held"] > 0.0:
            messages += 2.0 * _between(self.swap, v["held_side"] / math.sqrt(among))
        return {"work": nodes * t["node"] + v["sites"] * t["site"] + v["constrained"] * t["constrained"],
                "copies": (v["wrapped"] + 2.0 * sent) * t["byte"], "messages": messages,
                "sums": doublings * self.sum}


# Sizes of a study: strong, on one core alone, weak (one core, two cores: twice the sites; layers); seconds, repeats.
STUDIES = {"tiny": ((32,), (32, 64), (32, 46, 32), 0.05, 1),
           "short": ((64, 128), (32, 64, 128), (64, 92, 64), 0.1, 2),
           "full": ((256, 512), (64, 128, 256, 512), (272, 384, 256), 1.0, 3)}


def study(folder, which):
    """Strong and weak scaling on two cores, the messages, the model and its check. Ends the program if the
    records of a step differ between ranks or threads."""
    if not shutil.which(hosts.mpirun()[0]):
        sys.exit("bench: the scaling study needs mpirun\n    fix: apt-get install openmpi-bin")
    strong, single, weak, seconds, repeats = STUDIES[which]
    layouts = ((1, 1), (1, 2), (2, 1))
    cases = [(place, n, n, *layout) for n in strong for place in ("contact", "away") for layout in layouts]
    cases += [("contact", n, n, 1, 1) for n in single if n not in strong]
    cases += [("contact", weak[0] if r * t == 1 else weak[1], weak[2], r, t) for r, t in layouts]
    best, records = {}, {}
    for _ in range(repeats):
        for case in cases:
            result = step(folder, *case, seconds=seconds)
            record = records.setdefault(case[:3], result["sixth_step"])
            if result["sixth_step"] != record:
                sys.exit(f"bench: {case[3]} ranks of {case[4]} threads give other numbers than one: "
                         f"{result['sixth_step']} instead of {record} ({case[0]}, {case[1]} sites, {case[2]} layers)")
            if case not in best or result["seconds"] < best[case]["seconds"]:
                best[case] = result
    messages = _run([os.path.join(folder, "message_bench")], 1, 2)

    def entry(case, alone):
        s, a = best[case], best[alone]
        cores = case[3] * case[4]
        # Per node of the whole block, for the weak study's sizes are not twice each other to the node.
        work = volume[(case[1], case[2], 1)]["nodes"] / volume[(alone[1], alone[2], 1)]["nodes"]
        return {"place": case[0], "sites": case[1], "layers": case[2], "ranks": case[3], "threads": case[4],
                "seconds": s["seconds"], "phases": s["phases"], "halo_bytes": s["halo_bytes"],
                "communication": (s["phases"]["exchange"] + s["phases"]["sums"]) / s["seconds"],
                "efficiency": work * a["seconds"] / (cores * s["seconds"])}

    sizes = {(c[1], c[2]) for c in cases}
    predicted = [(n, n, r) for n in PREDICTED_SITES for r in PREDICTED_RANKS]
    volume = volumes(folder, sorted({(n, d, r) for n, d in sizes for r in (1, 2)}) + predicted)
    model = Model({n: best[("contact", n, n, 1, 1)] for n in single}, lambda n: volume[(n, n, 1)], messages)
    check = []
    for n in strong:
        measured, parts = best[("contact", n, n, 2, 1)], model.predict(volume[(n, n, 2)])
        check.append({"sites": n, "measured": measured["seconds"], "predicted": sum(parts.values()),
                      "halo_bytes": measured["halo_bytes"], "predicted_halo_bytes":
                      2.0 * (volume[(n, n, 2)]["x"] + volume[(n, n, 2)]["y"]),
                      "measured_communication": measured["phases"]["exchange"] + measured["phases"]["sums"],
                      "predicted_communication": sum(parts.values()) - parts["work"]})
    larger = []
    for n in PREDICTED_SITES:
        for kind, m in (("measured", model), ("network", model.over_network())):
            alone = sum(m.predict(volume[(n, n, 1)]).values())
            for r in PREDICTED_RANKS[1:]:
                parts = m.predict(volume[(n, n, r)])
                total = sum(parts.values())
                shared = sum(m.predict(volume[(n, n, r)], SHARED_AMONG).values())
                larger.append({"sites": n, "ranks": r, "messages": kind, "seconds": total,
                               "efficiency": alone / (r * total), "communication": 1.0 - parts["work"] / total,
                               "held": volume[(n, n, r)]["held"] / volume[(n, n, r)]["nodes"],
                               "shared": total / shared - 1.0})
    return {"strong": [entry(c, (*c[:3], 1, 1)) for c in cases[:len(strong) * 6]],
            "weak": [entry(c, ("contact", weak[0], weak[2], 1, 1)) for c in cases[-3:]],
            "messages": messages, "network": NETWORK, "check": check, "larger": larger,
            "coefficients": {"nodes": [round(math.exp(x)) for x, _ in model.cost["node"]],
                             "ns": {name: [1e9 * t for _, t in points] for name, points in model.cost.items()},
                             "us a reduction": 1e6 * model.sum, "us a short message": 1e6 * model.latency,
                             "GB/s of a long message": 1e-9 / model.gathered}}


# Networks between two hosts (hosts.py): microseconds one way, Gbit/s; first a veth pair as it is.
NETWORKS = ((None, None), (20, 1.0), (100, 1.0), (500, 1.0))


def networks(folder, repeats=4):
    """Steps of two ranks on two hosts over TCP, and the model with the messages measured over the same network."""
    single, sizes = (32, 64, 128, 256), (64, 128, 256)
    volume = volumes(folder, [(n, n, r) for n in single for r in (1, 2)])
    alone = {}
    for n in single * repeats:
        s = step(folder, "contact", n, n, 1, 1, 0.5)
        alone[n] = min(s, alone.get(n, s), key=lambda result: result["seconds"])
    rows = []
    for microseconds, gigabits in NETWORKS:
        wire = os.path.join(folder, "wire") if microseconds else None
        with hosts.Hosts(2, microseconds or 0, gigabits or 0, wire) as two:
            def run(command):
                done = two.mpirun(command, timeout=300)
                if done.returncode != 0:
                    sys.exit(f"bench: {' '.join(command)} failed on two hosts:\n{done.stderr}")
                return json.loads(done.stdout)
            message_bench = [os.path.join(folder, "message_bench")] + [f"{volume[(n, n, 2)]['y']:.0f}" for n in sizes]
            messages, best = run(message_bench), {}
            for _ in range(repeats):
                again = run(message_bench)
                for kind in ("ping", "swap"):
                    messages[kind] = [min(pair, key=lambda m: m["seconds"]) for pair in zip(messages[kind], again[kind])]
                messages["sum"] = min(messages["sum"], again["sum"])
                for n in sizes:
                    s = run(_step_bench(folder, "contact", n, n, 1.0))
                    best[n] = min(s, best.get(n, s), key=lambda result: result["seconds"])
        model = Model(alone, lambda n: volume[(n, n, 1)], messages)
        for n in sizes:
            if best[n]["sixth_step"] != alone[n]["sixth_step"]:
                sys.exit(f"bench: two hosts give other numbers than one: {best[n]['sixth_step']} instead of "
                         f"{alone[n]['sixth_step']} ({n} sites)")
            parts = model.predict(volume[(n, n, 2)])
            rows.append({"microseconds": microseconds, "gigabits": gigabits, "latency": model.latency, "sum": model.sum,
                         "sites": n, "measured": best[n]["seconds"], "predicted": sum(parts.values()),
                         "measured_communication": best[n]["phases"]["exchange"] + best[n]["phases"]["sums"],
                         "predicted_communication": sum(parts.values()) - parts["work"]})
    return rows
