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

# Every start builds what is out of date, in a batch job of several tasks too (SLURM gives its script rank 0 and the
# number of tasks), and after a failed build the next start tries again and says why.
builds=$PWD/builds broken=$PWD/broken
stand_in ninja 'case " $* " in *" -n "*) ;; *) echo "error: built" | tee -a "'"$builds"'"; [ ! -e "'"$broken"'" ] ;; esac'
export SLURM_JOB_ID=7 SLURM_NTASKS=4 SLURM_NPROCS=4 SLURM_PROCID=0
built() { [ "$(wc -l <"$builds")" -eq "$1" ] || fail "$(wc -l <"$builds") builds, not $1: $2"; }
expect 0 check
expect 0 check
built 2 "two starts of one shell in a batch job"
touch "$broken"
for count in 3 4; do
    expect 1 check
    says "error: built"
    says "the build failed"
    built $count "a start after a failed build"
done
rm "$broken"
expect 0 check
built 5 "a start after the build was mended"
unset SLURM_JOB_ID SLURM_NTASKS SLURM_NPROCS SLURM_PROCID

# Of starts that wait for one another, as ranks of one mpirun do, one builds; all end as it does.
stand_in flock "echo waits >>'$PWD/waiting'; exec $(command -v flock) \"\$@\""
together() { # CODE
    local pids=() pid rank
    : >"$builds"
    : >waiting
    (
        failures=0
        flock 9
        for rank in 0 1 2 3; do "$asperity" check >"rank-$rank" 2>&1 9>&- & pids+=($!); done
        until [ "$(wc -l <waiting)" -eq 5 ]; do sleep 0.05; done
        flock -u 9
        for pid in "${pids[@]}"; do
            wait "$pid"
            [ $? -eq "$1" ] || fail "a rank ends otherwise: $(cat rank-*)"
        done
        exit $((failures > 0))
    ) 9>"../a house/build/.lock" || fail "not all ranks end with $1"
    built 1 "four starts at once"
}
together 0
touch "$broken"
together 1
[ "$(grep -l "the build failed" rank-* | wc -l)" -eq 4 ] || fail "a rank ends without a word: $(cat rank-*)"
rm "$broken" bin/flock "$builds" waiting rank-*
stand_in ninja 'true'

# Under a limit on open files it says so, and builds nothing anywhere.
for limit in 5 20 63; do
    out=$(bash -c 'ulimit -n $1; exec bash "$2" check' - $limit "$asperity" 2>&1)
    [ $? -eq 4 ] || fail "ulimit -n $limit: $out"
    says "too few files may be open"
done
[ ! -e calls ] || [ "$(grep -c '^cmake in' calls)" -eq 1 ] || fail "a limit configures again: $(cat calls)"
[ ! -e /build ] || fail "a limit makes /build"

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
