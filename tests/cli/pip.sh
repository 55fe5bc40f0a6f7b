#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     pip.sh SOURCE BUILD
#
# `pip install .` in fresh virtual environments: with the module, which is the program as well, and the package alone
# with the program of BUILD. Exit code 77: PyPI is out of reach.
set -u
source=$(cd -- "$1" && pwd)
build=$(cd -- "$2" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/asperity-pip.XXXXXX") || exit 1
trap 'rm -rf -- "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
export TMPDIR=$work # pip builds in there
unset PYTHONPATH ASPERITY_PROGRAM ASPERITY_PYTHON VIRTUAL_ENV
export OMP_NUM_THREADS=1 MPLBACKEND=agg

# The sources as a release has them: what git tracks.
mkdir "$work/source"
git -C "$source" ls-files -z | (cd "$source" && xargs -0 cp --parents -t "$work/source")
cd "$work" || exit 1
read -ra mpirun <<<"${ASPERITY_MPIRUN:-mpirun --oversubscribe --allow-run-as-root --bind-to none}"
cat >scene.toml <<'END'
surface = { sites = 24, rms = 0.8 }
drive = { path = ["relax"] }
END

environment() { # environment NAME OPTION...: $work/NAME with the package
    /usr/bin/env python3 -m venv "$1" || fail "no virtual environment"
    "$1/bin/pip" download --quiet --no-deps --dest "$work/wheels" scikit-build-core pybind11 >/dev/null 2>&1 || { echo "skipped: no PyPI"; exit 77; }
    "$1/bin/pip" install --quiet "${@:2}" ./source >"$1.log" 2>&1 || fail "pip install ($1): $(tail -n 15 "$1.log")"
}

# Built by pip. Its program is the environment's own python3, active or not.
environment built
[ -x built/bin/asperity ] || fail "pip installed no program"
built/bin/asperity run scene.toml --out one --progress off >/dev/null || fail "run"
"${mpirun[@]}" -n 2 built/bin/asperity run scene.toml --out ranks --progress off >/dev/null || fail "run on two ranks"
built/bin/asperity sweep scene.toml --set surface.rms=0.5,0.8 --jobs 2 --out two >/dev/null || fail "sweep"
built/bin/asperity report one >/dev/null || fail "report"
[ -s one/report.html ] || fail "no report"
built/bin/python3 - <<'END' || fail "asperity in Python"
import os
import sys
import asperity
import asperity.running.program
from importlib.metadata import version
assert asperity.__file__.startswith(sys.prefix), asperity.__file__
assert os.path.samefile(asperity.running.program.path(), sys.prefix + "/bin/asperity"), asperity.running.program.path()
assert asperity.running.program.call(["--version"]).split()[1] == version("asperity")
one = asperity.load("one")
ranks = asperity.load("ranks")
assert ranks.run["ranks"] == 2 and ranks.binding_energy == one.binding_energy
again = asperity.run("scene.toml", out="again")
assert one.binding_energy == again.binding_energy > 0
statics = asperity.Statics("scene.toml")
statics.load = 0.0
assert statics.relax().contact > 0.0 and sys.modules["asperity._engine"].__file__.startswith(sys.prefix)
END
built/bin/pip uninstall --quiet --yes asperity || fail "uninstall"
[ ! -e built/bin/asperity ] || fail "the program stays after pip uninstall"

# The package alone, with a program that is there already.
environment alone --config-settings=wheel.cmake=false
if PATH=/usr/bin:/bin alone/bin/python3 -c 'import asperity; asperity.run("scene.toml", out="lost")' 2>lost.log; then
    [ -x /usr/bin/asperity ] || fail "a program was found where none is"
else
    grep -q "set ASPERITY_PROGRAM" lost.log || fail "the message without a program: $(tail -n 3 lost.log)"
fi
ASPERITY_PROGRAM=$build/engine/asperity alone/bin/python3 -c 'import asperity
assert asperity.run("scene.toml", out="found").binding_energy == asperity.load("one").binding_energy' || fail "the package alone"
echo "all fine"
