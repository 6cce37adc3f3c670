#!/bin/sh
# What the tests of interrupted and concurrent runs share; read by them with `.`.

# All files of a run but for what tells of the way there.
numbers() {
  for file in "$1"/*; do
    case $file in
    */run.json | */runs.txt) ;;
    *) echo "${file##*/}" && grep -v '_seconds"' "$file" ;;
    esac
  done
}
