#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     sbatch --array=1-8 docs/slurm/array.sh SCENE OUT [OPTIONS]
#
# Eight realisations of a surface, a job each: seed n is written to OUT/seed-n.
#SBATCH --job-name=asperity-array
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK
scene=$1 out=$2
shift 2
exec asperity run "$scene" --set surface.seed="$SLURM_ARRAY_TASK_ID" --out "$out/seed-$SLURM_ARRAY_TASK_ID" "$@"
