#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Commands, options and their mistakes.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 --help
for command in run init plan check surface theory sweep report export convert defaults info; do
    says "  $command"
    expect 0 "$command" --help
    expect 0 --help
done
expect 0 --version
says "asperity 0."
expect 0 info
for line in version git compiler flags MPI HDF5 FFTW threads ranks processor; do says "$line"; done

expect 0 defaults
printf '%s\n' "$out" >defaults.toml
expect 0 check defaults.toml
expect 0 defaults --plain
printf '%s\n' "$out" >plain.toml
expect 0 check plain.toml
expect 0 defaults --markdown
[ "$out" = "$(cat "$source/docs/reference/scene.md")" ] ||
    fail "docs/reference/scene.md is out of date: ./asperity defaults --markdown > docs/reference/scene.md"

mkdir new && cd new || exit 1
# A scene to start from: nothing wrong with it, all keys in it, those behind # with their defaults.
expect 0 init
expect 0 check scene.toml
cp scene.toml before.toml
expect 2 init
says "scene.toml: is there already"
cmp -s scene.toml before.toml || fail "init wrote over a file"
expect 0 init mine.toml
sed 's/^# \([a-z_0-9]* = \)/\1/' mine.toml >all.toml
expect 0 check all.toml
[ "$(grep -c '^[a-z_0-9]* = ' all.toml)" -eq "$(grep -c '^[a-z_0-9]* = ' ../plain.toml)" ] || fail "keys are missing in the scene of init"
values() { "$asperity" check "$1" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["scene"])'; }
[ "$(values mine.toml)" = "$(values all.toml)" ] || fail "a key behind # has not its default"
expect 4 init nowhere/scene.toml

# The standard input.
out=$("$asperity" check - <scene.toml) || fail "check -"
says "stdin: nothing wrong"
out=$(printf '[surface]\nsites = -1\n' | "$asperity" check - 2>&1)
[ $? -eq 2 ] || fail "check - of a wrong scene"
says "stdin:2:"
out=$(SLURM_NTASKS=4 SLURM_PROCID=0 "$asperity" check - <scene.toml) || fail "check - in a batch job: $out"
if [ ${#mpirun[@]} -gt 0 ]; then
    out=$("${mpirun[@]}" -n 1 "$asperity" check - <scene.toml) || fail "check - of one rank: $out"
    says "stdin: nothing wrong"
    out=$("${mpirun[@]}" -n 2 "$asperity" check - <scene.toml 2>&1) && fail "check - of two ranks"
    says "only rank 0 would have it"
fi
# A launcher that says it has started two processes, where MPI finds one: the first of them says so, and no run begins.
for step in 0 1; do
    out=$(SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=$step "$asperity" run scene.toml --out unconnected 2>&1)
    [ $? -eq 2 ] || fail "a step of SLURM that MPI does not connect: $out"
    [ $step -eq 1 ] || says "2 processes were started, and MPI connects none of them"
    [ $step -eq 0 ] || [ -z "$out" ] || fail "the second process speaks: $out"
    [ ! -e unconnected ] || fail "a run begins that MPI does not connect"
done
cd .. && rm -r new

expect 2
expect 2 chek
says "did you mean \`asperity check\`?"
expect 2 run
says "SCENE is required"
expect 2 run --no-such-option
expect 2 run plain.toml plain.toml
says "more than one scene"
expect 2 run plain.toml --wall-limit soon
says "--wall-limit soon: is no length of time"
expect 2 run plain.toml --progress loud
says "choices: auto, bar, lines, off"
for option in --out --resume --wall-limit --progress; do
    expect 2 run plain.toml $option ""
    says "$option: is empty"
done
expect 2 run plain.toml --out /
says "is the root of all directories"
expect 2 run plain.toml --resume gone.h5
says "there is no such file"
expect 2 check plain.toml --set
expect 0 check --set surface.sites=64 block.thickness=32 plain.toml
says "64 x 64 sites"
says "32 layers"
# of one key the last one counts
expect 0 check plain.toml --set surface.sites=64 block.thickness=32 --set block.thickness=48
says "48 layers"
# plan runs nothing and writes nothing
expect 0 plan --set surface.sites=32 block.thickness=32 surface.rms=1 drive.temperature=10 plain.toml --ranks 4
says "4 ranks"
says "drive.temperature = 10 K"
says "wall time"
expect 2 plan plain.toml --ranks 0
expect 2 plan plain.toml --set drive.timestep=1000
says "stability limit"
only_files ./defaults.toml ./plain.toml
finish
