#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Measures what numerics.accuracy goes by, and prints the rows of engine/scene/accuracy_table.hpp: for each
# setting the largest own error in the family, of the state (gamma, contact) and of all (works and
# force too), and the largest share of the time of the scene as it is. Half an hour, most of it the lattice
# of 128 x 128 sites; started again, it goes on.
#
#     scenes/cost/calibrate.sh results/calibration
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/calibration}
member() { # NAME KNOBS OVERRIDES...
    local name=$1 knobs=$2
    shift 2
    "$root/asperity" cost "$root/scenes/cost/calibration.toml" --knobs "$knobs" \
        --out "$place/$name" --progress off --set "$@" >"$place/$name.txt"
}
mkdir -p "$place"
for rms in 0.5 1 2; do
    member "rms-$rms" timestep,layers,precision surface.rms=$rms
done
member "wide" timestep,layers,precision surface.rms=1.5 surface.sites=48 block.thickness=48 surface.seed=2
# Half in contact, a quarter of the adhesion left.
sparse="surface.rms=3 surface.sites=128 block.thickness=128 drive.velocity=5 drive.timestep=40"
# shellcheck disable=SC2086 # words
member "sparse" layers $sparse
# shellcheck disable=SC2086
member "sparse-state" layers $sparse drive.path=zero-load

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
