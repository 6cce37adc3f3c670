#!/bin/sh
# cases/README.md's map of figures, cases and runs says what the cases of the paper say.
#   sh validation/case_map.sh path/to/capsule
set -eu
capsule=$(realpath "$1")
cd "$(dirname "$0")/.."
failures=0
for directory in cases/*/; do
  [ -e "$directory/case.toml" ] || continue
  id=$(basename "$directory")
  paper=$(sed -n 's/^paper = "\(.*\)"$/\1/p' "cases/$id/case.toml")
  runs=$("$capsule" show "cases/$id" | sed -n 's/^# \([0-9]*\) runs*, .*/\1/p')
  if [ -n "$paper" ] && ! grep -Fq "| $paper | \`cases/$id\` | $runs" cases/README.md; then
    echo "cases/README.md has no row '| $paper | \`cases/$id\` | $runs ...'"
    failures=$((failures + 1))
  fi
  [ -s "cases/$id/README.md" ] || { echo "cases/$id has no README.md"; failures=$((failures + 1)); }
done
[ "$failures" -eq 0 ] && echo "the map is that of the cases"
exit "$failures"
