#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# libasperity as a stranger uses it: a project outside the tree is configured, built and run against an
# installed prefix that was moved after the installation, by CMake and by pkg-config.
# shellcheck source=tests/cli/common.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"
build=$(cd -- "$3" && pwd)

cmake --install "$build" --prefix "$work/first prefix" >install.log 2>&1 || fail "cmake --install: $(tail -n 3 install.log)"
prefix="$work/moved prefix"
mv "$work/first prefix" "$prefix"
libraries=$(dirname -- "$(find "$prefix" -name 'libasperity.so')")
export LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
cat >scene.toml <<'END'
surface = { sites = 32, rms = 0.8 }
drive = { velocity = 200, timestep = 20, max_steps = 0 }
output = { series = 10 }
END
"$asperity" run scene.toml --out reference --progress off >/dev/null || fail "the program's run"

# The example: find_package.
cp -r "$source/library/example" project
cmake -S project -B project/build -DCMAKE_PREFIX_PATH="$prefix" >configure.log 2>&1 || fail "find_package: $(tail -n 5 configure.log)"
cmake --build project/build >build.log 2>&1 || fail "the example: $(tail -n 20 build.log)"
out=$(./project/build/first_contact scene.toml example)
printf '%s\n' "$out" | grep -qxE 'binding energy [0-9.]+ meV/Å\^2' || fail "the example printed: $out"
./project/build/first_contact nothing.toml other 2>/dev/null
[ $? -eq 2 ] || fail "the example with a scene that is not there"
sed -i 's/Asperity 0.1/Asperity 0.2/' project/CMakeLists.txt
cmake -S project -B project/newer -DCMAKE_PREFIX_PATH="$prefix" >/dev/null 2>&1 && fail "another minor version was accepted"

# Everything of the header: pkg-config, all warnings, C++17.
export PKG_CONFIG_PATH=$libraries/pkgconfig
[ "$(pkg-config --modversion asperity)" = "$("$asperity" --version | cut -d ' ' -f 2)" ] || fail "the version of pkg-config"
eval "g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror '$source/tests/library/consumer.cpp' -o consumer $(pkg-config --cflags --libs asperity)" ||
    fail "the consumer does not compile"
# The engine in a loop of one's own.
eval "g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror '$source/examples/stepping.cpp' -o stepping $(pkg-config --cflags --libs asperity)" ||
    fail "examples/stepping.cpp does not compile"
[ "$(wc -l <"$source/examples/stepping.cpp")" -le 40 ] || fail "examples/stepping.cpp is long"
out=$(./stepping scene.toml) || fail "examples/stepping.cpp: exit code $?"
printf '%s\n' "$out" | grep -qE '^parted after [0-9.]+ ps, largest attraction [0-9]{2,}' || fail "examples/stepping.cpp printed: $out"
./stepping nothing.toml 2>/dev/null
[ $? -eq 2 ] || fail "examples/stepping.cpp with a scene that is not there"
out=$(./consumer scene.toml alone reference 2>&1) || fail "the consumer"
[ -z "$out" ] || fail "the consumer, or the library, printed: $out"
out=$(OMP_NUM_THREADS=1 "${mpirun[@]}" -n 2 ./consumer scene.toml ranks reference 2>&1) ||
    fail "the consumer on two ranks: $out"
# An error that one rank alone meets ends all of them, and is told.
out=$(OMP_NUM_THREADS=1 timeout 60 "${mpirun[@]}" -n 2 ./consumer scene.toml uneven reference one-fails 2>&1)
code=$?
[ $code -ne 0 ] && [ $code -ne 124 ] || fail "an error of one rank: exit code $code"
says "is given no directory"
says "other ranks do not meet this"

# No name but the header's is shown, so another library's cannot be taken for ours.
shown=$(nm -DC --defined-only "$libraries/libasperity.so" | grep 'asperity' | grep -v 'libasperity::' )
[ -z "$shown" ] || fail "names of the engine are shown: $(printf '%s\n' "$shown" | head -n 3)"
readelf -d "$libraries/libasperity.so" | grep -q 'SONAME.*\[libasperity.so.0.1\]' || fail "the soname"
finish
