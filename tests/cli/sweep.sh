#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Sweeps of simulations: refused whole, resumed, side by side, and failing in part.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

printf '[surface]\nsites = 24\n[block]\nmodel = "spectral"\n[drive]\npath = ["zero-load"]\n' >state.toml
printf '[sweep]\nsurface.rms = [0.2, 0.4]\nsurface.seed = [1, 2]\n' >>state.toml

# What is wrong with one point is said before any has run.
expect 2 sweep state.toml --set surface.rms=0.2,-1 --out bad
says "surface.rms = -1 is out of range"
expect 2 sweep state.toml --set drive.mode=dynamic drive.path=approach drive.timestep=10,500 block.model=lattice --out bad
says "over the stability limit"
expect 2 sweep state.toml --set surface.rms=0.2,0.02nm,0.2 --out bad
says "two points are the same"
expect 2 sweep state.toml --set surface.rms=1 surface.seed=1 --out bad
says "nothing to sweep"
expect 2 sweep state.toml --jobs 0
expect 2 sweep state.toml --wall-limit soon
expect 2 sweep state.toml state.toml
says "has the name of another scene"
out=$(OMPI_COMM_WORLD_SIZE=1 "$asperity" sweep state.toml --out bad 2>&1) && fail "under mpirun: $out"
only_files ./state.toml

# The same table whatever --jobs; wall times aside.
numbers() { # DIRECTORY: the lines of the table without its times
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /wall_seconds/) drop = i }
             { for (i = 1; i <= NF; ++i) if (i != drop) printf "%s,", $i; print "" }' "$1/sweep.csv"
}
expect 0 sweep state.toml --out one --progress off
says "4 of 4 points are done"
expect 0 sweep state.toml --out two --progress off --jobs 2
[ "$(numbers one)" = "$(numbers two)" ] || fail "--jobs changes the table: $(numbers one) $(numbers two)"
# Points side by side share the processors, unless somebody has chosen.
threads() { grep -m1 '"threads"' "$1/rms=0.2,seed=1/result.json" | tr -dc 0-9; }
half=$(($(env -u OMP_NUM_THREADS nproc) / 2)) # nproc heeds it too
(unset OMP_NUM_THREADS && "$asperity" sweep state.toml --out shared --progress off --jobs 2 >log 2>&1) || fail "$(cat log)"
[ "$(threads shared)" = $((half > 1 ? half : 1)) ] || fail "$(threads shared) threads for one of two points"
(export OMP_NUM_THREADS=3 && "$asperity" sweep state.toml --out chosen --progress off --jobs 2 >log 2>&1) || fail "$(cat log)"
[ "$(threads chosen)" = 3 ] || fail "$(threads chosen) threads instead of the three chosen"
for file in sweep.csv sweep-mean.csv sweep.json sweep.h5 gamma.svg area.svg; do
    [ -s "one/$file" ] || fail "one/$file was not written"
done
[ "$(wc -l <one/sweep.csv)" -eq 5 ] && [ "$(wc -l <one/sweep-mean.csv)" -eq 3 ] || fail "lines of the tables"
# A point is what asperity run makes of it.
expect 0 run state.toml --set surface.rms=0.4 surface.seed=2 --out alone --progress off
[ "$(grep -m1 binding_energy alone/result.json)" = "$(grep -m1 binding_energy one/rms=0.4,seed=2/result.json)" ] ||
    fail "a point differs from its run"

# It goes on: points that are there stay, new ones come, another scene is not mixed in.
before=$(stat -c %Y%i one/rms=0.2,seed=1/result.json)
rm -r one/rms=0.4,seed=1
expect 0 sweep state.toml --set surface.rms=0.2,0.4,0.6 --out one --progress off
says "3 are there already"
says "6 of 6 points are done"
[ "$before" = "$(stat -c %Y%i one/rms=0.2,seed=1/result.json)" ] || fail "a finished point was run again"
expect 2 sweep state.toml --set block.thickness=12 --out one
says "holds the result of another scene"
expect 0 sweep state.toml --theory-only --set surface.rms=0.2:0.6:0.2 --out theory
says "3 points in" # seeds mean nothing to the theory of a target spectrum
expect 0 sweep state.toml --theory-only --set theory.spectrum=realised --out realised
says "2 adhesive"

# Several scenes, one set of plots.
sed 's/0.2, 0.4/0.3, 0.5/' state.toml >other.toml
expect 0 sweep state.toml other.toml --out both --progress off --jobs 2
[ -s both/state/sweep.csv ] && [ -s both/other/sweep.csv ] && [ -s both/gamma.svg ] || fail "both"
grep -q 'other: state at zero load' both/gamma.svg || fail "the second scene is not in the plot"

# A path that is killed, and one that is asked to stop: both go on, to the same table.
printf '[surface]\nsites = 32\nrms = 0.5\n[block]\nthickness = 16\n[drive]\ntimestep = 20\nmax_steps = 6000\n' >path.toml
printf '[output]\ncheckpoint = 0.2\n' >>path.toml
begun() { # waits until both points have a checkpoint
    for _ in $(seq 600); do
        [ -s "$1/velocity=30/checkpoint.h5" ] && [ -s "$1/velocity=40/checkpoint.h5" ] && return
        sleep 0.05
    done
    fail "no checkpoint in $1"
}
expect 0 sweep path.toml --set drive.velocity=30,40 --jobs 2 --progress off --out whole
for signal in INT KILL; do
    "$asperity" sweep path.toml --set drive.velocity=30,40 --jobs 2 --progress off --out "cut $signal" >log 2>&1 &
    job=$!
    begun "cut $signal"
    kill -s $signal $job
    wait $job 2>/dev/null
    code=$?
    [ $signal = KILL ] || [ $code -eq 75 ] || fail "after $signal: exit code $code"
    for _ in $(seq 100); do # those that the sweep left behind stop too
        pgrep -f -- "--out cut $signal/" >/dev/null || break
        sleep 0.1
    done
    expect 0 sweep path.toml --set drive.velocity=30,40 --jobs 2 --progress off --out "cut $signal"
    [ "$(numbers whole)" = "$(numbers "cut $signal")" ] || fail "another table after $signal"
done

# One that fails is told, the others go on, and the code is its own.
expect 3 sweep path.toml --set drive.velocity=30,2000 drive.timestep=70 drive.max_steps=3000 --progress off --out part
says "velocity=2000"
says "1 of 2 points are done"
grep -q '"status": "failed"' part/sweep.json || fail "sweep.json does not tell the failure"
expect 3 sweep path.toml --set drive.velocity=30,2000 drive.timestep=70 drive.max_steps=3000 --progress off --out part
says "1 failed before"

mpirun=$(command -v mpirun)
if [ -n "$mpirun" ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    expect 0 sweep path.toml --set drive.velocity=30,40 drive.max_steps=200 --progress off --out ranks \
        --launch "$mpirun --oversubscribe -n 2"
    grep -q '"ranks": 2' ranks/velocity=30/result.json || fail "--launch gave no ranks"
fi
finish
