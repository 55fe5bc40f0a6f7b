#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same slab in LAMMPS and in this engine: do they agree, and how fast is each?

    perf/lammps/compare.py SLAB [--check] [--sites 64] [--layers 64] [--steps 20]
                    [--rounds 3]

SLAB is the program perf/lammps/slab of a build. --check compares 20 steps of a small slab and
times nothing. Exit code 77 where LAMMPS (Debian package lammps) is missing, 1 where they disagree.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

TOLERANCE = 1e-9  # relative, of energies and of the largest force


def run(command, directory, threads=1):
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_PROC_BIND="false")
    done = subprocess.run(command, cwd=directory, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    return done.stdout


def ranks(count, command):
    if count == 1:
        return command
    return ["mpirun", "--allow-run-as-root", "--bind-to", "none", "-n", str(count)] + command


def our_path(name):
    """Energies and atoms (x y z fx fy fz) of each step."""
    steps = []
    with open(name) as lines:
        for line in lines:
            words = line.split()
            if words[0] == "step":
                steps.append(([float(w) for w in words[2:]], []))
            else:
                steps[-1][1].append([float(w) for w in words])
    return steps


def their_path(dump, log):
    energies = []
    for line in log.splitlines():
        if re.fullmatch(r"\s*\d+(\s+-?[\d.]+(e[-+]\d+)?){3}\s*", line):
            energies.append([float(w) for w in line.split()[1:]])
    atoms = []
    with open(dump) as lines:
        for line in lines:
            if line.startswith("ITEM: ATOMS"):
                atoms.append([])
            elif line.startswith("ITEM: TIMESTEP"):
                atoms.append(None)
            elif atoms and atoms[-1] is not None:
                atoms[-1].append([float(w) for w in line.split()[1:]])
    return list(zip(energies, [a for a in atoms if a is not None]))


def agree(slab, lammps, sites, layers, steps):
    """Both programs over the same steps; True if no difference exceeds TOLERANCE."""
    with tempfile.TemporaryDirectory() as directory:
        run([slab, "write", str(sites), str(layers), str(steps), directory], directory)
        log = run([lammps, "-in", "in.path", "-log", "none"], directory)
        ours = our_path(os.path.join(directory, "path.ours"))
        theirs = their_path(os.path.join(directory, "path.dump"), log)
    if len(ours) != steps + 1 or len(theirs) != steps + 1:
        sys.exit(f"{len(ours)} and {len(theirs)} steps instead of {steps + 1}")
    worst = {"interface energy": 0.0, "elastic energy": 0.0, "kinetic energy": 0.0,
             "force": 0.0, "position": 0.0}
    names = ["interface energy", "elastic energy", "kinetic energy"]
    largest_force = 0.0
    for (mine, my_atoms), (other, their_atoms) in zip(ours, theirs):
        for name, a, b in zip(names, mine, other):
            worst[name] = max(worst[name], abs(a - b) / max(abs(a), abs(b)))
        scale = max(abs(f) for atom in my_atoms for f in atom[3:])
        largest_force = max(largest_force, scale)
        if len(my_atoms) != len(their_atoms):
            sys.exit(f"{len(my_atoms)} and {len(their_atoms)} atoms")
        for a, b in zip(my_atoms, their_atoms):
            for p, q in zip(a[3:], b[3:]):
                worst["force"] = max(worst["force"], abs(p - q) / scale)
            for p, q in zip(a[:3], b[:3]):
                worst["position"] = max(worst["position"], abs(p - q) / (sites * 2.6))
    print(f"{sites} x {sites} x {layers} atoms, {steps} steps, forces up to {largest_force:.2f} "
          f"eV/Å; elastic energy {ours[-1][0][1]:.3f} eV, interface {ours[-1][0][0]:.3f} eV")
    measures = {"force": "the largest force of the step", "position": "the box"}
    for name, value in worst.items():
        print(f"  {name:<17} differs by {value:.1e} of {measures.get(name, 'itself')}")
    return all(value <= TOLERANCE for value in worst.values())


def speeds(slab, lammps, sites, layers, steps, rounds):
    """Nanoseconds for each mobile atom and step, the least of interleaved rounds."""
    mobile = sites * sites * layers
    best = {}

    def note(name, cores, value):
        best[name, cores] = min(value, best.get((name, cores), 1e300))

    with tempfile.TemporaryDirectory() as directory:
        run([slab, "write", str(sites), str(layers), str(steps), directory], directory)
        os.remove(os.path.join(directory, "path.ours"))
        for _ in range(rounds):
            for cores in (1, 2):
                for name, suffix in (("LAMMPS lj/cut", []), ("LAMMPS lj/cut/opt", ["-sf", "opt"])):
                    log = run(ranks(cores, [lammps, "-in", "in.time", "-log", "none"] + suffix),
                              directory)
                    loop = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", log)[-1]
                    note(name, cores, 1e9 * float(loop[0]) / (int(loop[1]) * mobile))
                for strain in ("linear", "finite"):
                    timed = [slab, "time", str(sites), str(layers), str(10 * steps), strain]
                    note(f"Asperity {strain}, threads", cores,
                         float(run(timed, directory, cores)))
                    if cores > 1:
                        note(f"Asperity {strain}, ranks", cores,
                             float(run(ranks(cores, timed), directory)))
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("slab")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--sites", type=int, default=64)
    parser.add_argument("--layers", type=int, default=64)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    lammps = shutil.which("lmp")
    if not lammps:
        print("skipped: there is no LAMMPS here (Debian: apt-get install lammps)")
        return 77
    slab = os.path.abspath(options.slab)
    if not agree(slab, lammps, 16, 6, 20):
        print(f"they disagree: more than {TOLERANCE:g}")
        return 1
    if options.check:
        return 0
    best = speeds(slab, lammps, options.sites, options.layers, options.steps, options.rounds)
    print(f"\n{options.sites} x {options.sites} x {options.layers} atoms, nanoseconds for each "
          f"mobile atom and step, the least of {options.rounds} rounds")
    print(f"  {'':<28}{'one core':>10}{'two cores':>11}")
    for name in sorted({name for name, _ in best}):
        one = f"{best[name, 1]:.1f}" if (name, 1) in best else ""
        print(f"  {name:<28}{one:>10}{best[name, 2]:>11.1f}")
    peer = min(value for (name, cores), value in best.items() if "LAMMPS" in name and cores == 2)
    for strain in ("linear", "finite"):
        ours = min(value for (name, cores), value in best.items() if strain in name and cores == 2)
        print(f"  {strain} strain on two cores: {peer / ours:.1f} times LAMMPS")
    return 0


if __name__ == "__main__":
    sys.exit(main())
