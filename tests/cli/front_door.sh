#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The script at the root, around a program that is there already: from anywhere, through a link, in a folder
# with a space, and under mpirun.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

mkdir -p "a house/build/release/engine" "a house/cmake" "a house/python/asperity/commands" elsewhere
cp "$source/asperity" "a house/asperity"
cp "$source/cmake/packages.txt" "a house/cmake/"
cp "$source/python/asperity/commands/table.txt" "a house/python/asperity/commands/"
cp "$asperity" "a house/build/release/engine/asperity"
asperity="$work/a house/asperity"
export ASPERITY_SKIP_BUILD=1
unset ASPERITY_PRESET # of the build under test

cd elsewhere || exit 1
expect 0 info
says "compiler"
expect 2 check gone.toml # the exit code comes through
ln -s "$asperity" link
asperity=./link expect 0 info
printf '[surface]\nsites = 64\n' >"my scene.toml"
expect 0 check "my scene.toml" --set "surface.rms=0.3 nm"

if [ ${#mpirun[@]} -gt 0 ]; then
    out=$("${mpirun[@]}" -n 2 "$asperity" info 2>&1)
    says "ranks      2"
    [ "$(grep -c compiler <<<"$out")" = 1 ] || fail "not one rank speaks: $out"
fi

# Its help lists what the program lists, and more, without building anything.
listed=$("$asperity" --help)
commands() { sed -n '/^commands:/,/^$/p' | tail -n +2 | grep .; }
[ "$("$1" --help | commands | wc -l)" -ge 10 ] || fail "the program lists no commands"
[ "$(commands <<<"$listed" | sed '/^  test /,$d')" = "$("$1" --help | commands)" ] || fail "--help lists other commands than the program's"
for name in test bench; do grep -q "^  $name " <<<"$listed" || fail "--help lacks $name"; done
expect 0 run --help # of a program that is there
says "--resume"

# What follows builds: by stand-ins that write down what they are called with.
mkdir bin
stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"bin/$1" && chmod +x "bin/$1"; }
stand_in apt-get 'echo "apt-get $*" >>calls; touch installed'
stand_in sudo 'exit 1'
stand_in id 'echo "${WHO:-1000}"'
# Like cmake, where GoogleTest is missing (and, with the file fftw-is-missing, FFTW) until apt-get was called.
# What the preset sets is in a file (cmake --preset NAME -N).
stand_in cmake 'cd - >/dev/null; [[ "$*" != *" -N" ]] || { cat preset-sets 2>/dev/null; exit 0; }; echo "cmake $* in $OLDPWD" >>calls; lacks=; packages=
    [ -e installed ] || { [ ! -e fftw-is-missing ] || { lacks=FFTW packages=" libfftw3-dev"; }
        [[ "$*" != *TESTS=ON* ]] || { lacks="${lacks:+$lacks, }GoogleTest" packages+=" libgtest-dev"; } }
    cd - >/dev/null; mkdir -p build/release/engine
    printf "%s\n" "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$@" | sed "s/^-D\(.*\)=/\1:STRING=/" >build/release/CMakeCache.txt
    [ -z "$lacks" ] || { printf "%s\n" "CMake Error at x.cmake:1 (message):" "  Not all was found." "" \
        "    missing:        $lacks" "    Debian, Ubuntu: apt-get install --no-install-recommends$packages" "    Fedora:         dnf install of-fedora" \
        "    or load modules (docs/howto/install.md)" "Call Stack"; exit 1; }
    touch build/release/build.ninja
    printf "#!/bin/sh\necho built\n" >build/release/engine/asperity; chmod +x build/release/engine/asperity'
stand_in ninja 'true'
stand_in ctest 'echo tested'
stand_in python 'true' # has every module
unset ASPERITY_SKIP_BUILD
export ASPERITY_PYTHON=$PWD/bin/python
given_path=$PATH
export PATH="$PWD/bin:$PATH"
rm -r "../a house/build"
expect 0 --help
expect 0 bench --help
expect 0 test --help
says "Usage: asperity test"
[ ! -e "../a house/build" ] || fail "--help builds"

# What CMake does not find is named, with the lines to type, for those who may not install it, and by commands that
# were not asked to.
touch fftw-is-missing
expect 2 run
says "missing: FFTW"
says "only root may install"
says "fix: Debian, Ubuntu: apt-get install --no-install-recommends libfftw3-dev"
says "dnf install of-fedora"
export WHO=0
for name in check plan info; do
    expect 2 $name
    says "\`$name\` installs nothing without being asked"
done
! grep apt-get calls || fail "a command that was not asked to installs"
for name in run:libfftw3-dev "test:libfftw3-dev libgtest-dev"; do # the stand-in has all that is missing after one call
    rm -rf calls installed "../a house/build"
    expect 0 "${name%:*}"
    grep -q "apt-get install -y --no-install-recommends ${name#*:}$" calls || fail "${name%:*} installs: $(cat calls)"
done
rm -rf calls installed "../a house/build"
ASPERITY_INSTALL=1 expect 0 check
grep -q "apt-get install" calls || fail "ASPERITY_INSTALL=1 installs nothing"

# A run asks for nothing that only tests use, before tests were asked for and after they could not be built.
export WHO=1000
rm -rf fftw-is-missing calls installed "../a house/build"
for name in run test run; do
    expect "$([ $name = test ] && echo 2 || echo 0)" $name
done
expect 2 test
says "missing: GoogleTest"
! grep -q TESTS=ON "../a house/build/release/CMakeCache.txt" || fail "tests that cannot be built are kept as asked for"
export WHO=0
expect 0 test
says "tested"
[ "$(grep -c ^cmake calls)" -eq 5 ] || fail "configured otherwise than for the run, the tests twice, and their installation: $(cat calls)"

# A first build is for this machine alone; tests are of every level of kernels, and stay so.
grep -m 1 ^cmake calls | grep -q "LEVELS=native" || fail "a first build has all kernels: $(cat calls)"
grep ^cmake calls | tail -n 1 | grep -q "LEVELS=all" || fail "tests are of one level: $(cat calls)"
expect 0 run
[ "$(grep -c ^cmake calls)" -eq 5 ] || fail "a run after the tests configures anew: $(cat calls)"

# What the preset sets is left as it is: those of the sanitizers have one level of kernels and no device.
printf '  %s="%s"\n' ASPERITY_LEVELS none ASPERITY_PERF OFF >preset-sets
mv calls kept && rm -r "../a house/build"
expect 0 test
grep -q "TESTS=ON" calls || fail "tests are not built: $(cat calls)"
! grep -Eq "LEVELS|PERF" calls || fail "the settings of the preset are overridden: $(cat calls)"
mv kept calls && rm preset-sets

# Without CMake, Ninja and a compiler, all that a build needs is named at once; so it is where there is no apt-get.
mkdir bare
for name in awk bash cat chmod cp date flock grep head id mkdir mv readlink rm sed tail touch; do ln -s "$(PATH=$given_path command -v $name)" bare/; done
rm -rf calls "../a house/build"
PATH=$PWD/bare expect 2 run
says "missing: CMake, Ninja, a C++ compiler"
says "apt-get install --no-install-recommends cmake ninja-build build-essential pkg-config libopenmpi-dev openmpi-bin"
says "dnf install cmake ninja-build gcc-c++"
says "conda install -c conda-forge cmake"
case $out in *gtest* | *benchmark* | *matplotlib*) fail "a run asks for what only tests use: $out" ;; esac
PATH=$PWD/bare expect 2 test
says "libgtest-dev libbenchmark-dev"
ln -s "$PWD/bin/cmake" "$PWD/bin/ninja" bare/
PATH=$PWD/bare CXX=no-such-compiler expect 2 run
says "missing: a C++ compiler (no-such-compiler)"
ln -s "$PWD/bin/cmake" bare/c++
touch fftw-is-missing
rm -f installed
PATH=$PWD/bare expect 2 run # no apt-get
says "missing: FFTW"
says "dnf install of-fedora"
rm fftw-is-missing
PATH=$PWD/bare expect 0 run

# What is to be compiled is counted when CMake's files are up to date, which a new build's are not.
stand_in ninja 'case " $* " in *" build.ninja "*) touch "'"$PWD"'/up-to-date" ;;
    *" -n "*) [ -e "'"$PWD"'/up-to-date" ] && printf "[%s/3] Building x\n" 1 2 3 || echo "[1/2] Re-running CMake..." ;; esac'
rm -rf calls "../a house/build"
expect 0 run
says "building (3 files to compile)"
stand_in ninja 'true'

# Modules of Python that a command imports.
stand_in python 'echo h5py jinja2'
expect 2 report
says "missing in $PWD/bin/python: h5py jinja2"
says "fix: $PWD/bin/python -m pip install h5py jinja2"
stand_in python 'true'
rm -rf calls "../a house/build"

# Every start builds what is out of date, in a batch job of several tasks too (SLURM gives its script rank 0 and the
# number of tasks), and after a failed build the next start tries again and says why.
builds=$PWD/builds broken=$PWD/broken
stand_in ninja 'case " $* " in *" -n "* | *" build.ninja "*) ;; *) echo "error: built" | tee -a "'"$builds"'"; [ ! -e "'"$broken"'" ] ;; esac'
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
        until [ "$(wc -l <waiting)" -ge 5 ]; do sleep 0.05; done
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
# A start that waits for long says for whom.
(
    flock 9
    printf 'process 7 since 12:34\n' >"../a house/build/.lock"
    "$asperity" check >waits 2>&1 9>&- &
    until grep -q "waiting for another build in .*/build (process 7 since 12:34)" waits; do sleep 0.05; done
    flock -u 9
    wait $! || fail "the start that waited ends otherwise: $(cat waits)"
) 9<>"../a house/build/.lock"
rm waits
stand_in ninja 'true'

# Under a limit on open files it says so, and builds nothing anywhere.
had_build=$([ -e /build ] && echo yes)
for limit in 5 20 63; do
    out=$(bash -c 'ulimit -n $1; exec bash "$2" check' - $limit "$asperity" 2>&1)
    [ $? -eq 4 ] || fail "ulimit -n $limit: $out"
    says "too few files may be open"
done
[ ! -e calls ] || [ "$(grep -c '^cmake' calls)" -eq 1 ] || fail "a limit configures again: $(cat calls)"
[ -e /build ] && [ ! "$had_build" ] && fail "a limit makes /build"

# The build of a copied tree is made anew: it holds the paths of the old place.
rm calls
expect 0 check
[ ! -e calls ] || fail "a second start configures again: $(cat calls)"
cp -r "../a house" "../another house"
rm "../another house/build/release/engine/asperity"
asperity="$work/another house/asperity" expect 0 check
says "belongs to $work/a house"
says "built"
grep -q "^cmake .* in $work/another house" calls || fail "a copied tree is not configured"
finish
