#!/bin/sh
# solver/ keeps its order: the folders stand in solver/README.md in the order in which data flows. No file includes
# one of a later folder, motion and steady do not include each other, no modules include each other in a circle. No
# module (.hpp and .cpp) but those of paper/ is longer than 450 lines, and few headers know the whole case.
set -eu
cd "$(dirname "$0")/../solver"
most_lines=450
most_headers=8 # that include case/case.hpp
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n 's/^| `\([a-z]*\)` .*/\1/p' README.md >"$work/order"
find . -name '*.?pp' | sed 's,^\./,,' | grep -vE '^(test|tool|benchmark)/' | sort >"$work/files"

{
  sed 's,/.*,,' "$work/files" | sort -u | grep -vxF -f "$work/order" |
    sed 's|.*|solver/&: README.md names no such folder|'

  # A line for each include: the file, what it includes, and their folders' places in the order.
  xargs grep -H '^#include "' <"$work/files" | sed 's,:#include "\([^"]*\)".*, \1,' |
    awk -v order="$work/order" '
      BEGIN { while ((getline folder < order) > 0) place[folder] = ++count }
      { split($1, from, "/"); split($2, to, "/"); print $1, $2, place[from[1]] + 0, place[to[1]] + 0 }
    ' >"$work/includes"
  awk '$4 > $3 || $4 == 0 { print $1 " includes " $2 ", which comes later" }
       $1 ~ /^steady/ && $2 ~ /^motion/ { print $1 " includes " $2 ": steady states and marches stand side by side" }
      ' "$work/includes"
  awk '{ sub(/\.[ch]pp$/, "", $1); sub(/\.[ch]pp$/, "", $2) } $1 != $2 { print $1, $2 }' "$work/includes" |
    tsort 2>&1 >/dev/null | sed 's,^tsort: -: input contains a loop:,modules that include each other:,; s,^tsort: ,  ,'

  while read -r file; do echo "${file%.?pp} $(wc -l <"$file")"; done <"$work/files" |
    awk -v most="$most_lines" '{ lines[$1] += $2 } END { for (module in lines)
      if (lines[module] > most && module !~ /^paper\//)
        print module " has " lines[module] " lines, more than " most }' | sort

  grep '\.hpp case/case\.hpp ' "$work/includes" | awk -v most="$most_headers" '{ list = list " " $1 }
    END { if (NR > most) print NR " headers include case/case.hpp, more than " most ":" list }'
} >"$work/wrong"

cat "$work/wrong"
[ -s "$work/wrong" ] && exit 1
echo "the folders of solver/ keep their order"
