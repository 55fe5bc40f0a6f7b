#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The paper's second explanation for adhesion beyond its theory, "the small system size", put to the test: states at zero
# load in boxes of 128 to 1024 sites, each beside the theory of its own surface's spectrum. Half an hour on one
# core. Started again, it goes on.
#
#     scenes/paper/finite-size.sh results/finite-size
#
# One row a point in finite-size.csv.
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/finite-size}

size() { # NAME SITES ROLLOFF ROUGHNESSES SEEDS
    "$root/asperity" sweep "$root/scenes/paper/finite-size.toml" --out "$place/$1" --progress off --set \
        surface.sites="$2" block.thickness="$2" surface.rolloff="$3" surface.seed="$5" surface.rms="$4"
}
# The paper's rule q0 = 3 q_L in every box, at the theta = E* h² q0 / Δγ of its 3 and 6 Å: h grows as the root of the
# width, against an interaction that keeps its reach.
size scaled-128 128 3 1.5,3 1,2,3,4,5,6
size scaled-256 256 3 2.1213,4.2426 1,2,3,4
size scaled-512 512 3 3,6 1,2,3
# The paper's roughness in a narrower and a wider box: the same wavevectors in 1/Å, fewer and more of each.
size same-256 256 1.5 3,6 1,2,3,4
size same-1024 1024 6 3,6 1,2,3

awk 'FNR == 1 { n = split(FILENAME, part, "/"); if (NR == 1) print "variant," $0; next }
     { print part[n - 1] "," $0 }' "$place"/*/sweep.csv >"$place/finite-size.csv"
