#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How often the works of quasi-static paths over soft walls lie within their stated uncertainty (docs/explanation/relaxation.md).

    scenes/validation/soft_walls.py [--first 0] [--scenes 40] [--tight 5e-6] [--out results/soft-walls]

Scenes of 16 sites are drawn at random: modulus, roughness, work and range of an exponential wall, at a held mean height or a
held top. The works and losses of each at the default tolerance are compared with those at a tolerance 50 times smaller. Prints
(stated - tight)/uncertainty of the works, then of the losses, of approach and pull-off. About five minutes of one core.
"""
import argparse
import os
import pathlib
import random
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402


def scene(number: int) -> dict:
    """The keys of a scene, by its number."""
    draw = random.Random(number)
    return {"surface.sites": 16, "surface.spacing": 10.0, "surface.seed": draw.randint(1, 99),
            "surface.rms": round(draw.uniform(3, 10), 2), "block.young": round(draw.uniform(0.01, 0.08), 4),
            "block.poisson": 0.45, "block.thickness": 16, "interface.kind": "wall",
            "interface.range": round(draw.uniform(5, 15), 2), "interface.adhesion": round(draw.uniform(1, 4), 2),
            "drive.mode": "quasistatic", "drive.control": ("top", "mean-height")[number // 2 % 2],
            "drive.displacement_step": 2.0, "output.fields": [], "output.checkpoint": "none"}


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--scenes", type=int, default=40)
    words.add_argument("--tight", type=float, default=5e-6)
    words.add_argument("--out", default="results/soft-walls")
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # 16 sites
    missed: list[float] = []
    for number in range(asked.first, asked.first + asked.scenes):
        keys = scene(number)
        stated, tight = (asperity.run({}, keys | more, out=f"{asked.out}/{number}-{name}", progress=False)
                         for name, more in (("stated", {}), ("tight", {"drive.tolerance": asked.tight})))
        here = [(getattr(getattr(stated, what), way) - getattr(getattr(tight, what), way))
                / max(getattr(getattr(stated, what).uncertainty, way), 1e-9)
                for what in ("work_of_drive", "lost") for way in ("approach", "pull_off")]
        missed += here
        print(f"{number:3}  {keys['drive.control']:11}  " + "  ".join(f"{m:7.2f}" for m in here), flush=True)
    print(f"of {len(missed)} numbers " + ", ".join(f"{sum(abs(m) > k for m in missed)} lie beyond {k}" for k in (1, 2, 4))
          + " times their uncertainty")

if __name__ == "__main__":
    main()
