# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The scaling study on two cores: the same block, one twice as large, and messages between two ranks."""
import json
import os
import shutil
import subprocess
import sys

from extrapolate import volumes


def mpirun():
    """The launcher, without options: that of the MPI that the tests were built with, or the one in PATH."""
    return os.environ.get("ASPERITY_MPIRUN", "mpirun").split()[:1]


def run(command, threads, ranks=1):
    """What a program prints as JSON."""
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    if ranks > 1:
        launcher = mpirun()
        said = subprocess.run([*launcher, "--version"], capture_output=True, text=True).stdout
        if "Open MPI" in said or "OpenRTE" in said:
            enough = len(os.sched_getaffinity(0)) >= ranks * threads
            launcher += ["--bind-to", "core", "--map-by", f"slot:PE={threads}"] if enough else \
                ["--oversubscribe", "--bind-to", "none"]
        command = [*launcher, "-n", str(ranks), *command]
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(f"bench: {' '.join(command)} failed:\n{done.stderr}")
    return json.loads(done.stdout)


def step(folder, place, sites, layers, ranks, threads, seconds, precision="double"):
    """A measured step (step_bench)."""
    return run([os.path.join(folder, "step_bench"), place, str(seconds), f"surface.sites={sites}",
                f"block.thickness={layers}", f"numerics.precision={precision}"], threads, ranks)


# Sizes of a study: strong; on one core alone; weak (one core, two cores: twice the sites; layers); seconds, repeats.
STUDIES = {"tiny": ((32,), (32, 64), (32, 46, 32), 0.05, 1),
           "short": ((64, 128), (32, 64, 128), (64, 92, 64), 0.1, 2),
           "full": ((256, 512), (64, 128, 256, 512), (272, 384, 256), 1.0, 3)}


def study(folder, which):
    """Strong and weak scaling and the messages. Ends the program if the records of a step differ between ranks or
    threads."""
    if not shutil.which(mpirun()[0]):
        sys.exit("bench: the scaling study needs mpirun\n    fix: apt-get install openmpi-bin")
    strong, single, weak, seconds, repeats = STUDIES[which]
    layouts = ((1, 1), (1, 2), (2, 1))
    cases = [(place, n, n, *layout) for n in strong for place in ("contact", "away") for layout in layouts]
    singles = [("contact", n, n, 1, 1) for n in single]
    grown = [("contact", weak[0] if r * t == 1 else weak[1], weak[2], r, t) for r, t in layouts]
    best, records = {}, {}
    for _ in range(repeats):
        for case in dict.fromkeys([*cases, *singles, *grown]):
            result = step(folder, *case, seconds=seconds)
            record = records.setdefault(case[:3], result["sixth_step"])
            if result["sixth_step"] != record:
                sys.exit(f"bench: {case[3]} ranks of {case[4]} threads give other numbers than one: "
                         f"{result['sixth_step']} instead of {record} ({case[0]}, {case[1]} sites, {case[2]} layers)")
            if case not in best or result["seconds"] < best[case]["seconds"]:
                best[case] = result

    def entry(case, alone):
        s, a = best[case], best[alone]
        # By node, for the sizes of the weak study are not twice each other to the node.
        work = volumes(*case[1:3], 1)["nodes"] / volumes(*alone[1:3], 1)["nodes"]
        return {"place": case[0], "sites": case[1], "layers": case[2], "ranks": case[3], "threads": case[4],
                "seconds": s["seconds"], "phases": s["phases"], "halo_bytes": s["halo_bytes"],
                "communication": (s["phases"]["exchange"] + s["phases"]["sums"]) / s["seconds"],
                "efficiency": work * a["seconds"] / (case[3] * case[4] * s["seconds"])}

    return {"strong": [entry(c, (*c[:3], 1, 1)) for c in cases], "single": [entry(c, c) for c in singles],
            "weak": [entry(c, grown[0]) for c in grown], "messages": run([os.path.join(folder, "message_bench")], 1, 2)}
