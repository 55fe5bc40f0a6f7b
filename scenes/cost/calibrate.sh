#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Measures what numerics.accuracy goes by, and prints the rows of engine/scene/accuracy_table.hpp: for each
# setting the largest own error in the family, of the state (gamma, contact) and of all (works and
# force too), and the largest share of the time of the scene as it is. A quarter of an hour or less; started
# again, it goes on.
#
#     scenes/cost/calibrate.sh results/calibration
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/calibration}
member() { # NAME OVERRIDES...
    local name=$1
    shift
    "$root/asperity" cost "$root/scenes/cost/calibration.toml" --knobs timestep,layers,precision \
        --out "$place/$name" --progress off --set "$@" >"$place/$name.txt"
}
mkdir -p "$place"
for rms in 0.5 1 2; do
    member "rms-$rms" surface.rms=$rms
done
member "wide" surface.rms=1.5 surface.sites=48 block.thickness=48 surface.seed=2

cat "$place"/*/cost.csv | python3 -c '
import csv, sys
heads = None
worst = {}
for row in csv.reader(sys.stdin):
    if row[0] == "knob":
        heads = row
        continue
    r = dict(zip(heads, row))
    if r["knob"] not in ("timestep", "layers", "precision"):
        continue
    if not r["own_gamma"] and r["value"] != "lattice": # what the others are measured against
        continue
    size = lambda *names: max(abs(float(r["own_" + n] or 0)) for n in names)
    numbers = (size("gamma", "contact"), size("gamma", "contact", "approach", "pull-off", "force"),
               float(r["ratio"]))
    key = (r["knob"], r["value"])
    worst[key] = tuple(map(max, numbers, worst.get(key, (0, 0, 0))))
for (knob, value), (state, path, time) in worst.items():
    print("    {Dial::%s, %s, %.2g, %.2g, %.2f}," % (
        knob, value.split()[0] if value[0].isdigit() else "0", state, path, time))
'
