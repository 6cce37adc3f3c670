#!/bin/sh
# The runs of a case shared out by GNU parallel, on this machine or on several:
#   sweep/parallel.sh CASE [JOBS [SSHLOGIN]]
# JOBS runs at a time and machine (default: its cores). SSHLOGIN is parallel's list of machines, "one,two,:" (":" is
# this one); each needs rsync and the project built from the same commit in a directory of the same name. What they
# compute comes back into results/runs by its identity, where the last line finds it: run again after an interruption,
# only what is missing is computed. A failed run is listed and stops no other; it is a result, and kept.
# Ends as `capsule run` does if all runs are there; otherwise they are listed, and it ends with 130, or with 4 if the jobs
# have computed none.
set -eu
SWEEP_CASE=$1 # from the environment no shell reads it as anything but a name, here and elsewhere
export SWEEP_CASE
jobs=${2:-100%}
[ $# -lt 3 ] || set -- "$1" "$jobs" --sshlogin "$3" --env SWEEP_CASE --workdir "$PWD" --return 'results/runs/{3}'
shift $(($# < 2 ? $# : 2))
unfinished() {
  runs=$(build/capsule run "$SWEEP_CASE" --list)
  missing=$(printf '%s\n' "$runs" | awk -F '\t' '$4 == "to be computed" || $4 ~ /% done$/')
}

unfinished
before=$missing
if [ -n "$before" ]; then
  # One signal for all jobs, and time to leave a checkpoint: parallel is out of the terminal's reach.
  interrupted=
  trap 'interrupted=yes; trap "" INT TERM HUP; kill -TERM "$parallel"' INT TERM HUP
  printf '%s\n' "$before" |
    setsid parallel --will-cite --colsep '\t' --jobs "$jobs" --termseq TERM,60000,KILL,100 "$@" \
      'build/capsule run "$SWEEP_CASE" --jobs 1 --only {1}' &
  parallel=$!
  while kill -0 "$parallel" 2>/dev/null; do wait "$parallel" || true; done
  unfinished
  if [ -n "$missing" ]; then
    printf '%s\n' "$missing"
    count=$(printf '%s\n' "$missing" | wc -l)
    all=$(printf '%s\n' "$runs" | wc -l)
    if [ -z "$interrupted" ] && [ "$missing" = "$before" ]; then
      echo "error: no job has computed anything: $count of $all runs are to be computed" >&2
      exit 4
    fi
    echo "interrupted: $count of $all runs to finish; the same command goes on" >&2
    exit 130
  fi
  trap - INT TERM HUP
fi
exec build/capsule run "$SWEEP_CASE" --jobs 1
