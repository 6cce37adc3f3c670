#!/bin/sh
# The directories of FOLDER that hold a file which fits PATTERN, by their names, one a line. A name that targets, tests and
# files cannot be made of is left out, and that is said on standard error. CMake's own lists cannot be trusted with
# names: a bracket, a semicolon or a quotation mark in one of them would spoil all.
#   sh cmake/names.sh FOLDER PATTERN     in the project's directory
set -eu
LC_ALL=C # letters are those of ASCII
export LC_ALL
folder=$1
pattern=$2
for directory in "$folder"/* "$folder"/.[!.]*; do
  # shellcheck disable=SC2086 # the pattern's stars are meant
  set -- "$directory"/$pattern
  [ -e "$1" ] || continue
  name=${directory#"$folder"/}
  case $name in
  *[!A-Za-z0-9._-]* | [.-]*) why="a name is made of letters, digits, '-', '_' and '.', and begins with neither '-' nor '.'" ;;
  *)
    [ ${#name} -gt 100 ] || {
      echo "$name"
      continue
    }
    why='a name has at most 100 characters'
    ;;
  esac
  printf '%s is left out: %s\n' "$(printf %s "$directory" | tr '[:cntrl:]' '?')" "$why" >&2
done
