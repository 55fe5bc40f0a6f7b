#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# All states of a contact as a user meets them: in result.json and in the summary, the same after
# stops, and told apart by a load: under less than the barrier a relaxation stays near the first,
# under more it ends in the second.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

export OMP_NUM_THREADS=1 # a small box: a second thread has nothing to win

# value DIR EXPRESSION: of its result, r.
value() { python3 -c "import json; r = json.load(open('$1/result.json')); print($2)"; }
# holds CONDITION: in Python.
holds() { python3 -c "import sys; sys.exit(not ($1))" || fail "not so: $1"; }

cat >hill.toml <<'EOF'
[surface]
sites = 64
rms = 4
seed = 2
[block]
thickness = 64
[interface]
frictionless = true
[drive]
path = ["zero-load"]
states = "all"
[theory]
renormalised = false
EOF
expect 0 run hill.toml --progress off --out whole
says "2 stable states"
says "May be missed"
holds "$(value whole 'len(r["states"]["all"])') == 2"
holds "$(value whole 'r["binding_energy"] == r["states"]["first"]["binding_energy"]')"
holds "$(value whole 'r["states"]["deepest"]["binding_energy"] > 2 * r["binding_energy"]')"
holds "$(value whole 'r["states"]["search"]["ended"] == "no area left to attract"')"
barrier=$(value whole 'r["states"]["first"]["barrier"]')
first=$(value whole 'r["states"]["all"][0]["mean_height"]')
second=$(value whole 'r["states"]["all"][1]["mean_height"]')

# Stopped wherever it is after some time, again and again. (A first relaxation that was stopped ends
# at another place within the tolerance; the search for states resumes to the bit.)
expect 75 run hill.toml --progress off --out parts --wall-limit 0.01s
for ((i = 0; i < 8; i++)); do
    "$asperity" run hill.toml --progress off --out parts --resume auto --wall-limit 0.08s >out.txt 2>&1
    code=$?
    [ $code -eq 75 ] || break
done
[ $code -ne 75 ] || expect 0 run hill.toml --progress off --out parts --resume auto
for state in 0 1; do
    for key in binding_energy mean_height contact_fraction; do
        holds "abs($(value whole "r['states']['all'][$state]['$key']") - $(value parts "r['states']['all'][$state]['$key']")) < 1e-3"
    done
done
holds "$(value whole 'r["states"]["search"]["points"]') == $(value parts 'r["states"]["search"]["points"]')"

# The states stay known on the path that follows, also over a stop.
expect 0 run hill.toml --progress off --out then-apart --set drive.mode=quasistatic 'drive.path=["zero-load", "pull-off"]' drive.max_steps=3
expect 0 run hill.toml --progress off --out then-apart --resume auto --set drive.mode=quasistatic 'drive.path=["zero-load", "pull-off"]'
holds "$(value then-apart 'len(r["states"]["all"])') == 2"
holds "abs($(value then-apart 'r["states"]["deepest"]["binding_energy"]') - $(value whole 'r["states"]["deepest"]["binding_energy"]')) < 1e-3"

# A checkpoint is written while a relaxation goes on, and survives a kill.
"$asperity" run hill.toml --progress off --out killed --set surface.sites=256 block.thickness=256 drive.states=first \
    drive.tolerance=1e-13 output.checkpoint=0.1s >out.txt 2>&1 &
for ((i = 0; i < 100; i++)); do
    [ ! -e killed/checkpoint.h5 ] || break
    sleep 0.1
done
kill -9 $!
wait $! 2>/dev/null
[ -e killed/checkpoint.h5 ] || fail "no checkpoint during a relaxation: $(cat out.txt)"

# A load in MPa.
for load in 0.8 1.2; do
    expect 0 run hill.toml --progress off --out "load-$load" --set drive.states=first \
        "drive.load=$(python3 -c "print($load * $barrier)")"
done
half=$(python3 -c "print(0.5 * ($first + $second))")
holds "$(value load-0.8 'r["zero_load"]["mean_height"]') > $half"
holds "$(value load-1.2 'r["zero_load"]["mean_height"]') < $half"

# JKR's γ from the binding energy is that of a state without load.
sphere=(--set surface.kind=flat surface.radius=500 drive.states=first)
expect 0 run hill.toml --progress off --out sphere "${sphere[@]}"
expect 0 run hill.toml --progress off --out sphere-load "${sphere[@]}" drive.load=20
holds "$(value sphere '"zero_load" in r["jkr"]')"
holds "$(value sphere-load '"zero_load" not in r.get("jkr", {})')"

expect 0 check hill.toml --set 'drive.path=["approach"]' drive.mode=quasistatic
says "drive.states"
finish
