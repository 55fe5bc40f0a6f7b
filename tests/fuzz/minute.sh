#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# minute.sh SOURCE [SECONDS]: builds the fuzz targets with clang and runs each for so long. What is found
# stays in build/fuzz/found.
set -u
source=$1 seconds=${2:-60}
command -v clang++ >/dev/null && [ -n "$(ls /usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a 2>/dev/null)" ] || {
    echo "clang with libFuzzer is not installed (packages clang, libclang-rt-14-dev, libomp-dev)"
    exit 77
}
cd -- "$source" || exit 1
cmake --preset fuzz >/dev/null && ninja -C build/fuzz fuzz_targets >/dev/null || exit 1
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1
failed=0
for program in build/fuzz/tests/fuzz/fuzz_*; do
    [ -x "$program" ] && [ -f "$program" ] || continue
    target=${program##*/fuzz_}
    found=build/fuzz/found/$target
    mkdir -p "$found"
    # Of what happens in a child process the fuzzer sees nothing: seeds are kept all the same.
    "$program" -keep_seed=1 -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=4096 \
        -print_final_stats=1 -verbosity=0 -artifact_prefix="$found/finding-" "$found" \
        "$source/tests/fuzz/corpus/$target" || failed=1
done
exit $failed
