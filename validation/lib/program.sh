#!/bin/sh
# What the tests of the program begin with; read with `.` by a script that was given the program's path. Then $capsule is
# the program, $project the project's directory, and the script is in a directory of its own, which goes with it.
set -eu
capsule=$(realpath "$1")
project=$(cd "$(dirname "$0")/.." && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place"

# Says what is wrong, and what the commands said, as far as it was kept.
fail() {
  echo "FAILED: $*"
  for file in log *.log; do
    [ ! -f "$file" ] || cat "$file"
  done
  exit 1
}
# ends CODE ARGUMENT...: the program does, with this code; what it says goes into log
ends() {
  expected=$1
  shift
  code=0
  "$capsule" "$@" >log 2>&1 || code=$?
  [ "$code" -eq "$expected" ] || fail "'$*' ended with $code, not with $expected"
}
# What a case begins with whose runs are short: a capsule that starts in the mouth.
short_case() {
  cat <<'TOML'
accuracy = 1e-2
capsule.radius = 0.7
capsule.start_x = -1.4
membrane.law = "skalak"
membrane.bending_ratio = 1e-3
flow.capillary_number = 0.05
TOML
}
# All files of a run but for what tells of the way there.
numbers() {
  for file in "$1"/*; do
    case $file in
    */run.json | */runs.txt) ;;
    *) echo "${file##*/}" && grep -v '_seconds"' "$file" ;;
    esac
  done
}
# killed_on_the_way CASE DIRECTORY: the run is killed as soon as there is a checkpoint of a part of the way
killed_on_the_way() {
  "$capsule" run "$1" --out "$2" &
  process=$!
  until "$capsule" show "$1" --out "$2" | grep -q '% done'; do
    kill -0 "$process" || fail 'show does not know the checkpoint'
    sleep 0.05
  done
  kill -9 "$process" || fail 'finished without a checkpoint'
  wait "$process" && fail 'survived being killed'
  [ ! -e "$2/summary.json" ] || fail 'a killed run has a summary'
}
# in_parts CASE DIRECTORY WHOLE PARTS: the run is stopped again and again, after a share of the time that WHOLE took, on any
# machine; each time it gets further
in_parts() {
  limit=$(sed -n 's/.*"wall_seconds": \([0-9.]*\).*/\1/p' "$3/summary.json" | awk -v parts="$4" '{ print 0.1 + $1 / parts }')
  calls=0
  code=130
  while [ "$code" -eq 130 ]; do
    calls=$((calls + 1))
    [ "$calls" -lt 60 ] || fail 'a march does not get further'
    code=0
    "$capsule" run "$1" --out "$2" --time-limit "$limit" || code=$?
    limit=$(echo "$limit" | awk '{ print 1.1 * $1 }') # the machine may be busier than it was for the whole march
  done
  [ "$code" -eq 0 ] && [ "$calls" -gt 2 ] || fail "ended with $code after $calls calls"
}
