#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# minute.sh SOURCE [SECONDS [TARGET...]]: builds the fuzz targets with clang and runs each for so long. What is
# found stays in build/fuzz/found/TARGET.
set -u
source=$1 seconds=${2:-60}
shift $(($# < 2 ? $# : 2))
command -v clang++ >/dev/null && [ -n "$(ls /usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a 2>/dev/null)" ] || {
    echo "clang with libFuzzer is not installed (packages clang, libclang-rt-14-dev, libomp-dev)"
    exit 77
}
cd -- "$source" || exit 1
cmake --preset fuzz >/dev/null && ninja -C build/fuzz fuzz_targets >/dev/null || exit 1
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 OMP_NUM_THREADS=1
failed=0
for target in ${*:-scene set map json checkpoint}; do
    program=build/fuzz/tests/fuzz/fuzz_$target found=build/fuzz/found/$target
    mkdir -p "$found/corpus"
    # Entropic scheduling costs more here than the work that it schedules.
    options=(-max_total_time="$seconds" -entropic=0 -timeout=20 -rss_limit_mb=4096
        -artifact_prefix="$found/" "$found/corpus" "tests/fuzz/corpus/$target")
    echo "== $target"
    case $target in
    checkpoint) # libhdf5 trusts its files: where it crashes, go on and look at it afterwards
        "$program" -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 -max_len=16384 \
            "${options[@]}" >"$found/log" 2>&1
        tail -n 1 "$found/log" ;;
    *) "$program" -max_len=$([ "$target" = set ] && echo 512 || echo 4096) -verbosity=0 \
            -print_final_stats=1 "${options[@]}" || failed=1 ;;
    esac
    for input in "$found"/crash-* "$found"/timeout-* "$found"/oom-*; do
        [ -e "$input" ] || continue
        "$program" -timeout=20 -rss_limit_mb=4096 "$input" >"$found/report" 2>&1 && continue
        # Whose it is tells the innermost frame of a library or of ours.
        if grep -o -m 1 ' in asperity::\|libhdf5' "$found/report" | grep -q libhdf5; then
            echo "in libhdf5: $input"
        else
            echo "FOUND: $input" && failed=1
        fi
    done
done
exit $failed
