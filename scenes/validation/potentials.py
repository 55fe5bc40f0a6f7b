#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What the form of the pair potential changes (docs/reports/validation.md).

    scenes/validation/potentials.py [--sites 64] [--rms 1.5] [--out results/potentials]

Four potentials on one surface: Lennard-Jones; the same from a table of its values; Morse's with its depth, place and curvature of
the minimum (a = 6 / r_m); and Morse's with a smaller a, whose attraction reaches as far as the half of that of Lennard-Jones does.
For each: flat on flat, the state at zero load, the works of the drive and the energy lost on a path at a held top, and the
renormalised theory.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402
from asperity.theories import combined  # noqa: E402

EPSILON, R0 = 0.1, 3.28
R_M = 2 ** (1 / 6) * R0


def table(file: pathlib.Path, points: int) -> str:
    """Lennard-Jones at `points` distances from 0.5 r0 to 4.2 r0."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w", encoding="utf-8") as out:
        out.write("# r, Å    V, eV\n")
        for i in range(points):
            r = R0 * (0.5 + 3.7 * i / (points - 1))
            out.write(f"{r:.12g} {4 * EPSILON * ((R0 / r) ** 12 - (R0 / r) ** 6):.17g}\n")
    return str(file.resolve())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sites", type=int, default=64)
    parser.add_argument("--rms", type=float, default=1.5)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/potentials"))
    given = parser.parse_args()

    def morse(a: float) -> dict[str, object]:
        return {"interface.potential": "morse", "interface.morse_D": EPSILON, "interface.morse_a": a,
                "interface.morse_r_min": R_M}

    cases = {"lennard-jones": {},
             "table of it": {"interface.potential": "table", "interface.table": table(given.out / "lj.txt", 1500)},
             "morse, a = 6 / r_m": morse(6 / R_M), "morse, a = 4.5 / r_m": morse(4.5 / R_M)}
    print("potential              flat   tension  |  state  contact |  work in    lost  work out    lost |  theory contact")
    print("                    meV/Å²     GPa     | meV/Å²           |  meV/Å²                          |  meV/Å²")
    for name, keys in cases.items():
        r = asperity.run({}, {"surface.sites": given.sites, "block.thickness": given.sites, "surface.rms": given.rms,
                              "drive.mode": "quasistatic", **keys},
                         out=given.out / name.replace(" ", "").replace("/", "over"))
        combined.complete(r)
        n = r.number
        print(f"{name:20s} {n('delta_gamma'):8.4f} {n('theory.renormalised.tension'):8.3f}   | "
              f"{n('binding_energy'):9.5f} {n('contact_fraction'):6.4f} | {-n('work_of_drive.approach'):9.4f} "
              f"{n('lost.approach'):7.4f} {n('work_of_drive.pull_off'):9.4f} {n('lost.pull_off'):7.4f} | "
              f"{n('theory.renormalised.gamma_eff'):8.3f} {n('theory.renormalised.contact_fraction'):6.4f}", flush=True)


if __name__ == "__main__":
    main()
