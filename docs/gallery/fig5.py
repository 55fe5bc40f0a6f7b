# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Fig. 5 of the paper with γ by JKR from the force and from the energy at zero load: python3 docs/gallery/fig5.py

Reads docs/data/fig5.csv (5 m/s) and fig5-equilibrium.csv (scenes/paper/fig5-equilibrium.toml), writes fig5-gamma-force.svg beside
itself and the table docs/data/tables/fig5-gamma-force.csv of docs/reports/paper.md. What a Maugis-Dugdale
sphere with the renormalised law has is integrated here.
Needs numpy and matplotlib (Debian: python3-numpy python3-matplotlib)."""
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

GALLERY = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(GALLERY.parents[1] / "python"))
from asperity.plots.style import RC  # noqa: E402
from asperity.units import GIGAPASCAL  # noqa: E402

R, E = 4410.0, 77.2 * GIGAPASCAL / (1 - 0.42**2)
K = 4 * E / 3


def binding_energy(w, stress):
    """Work to part a Maugis-Dugdale sphere from zero load. In contact along Maugis' curve (python/asperity/theories/sphere.py); before it the
    attraction acts on a disc of the radius c, whose edge is at the opening w/stress (no images)."""
    reach, softening = w / stress, 2 * stress / E * (1 - 2 / math.pi)
    c = np.linspace(0, R * (-softening + math.sqrt(softening**2 + 2 * reach / R)), 4001)
    apart = np.trapz(-math.pi * c**2 * stress, reach - c**2 / (2 * R) + 4 * stress * c / (math.pi * E))
    scale = 2 * stress * (R / (math.pi * w * K**2)) ** (1 / 3)  # Maugis' λ
    s = np.exp(np.linspace(12, -8, 200001))
    m, angle = np.sqrt(1 + s * s), np.arctan(s)
    A, B = scale / 2 * (s + (m * m - 2) * angle), 4 * scale**2 / 3 * (s * angle - m + 1)
    a = 2 / (B + np.sqrt(B * B + 4 * A))
    force = (a**3 - scale * a * a * (s + m * m * angle)) * math.pi * w * R
    approach = (a * a - 4 / 3 * scale * a * s) * (math.pi**2 * w**2 * R / K**2) ** (1 / 3)
    end = int(np.argmax(force > 0))
    return apart - np.trapz(force[:end], approach[:end])


def by_jkr(energy):
    return (10 * energy * (K * K * R) ** (1 / 3)) ** 0.6 / (6 * math.pi * R)


def rows(name):
    with open(GALLERY.parent / "data" / name) as file:
        return list(csv.DictReader(file))


points = {}
for row in rows("fig5-equilibrium.csv"):
    points.setdefault(float(row["surface.rms"]), []).append(row)
paths = {float(r["surface.rms"]): r for r in rows("fig5.csv")}
table, cells = [], [["h_rms, Å", "in, averaged, 5 m/s", "out, 5 m/s", "by energy, surface 1", "by energy, six places",
                     "flat, renormalised theory", "Maugis' λ of the smooth sphere",
                     "smooth sphere with the renormalised potential, by force",
                     "smooth sphere with the renormalised potential, by energy"]]
for rms, these in points.items():
    one = these[0]
    flat, w = float(one["delta_gamma"]), float(one["theory.renormalised.gamma_eff"]) / 1e3
    energy = np.array([float(r["jkr.relaxed_ratio"]) for r in these])
    law = by_jkr(binding_energy(w, float(one["theory.renormalised.tension"]) * GIGAPASCAL)) * 1e3 / flat
    table.append((rms, energy[0], energy.mean(), energy.std(ddof=1), float(one["theory.renormalised.gamma_eff_ratio"]),
                  float(one["theory.sphere.renormalised_parameter"]), float(one["theory.sphere.renormalised_ratio"]), law))
    path = paths.get(rms)
    ways = [f"{float(path[k]):.3f}" if path else "" for k in ("jkr.approach_averaged_ratio", "jkr.pull_off_ratio")]
    cells.append([f"{rms:g}", *ways, f"{energy[0]:.3f}", f"{energy.mean():.3f} ± {energy.std(ddof=1):.3f}", f"{table[-1][4]:.3f}",
                  f"{table[-1][5]:.2f}", f"{table[-1][6]:.3f}", f"{law:.3f}"])
with open(GALLERY.parent / "data/tables/fig5-gamma-force.csv", "w", newline="") as file:
    csv.writer(file, lineterminator="\n").writerows(cells)

matplotlib.rcParams.update(RC)
figure, axis = plt.subplots(figsize=(5.6, 4), constrained_layout=True)
rms, _, mean, spread, gamma, _, force, law = map(np.array, zip(*table))
axis.errorbar(rms, mean, spread, fmt="^", ms=5, color="#009e73", capsize=2, label="sphere, energy at zero load, six places")
x = sorted(paths)
axis.plot(x, [float(paths[k]["jkr.approach_averaged_ratio"]) for k in x], "o", ms=4.5, color="#0072b2", label="in, 5 m/s, averaged")
axis.plot(x, [float(paths[k]["jkr.pull_off_ratio"]) for k in x], "s", ms=4.5, color="#d55e00", markerfacecolor="none", label="out, 5 m/s")
axis.plot(rms, law, "--", color="#009e73", lw=1.1, label="Maugis-Dugdale, renormalised law, energy")
axis.plot(rms, force, "--", color="#d55e00", lw=1.1, label="the same, pull-off force")
axis.plot(rms, gamma, "-", color="#cc79a7", lw=1.2, label="renormalised theory, flat")
axis.plot(rms, [float(t[0]["theory.persson.gamma_eff_ratio"]) for t in points.values()], ":", color="0.3", label="paper's theory, flat")
axis.set(xlabel="rms roughness, Å", ylabel="$γ$ / Δγ by JKR", xlim=(-0.2, 9.3), ylim=(-0.02, 1.12))
axis.legend(fontsize=7.5)
figure.savefig(GALLERY / "fig5-gamma-force.svg", metadata={"Date": None})
