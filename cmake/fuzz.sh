#!/bin/sh
# Runs the fuzzers of build-fuzz/, half of the seconds each: from the corpus of the tree, the cases, and what earlier
# times have found. A finding ends it with the input in build-fuzz/finding-*.
#   cmake/fuzz.sh SECONDS
set -eu
cd "$(dirname "$0")/.."
mkdir -p build-fuzz/corpus/case_file build-fuzz/corpus/set
for file in cases/*/*.toml cases/common.toml; do
  cp "$file" "build-fuzz/corpus/case_file/$(printf %s "$file" | tr / -)"
done
# Sections and names of the keys, and units, as words to try.
{
  grep -oE '"[a-z_]+\.[a-z_]+"' solver/case/keys.cpp | sed 's/\./"\n"/'
  grep -oE '\{"[a-zA-Z]+", -?[0-9]' solver/case/units.cpp | grep -oE '"[a-zA-Z]+"'
} | sort -u >build-fuzz/words.dict
for what in case_file set; do
  echo "fuzz_$what:"
  build-fuzz/fuzz_$what -max_total_time="$(($1 / 2))" -max_len=4096 -timeout=120 -rss_limit_mb=4096 -verbosity=0 -print_final_stats=1 \
    -dict=build-fuzz/words.dict -artifact_prefix=build-fuzz/finding- build-fuzz/corpus/$what fuzz/corpus/$what
done
