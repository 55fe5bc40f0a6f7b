#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Energy lost in a dynamic cycle as the velocity falls, against the quasi-static loss (docs/reports/validation.md).

    scenes/validation/jumps.py [--small] [--out results/jumps]

works.toml with 16 sites and 16 layers: flat, where the block jumps in and out, and at an rms height of 0.3 Å, where it does not.
--small: 5 and 2 m/s.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402

ROUGHNESSES, VELOCITIES = (0.0, 0.3), (20, 5, 2, 1)


def losses(out: pathlib.Path, velocities=VELOCITIES) -> list[dict]:
    """For each roughness the loss in meV/Å² by velocity in m/s, 0: quasi-static. A result that is there is an error."""
    rows, seconds = [], 0.0
    print("rms, Å  " + "".join(f"{v:6} m/s" for v in velocities) + "  quasi-static")
    for rms in ROUGHNESSES:
        row = {}
        for velocity in (*velocities, 0):
            mode = {"drive.velocity": velocity} if velocity else {"drive.mode": "quasistatic"}
            r = asperity.run(ROOT / "scenes/validation/works.toml", {
                "surface.sites": 16, "block.thickness": 16, "surface.rms": rms, "output.fields": [], "output.checkpoint": "none",
                **mode}, out / f"{rms}-{velocity}")
            row[velocity] = r["lost"]["cycle"]
            seconds += r["run"]["wall_seconds"]
        rows.append(row)
        print(f"{rms:6}  " + "".join(f"{row[v]:10.2f}" for v in velocities) + f"{row[0]:14.2f}", flush=True)
    print(f"{seconds:.0f} s of the program")
    return rows


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/jumps"))
    given = parser.parse_args()
    losses(given.out, VELOCITIES[1:3] if given.small else VELOCITIES)
