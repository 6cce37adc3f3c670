#!/bin/sh
# Configures a build directory by its preset where that is still to be done, or where the presets are newer. One that came
# with a copy of the tree, or from where the tree lay before, belongs to the other place and would build there: it is
# configured anew.
#   cmake/configure.sh PRESET DIRECTORY
set -eu
cd "$(dirname "$0")/.."
home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$2/CMakeCache.txt" 2>/dev/null || true)
if [ -n "$home" ] && ! [ "$home" -ef . ]; then
  echo "$2 belongs to $home: configured anew"
  exec cmake --fresh --preset "$1"
fi
if ! [ -e "$2/build.ninja" ] || [ CMakePresets.json -nt "$2/CMakeCache.txt" ]; then
  exec cmake --preset "$1"
fi
