# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""States at zero load beside the paper's theory and the renormalised theory: python3 docs/gallery/renormalised.py

Reads docs/data/renormalised.csv (512 sites, the paper's roughnesses), fig2-quasistatic.csv and parameters.csv
(scenes/validation/parameters.py); writes theory-renormalised.svg, fig2-paths.svg and theory-sets.svg beside itself.
Needs matplotlib (Debian: python3-matplotlib)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

GALLERY = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(GALLERY.parents[1] / "python"))
from asperity.plots.style import RC  # noqa: E402

matplotlib.rcParams.update(RC)
SIMULATED, PAPER, RENORMALISED = "#009e73", "#4d4d4d", "#cc79a7"


def rows(name):
    with open(GALLERY.parent / "data" / name) as file:
        return list(csv.DictReader(file))


def means(table, keys):
    """{values of the keys: {column: mean, column + "±": standard deviation}} over what else differs."""
    groups = {}
    for row in table:
        groups.setdefault(tuple(row[k] for k in keys), []).append(row)
    found = {}
    for group, members in groups.items():
        found[group] = {}
        for column in ("binding_energy_ratio", "contact_fraction", "theory.persson.gamma_eff_ratio", "theory.persson.contact_fraction",
                       "theory.renormalised.gamma_eff_ratio", "theory.renormalised.contact_fraction"):
            values = np.array([float(m[column] or "nan") for m in members])
            found[group][column], found[group][column + "±"] = values.mean(), values.std(ddof=1)
    return found


def save(figure, name):
    figure.savefig(GALLERY / name, metadata={"Date": None})


table = means(rows("renormalised.csv"), ["surface.rms"])
rms = np.array([float(k[0]) for k in table])


def column(name):
    return np.array([m[name] for m in table.values()])


figure, axes = plt.subplots(1, 2, figsize=(8, 3.4), constrained_layout=True)
for axis, simulated, theory, label in (
        (axes[0], "binding_energy_ratio", "gamma_eff_ratio", "$γ_{eff}$ / Δγ"),
        (axes[1], "contact_fraction", "contact_fraction", "contact fraction")):
    axis.errorbar(rms, column(simulated), column(simulated + "±"), fmt="^", ms=5, color=SIMULATED, capsize=2,
                  label="state at zero load, three surfaces")
    axis.plot(rms, column("theory.renormalised." + theory), "--", color=RENORMALISED, label="renormalised theory")
    axis.plot(rms, column("theory.persson." + theory), ":", color=PAPER, label="paper's theory")
    axis.set(xlabel="rms roughness, Å", ylabel=label, xlim=(0, 12.5), ylim=(-0.02, 1.03))
axes[0].legend()
save(figure, "theory-renormalised.svg")

paths = {float(r["surface.rms"]): r for r in rows("fig2-quasistatic.csv") if float(r["surface.rms"]) <= 12}
figure, axis = plt.subplots(figsize=(4.6, 3.4), constrained_layout=True)
for segment, marker, colour, label in (("pull_off", "s", "#d55e00", "quasi-static pull-off, surface 1"),
                                       ("approach", "o", "#0072b2", "quasi-static approach, surface 1")):
    axis.plot(list(paths), [abs(float(r[f"work_of_interface.{segment}_ratio"])) for r in paths.values()], marker, color=colour,
              markerfacecolor="none" if marker == "s" else colour, label=label)
axis.errorbar(rms, column("binding_energy_ratio"), column("binding_energy_ratio±"), fmt="^", ms=5, color=SIMULATED, capsize=2,
              label="state at zero load, three surfaces")
axis.plot(rms, column("theory.renormalised.gamma_eff_ratio"), "--", color=RENORMALISED, label="renormalised theory")
axis.plot(rms, column("theory.persson.gamma_eff_ratio"), ":", color=PAPER, label="paper's theory")
axis.set(xlabel="rms roughness, Å", ylabel="work or $γ_{eff}$ / Δγ", xlim=(0, 12.5), ylim=(-0.02, 1.2))
axis.legend()
save(figure, "fig2-paths.svg")

sets = means(rows("parameters.csv"), ["set", "interface", "rms"])
figure, axes = plt.subplots(1, 2, figsize=(8, 3.8), constrained_layout=True, sharex=True)


def draw(points, marker, colour, label):
    x = np.array([m["binding_energy_ratio"] for m in points])
    for axis, theory in ((axes[0], "theory.renormalised.gamma_eff_ratio"), (axes[1], "theory.persson.gamma_eff_ratio")):
        y = np.array([m[theory] for m in points])
        axis.plot(x, y - x, marker, ms=4.5, color=colour, markerfacecolor="none", label=f"{label} ({len(x)})")


for interface, marker, colour in (("friction", "o", "#0072b2"), ("frictionless", "s", "#e69f00"), ("wall", "D", "#009e73")):
    draw([m for k, m in sets.items() if k[1] == interface], marker, colour,
         {"friction": "sets, atoms", "frictionless": "sets, frictionless", "wall": "sets, wall"}[interface])
for axis, name in zip(axes, ("renormalised theory", "paper's theory")):
    axis.axhspan(-0.03, 0.03, color="0.9", zorder=0)
    axis.axhline(0, color="0.5", lw=0.6)
    axis.set(xlabel="simulated $γ$ / Δγ, mean over the surfaces", ylabel=f"{name} less simulated")
axes[0].set_ylim(-0.1, 0.1)
axes[1].legend(fontsize=8)
save(figure, "theory-sets.svg")
