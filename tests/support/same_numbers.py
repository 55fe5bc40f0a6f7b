#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Compares the numbers of two results, bit by bit: every number of result.json, every data set of
run.h5, every column of sweep.h5.

    same_numbers.py BEFORE AFTER     two result directories, or two directories of a sweep

Times, the place and the program are left out (KEPT_APART). Prints what differs and what only one of the
two has. Exit code 1 if a number that both have differs.
"""

import json
import sys
from pathlib import Path

import h5py
import numpy

KEPT_APART = ("run.", "memory.", "scene_file", "units.")


def leaves(value, name=""):
    """(path, leaf) of everything in a JSON document."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from leaves(item, f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield from leaves(item, f"{name}[{i}]")
    else:
        yield name, value


def numbers_of(file):
    """name -> array of a result file."""
    if file.suffix == ".json":
        found = dict(leaves(json.loads(file.read_text())))
        return {k: numpy.array(v) for k, v in found.items()
                if isinstance(v, (int, float)) and not k.startswith(KEPT_APART)}
    found = {}
    with h5py.File(file) as h5:
        h5.visititems(lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None)
    return {k: numpy.asarray(v) for k, v in found.items() if numpy.asarray(v).dtype.kind in "fiub" and "/run." not in k}


def same(a, b):
    return a.shape == b.shape and numpy.array_equal(a, b, equal_nan=a.dtype.kind == "f" and b.dtype.kind == "f")


def main():
    before, after = map(Path, sys.argv[1:])
    files = sorted(p.relative_to(before) for p in before.rglob("*")
                   if p.name in ("result.json", "run.h5", "sweep.h5"))
    differ = 0
    for name in files:
        a, b = numbers_of(before / name), numbers_of(after / name)
        both = sorted(a.keys() & b.keys())
        unlike = [k for k in both if not same(a[k], b[k])]
        differ += len(unlike)
        print(f"{name}: {len(both)} in both, {len(unlike)} differ")
        for k in unlike:
            print(f"    {k}: {a[k] if a[k].size < 5 else a[k].shape} and {b[k] if b[k].size < 5 else b[k].shape}")
        for what, only in (("before", a.keys() - b.keys()), ("after", b.keys() - a.keys())):
            if only:
                print(f"    only {what}: {' '.join(sorted(only))}")
    if not files:
        sys.exit(f"{before}: no result in there")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
