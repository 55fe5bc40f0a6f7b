#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# docs/slurm/chain.sh as SLURM runs it, around the launcher of this build and around stand-ins: it puts its job
# back into the queue as long as the run is not over, whatever the launcher makes of status 75.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
if [ ${#mpirun[@]} -eq 0 ]; then
    echo "there is no mpirun"
    exit 77
fi
mpirun[0]=$(command -v "${mpirun[0]}")

mkdir bin
stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"bin/$1" && chmod +x "bin/$1"; }
stand_in scontrol "echo \"\$*\" >>'$work/calls'"
ln -s "$asperity" bin/asperity
export PATH="$work/bin:$PATH" SLURM_JOB_ID=7 SLURM_NTASKS=2 SLURM_CPUS_PER_TASK=1
cat >scene.toml <<'END'
surface = { sites = 16, rms = 0.8 }
block = { thickness = 16 }
drive = { velocity = 3, timestep = 20 } # more than a second: it is stopped on its way
END
chain() { # CODE REQUEUES WHAT: starts the job, with USR1 as soon as the run records, if it is to stop
    : >calls
    bash "$source/docs/slurm/chain.sh" scene.toml out --progress off >said 2>&1 &
    local job=$! code
    if [ "$2" -gt 0 ]; then
        until [ -s out/run.journal ] || ! kill -0 $job 2>/dev/null; do sleep 0.05; done
        kill -USR1 $job
    fi
    wait $job
    code=$?
    [ $code -eq "$1" ] || fail "$3: status $code, not $1: $(cat said)"
    [ "$(grep -c '^requeue 7$' calls)" = "$2" ] || fail "$3: not $2 times back into the queue: $(cat said)"
}

# The launcher that is here. (It shall not take this for a job of SLURM.)
stand_in mpirun "exec env -u SLURM_JOB_ID -u SLURM_NTASKS -u SLURM_CPUS_PER_TASK $(printf '%q ' "${mpirun[@]}") \"\$@\""
chain 0 1 "a run that is stopped"
[ -e out/checkpoint.h5 ] || fail "a run that is stopped leaves no checkpoint"
chain 0 0 "a run that is over"
if [ ! -e out/result.json ] || [ -e out/checkpoint.h5 ]; then fail "the second job does not end the run: $(ls out)"; fi

# What launchers end with.
for code in 0 75; do
    rm -rf out
    stand_in mpirun "trap 'touch out/checkpoint.h5; exit $code' USR1; mkdir -p out; sleep 0.2; echo x >out/run.journal
        for ((i = 0; i < 600; i++)); do sleep 0.05; done"
    chain 0 1 "a launcher that ends with $code"
done
rm -rf out
stand_in mpirun "exit 3"
chain 3 0 "a run that fails"
finish
