#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Every command of the README and the docs runs. Runs are made small and short by overrides put behind the
# command's own; a comment "# exit N" behind a command says with which code it is meant to end.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

small="--set surface.sites=32 block.thickness=32 theory.renormalised=false --progress off"
"$asperity" surface "$source/scenes/first-contact.toml" --out map >/dev/null || fail "no surface"
ln -s "$source/scenes" scenes
cp map/heights.h5 heights.h5 # "your own surface"
kernels=$("$asperity" info | sed -n 's/.*kernels for \([a-z0-9]*\).*/\1/p')

count=0
while IFS= read -r line; do
    wanted=0
    [[ $line =~ "# exit "([0-9]+) ]] && wanted=${BASH_REMATCH[1]}
    # Devices are refused where the kernels do not fuse multiplications and additions.
    [[ $line == *numerics.device=* && $kernels =~ ^(portable|v2)$ ]] && wanted=2
    command=${line%%#*}
    case $command in
    *" run scenes/atoms/"*) command="$command --set drive.max_steps=30 --progress off" ;; # as wide as its atoms
    *"./asperity test"* | *"./asperity bench"*) continue ;; # would call this test
    *--theory-only*) ;;
    *" cost "*) command="$command --parameters precision --progress off --set surface.sites=16 block.thickness=4 drive.velocity=40 drive.timestep=40" ;;
    *" run "* | *" sweep "*) command="$command $small"
        # What is meant to fail has to get there; the others stop after a few steps.
        [ "$wanted" = 0 ] && command="$command --set drive.max_steps=30" ;;
    esac
    command=${command//.\/asperity/\"$asperity\"}
    command=${command//mpirun /${mpirun[*]} }
    out=$(eval "timeout 400 $command" 2>&1 </dev/null)
    code=$?
    [ $code -eq "$wanted" ] || fail "exit code $code, not $wanted: $command
$out"
    count=$((count + 1))
done < <(find "$source/README.md" "$source/ARCHITECTURE.md" "$source/docs" -name '*.md' -print0 | sort -z | xargs -0 cat |
    grep -E '^    (mpirun .*)?\./asperity ' | sed 's/^    //')
[ $count -ge 10 ] || fail "only $count commands were found"
finish
