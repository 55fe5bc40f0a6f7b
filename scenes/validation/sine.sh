#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The adhesive sine wave (Johnson 1995): states of a frictionless spectral block over h cos(2πx/λ), λ the box, for several
# α = √(2wλ/(π²E*h²)), w the flat reference. Contact fraction and binding energy at zero load, beside the closed forms of
# docs/reports/validation.md; and the contact fraction under load, p over p* = πE*h/λ, at α = 0.3.
#
#     scenes/validation/sine.sh results/sine [sites ...]      # 128 256: half a minute; 512: a minute more
#
# Results that are there are neither read nor written over: name another directory.
set -eu
root=$(cd -- "$(dirname "$0")/../.." && pwd)
place=${1:-results/sine}
shift || true
[ $# -gt 0 ] || set -- 128 256
mkdir -p "$place"
table=$place/sine.csv

number() { sed -n "s/^ *\"$2\": \([-0-9.e+]*\),\?$/\1/p" "$1" | head -n 1; }

# point SITES ALPHA LOAD/p*
point() {
    local name=$1-$2-$3 amplitude rms load
    amplitude=$(awk -v n="$1" -v alpha="$2" 'BEGIN { pi = atan2(0, -1); E = 77.2 / 160.21766 / (1 - 0.42 ^ 2)
        print sqrt(2 * 0.0988633 * n * 2.6 / (pi * pi * E)) / alpha }')
    rms=$(awk -v h="$amplitude" 'BEGIN { print h / sqrt(2) }')
    load=$(awk -v n="$1" -v h="$amplitude" -v p="$3" 'BEGIN { print p * atan2(0, -1) * 77200 / (1 - 0.42 ^ 2) * h / (n * 2.6) }')
    awk -v n="$1" -v h="$amplitude" 'BEGIN { for (i = 0; i < n; i++) row = row sprintf("%.8f ", h * cos(2 * atan2(0, -1) * i / n))
        for (j = 0; j < n; j++) print row }' >"$place/$name.txt"
    "$root/asperity" run "$root/scenes/paper/flat-3A.toml" --progress off --out "$place/$name" \
        --set numerics.precision=double drive.path=relax interface.frictionless=true output.checkpoint=none surface.kind=file \
        surface.file="$(realpath "$place/$name.txt")" surface.rms="$rms" surface.sites="$1" block.thickness="$1" drive.load="$load" >/dev/null
    rm "$place/$name.txt"
    echo "$1,$2,$3,$(number "$place/$name/result.json" contact_fraction),$(number "$place/$name/result.json" binding_energy)" | tee -a "$table"
}

echo "sites,alpha,load,contact_fraction,binding_energy" | tee "$table"
for sites in "$@"; do
    for alpha in 0.2 0.3 0.4 0.5; do point "$sites" $alpha 0; done
    for load in -0.08 -0.04 0.1 0.2 0.3; do point "$sites" 0.3 $load; done
done
