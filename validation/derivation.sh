#!/bin/sh
# paper-notes/equations.md speaks of functions, files and tests that are there.
set -eu
cd "$(dirname "$0")/.."
failures=0
# `Wall::response`, `membrane.cpp`: every word that is a name in C++ or the start of a file's name.
for name in $(grep -o '`[A-Za-z_:.]*`' paper-notes/equations.md | tr -d '`' | sed 's/::/ /g' | tr ' ' '\n' | sort -u); do
  case $name in
    *...) name=${name%...}; grep -rqE "\b$name" solver && continue ;;
    *.*) [ -n "$(find solver -name "$name")" ] || [ -e "paper-notes/$name" ] || grep -rqF "\"$name\"" solver && continue ;;
    *) grep -rqwF "$name" solver && continue ;;
  esac
  echo "paper-notes/equations.md speaks of '$name', which is not in solver/"
  failures=$((failures + 1))
done
[ "$failures" -eq 0 ] && echo "the derivation speaks of what is there"
exit "$failures"
