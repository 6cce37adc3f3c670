#!/bin/sh
# Runs the fuzzers of build-fuzz/, half of the seconds each: from the corpus of the tree, the cases, and what earlier
# times have found. A finding ends it with the input in build-fuzz/finding-*.
#   cmake/fuzz.sh SECONDS
set -eu
cd "$(dirname "$0")/.."
mkdir -p build-fuzz/corpus/case_file build-fuzz/corpus/set
for file in cases/*/*.toml cases/common.toml; do
  cp "$file" "build-fuzz/corpus/case_file/$(echo "$file" | tr / -)"
done
# Sections and names of the keys, and units, as words to try.
{
  sed -n 's/^ *{"\([a-z_]*\)\.\([a-z_]*\)",.*/"\1"\n"\2"/p' solver/case/key.cpp
  sed -n 's/.*{"\([a-zA-Z]\+\)", -\?[0-9].*/"\1"/p' solver/case/units.cpp
} | sort -u >build-fuzz/words.dict
for what in case_file set; do
  echo "fuzz_$what:"
  build-fuzz/fuzz_$what -max_total_time=$(($1 / 2)) -max_len=4096 -timeout=120 -rss_limit_mb=4096 -verbosity=0 -print_final_stats=1 \
    -dict=build-fuzz/words.dict -artifact_prefix=build-fuzz/finding- build-fuzz/corpus/$what fuzz/corpus/$what
done
