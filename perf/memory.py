#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Peak memory of each rank beside what plan says: memory.py [--program PROGRAM] [--kinds wall ...] [--sites 1024 ...] [--ranks 1 2 4]

The peak is the kernel's high-water mark of each process. "sum" is that of all ranks, "over one" this sum over the peak of one rank, "own" the
same of what ranks take beyond the peak of as many ranks on 16 sites (the program, MPI and its buffers), and "planned over own" the memory
that plan says for all ranks over this. Kinds: a state over a wall, over atoms, of a tip with free edges, over a wall with a field of
adhesion, and four points of a path over a wall and over atoms. Writes all as CSV with --csv.
"""
import argparse
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from scaling import mpirun

ROOT = pathlib.Path(__file__).resolve().parents[1]
#: At a loose tolerance, which saves hours; at 1024 sites it changes the peaks of a state over a wall and over atoms by 1 MB at most.
STATE = {"surface.rms": 4, "surface.rolloff": 3, "drive.mode": "quasistatic", "drive.path": ["relax"], "output.fields": ["relaxed"],
         "output.checkpoint": "none", "drive.tolerance": 0.5}
WALL = STATE | {"interface.kind": "wall", "interface.adhesion": "50 mJ/m2"}
PATH = {"drive.path": ["approach", "pull-off"], "drive.max_steps": 4, "output.fields": []}
KINDS = {"wall": WALL, "atoms": STATE,
         "free": {key: value for key, value in WALL.items() if key not in ("surface.rms", "surface.rolloff")}
         | {"surface.kind": "flat", "surface.boundary": "free", "surface.radius": "20 nm"} | PATH,
         "field": WALL | {"interface.adhesion": "patches 30 mJ/m^2 50 mJ/m^2 10 nm 1"},
         "wall path": WALL | PATH, "atoms path": STATE | PATH}


def peak(command: list[str]) -> int:
    """Returns the largest memory of a process, bytes."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status:
        sys.exit(f"memory: {' '.join(command)} failed")
    return 1024 * used.ru_maxrss


def peaks(program: str, scene: pathlib.Path, ranks: int) -> list[int]:
    """Returns the largest memory of each rank of a run, bytes."""
    with tempfile.TemporaryDirectory() as scratch:
        command = [sys.executable, __file__, "--rank", scratch, program, "run", str(scene), "--progress", "off", "--out", f"{scratch}/run"]
        if ranks > 1:
            command = [*mpirun(), "--oversubscribe", "--bind-to", "none", "-n", str(ranks), *command]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env={
            **os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
        return sorted((int(file.read_text()) for file in pathlib.Path(scratch).glob("rank-*")), reverse=True)


def write(scene: pathlib.Path, keys: dict[str, object], sites: int) -> None:
    """Writes the scene of these keys and sites."""
    lines: dict[str, list[str]] = {}
    for key, value in keys.items():
        section, name = key.split(".")
        lines.setdefault(section, []).append(f"{name} = {json.dumps(value)}")
    lines["surface"].append(f"sites = {sites}")
    scene.write_text("".join(f"[{section}]\n" + "\n".join(names) + "\n" for section, names in lines.items()))


def main() -> None:
    if sys.argv[1:2] == ["--rank"]:
        scratch, command = sys.argv[2], sys.argv[3:]
        pathlib.Path(scratch, f"rank-{os.getpid()}").write_text(str(peak(command)))
        return
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--program", default=str(ROOT / "asperity"))
    words.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    words.add_argument("--sites", type=int, nargs="+", default=[1024])
    words.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4])
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    rows = [["kind", "sites", "ranks", "sum, MB", "largest, MB", "over one", "own", "planned over own"]]
    print("  ".join(rows[0]))
    with tempfile.TemporaryDirectory() as scratch:
        scene, small = pathlib.Path(scratch, "memory.toml"), pathlib.Path(scratch, "small.toml")
        write(small, WALL, 16)
        bare = {ranks: sum(peaks(asked.program, small, ranks)) for ranks in asked.ranks}
        for kind, sites in itertools.product(asked.kinds, asked.sites):
            write(scene, KINDS[kind], sites)
            one = own_of_one = 0.0
            for ranks in asked.ranks:
                found = peaks(asked.program, scene, ranks)
                planned = json.loads(subprocess.run([asked.program, "plan", str(scene), "--ranks", str(ranks), "--json"], check=True,
                                                    capture_output=True, text=True).stdout)["bytes"]["altogether"]
                own = sum(found) - bare[ranks]
                one, own_of_one = one or sum(found), own_of_one or own
                rows.append([kind, sites, ranks, f"{sum(found) / 1e6:.0f}", f"{found[0] / 1e6:.0f}", f"{sum(found) / one:.2f}",
                             f"{own / own_of_one:.2f}", f"{planned / own:.2f}"])
                print("  ".join(map(str, rows[-1])), flush=True)
    if asked.csv:
        with asked.csv.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
