#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     others.sh PROGRAM
#
# Maps of heights against SurfaceTopography, exports against ASE, OVITO, MDAnalysis and VTK. The packages go
# into the virtual environment $ASPERITY_OTHERS, made if it is not there (default: a temporary one). Exit
# code 77: they cannot be installed.
set -u
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
place=${ASPERITY_OTHERS:-}
if [ -z "$place" ]; then
    place=$(mktemp -d "${TMPDIR:-/tmp}/asperity-others.XXXXXX") || exit 1
    trap 'rm -rf -- "$place"' EXIT
fi
if [ ! -x "$place/bin/pytest" ]; then
    /usr/bin/env python3 -m venv "$place" || { echo "skipped: no virtual environment"; exit 77; }
    "$place/bin/pip" install --quiet pytest numpy h5py matplotlib jinja2 SurfaceTopography gwyfile ase MDAnalysis vtk ovito ||
        { echo "skipped: PyPI is out of reach"; exit 77; }
fi
export ASPERITY_PROGRAM=$1 ASPERITY_PYTHON=$place/bin/python3 OMP_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH VIRTUAL_ENV
"$place/bin/pytest" -q -p no:cacheprovider -W ignore::DeprecationWarning "$here/test_convert.py" "$here/test_viewers.py"
