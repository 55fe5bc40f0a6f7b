#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# A run that changes between processor and device at its checkpoints, as a user would change it:
# every number of its result is that of a run that never changed.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

export OMP_NUM_THREADS=1 # a small box: a second thread has nothing to win

contact() {
    local code=$1
    shift
    expect "$code" run "$source/scenes/first-contact.toml" --progress off --set surface.sites=16 \
        block.thickness=16 drive.velocity=40 output.trajectory=none "$@"
}
# same A B: all of their results, but for what says where and how fast they were made.
same() {
    python3 - "$1" "$2" <<'EOF' || fail "$1 and $2 differ"
import json, sys

results = []
for directory in sys.argv[1:]:
    with open(directory + "/result.json") as file:
        result = json.load(file)
    for name in ("digest", "run"):
        del result[name]
    del result["scene"]["numerics"]["device"]
    del result["units"]["run"]
    results.append(result)
different = [name for name in results[0].keys() | results[1].keys() if results[0].get(name) != results[1].get(name)]
print("differ:", different) if different else None
sys.exit(bool(different) or len(results[0]) < 10)
EOF
}

if "$asperity" info | grep -qE 'kernels for (portable|v2)'; then
    contact 2 --out refused --set numerics.device=emulated
    says "do not"
    finish
fi
contact 0 --out whole
contact 0 --out changed --set numerics.device=emulated drive.max_steps=700
says "Stopped early"
contact 0 --out changed --resume auto --set numerics.device=none drive.max_steps=1200
contact 0 --out changed --resume auto --set numerics.device=emulated
says "emulated"
same whole changed

finish
