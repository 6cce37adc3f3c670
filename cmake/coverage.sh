#!/bin/sh
# Which lines of solver/ the unit tests and the quick tests of the program run, from a build by the preset `coverage`.
# Prints the share for each file, and writes the lines that nothing runs to build-coverage/not-run.txt.
#   cmake/coverage.sh            fails below 90 %
set -eu
cd "$(dirname "$0")/.."
build=$PWD/build-coverage
find "$build" -name '*.gcda' -delete
ctest --test-dir "$build" -j2 --output-on-failure -L unit
ctest --test-dir "$build" -j2 --output-on-failure \
  -R '^(bad_input|branch|case_map|case-fig01-geometry|new_case|resume|same_bytes|sweep|two_at_once|verdicts)$'

# One file of counts for each source in each object; a line of a header counts as run if it was in any of them.
rm -rf "$build/counts"
mkdir "$build/counts"
cd "$build" # from where the compiler saw the sources
find CMakeFiles/solver.dir CMakeFiles/quickly.dir CMakeFiles/capsule.dir CMakeFiles/test_*.dir -name '*.gcda' \
  -exec gcov --long-file-names --preserve-paths {} \; >/dev/null 2>&1
mv ./*.gcov counts
awk -F: '
  $2 + 0 == 0 { if ($3 == "Source") source = substr($0, index($0, "Source:") + 7); next }
  source !~ /\/solver\/[a-z]*\/[^\/]*\.[ch]pp$/ || source ~ /\/solver\/(test|tool|benchmark)\// { next }
  { gsub(/ /, "", $1); sub(/^.*\/solver\//, "", source) ; source = "/solver/" source }
  $1 == "-" { next }
  { line = source ":" $2 + 0; lines[line] = source; if ($1 + 0 > 0) run[line] = 1 }
  END {
    for (line in lines) {
      file = substr(lines[line], 9)
      ++all[file]; ++total
      if (line in run) { ++done[file]; ++total_run } else print substr(line, 9) > "not-run.txt"
    }
    for (file in all) printf "%6.1f %% of %4d  %s\n", 100 * done[file] / all[file], all[file], file | "sort -n"
    close("sort -n")
    printf "%6.1f %% of %4d  all\n", 100 * total_run / total, total
    exit !(total_run > 0 && total_run >= 0.9 * total)
  }' counts/*.gcov
