#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# What accuracy costs: refused, run, killed, gone on with.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

printf '[surface]\nsites = 16\nrms = 0.3\n[block]\nthickness = 8\n' >tiny.toml
printf '[drive]\nvelocity = 60\ntimestep = 20\n' >>tiny.toml

expect 2 cost tiny.toml --knobs layer --out bad
says "did you mean layers?"
expect 2 cost tiny.toml --set drive.temperature=300 --out bad
says "those of their noise"
expect 2 cost tiny.toml --jobs 0 --out bad
out=$(OMPI_COMM_WORLD_SIZE=1 "$asperity" cost tiny.toml --out bad 2>&1) && fail "under mpirun: $out"
only_files ./tiny.toml

expect 0 cost tiny.toml --knobs timestep,layers,precision --out whole --progress off --jobs 2
says "Cheapest for the whole path"
says "velocity Verlet"
for file in cost.csv cost.json cost-state.svg cost-path.svg; do
    [ -s "whole/$file" ] || fail "whole/$file was not written"
done
grep -q processor_seconds whole/scene/result.json || fail "no processor time in result.json"

# Killed after a while, it goes on with what is there, and nothing is run twice.
"$asperity" cost tiny.toml --knobs timestep,layers,precision --out cut --progress off >log 2>&1 &
job=$!
for _ in $(seq 600); do
    [ -s cut/scene/result.json ] && break
    sleep 0.05
done
kill -s KILL $job
wait $job 2>/dev/null
before=$(stat -c %Y%i cut/scene/result.json)
expect 0 cost tiny.toml --knobs timestep,layers,precision --out cut --progress off --jobs 2
says "are there already"
[ "$before" = "$(stat -c %Y%i cut/scene/result.json)" ] || fail "a finished run was run again"
numbers() { # without the times and what follows from them: the scene's knobs alone
    grep -v '^"combination"' "$1/cost.csv" | cut -d, -f1-3,7-11
}
[ "$(numbers whole | sed 's/"[^"]*"//g')" = "$(numbers cut | sed 's/"[^"]*"//g')" ] ||
    fail "another table after a kill"
finish
