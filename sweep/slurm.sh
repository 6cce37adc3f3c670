#!/bin/sh
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
# The runs of a case as an array of jobs on a cluster whose machines share this directory:
#   sweep/slurm.sh CASE [OPTION OF SBATCH]...
# Each job computes one run and leaves it in results/ by its identity; submitted again, only what is missing is
# computed. A failed run fails its job and no other. When all are done, `build/capsule run CASE --list` shows how each
# ended.
set -eu
if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
  case=$1
  shift
  runs=$(build/capsule run "$case" --list | wc -l)
  exec sbatch --array="1-$runs" "$@" "$0" "$case"
fi
exec build/capsule run "$1" --jobs 1 --only "$SLURM_ARRAY_TASK_ID"
