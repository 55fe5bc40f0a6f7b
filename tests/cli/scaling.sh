#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     scaling.sh BUILD SOURCE
#
# A short scaling study on two cores. It fails if it cannot run, or if ranks or threads change a number; how fast
# anything is decides nothing. Its tables are left in BUILD/scaling.txt, which .ci/run prints.
set -u -o pipefail
if ! command -v "${ASPERITY_MPIRUN%% *}" >/dev/null; then
    echo "mpirun is not installed: no scaling study"
    exit 77
fi
rm -f "$1/scaling.txt"
"${ASPERITY_PYTHON:-/usr/bin/python3}" "$2/perf/suite.py" --build "$1" --study >"$1/scaling.part" || exit 1
grep -q '128  *contact  *2 x 1' "$1/scaling.part" || { echo "no table:"; cat "$1/scaling.part"; exit 1; }
mv "$1/scaling.part" "$1/scaling.txt"
cat "$1/scaling.txt"
