#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Runs without time as a user meets them: stopped and taken up again they end the same, and their
# files say what there is.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

export OMP_NUM_THREADS=1 # small boxes: a second thread has nothing to win

# number FILE KEY: the first number behind this key of a result.
number() { sed -n "s/.*\"$2\": \([-0-9.e+]*\),\?$/\1/p" "$1/result.json" | head -n 1; }
# objects DIRECTORY: the names in its run.h5, one a line.
objects() {
    "${ASPERITY_PYTHON:-/usr/bin/python3}" -c 'import h5py, sys; h5py.File(sys.argv[1]).visit(print)' "$1/run.h5"
}
# near A B TOLERANCE TEXT
near() {
    awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; exit !(a != "" && b != "" && d * d <= t * t) }' ||
        fail "$4: $1, $2"
}

cat >path.toml <<'EOF'
[surface]
sites = 24
rms = 0.8
[block]
thickness = 90
[drive]
mode = "quasistatic"
[output]
fields = ["zero-load", "pull-off", "every:40"]
EOF
expect 0 run path.toml --progress off --out whole
says "energy gained + energy dissipated"
# The balance of the branches: approach + lost = state = pull-off - lost, to the tolerance on the way.
state=$(number whole binding_energy)
awk -v s="$state" -v a="$(sed -n '/"work_of_drive"/,/}/s/.*"approach": \([0-9.]*\),*/\1/p' whole/result.json)" \
    -v l="$(sed -n '/"lost"/,/"pull_off"/s/.*"approach": \([0-9.]*\),*/\1/p' whole/result.json)" \
    'BEGIN { d = a + l - s; exit !(l > 1 && d * d < 0.1 * 0.1) }' || fail "the approach's balance: $out"
for object in fields/zero-load fields/pull-off fields/step-40 series/dissipated; do
    objects whole | grep -qx "$object" || fail "no $object"
done
! objects whole | grep -qx series/time || fail "a time without time"

# What was found, without what the run took: the same bits print as the same digits.
found() {
    grep -E '"(approach|pull_off|binding_energy|mean_height|residual|work|events|energy|force|iterations|steps)": [-0-9]' "$1/result.json"
}
# same A B: two runs found the same.
same() {
    [ -n "$(found "$1")" ] && [ "$(found "$1")" = "$(found "$2")" ] ||
        fail "$1 and $2 differ: $(diff <(found "$1") <(found "$2"))"
}
# A wall limit ends it at a point, wherever it is then; a number of points at that point.
expect 75 run path.toml --progress off --out parts --wall-limit 0.05s
grep -q '"stopped": "wall_limit"' parts/result.json || fail "run.stopped is not wall_limit"
expect 0 run path.toml --progress off --out parts --resume auto --set drive.max_steps=37
expect 0 run path.toml --progress off --out parts --resume auto
same whole parts

# Two cycles: maps of both states at zero load; each branch's loss is of the last one, the energy of all.
expect 0 run path.toml --progress off --out cycles --set 'drive.path=["approach", "pull-off", "approach", "pull-off"]'
for object in fields/zero-load fields/zero-load-2; do
    objects cycles | grep -qx "$object" || fail "no $object after two cycles"
done
expect 0 run path.toml --progress off --out cycles-in-parts --set 'drive.path=["approach", "pull-off", "approach", "pull-off"]' drive.max_steps=150
expect 0 run path.toml --progress off --out cycles-in-parts --resume auto --set 'drive.path=["approach", "pull-off", "approach", "pull-off"]'
same cycles cycles-in-parts
expect 2 run path.toml --progress off --set 'output.fields=["every:10", "every:7"]'
says "twice"

# Over a wall no relaxation is given up by a force that is not summed on the way (763 points were then needed).
sed -e '/sites = /s/24/64/' -e '/rms = /s/0.8/2/' -e 's/thickness = 90/thickness = 64/' -e '/^\[output/,$d' path.toml >soft-wall.toml
expect 0 run soft-wall.toml --progress off --out soft-wall --set drive.hold=mean-height drive.tolerance=1e-4 interface.kind=wall \
    'interface.adhesion="50 meV/Å^2"' 'interface.range="1 Å"'
steps=$(number soft-wall steps)
[ "${steps:-1000}" -lt 500 ] || fail "a path over a wall takes $steps points"

# The same solids at a held mean height: no fall as a whole, and the two works are the state's energy.
held=(--set drive.hold=mean-height)
expect 0 run path.toml --progress off --out held "${held[@]}"
near "$state" "$(number held binding_energy)" 0.1 "the state after a held mean height"
for key in approach pull_off; do
    near "$state" "$(sed -n "/\"work_of_adhesion\"/,/}/s/.*\"$key\": \([0-9.]*\),*/\1/p" held/result.json)" 0.5 "held, $key"
done
expect 75 run path.toml --progress off --out held-parts --wall-limit 0.05s "${held[@]}"
cp held-parts/result.json before.json
expect 2 run path.toml --progress off --out held-parts --resume auto
says "differs from it in drive.hold"
cmp -s before.json held-parts/result.json || fail "a refused resume changed result.json"
expect 0 run path.toml --progress off --out held-parts --resume auto "${held[@]}"
same held held-parts
expect 0 check path.toml "${held[@]}" 'drive.path=["zero-load"]' 'output.fields=[]'
says "drive.hold has no effect"

# Over a wall: the balance, and the same when stopped and resumed.
wall=(--set interface.kind=wall interface.adhesion=60 'output.fields=["zero-load"]')
expect 0 run path.toml --progress off --out wall "${wall[@]}"
says "energy gained + energy dissipated"
expect 75 run path.toml --progress off --out wall-parts --wall-limit 0.02s "${wall[@]}"
expect 0 run path.toml --progress off --out wall-parts --resume auto "${wall[@]}"
same wall wall-parts

# One relaxation, stopped inside.
zero=(--set drive.path=zero-load 'output.fields=["zero-load"]' surface.sites=64 drive.tolerance=1e-6)
expect 0 run path.toml --progress off --out zero "${zero[@]}"
expect 75 run path.toml --progress off --out zero-parts --wall-limit 0.001s "${zero[@]}"
expect 0 run path.toml --progress off --out zero-parts --resume auto "${zero[@]}"
near "$(number zero binding_energy)" "$(number zero-parts binding_energy)" 1e-6 "zero load"

expect 0 check path.toml --set 'output.fields=[]' 'drive.path=["zero-load","pull-off"]' drive.load=100
says "carries drive.load"
finish
