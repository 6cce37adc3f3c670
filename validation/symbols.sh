#!/bin/sh
# The symbols that the README's table names are those of the program's keys.
#   sh validation/symbols.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
ends 0 keys
awk -F'[|`]' '
  NR == FNR { if (/^[a-z]/) key = $1; sub(/ .*/, "", key); if (/^ *symbol: /) symbols[key] = $0 ","; next }
  /^\| symbol \|/ { inside = 1; next }
  inside && !/^\|/ { inside = 0 }
  inside && !/---/ {
    gsub(/ /, "", $2)
    ++rows
    if (!index(symbols[$(NF - 2)], " " $2 ",")) { print $2 " is no symbol of " $(NF - 2); wrong = 1 }
  }
  END { exit wrong || rows < 7 }' log "$project/README.md" || fail 'symbols'
echo 'the symbols of the README are those of the keys'
