#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The commands theory and sweep, and the theory of a run.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# number FILE KEY: the value of the last line "KEY": value that is not of the renormalised theory.
number() { sed -e '/"renormalised": {/,/}/d' "$1" | sed -n "s/^ *\"$2\": \([-0-9.e+]*\),\?$/\1/p" | tail -n 1; }
# near FILE KEY VALUE TOLERANCE
near() {
    local got
    got=$(number "$1" "$2")
    awk -v a="$got" -v b="$3" -v t="$4" 'BEGIN { d = a - b; exit !(a != "" && d <= t && -d <= t) }' ||
        fail "$1: $2 is '$got', not $3"
}

# The table of theory.md, through the command line.
paper() { # RMS GAMMA AREA FULL
    expect 0 theory "$source/scenes/paper/fig2.toml" --set surface.rms="$1" --out "paper $1"
    near "paper $1/result.json" gamma_eff "$2" 0.002
    near "paper $1/result.json" contact_fraction "$3" 0.00002
    near "paper $1/result.json" gamma_full_contact "$4" 0.002
    says "critical rms   6.972"
    [ -s "paper $1/theory.h5" ] || fail "no profile"
}
paper 3 67.469 0.98985 68.120
paper 5 15.159 0.66628 11.353
paper 6.5 0.604 0.24305 -49.960
says "hold together without any load"
grep -q '"energy"\|"binding_energy"\|"steps"' "paper 3/result.json" && fail "numbers that no simulation gave"
expect 2 theory "$source/scenes/paper/fig2.toml" --out "paper 3"
says "already holds a result"

printf '[surface]\nsites = 64\nrms = 12\n' >rough.toml
expect 0 theory rough.toml --set surface.rms=0.5
says "ends at Nyquist"
[ -s results/rough-theory/result.json ] || fail "the default directory was not taken"
expect 0 theory rough.toml --out rough
says "there is no adhesive solution"
near rough/result.json gamma_eff 0 0
near rough/result.json contact_fraction 0 0
expect 0 theory rough.toml --set surface.kind=flat --out flat
near flat/result.json contact_fraction 1 0
expect 0 theory rough.toml --set theory.spectrum=realised --set surface.rms=1 --out realised
says "the surface itself"
expect 0 theory rough.toml --set drive.load=3000 --out pressed
says "the load alone"
expect 0 theory rough.toml --set surface.rms=0 surface.radius=4410 theory.delta_gamma=100 --out sphere
says "JKR pull-off   2078."
says "1.75" # the Tabor number that the paper's formula gives
rm -rf rough flat realised pressed sphere results paper*

expect 2 theory rough.toml --set theory.delta_gamma=-1
says "theory.delta_gamma = -1"
expect 2 theory rough.toml --set theory.spectrum=exact
expect 2 theory rough.toml --set surface.cutoff=1 surface.rolloff=1
says "no roughness"
expect 2 theory gone.toml
expect 4 theory rough.toml --out rough.toml/x
only_files ./rough.toml

expect 2 sweep rough.toml --theory-only --set surface.rms=1:2:-1
says "is a range without values"
expect 2 sweep rough.toml --theory-only --set surface.rms=1,-1 --out s
says "surface.rms = -1 is out of range"
expect 2 sweep rough.toml --theory-only --set surface.rsm=1,2 --out s
says "did you mean surface.rms?"
expect 2 sweep rough.toml --theory-only --set surface.rms=1 --out s
says "nothing to sweep"
only_files ./rough.toml

expect 0 sweep rough.toml --theory-only --set surface.rms=0.5:1.5:0.5 --set drive.load=0,100 --out "a sweep"
says "6 points in"
for file in sweep.csv sweep.json gamma.svg area.svg full-contact.svg; do
    [ -s "a sweep/$file" ] || fail "a sweep/$file was not written"
    says "$file"
done
[ "$(wc -l <"a sweep/sweep.csv")" -eq 7 ] || fail "the table has not one line a point"
[ "$(head -n 1 "a sweep/sweep.csv" | cut -d, -f1-4)" = "surface.rms,drive.load,delta_gamma,gamma_eff" ] ||
    fail "columns: $(head -n 1 "a sweep/sweep.csv")"
[ "$(awk -F, '{ print NF }' "a sweep/sweep.csv" | sort -u | wc -l)" -eq 1 ] || fail "lines of unequal length"
[ "$(grep -c '"gamma_full_contact"' "a sweep/sweep.json")" -eq 6 ] || fail "sweep.json has not six points"
grep -q '"surface.rms": 1.5' "a sweep/sweep.json" || fail "sweep.json does not say its values"
expect 2 sweep rough.toml --theory-only --set surface.rms=1,2 --out "a sweep"
says "already holds a sweep"
expect 0 sweep rough.toml --theory-only --set theory.area_factor=none,gaussian surface.rms=1 --out words
says "no plots"
expect 0 sweep rough.toml --theory-only --set surface.rms=0.2:20:0.2 --out hundred # issue 4: under 10 s
says "100 points in"
awk -v s="$(number hundred/sweep.json wall_seconds)" 'BEGIN { exit !(s != "" && s < 10) }' ||
    echo "slow: 100 points took $(number hundred/sweep.json wall_seconds) s"
expect 0 sweep rough.toml --theory-only --set surface.sites=64
says "sweeping surface.rms from"

# Every run carries the theory of its scene.
printf '[surface]\nsites = 32\nrms = 0.5\n[drive]\nmax_steps = 2\n' >small.toml
expect 0 run small.toml --progress off --out run
expect 0 theory small.toml --out theory
near run/result.json gamma_full_contact "$(number theory/result.json gamma_full_contact)" 1e-9
near run/result.json gamma_eff "$(number theory/result.json gamma_eff)" 1e-9

# Without adhesion there is no θ, and all else of the theory; a sweep runs whether its theory can be computed or not.
cat >wall.toml <<'EOF'
[surface]
sites = 32
rms = 0.5
[block]
thickness = 32
[interface]
kind = "wall"
law = "exponential"
adhesion = 0
[drive]
path = ["zero-load"]
load = 50
EOF
expect 0 theory wall.toml --out wall-theory
grep -q '"contact_fraction"' wall-theory/result.json || fail "no theory of a wall without adhesion"
expect 0 sweep wall.toml --set drive.load=50,100 --out wall-sweep --progress off
expect 0 sweep wall.toml --set surface.rolloff=1 surface.cutoff=1,2 --out ring-sweep --progress off

if [ ${#mpirun[@]} -gt 0 ]; then
    for command in theory surface; do
        out=$(timeout 60 "${mpirun[@]}" -n 2 "$asperity" $command small.toml --out theory 2>&1)
        code=$?
        [ $code -eq 2 ] || fail "mpirun $command with an old result: exit code $code: $out"
        [ "$(grep -c 'already holds a result' <<<"$out")" = 1 ] || fail "not one complaint: $out"
    done
fi
finish
