#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The renormalised theory against states at zero load over many sets of parameters (docs/explanation/theory.md).

    scenes/validation/parameters.py [SET ...] [--out results/parameters]     # all: a quarter of an hour of one core
    scenes/validation/parameters.py --draw 100 [--from 33] --out results/drawn    # scenes drawn at random: an hour

Each set is parameters.toml with some keys changed, at its roughnesses, for its surfaces, over three interfaces: the atoms with lateral
forces (friction), without (frictionless), and the substrate's atoms smeared over their layer (wall), where there is no registry
and nothing depends on the slope, so that what is left of a deviation there is that of the flow of the potential. The theory is that
of each surface's own spectrum. Results that are there are neither read nor written over: name another --out. parameters.csv has a
row for each state; the table printed a row for each mean over the surfaces.

The sets "drawn-1" to "drawn-10" were drawn at random once (uniform: Hurst exponent 0.4 to 1, ε 0.04 to 0.2 eV, E 40 to 150 GPa, ν 0.05 to
0.45, r0 2.6 to 4.9 Å, rms slope 0.08 to 0.45; q0/q_L of 2, 3, 4, 5, 6, 8) and none was left out.
"""
import argparse
import csv
import math
import pathlib
import random
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402
from asperity.theories import combined  # noqa: E402


def drawn(hurst, epsilon, young, poisson, rolloff, r0, rms):
    keys = {"surface.hurst": hurst, "interface.epsilon": epsilon, "block.young": young, "block.poisson": poisson,
            "surface.rolloff": rolloff, "interface.r0": r0, "interface.cutoff": round(4 * r0, 2)}
    return keys, [rms]


SETS = {  # name: keys that differ from the scene, roughnesses in Å
    "paper": ({}, [3, 4.5, 6]),
    "nu-0.25": ({"block.poisson": 0.25}, [2.5, 4]),
    "hurst-0.5": ({"surface.hurst": 0.5}, [1.5, 2.5]),
    "hurst-1": ({"surface.hurst": 1}, [2.5, 4]),
    "epsilon-0.05": ({"interface.epsilon": 0.05}, [1.5, 2.5]),
    "epsilon-0.2": ({"interface.epsilon": 0.2}, [3, 5]),
    "young-40": ({"block.young": 40}, [3, 5]),
    "young-150": ({"block.young": 150}, [1.5, 2.5]),
    "rolloff-1": ({"surface.rolloff": 1}, [3, 5]),
    "rolloff-8": ({"surface.rolloff": 8}, [1.5, 2.5]),
    # The reach of the potential; the same work of flat surfaces (scenes/paper/long-range.sh).
    "r0-2.46": ({"interface.r0": 2.46, "interface.cutoff": 9.84, "interface.epsilon": 0.1367232248}, [3, 4.5, 6]),
    "r0-4.92": ({"interface.r0": 4.92, "interface.cutoff": 19.68, "interface.epsilon": 0.0499503807}, [3, 4.5, 6]),
    # Sizes: by the paper's rule q0 = 3 q_L, and with q0 of 512 sites (scenes/paper/finite-size.sh).
    "sites-128": ({"surface.sites": 128, "block.thickness": 128}, [1.5, 3]),
    "sites-512": ({"surface.sites": 512, "block.thickness": 512}, [3, 6]),
    "sites-256-same": ({"surface.rolloff": 1.5}, [3, 6]),
    "sites-1024-same": ({"surface.sites": 1024, "block.thickness": 1024, "surface.rolloff": 6}, [3, 6]),
    "drawn-1": drawn(0.47, 0.12, 96, 0.39, 2, 4.63, 3.1),
    "drawn-2": drawn(0.77, 0.107, 103, 0.39, 5, 4.33, 2.4),
    "drawn-3": drawn(0.54, 0.138, 52, 0.38, 5, 2.63, 2.3),
    "drawn-4": drawn(0.69, 0.09, 84, 0.19, 4, 4.45, 3.7),
    "drawn-5": drawn(0.71, 0.052, 77, 0.27, 4, 3.26, 1.1),
    "drawn-6": drawn(0.79, 0.155, 74, 0.39, 4, 3.44, 2.3),
    "drawn-7": drawn(0.64, 0.134, 95, 0.1, 6, 4.45, 2.4),
    "drawn-8": drawn(0.93, 0.104, 98, 0.39, 6, 4.73, 2.3),
    "drawn-9": drawn(0.71, 0.044, 65, 0.1, 2, 4.81, 3.7),
    "drawn-10": drawn(0.8, 0.155, 87, 0.11, 3, 4.55, 1.6),
    "drawn-3-less-steep": (drawn(0.54, 0.138, 52, 0.38, 5, 2.63, 2.3)[0], [0.8, 1.2, 1.7]),
}
SURFACES = {"rolloff-1": range(1, 13)}  # few long waves: the surfaces differ
INTERFACES = {"friction": {}, "frictionless": {"interface.frictionless": "true"},
              "wall": {"interface.kind": "wall", "interface.law": "smeared"}}


def interfaces(name: str) -> list[str]:
    return ["friction"] if name.startswith("sites") else list(INTERFACES)


SCENE = ROOT / "scenes/validation/parameters.toml"


def state(name: str, keys: dict, interface: str, rms: float, seed: int, place: pathlib.Path) -> dict:
    """The row of one state. Numbers of a theory that has none are nan."""
    where = place / f"{name}-{interface}" / f"rms={rms:g},seed={seed}"
    settings = {**keys, **INTERFACES[interface], "output.checkpoint": "none", "output.fields": [],
                "surface.rms": rms, "surface.seed": seed}
    result = asperity.run(SCENE, settings, where)
    flat, theory = result["delta_gamma"], result["theory"]["persson"]
    found = combined.of_run(result).part("theory.renormalised")
    renormalised = {key: found.get(key, math.nan) for key in (
        "gamma_eff_ratio", "gamma_eff_error", "gamma_eff_expected_error", "contact_fraction", "contact_fraction_expected_error")}
    return {"set": name, "interface": interface, "rms": rms, "seed": seed, "rms_slope": result["surface"]["rms_slope"],
            "delta_gamma": flat, "binding_energy_ratio": result["binding_energy"] / flat,
            "contact_fraction": result["contact_fraction"], "theory.persson.gamma_eff_ratio": theory["gamma_eff"] / flat,
            "theory.persson.contact_fraction": theory["contact_fraction"],
            **{"theory.renormalised." + key: value for key, value in renormalised.items()}}


DRAWN = {"surface.sites": "sites", "surface.hurst": "hurst", "surface.rolloff": "rolloff", "block.young": "young",
         "block.poisson": "poisson", "interface.epsilon": "epsilon", "interface.r0": "r0"}  # key: column


def scenes_drawn(number: int, from_seed: int):
    """Scenes drawn at random: (name, keys, rms, surface's seed). Uniform over the ranges below (Young's modulus in its
    logarithm), the rms over 0.2 to 1.3 of that at which full contact costs all of the adhesion; those steeper than 0.6, or with
    γ_eff of both theories below 0.05 or above 0.95 of the flat one, are drawn again. No state is looked at."""
    chance = random.Random(from_seed)
    for i in range(1, number + 1):
        while True:
            r0, sites = round(chance.uniform(2.2, 5), 2), chance.choice([96, 128, 160, 192])
            keys = {"surface.sites": sites, "block.thickness": sites, "surface.hurst": round(chance.uniform(0.3, 0.95), 2),
                    "surface.rolloff": round(chance.uniform(2, 6), 1),
                    "block.young": round(math.exp(chance.uniform(math.log(20), math.log(200)))),
                    "block.poisson": round(chance.uniform(-0.3, 0.48), 2),
                    "interface.epsilon": round(chance.uniform(0.05, 0.25), 3),
                    "interface.r0": r0, "interface.cutoff": round(4 * r0, 2)}
            seed, fraction = chance.randint(1, 10**6), chance.uniform(0.2, 1.3)

            def theory(rms: float, *more: str) -> dict:
                return combined.points(str(SCENE), [[f"{k}={v}" for k, v in keys.items()] + [
                    f"surface.rms={rms}", f"surface.seed={seed}", *more]])[0]
            one = theory(1, "theory.area_factor=none")
            cost = 1 - one["theory"]["persson"]["gamma_full_contact"] / one["delta_gamma"]
            rms = round(fraction / math.sqrt(cost), 2)
            if one["theory"]["persson"]["rms_slope"] * rms > 0.6:
                continue
            both = theory(rms)
            ratios = [both["theory"]["persson"]["gamma_eff"] / both["delta_gamma"],
                      both["theory"]["renormalised"].get("gamma_eff_ratio", 0.5)]
            if any(0.05 < ratio < 0.95 for ratio in ratios):
                break
        yield f"{from_seed}-{i:03}", keys, rms, seed


def compare_drawn(options: argparse.Namespace) -> None:
    """Draws, runs, writes drawn.csv and says how many states lie within the expected errors of the theory."""
    rows = []
    for i, (name, keys, rms, seed) in enumerate(scenes_drawn(options.draw, options.from_seed)):
        for interface in INTERFACES if i % 4 == 0 else ["friction"]:
            try:
                row = state(name, keys, interface, rms, seed, options.out)
            except asperity.PhysicsError as error:  # the state was not found
                print(name, interface, error, flush=True)
                continue
            rows.append({**row, **{column: keys[key] for key, column in DRAWN.items()}})
            print(*(f"{v:.4g}" if isinstance(v, float) else v for v in rows[-1].values()), flush=True)
    write_rows(rows, options.out / "drawn.csv")
    covered(rows)


def covered(rows: list[dict]) -> None:
    """States within the expected errors, by interface."""
    print("| drawn from | interface | states | gamma_eff: within, median ±, largest difference | contact: the same |\n|" + "---|" * 5)
    for of, interface in sorted({(r["set"].partition("-")[0], r["interface"]) for r in rows}):
        text = []
        chosen = [r for r in rows if r["set"].partition("-")[0] == of and r["interface"] == interface
                  and not math.isnan(float(r["theory.renormalised.gamma_eff_ratio"]))]
        for simulated, theory, flat in (("binding_energy_ratio", "gamma_eff", True), ("contact_fraction", "contact_fraction", False)):
            errors = [float(r[f"theory.renormalised.{theory}_expected_error"]) / (float(r["delta_gamma"]) if flat else 1)
                      for r in chosen]
            off = [float(r["theory.renormalised." + theory + "_ratio" * flat]) - float(r[simulated]) for r in chosen]
            text.append(f"{sum(abs(d) <= e for d, e in zip(off, errors))}, {statistics.median(errors):.3f}, "
                        f"{max(off, key=abs):.3f}")
        print(f"| {of} | {interface} | {len(chosen)} | {text[0]} | {text[1]} |")


def write_rows(rows: list[dict], file: pathlib.Path) -> None:
    with open(file, "w", newline="") as out:
        writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: v if isinstance(v, str) else f"{v:.6g}" for k, v in row.items()} for row in rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="*", metavar="SET", help=f"of {', '.join(SETS)}")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/parameters"))
    parser.add_argument("--draw", type=int, metavar="N", help="N scenes drawn at random, in place of the sets")
    parser.add_argument("--from", dest="from_seed", type=int, default=33, metavar="SEED", help="of the random draw")
    parser.add_argument("--covered", type=pathlib.Path, metavar="CSV", help="only say how many states of a drawn.csv are within")
    options = parser.parse_args()
    if unknown := [s for s in options.sets if s not in SETS]:
        parser.error(f"no set {', '.join(unknown)}: choose from {', '.join(SETS)}")
    if options.covered:
        with open(options.covered, newline="") as file:
            covered(list(csv.DictReader(file)))
        return
    options.out.mkdir(parents=True, exist_ok=True)
    if options.draw:
        compare_drawn(options)
        return
    found = []
    print("| set | rms, Å | rms slope | surfaces | simulated | renormalised | difference (worst surface) | frictionless | wall "
          "| paper's theory, difference | contact, simulated | renormalised |\n|" + "---|" * 12)
    for name in options.sets or SETS:
        for rms in SETS[name][1]:
            of = {interface: [state(name, SETS[name][0], interface, rms, seed, options.out) for seed in SURFACES.get(name, (1, 2, 3))]
                  for interface in interfaces(name)}
            found += [row for rows in of.values() for row in rows]
            mean = {c: statistics.fmean(r[c] for r in of["friction"]) for c in of["friction"][0] if c not in ("set", "interface")}
            off = {i: [r["theory.renormalised.gamma_eff_ratio"] - r["binding_energy_ratio"] for r in rows] for i, rows in of.items()}
            differences = " | ".join(f"{statistics.fmean(off[i]):.3f} ({max(off[i], key=abs):.3f})" if i in off else ""
                                     for i in INTERFACES)
            print(f"| {name} | {rms:g} | {mean['rms_slope']:.2f} | {len(off['friction'])} | {mean['binding_energy_ratio']:.3f} "
                  f"| {mean['theory.renormalised.gamma_eff_ratio']:.3f} | {differences} "
                  f"| {mean['theory.persson.gamma_eff_ratio'] - mean['binding_energy_ratio']:.3f} | {mean['contact_fraction']:.3f} "
                  f"| {mean['theory.renormalised.contact_fraction']:.3f} |", flush=True)
    write_rows(found, options.out / "parameters.csv")


if __name__ == "__main__":
    main()
