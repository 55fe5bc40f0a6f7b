#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Scenes that are right: the ones that come with Asperity pass the check, and a few steps of a small one
# leave a result.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

while IFS= read -r scene; do
    expect 0 check "$scene"
    says "nothing wrong"
done < <(find "$source/scenes" -name '*.toml')
only_files ""

printf '[surface]\nsites = 32\nrms = "0.5 Å"\n[drive]\nmax_steps = 20\n[output]\nseries = 10\n' >small.toml
expect 0 run small.toml --progress off
for file in result.json run.h5; do
    [ -s "results/small/$file" ] || fail "results/small/$file was not written"
done
grep -q '"stopped": "max_steps"' results/small/result.json || fail "run.stopped is not max_steps"
grep -q '"skipping of far sites"' results/small/result.json || fail "run.effects is missing"
grep -q '"sites": 32' results/small/result.json || fail "the scene is not in result.json"
grep -q '"timestep": 10.0' results/small/result.json || fail "defaults are not filled in"

# Never over an old result.
before=$(cat results/small/result.json)
expect 0 run small.toml --progress off
says "results/small-2"
[ -s results/small-2/result.json ] || fail "the second run did not go to small-2"
[ "$before" = "$(cat results/small/result.json)" ] || fail "the first result was touched"
expect 2 run small.toml --out results/small
says "already holds a result"
# Only one rank looks for the directory; all end with its code, and at once.
if [ ${#mpirun[@]} -gt 0 ]; then
    out=$(timeout 60 "${mpirun[@]}" -n 2 "$asperity" run small.toml --out results/small 2>&1)
    code=$?
    [ $code -eq 2 ] || fail "mpirun with an old result: exit code $code: $out"
    [ "$(grep -c 'already holds a result' <<<"$out")" = 1 ] || fail "not one complaint: $out"
    # a file that cannot be written ends all with 4
    touch plain-file
    out=$(timeout 60 "${mpirun[@]}" -n 2 "$asperity" run small.toml --out plain-file/x 2>&1)
    code=$?
    [ $code -eq 4 ] || fail "mpirun without a place to write: exit code $code: $out"
fi
expect 0 run small.toml --progress off --out "else where/deep" --set drive.max_steps=3
[ -s "else where/deep/result.json" ] || fail "--out was not followed"

# A surface goes out and comes in again.
expect 0 surface small.toml --out surface
says "rms height"
printf '[surface]\nkind = "file"\nfile = "surface/heights.h5"\nsites = 32\n[drive]\nmax_steps = 3\n' >map.toml
expect 0 check map.toml
expect 0 surface map.toml --out again
for key in rms min max; do
    a=$(grep -m1 "\"$key\": [-0-9.e]*,\?$" <(sed -n '/^  "surface"/,/}/p' surface/result.json))
    b=$(grep -m1 "\"$key\": [-0-9.e]*,\?$" <(sed -n '/^  "surface"/,/}/p' again/result.json))
    awk -v a="${a#*: }" -v b="${b#*: }" \
        'BEGIN { d = a - b; exit !(a != "" && b != "" && d * d <= 1e-18 * a * a) }' ||
        fail "$key changed on the way: $a, $b"
done
finish
