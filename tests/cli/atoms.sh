#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# A substrate of atoms from a file, as a user meets it: a flat layer written as atoms gives the numbers of the
# flat surface, a run is resumed with the same bits over the same file only, and what does not apply is said.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

export OMP_NUM_THREADS=1

# number DIRECTORY KEY: the first number behind this key of a result.
number() { sed -n "s/.*\"$2\": \([-0-9.e+]*\),\?$/\1/p" "$1/result.json" | head -n 1; }

# 16 x 16 atoms at height 57 Å, from the last to the first, some of them outside of the box.
awk 'BEGIN { print "a flat layer, units = metal\n\n256 atoms\n1 atom types\n10 51.6 xlo xhi\n-5 36.6 ylo yhi\n50 60 zlo zhi\n\nAtoms\n"
    for (n = 255; n >= 0; --n) printf "%d 1 %.17g %.17g 57\n", n + 1, 10 + 2.6 * (n % 16) - (n % 5 ? 0 : 41.6), -5 + 2.6 * int(n / 16) }' >flat.data
expect 2 check "$source/scenes/atoms/stepped.toml" --set surface.file="$PWD/flat.data"
says "convert it first: asperity convert '$PWD/flat.data' flat.h5"
expect 0 convert flat.data flat.h5
says "52 coordinates of atoms lay outside of the box"
printf '[surface]\nkind = "atoms"\nfile = "flat.h5"\nsites = 16\n[drive]\npath = ["zero-load"]\ntolerance = 1e-8\n' >atoms.toml
printf '[surface]\nkind = "flat"\nsites = 16\n[drive]\npath = ["zero-load"]\ntolerance = 1e-8\n' >flat.toml
expect 0 run flat.toml --progress off --out flat
expect 0 run atoms.toml --progress off --out atoms
says "256 atoms"
says "a unit of measure"
says "over one flat layer (98.86)"
for key in binding_energy contact_fraction mean_height; do
    awk -v a="$(number atoms $key)" -v b="$(number flat $key)" \
        'BEGIN { d = a - b; exit !(a != "" && b != "" && d * d <= 1e-16) }' ||
        fail "$key: $(number atoms $key) over atoms, $(number flat $key) over the flat surface"
done
grep -q '"atoms": 256' atoms/result.json || fail "the number of atoms is missing"
grep -q '"note": "the substrate.s atoms stand anywhere' atoms/result.json || fail "theory.note is missing"
! grep -q gamma_eff atoms/result.json || fail "a theory that does not apply"

# The scene that comes with Asperity, in time and without.
ln -s "$source/scenes/atoms/stepped.h5" stepped.h5
"$source/scenes/atoms/stepped.py" >stepped.data
expect 0 convert stepped.data again.h5
cp "$source/scenes/atoms/stepped.toml" .
expect 0 check stepped.toml
says "a unit of measure"
expect 0 plan stepped.toml
says 'the theory is of one layer with heights'
expect 0 surface stepped.toml --out again --set surface.file=again.h5
expect 0 surface stepped.toml --out heights
digest() { grep file_digest "$1/result.json"; }
[ -n "$(digest heights)" ] && [ "$(digest heights)" = "$(digest again)" ] || fail "stepped.h5 is not what stepped.py writes"
says "555"
says "heights of the topmost atoms"
expect 2 theory stepped.toml
says "no theory applies"
expect 2 check stepped.toml --set surface.sites=32
says "the periodic box of the atoms in stepped.h5 is 41.6 x 41.6 Å"
expect 2 check stepped.toml --set interface.tail=true numerics.device=emulated
says "interface.tail"
says "numerics.device"
expect 0 sweep stepped.toml --set drive.load=0,100 drive.path=zero-load --out swept --progress off
[ "$(grep -c '"status": "done"' swept/sweep.json)" = 2 ] || fail "a sweep over atoms: $out"
expect 2 sweep stepped.toml --set drive.load=0,100 --theory-only

# Same bits in parts, and over other atoms not at all.
found() { grep -E '"(approach|pull_off|binding_energy|mean_height|work|force|elastic|kinetic|steps)": [-0-9]' "$1/result.json"; }
fast=(--progress off --set drive.velocity=100 block.layers_per_level=3)
for mode in dynamic quasistatic; do
    expect 0 run stepped.toml --out whole-$mode "${fast[@]}" drive.mode=$mode
    expect 0 run stepped.toml --out parts-$mode "${fast[@]}" drive.mode=$mode drive.max_steps=25
    expect 0 run stepped.toml --out parts-$mode --resume auto "${fast[@]}" drive.mode=$mode
    [ -n "$(found whole-$mode)" ] && [ "$(found whole-$mode)" = "$(found parts-$mode)" ] ||
        fail "$mode: $(diff <(found whole-$mode) <(found parts-$mode))"
done
expect 0 run stepped.toml --out parts "${fast[@]}" drive.mode=dynamic drive.max_steps=25
converted() { # of standard input
    cat >changed.data
    rm -f stepped.h5
    expect 0 convert changed.data stepped.h5
}
converted < <(sed '0,/^3 1 5.5467/s//3 1 5.5468/' stepped.data)
expect 2 run stepped.toml --out parts --resume auto "${fast[@]}" drive.mode=dynamic

# Nor over atoms of other types. Every other atom is of type 2.
typed() { converted < <(awk -v odd="$1" '/^[0-9]+ 1 / && NF == 5 { $2 = $1 % 2 == odd ? 2 : 1 } { sub("^1 atom types", "2 atom types"); print }' stepped.data); }
typed 1
expect 2 check stepped.toml
says "are of 2 types: 2 (278 atoms), 1 (277)"
says "interface.pairs"
expect 2 check stepped.toml --set 'interface.pairs=["1 0.1 3.28"]'
says "has no type '2'"
pairs=('interface.pairs=["1 100 meV 3.28", "2 0.03 3.0 10"]')
expect 0 check stepped.toml --set "${pairs[@]}"
says "a unit of measure"
expect 0 run stepped.toml --out types "${fast[@]}" "${pairs[@]}" drive.mode=dynamic
expect 0 run stepped.toml --out types-parts "${fast[@]}" "${pairs[@]}" drive.mode=dynamic drive.max_steps=25
typed 0
expect 2 run stepped.toml --out types-parts --resume auto "${fast[@]}" "${pairs[@]}" drive.mode=dynamic
typed 1
expect 0 run stepped.toml --out types-parts --resume auto "${fast[@]}" "${pairs[@]}" drive.mode=dynamic
[ "$(found types)" = "$(found types-parts)" ] || fail "$(diff <(found types) <(found types-parts))"
awk -v a="$(number types approach)" -v b="$(number whole-dynamic approach)" 'BEGIN { exit !(a != "" && a < b) }' ||
    fail "a weaker type attracts as much: $(number types approach), $(number whole-dynamic approach)"
"$asperity" export types --to lammps >/dev/null || fail "a run with two types is not exported"
for data in types/export/*.data; do
    [ "$(awk '/^Atoms/ { on = 1 } on && NF == 5 { ++n[$2] } END { print n[1], n[2], n[3] }' "$data")" = "277 278 256" ] ||
        fail "types in $data: $(grep types "$data")"
done

# Nor over another map, nor with other frames.
map() { awk -v bump="$1" 'BEGIN { for (y = 0; y < 16; ++y) { for (x = 0; x < 16; ++x) printf "%g ", (x == 3 && y == 5 ? bump : 0); print "" } }' >map.txt; }
printf '[surface]\nkind = "file"\nfile = "map.txt"\nfile_unit = "Å"\nsites = 16\n' >map.toml
map 1
expect 0 run map.toml --out mapped "${fast[@]}" output.trajectory=10 drive.max_steps=25
map 1.001
expect 2 run map.toml --out mapped --resume auto "${fast[@]}"
map 1
expect 2 run map.toml --out mapped --resume auto "${fast[@]}" output.trajectory=10 output.velocities=true
says "differs from it in output.velocities"
expect 0 run map.toml --out mapped --resume auto "${fast[@]}" output.trajectory=10 drive.max_steps=50
finish
