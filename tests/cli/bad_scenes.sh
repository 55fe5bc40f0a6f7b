#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Scenes that are wrong: exit 2, position, reason and remedy, and nothing written.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# bad NAME TEXT MESSAGE...: check and run refuse the scene and say all the messages.
bad() {
    local name=$1 text=$2 command message
    shift 2
    printf '%s\n' "$text" >scene.toml
    for command in check run; do
        expect 2 "$command" scene.toml
        for message in "$@"; do says "$message"; done
        says "fix: "
        says "nothing was written"
    done
    [ ! -e results ] || fail "$name: results were made"
}

bad "unknown key" $'[surface]\nsites = 64\nrmss = 1.0' \
    "scene.toml:3:1: surface.rmss is no key of a scene" "did you mean surface.rms?"
bad "unknown section" $'[surfaces]\nsites = 64' "scene.toml:1:2: [surfaces] is no section" "[surface]?"
bad "wrong type" $'[surface]\nsites = "many"' \
    "scene.toml:2:9: surface.sites = \"many\" is of the wrong type" "a whole number is needed"
bad "negative rms" $'[surface]\nrms = -1.0' "scene.toml:2:7: surface.rms = -1" "allowed: 0 Å or more"
bad "wrong unit" $'[surface]\nrms = "1 GPa"' "scene.toml:2:7" "a length is needed, and GPa is a pressure"
bad "cutoff" $'[surface]\nsites = 8' "scene.toml:2:9: interface.cutoff = 13.12 Å is more than half the box"
bad "cutoff over many sites" $'[surface]\nsites = 130\n[block]\nthickness = 4\n[interface]\ncutoff = 160' \
    "scene.toml:6:10: interface.cutoff = 160 Å reaches over too many atoms" "it may be 156 Å"
bad "cutoff over many rows" $'[surface]\nsites = 32\nlattice_ratio = 10\n[interface]\ncutoff = 35' \
    "scene.toml:5:10: interface.cutoff = 35 Å reaches over too many atoms" "it may be 27.3 Å"
bad "time step" $'[surface]\nsites = 32\n[drive]\ntimestep = 200.0' \
    "scene.toml:4:12: drive.timestep = 200 fs is over the stability limit"
bad "missing map" $'[surface]\nkind = "file"\nfile = "gone.h5"' \
    "scene.toml:3:8: surface.file = \"gone.h5\": there is no such file"
bad "no TOML" $'[surface]\nrms = 0.3 nm' "scene.toml:2:" "stand in quotes: rms = \"0.3 nm\""
bad "path" $'[drive]\npath = ["pull-off"]' "scene.toml:2:8: drive.path has \"pull-off\""
bad "not yet" $'[drive]\npath = ["zero-load", "pull-off"]' "scene.toml:2:8: drive.path = a path in time from \"zero-load\" is not available yet"
bad "a model that is gone" $'[block]\nmodel = "spectral"' "scene.toml:2:9: block.model = \"spectral\" is not a choice any more" "leave block.model out"
bad "a key that is gone" $'[numerics]\naccuracy = "1%"' "scene.toml:2:1: numerics.accuracy is not a key any more" "asperity cost SCENE --target 1%"
bad "waves at finite strain" $'[block]\nstrain = "finite"\n[drive]\npath = ["zero-load"]' \
    "scene.toml:2:10: block.strain = \"finite\" on a path without time" "waves do not add up"
bad "a wall in time" $'[interface]\nkind = "wall"' "scene.toml:2:8: interface.kind = \"wall\" on a path in time"
bad "mean height in time" $'[drive]\nhold = "mean-height"' \
    "scene.toml:2:8: drive.hold = \"mean-height\" on a path in time" "take drive.mode = \"quasistatic\""
bad "several" $'[surface]\nrms = -1\nhurst = 3\n[drive]\nspeed = 1\n' \
    "scene.toml:2:7" "scene.toml:3:9" "scene.toml:5:1" "3 problems"

# What stands in the map is looked at before anything is written.
for row in $(seq 32); do
    printf '0 %.0s' $(seq 31)
    if [ "$row" = 5 ]; then echo nan; else echo 0; fi
done >map.txt
bad "NaN in a map" $'[surface]\nkind = "file"\nfile = "map.txt"\nsites = 32' "map.txt:5:63" \
    "the height in row 5, column 32 is nan"
sed -i 's/nan/0/; 7d' map.txt
bad "map that is not square" $'[surface]\nkind = "file"\nfile = "map.txt"\nsites = 32' "not square"

expect 2 check gone.toml
says "gone.toml: the scene cannot be read"
says "there is no such file"
expect 2 check .
says "it is a directory"
rm -f map.txt
printf '[surface]\nsites = 64\n' >scene.toml
expect 2 check scene.toml --set surface.rms=-1
says "--set surface.rms=-1: surface.rms = -1 is out of range"
expect 2 run scene.toml --set rms=1
says "did you mean surface.rms?"
only_files ./scene.toml

# More ranks than tiles; under mpirun one rank speaks and all end alike.
if [ ${#mpirun[@]} -gt 0 ]; then
    out=$("${mpirun[@]}" -n 2 "$asperity" run scene.toml --set surface.rms=-1 2>&1)
    code=$?
    [ $code -eq 2 ] || fail "mpirun: exit code $code"
    [ "$(grep -c 'is out of range' <<<"$out")" = 1 ] || fail "mpirun: not one complaint: $out"
    # 12 sites of 2.6 Å can be cut in few tiles only
    printf '[surface]\nsites = 12\nrolloff = 2\n[drive]\nmax_steps = 1\n' >scene.toml
    out=$("${mpirun[@]}" -n 7 "$asperity" run scene.toml 2>&1)
    code=$?
    [ $code -eq 2 ] || fail "more ranks than tiles: exit code $code: $out"
    says "rank"
    only_files ./scene.toml
fi
finish
