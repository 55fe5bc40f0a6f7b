#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The paper's first explanation for adhesion beyond its theory, "the long range wall-wall interaction", put to the test:
# states at zero load of 256 x 256 sites under interactions of different reach that all bind flat surfaces with
# the same 98.863 meV/Å². The same three surfaces under all of them; some minutes
# on one core. Started again, it goes on.
#
#     scenes/paper/long-range.sh results/long-range
#
# The work of flat surfaces is proportional to epsilon, so epsilon is 0.1 eV x 98.8633 over their work at 0.1 eV (`asperity theory`
# prints it). One row a point in long-range.csv.
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/long-range}

variant() { # NAME r0 CUTOFF TAIL EPSILON FRICTIONLESS
    "$root/asperity" sweep "$root/scenes/paper/long-range.toml" --out "$place/$1" --progress off --set \
        interface.r0="$2" interface.cutoff="$3" interface.tail="$4" interface.epsilon="$5" \
        interface.frictionless="$6"
}
# How far the attraction reaches: what is beyond 2.5 to 8 r0 is left out.
variant cutoff-2.5 3.28 8.2 false 0.1096690352 false
variant cutoff-4 3.28 13.12 false 0.1 false
variant cutoff-8 3.28 26.24 false 0.0984464054 false
# The whole potential narrower and wider, cut at 4 r0.
variant range-2.46 2.46 9.84 false 0.1367232248 false
variant range-4.92 4.92 19.68 false 0.0499503807 false
# The same without lateral forces, as in the theory.
variant frictionless-2.46 2.46 9.84 false 0.1367232248 true
variant frictionless-3.28 3.28 13.12 false 0.1 true
variant frictionless-4.92 4.92 19.68 false 0.0499503807 true
# Without an end: what lies beyond 4 r0 as a continuum.
variant tail-4 3.28 13.12 true 0.0983405288 false

awk 'FNR == 1 { n = split(FILENAME, part, "/"); if (NR == 1) print "variant," $0; next }
     { print part[n - 1] "," $0 }' "$place"/*/sweep.csv >"$place/long-range.csv"
