#!/bin/sh
# The runs of a case shared out by GNU parallel, on this machine or on several:
#   sweep/parallel.sh CASE [JOBS [SSHLOGIN]]
# JOBS runs at a time and machine (default: its cores). SSHLOGIN is parallel's list of machines, "one,two,:" (":" is
# this one); each needs the project built from the same commit in a directory of the same name. What they compute comes
# back into results/runs by its identity, where the last line finds it: run again after an interruption, only what is
# missing is computed. A failed run is listed and stops no other; it is a result, and kept.
set -eu
case=$1
jobs=${2:-100%}
capsule=build/capsule
[ $# -lt 3 ] || set -- "$case" "$jobs" "$3" --sshlogin "$3" --return results/runs/{3}
shift $(($# < 3 ? $# : 3))

"$capsule" run "$case" --list |
  parallel --will-cite --colsep '\t' --jobs "$jobs" --workdir "$PWD" "$@" \
    "$capsule" run "$case" --jobs 1 --only {1} ||
  echo "some runs failed or were interrupted:"
"$capsule" run "$case" --list
exec "$capsule" run "$case" --jobs 1
