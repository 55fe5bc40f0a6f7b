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

# Its help lists what the program lists, and more, without building anything.
listed=$("$asperity" --help)
[ "$("$1" --help | grep -c '^  [a-z]* .*  *[a-z]')" -ge 10 ] || fail "the program lists no commands"
while read -r name purpose; do
    grep -qE "^  $name .*  ${purpose//[.()]/.}$" <<<"$listed" || fail "--help lacks: $name $purpose"
done < <(sed -n '/^Subcommands:/,/^$/p' <("$1" --help) | tail -n +2 | grep .)
for name in test bench; do grep -q "^  $name " <<<"$listed" || fail "--help lacks $name"; done
expect 0 run --help # of a program that is there
says "--resume"

# What follows builds: by stand-ins that write down what they are called with.
mkdir bin
stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"bin/$1" && chmod +x "bin/$1"; }
stand_in dpkg-query '[ ! -e installed ] || for name; do printf "installed:%s " "$name"; done'
stand_in apt-get 'echo "apt-get $*" >>calls; touch installed'
stand_in sudo 'exit 1'
stand_in id 'echo "${WHO:-1000}"'
stand_in cmake 'echo "cmake in $PWD" >>"$OLDPWD/calls"; mkdir -p build/release/engine
    echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/release/CMakeCache.txt; touch build/release/build.ninja
    printf "#!/bin/sh\necho built\n" >build/release/engine/asperity; chmod +x build/release/engine/asperity'
stand_in ninja 'true'
stand_in ctest 'echo tested'
unset ASPERITY_SKIP_BUILD
export PATH="$PWD/bin:$PATH"
rm -r "../a house/build"
expect 0 --help
[ ! -e "../a house/build" ] || fail "--help builds"

# Missing packages are named, with the line to type, for those who may not install them, and by commands that
# were not asked to.
expect 2 run
says "fix: sudo apt-get install -y --no-install-recommends build-essential cmake"
export WHO=0
for name in check plan info; do
    expect 2 $name
    says "\`$name\` installs nothing without being asked"
done
[ ! -e calls ] || fail "a command that was not asked to installs: $(cat calls)"
for name in run:build-essential test:python3-pytest; do # the stand-in has all that is missing after one call
    rm -rf calls installed "../a house/build"
    expect 0 "${name%:*}"
    grep -q "apt-get install -y --no-install-recommends .*${name#*:}" calls || fail "${name%:*} installs nothing"
done
rm -rf calls installed "../a house/build"
ASPERITY_INSTALL=1 expect 0 check
grep -q "apt-get install" calls || fail "ASPERITY_INSTALL=1 installs nothing"

# The build of a copied tree is made anew: it holds the paths of the old place.
rm calls
expect 0 check
[ ! -e calls ] || fail "a second start configures again: $(cat calls)"
cp -r "../a house" "../another house"
rm "../another house/build/release/engine/asperity"
asperity="$work/another house/asperity" expect 0 check
says "belongs to $work/a house"
says "built"
grep -q "cmake in $work/another house" calls || fail "a copied tree is not configured"
finish
