#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     aarch64.sh SOURCE
#
# The kernels and their tests for aarch64: made by a cross compiler, run by qemu. simd_test compares NEON's fused
# operations with those of one number, bit for bit, and so with x86-64-v3. (Debian: g++-aarch64-linux-gnu, qemu-user,
# libgtest-dev, libfmt-dev; exit code 77 where they lack.)
set -u
source=$1
compiler=${AARCH64_CXX:-aarch64-linux-gnu-g++}
for program in "$compiler" qemu-aarch64; do
    command -v "$program" >/dev/null || { echo "there is no $program"; exit 77; }
done
[ -d /usr/src/googletest ] || { echo "there are no sources of GoogleTest"; exit 77; }
work=$(mktemp -d "${TMPDIR:-/tmp}/asperity-arm.XXXXXX")
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/layers"
for layer in kernels decomposition engine; do ln -s "$(readlink -f "$source/$layer")" "$work/layers/"; done
random123=${RANDOM123_INCLUDE_DIR:-/usr/include}/Random123
[ -d "$random123" ] && ln -s "$random123" "$work/layers/"
[ -d /usr/include/fmt ] && ln -s /usr/include/fmt "$work/layers/" # of potential_table.cpp, whose tables a test makes
google=/usr/src/googletest/googletest
files=("$source"/kernels/*.cpp "$source"/kernels/device/{emulated,no_cuda}.cpp "$source"/tests/kernels/*_test.cpp
    "$source"/{tests/support/{elastic_reference,spectral_lattice},engine/case/potential_table}.cpp "$google"/src/{gtest-all,gtest_main}.cc)
export flags="-std=c++20 -O2 -ffp-contract=off -fopenmp -DFMT_HEADER_ONLY -I$work/layers -I$source/tests -I$google/include -I$google"
compile() { # OBJECT SOURCE
    local more=""
    case $2 in */emulated.cpp) more=-DASPERITY_VARIANT=emulated ;; esac
    # shellcheck disable=SC2086
    $compiler $flags $more -c "$2" -o "$1" || touch "$1.failed"
}
number=0
for file in "${files[@]}"; do
    compile "$work/$number.o" "$file" &
    number=$((number + 1))
    [ $((number % 2)) -ne 0 ] || wait
done
wait
ls "$work"/*.failed >/dev/null 2>&1 && exit 1
"$compiler" -static -fopenmp "$work"/*.o -o "$work/tests" || exit 1
qemu-aarch64 "$work/tests" "${@:2}"
