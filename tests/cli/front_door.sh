#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The script at the root, around a program that is there already: from anywhere, through a link, in a folder
# with a space, and under mpirun.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

mkdir -p "a house/build/release/engine" elsewhere
cp "$source/asperity" "a house/asperity"
cp "$asperity" "a house/build/release/engine/asperity"
asperity="$work/a house/asperity"
export ASPERITY_SKIP_BUILD=1

cd elsewhere || exit 1
expect 0 info
says "compiler"
expect 2 check gone.toml # the exit code comes through
ln -s "$asperity" link
asperity=./link expect 0 info
printf '[surface]\nsites = 64\n' >"my scene.toml"
expect 0 check "my scene.toml" --set "surface.rms=0.3 nm"

mpirun=$(command -v mpirun)
if [ -n "$mpirun" ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    out=$("$mpirun" --oversubscribe -n 2 "$asperity" info 2>&1)
    says "ranks      2"
    [ "$(grep -c compiler <<<"$out")" = 1 ] || fail "not one rank speaks: $out"
fi

# Packages that are missing are named, with the line to type, for those who may not install them.
mkdir bin
printf '#!/bin/sh\nexit 1\n' >bin/dpkg-query
printf '#!/bin/sh\nexit 1\n' >bin/sudo
printf '#!/bin/sh\necho 1000\n' >bin/id
chmod +x bin/*
unset ASPERITY_SKIP_BUILD
out=$(PATH="$PWD/bin:$PATH" "$asperity" info 2>&1)
code=$?
[ $code -eq 2 ] || fail "missing packages: exit code $code"
says "fix: sudo apt-get install -y --no-install-recommends build-essential cmake"
finish
