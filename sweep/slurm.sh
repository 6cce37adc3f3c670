#!/bin/sh
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
# The runs of a case as jobs on a cluster whose machines share this directory:
#   sweep/slurm.sh CASE [OPTION OF SBATCH]...
# Each job computes one run and leaves it in results/ by its identity. They are submitted as arrays, each as long as the
# cluster allows; submitted again, only what is missing is computed. A failed run fails its job and no other. When all are
# done, `build/capsule run CASE --list` shows how each ended.
# Ends with 0 or the last other code of sbatch: an array that is refused stops no other.
set -eu
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then # in a job: CASE, and how many runs come before its array
  exec build/capsule run "$1" --jobs 1 --only $(($2 + SLURM_ARRAY_TASK_ID))
fi
case=$1
shift
size=$(scontrol show config 2>/dev/null | sed -n 's/^MaxArraySize *= *\([0-9][0-9]*\).*/\1/p')
size=${size:-1001} # Slurm's default; numbers in an array are below it
[ "$size" -gt 1 ] || { echo 'error: this cluster allows no arrays of jobs (MaxArraySize)' >&2 && exit 4; }
runs=$(build/capsule run "$case" --list)
# A line for each array: how many runs come before it, and which of its own are missing, as sbatch takes them: "0:1,4-7".
arrays=$(printf '%s\n' "$runs" | awk -F '\t' -v most=$((size - 1)) '
  function end_range() { if (last > first) missing = missing "-" last }
  function end_array() { if (missing != "") { end_range(); print before + 0 ":" missing } missing = "" }
  $4 == "to be computed" || $4 ~ /% done$/ {
    if ($1 > before + most) { end_array(); before = int(($1 - 1) / most) * most }
    number = $1 - before
    if (missing == "" || number > last + 1) {
      if (missing != "") { end_range(); missing = missing "," }
      missing = missing number
      first = number
    }
    last = number
  }
  END { end_array() }')
[ -n "$arrays" ] || echo 'all runs are computed'
status=0
for array in $arrays; do
  sbatch --array="${array#*:}" "$@" "$0" "$case" "${array%%:*}" || status=$?
done
exit $status
