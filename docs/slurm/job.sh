#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     sbatch docs/slurm/job.sh SCENE [OPTIONS]
#
# One run: two ranks of one thread each.
#SBATCH --job-name=asperity
#SBATCH --ntasks=2
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK
exec mpirun -n "$SLURM_NTASKS" asperity run "$@"
