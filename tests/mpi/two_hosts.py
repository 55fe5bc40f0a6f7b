#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A run on two hosts over TCP leaves the bits of a run on one: run.h5 byte for byte, the numbers of result.json.

    two_hosts.py PROGRAM [WIRE]

The hosts are two network namespaces of this machine (perf/hosts.py), joined by a veth pair and then, with the
program perf/wire, by a network of 20, 100 and 500 us and 1 Gbit/s. That the ranks were on both and talked over
this network is seen from their hosts' names and from the bytes that the devices have sent.
Exit code 77, with the reason, where namespaces cannot be made or Open MPI does not start in them.
"""
import os
import subprocess
import sys
import tempfile

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path[:0] = [os.path.join(SOURCE, "perf"), os.path.join(SOURCE, "tests", "support")]
import hosts  # noqa: E402
from run_outcome import outcome  # noqa: E402

# Five levels: four are cut, the last one is held by both ranks and gathered in each step.
SCENE = """
[surface]
sites = 32
rms = 1.5
[block]
thickness = 62
layers_per_level = 2
[drive]
velocity = 100
timestep = 20
[output]
series = 10
trajectory = 100
"""


def names_of(two):
    """Where Open MPI starts two ranks of a program that is not ours."""
    try:
        trial = two.mpirun(["hostname"], timeout=60)
    except subprocess.TimeoutExpired:
        raise hosts.CannotMakeHosts("mpirun did not come back within a minute") from None
    if trial.returncode != 0:
        raise hosts.CannotMakeHosts("mpirun hostname failed: " + trial.stderr.strip())
    return trial.stdout.split()


def main():
    program, wire = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None
    networks = [("veth", 0.0, 0.0, None)]
    if wire:
        networks += [(f"{t} us, 1 Gbit/s", t, 1.0, wire) for t in (20, 100, 500)]
    with tempfile.TemporaryDirectory(prefix="asperity-two-hosts.") as folder:
        scene = os.path.join(folder, "scene.toml")
        with open(scene, "w") as file:
            file.write(SCENE)
        command = [program, "run", scene, "--out"]
        here = os.path.join(folder, "here")
        subprocess.run(command + [here], check=True, capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
        data, result, run = outcome(here)
        steps = run["phases"]["exchange"]["calls"]
        failures = 0
        for name, microseconds, gigabits, wire in networks:
            out = os.path.join(folder, name.replace(" ", "-"))
            try:
                with hosts.Hosts(2, microseconds, gigabits, wire) as two:
                    names = names_of(two)
                    before = [two.bytes_sent(host) for host in (0, 1)]
                    done = two.mpirun(command + [out], timeout=120)
                    sent = [two.bytes_sent(host) - b for host, b in zip((0, 1), before)]
            except hosts.CannotMakeHosts as problem:
                print(f"{name}: left out: {problem}")
                if wire:
                    continue
                return 77
            if done.returncode != 0:
                sys.exit(f"FAILED over {name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
            found = outcome(out)
            wrong = [what for what, bad in (
                ("other bytes in run.h5", found[0] != data), ("other numbers in result.json", found[1] != result),
                (f"ranks {found[2]['ranks']}", found[2]["ranks"] != 2),
                (f"hosts {names}", sorted(names) != ["asperity-0", "asperity-1"]),
                # Halos of 10 kB a step at least.
                (f"only {sent} bytes over the network", min(sent) < 10000 * steps)) if bad]
            print(f"{name}: {steps} exchanges, {min(sent) / 1e6:.1f} MB sent by each host: " +
                  (", ".join(wrong) or "the same bits as on one host"))
            failures += bool(wrong)
    return int(failures > 0)


if __name__ == "__main__":
    sys.exit(main())
