#!/bin/sh
# clang-format and clang-tidy (both of LLVM 14, Debian 12's) over the sources; says so where they are not installed.
#   cmake/lint.sh                     clang-format, seconds
#   cmake/lint.sh BUILD [PATTERN]     and clang-tidy, with the compile commands of this directory, which the preset
#                                     `lint` has configured, on the files whose paths fit the pattern, or all (20 s of one
#                                     core each)
set -eu
cd "$(dirname "$0")/.."
for tool in clang-format clang-tidy run-clang-tidy; do
  if ! command -v $tool >/dev/null; then
    echo "lint: skipped, needs the packages clang-format and clang-tidy"
    exit 0
  fi
done
git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
echo 'lint: clang-format is content'
[ $# -gt 0 ] || exit 0
pattern=${2:-(solver|report|validation|fuzz)/}
here=$(printf %s "$PWD" | sed 's/[][(){}.*+?^$|\]/\\&/g') # in a pattern
log=$(mktemp)
trap 'rm -f "$log"' EXIT
tidy() {
  run-clang-tidy -quiet -p "$1" -j "$(nproc)" "^$here/$pattern" || return
  # The fuzzers are in no compile commands but those of clang.
  for file in fuzz/*.cpp; do
    printf '%s\n' "$file" | grep -qE "^$pattern" || continue
    echo "clang-tidy $file"
    clang-tidy -quiet "$file" -- -std=c++20 -Isolver $(pkg-config --cflags eigen3) || return
  done
}
if tidy "$1" >"$log" 2>/dev/null && grep -q '^clang-tidy' "$log"; then
  echo "lint: clang-tidy is content with $(grep -c '^clang-tidy' "$log") files"
else
  grep -E -A 4 '(error|warning):' "$log" || echo "lint: clang-tidy did not come to its end, or '$pattern' fits no file"
  exit 1
fi
