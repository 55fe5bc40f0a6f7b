#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     wheel.sh SOURCE WORK [WHEEL]
#
# Makes the wheel that is passed on (unless WHEEL is one) and tries README's commands with it in a virtual environment that sees
# no library of ours: not the build, not the packages of the distribution. Exit code 77: PyPI or apt is out of reach.
set -u
source=$(cd -- "$1" && pwd)
mkdir -p "$2"
work=$(cd -- "$2" && pwd)
fail() { echo "FAILED: $*" >&2; exit 1; }

wheel=${3:-}
if [ -z "$wheel" ]; then
    command -v apt-get >/dev/null || { echo "skipped: no apt-get"; exit 77; }
    /usr/bin/env python3 -m pip download --quiet --no-deps --dest "$work/reached" auditwheel >/dev/null 2>&1 || { echo "skipped: no PyPI"; exit 77; }
    /usr/bin/env python3 "$source/packaging/wheel.py" "$work/wheels" --work "$work" >"$work/wheel.log" 2>&1 || fail "wheel.py: $(tail -n 15 "$work/wheel.log")"
    wheel=$(tail -n 2 "$work/wheel.log" | head -n 1)
fi
wheel=$(realpath "$wheel")
case $wheel in *-manylinux_*_x86_64.whl) ;; *) fail "no manylinux wheel: $wheel" ;; esac

bare=$(mktemp -d "${TMPDIR:-/tmp}/asperity-wheel.XXXXXX") || exit 1
trap 'rm -rf -- "$bare"' EXIT
/usr/bin/env python3 -m venv "$bare/env" || fail "no virtual environment"
"$bare/env/bin/pip" install --quiet "$wheel" || fail "pip install"
cd "$bare" || exit 1
clean() { env -i HOME="$bare" PATH="$bare/env/bin:/usr/bin:/bin" OMP_NUM_THREADS=1 MPLBACKEND=agg "$@"; }

# Only the C library, and what every Linux has, is from outside.
module=$(echo env/lib/python3*/site-packages/asperity/_engine*.so)
outside=$(clean ldd "$module" | awk '{ print $3 }' | grep -v "^$bare/" | grep -vE '/lib(c|m|z|dl|rt|pthread|stdc\+\+|gcc_s)[.]so' | grep .)
[ -z "$outside" ] || fail "libraries from outside: $outside"
python3 "$source/tests/cli/wheel_contents.py" "$wheel" || fail "contents"
bad="$bare/bad/$(basename "$wheel")"
mkdir bad
python3 - "$wheel" "$bad" <<'END' || fail "a copy without a licence"
import sys, zipfile
wheel, bad = zipfile.ZipFile(sys.argv[1]), zipfile.ZipFile(sys.argv[2], "w")
for name in wheel.namelist():
    if not name.endswith("licenses/fftw3.txt"):
        bad.writestr(name, wheel.read(name))
END
python3 "$source/tests/cli/wheel_contents.py" "$bad" >told && fail "a wheel without the licence of FFTW passes"
grep -q "^no licence text of fftw3" told || fail "the message of a missing licence: $(cat told)"

clean asperity scenes >/dev/null || fail "scenes"
clean asperity run scenes/first-contact.toml --set surface.sites=32 drive.velocity=100 --progress off >first.txt || fail "run"
clean asperity report results/first-contact >/dev/null || fail "report"
[ -s results/first-contact/report.html ] || fail "no report"
clean python3 - <<'END' || fail "asperity in Python"
import asperity
result = asperity.load("results/first-contact")
assert 0.0 < result.binding_energy < result.delta_gamma, result.binding_energy
again = asperity.run("scenes/first-contact.toml", {"surface.sites": 32, "drive.path": "relax"}, out="small")
statics = asperity.Statics("scenes/first-contact.toml", {"surface.sites": 32})
assert again.binding_energy > 0 and statics.relax().contact >= 0
END
clean asperity sweep scenes/first-contact.toml --set surface.sites=32 --set drive.path=relax --set surface.rms=0.5,0.8 \
    --progress off --out swept >/dev/null || fail "sweep"
clean env OMPI_COMM_WORLD_SIZE=2 asperity info >/dev/null 2>told && fail "two ranks"
grep -q "built without MPI" told || fail "two ranks: $(cat told)"
echo "all fine: $wheel"
