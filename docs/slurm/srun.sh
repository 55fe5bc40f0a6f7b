#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     sbatch docs/slurm/srun.sh SCENE [OPTIONS]
#
# One run by srun: two ranks, one a socket, each with eight threads that stay on the cores of its socket. --mem is what
# `asperity plan SCENE --ranks 2` says in all, and a tenth more.
#SBATCH --job-name=asperity
#SBATCH --nodes=1
#SBATCH --ntasks=2
#SBATCH --ntasks-per-socket=1
#SBATCH --cpus-per-task=8
#SBATCH --mem=8G
#SBATCH --time=01:00:00
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK OMP_PLACES=cores OMP_PROC_BIND=close
exec srun --mpi=pmix --cpu-bind=cores --cpus-per-task="$SLURM_CPUS_PER_TASK" asperity run "$@"
