#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     sbatch docs/slurm/chain.sh SCENE OUT [OPTIONS]
#
# A run that is longer than the queue allows. SLURM sends USR1 some time before the limit; the run
# writes a checkpoint and ends with status 75, and the job goes back to the queue, where it resumes.
#SBATCH --job-name=asperity-chain
#SBATCH --ntasks=2
#SBATCH --cpus-per-task=1
#SBATCH --time=24:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK
scene=$1 out=$2
shift 2
trap 'kill -USR1 "$run"' USR1 # mpirun passes it on to the ranks
mpirun -n "$SLURM_NTASKS" asperity run "$scene" --out "$out" --resume auto "$@" &
run=$!
while kill -0 "$run" 2>/dev/null; do wait "$run"; done # a signal ends wait, not the run
wait "$run"
code=$?
# MPICH's mpirun ends with 0 after a signal. A run that is over has no checkpoint.
[ "$code" -eq 0 ] && [ -e "$out/checkpoint.h5" ] && code=75
[ "$code" -eq 75 ] || exit "$code"
scontrol requeue "$SLURM_JOB_ID"
