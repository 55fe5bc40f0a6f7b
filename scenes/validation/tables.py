#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What coarse and noisy tables of a potential do to its numbers, beside interface.table_error (docs/reports/validation.md).

    scenes/validation/tables.py [--sites 24] [--out results/tables]

Five potentials, as tables of rows at equal distances (equal), at equal ratios of distances (ratios), and at distances that are
moved at random by up to 0.3 of a row (uneven); with noise, or written with few decimals. Against the table of 3000 rows: the errors
of the work of adhesion of flat surfaces and of the binding energy of a rough state, over the work of adhesion.
"""
import argparse
import pathlib
import re
import sys
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402


def morse(depth: float, a: float, r_min: float) -> Callable:
    return lambda r: depth * ((1 - np.exp(-a * (r - r_min))) ** 2 - 1)


POTENTIALS = {"lennard-jones": (lambda r: 0.4 * ((3.28 / r) ** 12 - (3.28 / r) ** 6), 2.4),
              "morse soft": (morse(0.1, 1.0, 3.4), 1.2), "morse": (morse(0.1, 1.5, 3.68), 2.2),
              "morse stiff": (morse(0.2, 2.5, 3.0), 2.0),
              "buckingham": (lambda r: 3000 * np.exp(-r / 0.32) - 60 / r**6, 2.2)}
"""Energies, eV, and the first distance, Å."""
LAST = 13.1


class Case(NamedTuple):
    potential: str
    places: str = "equal"
    rows: int = 100
    noise: float = 0.0
    """eV"""
    decimals: int = 15


def cases() -> list[Case]:
    return [*(Case("lennard-jones", "equal", n) for n in (16, 24, 48, 72, 96, 200)),
            *(Case("lennard-jones", "ratios", n) for n in (24, 40, 64)),
            *(Case("morse", "equal", n) for n in (16, 22, 48, 64, 128)), *(Case("morse", "ratios", n) for n in (24, 40)),
            *(Case("morse", "uneven", n) for n in (48, 96, 200)), *(Case("morse soft", "equal", n) for n in (24, 48)),
            *(Case("morse stiff", "equal", n) for n in (48, 96)), *(Case("morse stiff", "uneven", n) for n in (96, 200)),
            *(Case("buckingham", "equal", n) for n in (32, 64, 100)), Case("buckingham", "uneven", 128),
            *(Case("lennard-jones", "equal", 300, noise) for noise in (2e-3, 1e-4, 1e-5, 1e-6, 1e-7)),
            *(Case("morse stiff", "equal", 150, noise) for noise in (1e-3, 1e-5, 1e-7)),
            *(Case("lennard-jones", "equal", 500, 0.0, decimals) for decimals in (4, 5, 6, 7))]


def distances(case: Case) -> np.ndarray:
    first, part = POTENTIALS[case.potential][1], np.linspace(0, 1, case.rows)
    if case.places == "ratios":
        return first * (LAST / first) ** part
    r = first + (LAST - first) * part
    if case.places == "uneven":
        r[1:-1] += np.random.default_rng(1).uniform(-0.3, 0.3, case.rows - 2) * (r[1] - r[0])
    return r


def numbers(case: Case, sites: int, place: pathlib.Path) -> tuple[float, float, float]:
    """Work of adhesion, binding energy (meV/Å²), interface.table_error. Raises SceneError for a table that is refused."""
    place.mkdir(parents=True, exist_ok=True)
    r = distances(case)
    energy = POTENTIALS[case.potential][0](r) + np.random.default_rng(2).normal(0, case.noise or 1e-300, len(r))
    np.savetxt(place / "table.txt", np.c_[r, energy], fmt=("%.12g", f"%.{case.decimals}f"))
    found = asperity.run({"surface": {"sites": sites, "rms": 1.0}, "block": {"thickness": sites}, "drive": {"path": ["relax"]}},
                         {"interface.potential": "table", "interface.table": str(place / "table.txt")}, out=place)
    return found.delta_gamma, found.binding_energy, found.number("interface.table_error")


def compared(place: pathlib.Path, sites: int, chosen: list[Case]) -> list[dict]:
    """For each table its true errors and what is stated, over the work of adhesion; nan: it is refused."""
    rows, exact = [], {}
    for number, case in enumerate(chosen):
        if case.potential not in exact:
            exact[case.potential] = numbers(Case(case.potential, rows=3000), sites, place / case.potential)
        true = exact[case.potential]
        row = {**case._asdict(), "delta_gamma": np.nan, "binding_energy": np.nan}
        try:
            made = numbers(case, sites, place / str(number))
            row |= {"stated": made[2], **{name: abs(made[k] - true[k]) / true[0]
                                          for k, name in enumerate(("delta_gamma", "binding_energy"))}}
        except asperity.SceneError as error:
            said = re.search(r"wrong by ([\d.e+]+) %", str(error))
            row |= {"stated": float(said[1]) / 100 if said else np.nan, "refused": str(error)}
        rows.append(row)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sites", type=int, default=24)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/tables"))
    given = parser.parse_args()
    print("potential      rows           noise, eV  decimals | error of Δγ, %  of binding, %   stated, %")
    for row in compared(given.out, given.sites, cases()):
        end = " refused" if "refused" in row else ""
        print(f"{row['potential']:14s} {row['rows']:4d} {row['places']:8s} {row['noise']:9g} {row['decimals']:8d} | "
              f"{100 * row['delta_gamma']:12.5f} {100 * row['binding_energy']:14.5f} {100 * row['stated']:12.4f}{end}")


if __name__ == "__main__":
    main()
