#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Whether two programs, as two compilers or MPIs build them, compute the same bits.

    tests/bits.py build/release/engine/asperity build/clang/engine/asperity [SCENE...]
    tests/bits.py BEFORE AFTER      # two result directories

Runs small scenes with both, and compares every number of result.json and every data set of run.h5. What differs is
named, with its largest relative difference; the exit code is then 1. ASPERITY_KERNELS=v2|v3|v4 and OMP_NUM_THREADS
choose kernels and threads of both, --launch "mpirun -n 2" starts the second one on ranks. About two minutes.
"""

import json
import os
import shlex
import subprocess
import sys
import tempfile

import h5py
import numpy as np

SMALL = ["surface.sites=32", "block.thickness=32"]
TIME = [*SMALL, "drive.timestep=40", "drive.velocity=60"]
REST = [*SMALL, "drive.mode=quasistatic"]
WALL = [*REST, "interface.kind=wall"]
SCENES = {
    "multiscale": TIME,
    "lattice": [*TIME, "block.thickness=12", "block.model=lattice"],
    "incommensurate": [*TIME, "surface.lattice_ratio=1.618", "interface.tail=true"],
    "mixed precision": [*TIME, "numerics.precision=mixed"],
    "sphere, 20 K": [*TIME, "surface.sites=48", "surface.radius=400", "drive.temperature=20"],
    "finite strain": [*TIME, "block.strain=finite", "drive.timestep=30"],
    "quasi-static": REST,
    "mean height controlled": [*REST, "drive.control=mean-height"],
    "wall": [*REST, "interface.kind=wall", "drive.control=mean-height"],
    "spring in time": [*TIME, "drive.stiffness=20", "drive.damping=0.1"],
    "spring": [*WALL, "drive.stiffness=20"],
    "free edges, spring": [*WALL, "surface.radius=200", "surface.boundary=free", "drive.stiffness=20",
                           "surface.rms=0.3", "interface.adhesion=10"],
    "layers, surface stress, w(x, y)": [*WALL, 'block.layers=[["1 nm", "10 GPa", 0.3]]', "block.surface_stress=0.5",
                                        "interface.adhesion=stripes 20 60 4nm"],
    "yields": [*WALL, "interface.hardness=stripes 1GPa 3GPa 4nm", 'drive.path=["approach", "load 300 MPa", "pull-off"]'],
    "viscoelastic": [*REST, 'block.prony=[[1.0, "1 ns"]]', "drive.control=mean-height"],
    "slide": [*WALL, 'drive.path=["load 100 MPa", "slide x 2 nm under load"]', "drive.control=mean-height"],
    "atoms, slide": [*TIME, 'drive.path=["approach", "slide x 0.5 nm"]'],
    "Morse": [*TIME, "interface.potential=morse"],
    "frictionless": [*REST, "interface.frictionless=true"],
}
# Of the build, of the machine and of the clock, at any depth of result.json.
NOT_COMPARED = {"version", "git", "compiler", "flags", "mpi", "hdf5", "fftw", "machine", "host", "date", "digest",
                "file_digest", "written", "build", "wall_seconds", "processor_seconds", "phases", "memory", "accuracy",
                "threads", "ranks", "tiles"}


def values(node, path=""):
    """Every value of result.json by its path."""
    if isinstance(node, dict):
        for name, child in node.items():
            if name not in NOT_COMPARED:
                yield from values(child, f"{path}.{name}" if path else name)
    elif isinstance(node, list):
        for i, child in enumerate(node):
            yield from values(child, f"{path}[{i}]")
    else:
        yield path, node


def results(folder):
    with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
        found = dict(values(json.load(file)))
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        file.visititems(lambda name, node: found.update({"run.h5/" + name: node[()]})
                        if isinstance(node, h5py.Dataset) and node.dtype.kind in "fiu" else None)
    return found


def difference(one, other):
    """0: the same bits; else the largest difference over the largest magnitude, infinite if they are no numbers alike."""
    a, b = np.asarray(one), np.asarray(other)
    if a.shape != b.shape or a.dtype != b.dtype:
        return np.inf
    if a.dtype.kind not in "fiu":
        return 0.0 if one == other else np.inf
    if a.dtype.kind == "f":  # a value that is no number has a sign, which means nothing
        a, b = (np.where(np.isnan(x), np.nan, x) for x in (a, b))
    if a.tobytes() == b.tobytes():
        return 0.0
    known = np.isfinite(a) & np.isfinite(b)
    if not np.array_equal(a[~known], b[~known], equal_nan=True):
        return np.inf
    scale = np.max(np.abs(a[known].astype(float)))
    return float(np.max(np.abs(a[known].astype(float) - b[known])) / scale) if scale else np.inf


def differs(what, one, other):
    """Prints what is not the same in both."""
    apart = {key: difference(one.get(key), other.get(key)) for key in sorted(one.keys() | other.keys())}
    apart = {key: by for key, by in apart.items() if by}
    print(f"{what}: {len(one) - len(apart)} of {len(one)} the same", flush=True)
    for key, by in sorted(apart.items(), key=lambda item: -item[1])[:12]:
        print(f"    {key}: {by:.1e}", flush=True)
    return bool(apart)


def main():
    words = sys.argv[1:]
    if len(words) == 2 and all(map(os.path.isdir, words)):
        return int(differs(words[1], *map(results, words)))
    launch = []
    if "--launch" in words:
        at = words.index("--launch")
        launch = shlex.split(words[at + 1])
        del words[at:at + 2]
    if len(words) < 2 or any(name not in SCENES for name in words[2:]):
        sys.exit(__doc__ + "\nScenes: " + ", ".join(SCENES))
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    environment = {"OMP_NUM_THREADS": "1", **os.environ}
    differ = 0
    for name in words[2:] or SCENES:
        with tempfile.TemporaryDirectory() as folder:
            found = []
            for i, program in enumerate(words[:2]):
                out = os.path.join(folder, str(i))
                done = subprocess.run([*(launch if i else []), os.path.abspath(program), "run",
                                       os.path.join(root, "scenes/first-contact.toml"), "--set", *SCENES[name],
                                       "--out", out, "--progress", "off"],
                                      env=environment, capture_output=True, text=True)
                if done.returncode:
                    sys.exit(f"{name}: {program} ended with {done.returncode}:\n{done.stderr}")
                found.append(results(out))
        differ += differs(name, *found)
    return int(differ > 0)


if __name__ == "__main__":
    sys.exit(main())
