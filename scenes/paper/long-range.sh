#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The paper's first explanation for adhesion beyond its theory, "the long range wall-wall interaction", put to the test:
# states at zero load of 256 x 256 sites under interactions of different reach that all bind flat surfaces with
# the same 98.863 meV/Å². Three surfaces each; an hour on one core. Started again, it goes on.
#
#     scenes/paper/long-range.sh results/long-range
#
# The work of flat surfaces is proportional to epsilon, so epsilon is 0.1 eV x 98.8633 over their work at 0.1 eV (`asperity theory`
# prints it). One row a point in long-range.csv.
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/long-range}

variant() { # NAME r0 CUTOFF TAIL EPSILON FRICTIONLESS
    "$root/asperity" sweep "$root/scenes/paper/fig2-equilibrium.toml" --out "$place/$1" --progress off --set \
        surface.sites=256 block.thickness=256 surface.rms=3,4.5,6 surface.seed=1,2,3 \
        interface.r0="$2" interface.cutoff="$3" interface.tail="$4" interface.epsilon="$5" \
        interface.frictionless="$6"
}
# How far the attraction reaches: what is beyond 2.5 to 8 r0 is left out, or added as a continuum.
variant cutoff-4 3.28 13.12 false 0.1 false
variant cutoff-2.5 3.28 8.2 false 0.1096690348 false
variant cutoff-3 3.28 9.84 false 0.1036718151 false
variant cutoff-6 3.28 19.68 false 0.0986719866 false
variant cutoff-8 3.28 26.24 false 0.0984464050 false
variant tail-2.5 3.28 8.2 true 0.0984826209 false
variant tail-4 3.28 13.12 true 0.0983405283 false
# The whole potential wider and narrower, cut at 4 r0; with lateral forces and without.
variant range-2.46 2.46 9.84 false 0.1367232240 false
variant range-2.87 2.87 11.48 false 0.1183153116 false
variant range-4.1 4.1 16.4 false 0.0700002251 false
variant range-4.92 4.92 19.68 false 0.0499503803 false
variant frictionless-2.46 2.46 9.84 false 0.1367232240 true
variant frictionless-3.28 3.28 13.12 false 0.1 true
variant frictionless-4.92 4.92 19.68 false 0.0499503803 true

awk 'FNR == 1 { n = split(FILENAME, part, "/"); if (NR == 1) print "variant," $0; next }
     { print part[n - 1] "," $0 }' "$place"/*/sweep.csv >"$place/long-range.csv"
