#!/bin/sh
# Runs the fuzzers of build-fuzz/, a share of the seconds each: from the corpus of the tree, the cases, and what earlier
# times have found. A finding ends it with the input in build-fuzz/finding-*.
#   cmake/fuzz.sh SECONDS
set -eu
cd "$(dirname "$0")/.."
targets=$(ls fuzz/fuzz_*.cpp | sed 's/.*fuzz_\(.*\)\.cpp/\1/')
for what in $targets; do
  mkdir -p "build-fuzz/corpus/$what"
done
for file in cases/*/*.toml cases/common.toml; do
  cp "$file" "build-fuzz/corpus/case_file/$(printf %s "$file" | tr / -)"
done
for file in cases/*/expected.csv; do
  cp "$file" "build-fuzz/corpus/expected/$(printf %s "$file" | tr / -)"
done
# Sections and names of the keys, units and quantities, as words to try.
{
  grep -oE '"[a-z_]+"' solver/observe/quantities.cpp
  grep -oE '"[a-z_]+\.[a-z_]+"' solver/case/keys.cpp | sed 's/\./"\n"/'
  grep -oE '\{"[a-zA-Z]+", -?[0-9]' solver/case/units.cpp | grep -oE '"[a-zA-Z]+"'
} | sort -u >build-fuzz/words.dict
for what in $targets; do
  echo "fuzz_$what:"
  build-fuzz/fuzz_$what -max_total_time="$(($1 / $(echo "$targets" | wc -l)))" -max_len=4096 -timeout=120 -rss_limit_mb=4096 -verbosity=0 -print_final_stats=1 \
    -dict=build-fuzz/words.dict -artifact_prefix=build-fuzz/finding- build-fuzz/corpus/$what fuzz/corpus/$what
done
