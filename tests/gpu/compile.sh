#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Compiles kernels.cu for a device: with nvcc, else with a clang that knows NVIDIA's instruction set
# (no CUDA toolkit needed). Exit code 77: neither is here.
#
#     compile.sh FOLDER_THAT_HOLDS_kernels
set -u
source=$(cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)/kernels.cu
out=$(mktemp -d) || exit 1
trap 'rm -rf "$out"' EXIT

if command -v nvcc >/dev/null; then
    echo "compiled by $(command -v nvcc)"
    # 554: a view of constants converts to itself without its conversion operator. True, and fine.
    nvcc -std=c++20 -Werror all-warnings -diag-suppress 554 -I"$1" -c -o "$out/kernels.o" "$source" || exit 1
    exit 0
fi

clang=(clang++ -x cuda -std=c++20 -nocudainc -nocudalib --cuda-device-only --cuda-gpu-arch=sm_70 -S
    -Wno-unknown-cuda-version)
echo 'extern "C" __attribute__((global)) void nothing() {}' >"$out/nothing.cu"
if ! command -v clang++ >/dev/null || ! "${clang[@]}" -o "$out/nothing.ptx" "$out/nothing.cu" 2>/dev/null; then
    echo "skipped: there is neither nvcc nor a clang++ for NVIDIA devices here (Debian: apt-get install clang)"
    exit 77
fi
echo "compiled to PTX by $(clang++ --version | head -n 1); there is no nvcc here"
"${clang[@]}" -Wall -Wextra -Werror -I"$1" -o "$out/kernels.ptx" "$source" || exit 1
for kernel in linear_forces finite_forces interface_forces; do
    grep -q "entry .*$kernel" "$out/kernels.ptx" || { echo "$kernel is not in the device code"; exit 1; }
done
