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
