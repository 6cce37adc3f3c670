#!/bin/sh
# Writes figures/gallery.md: the figures and tables of the given cases in the order of the paper, then those of other
# cases, and how they compare.
# Pictures of cases and studies that are no longer there go, and their tables are named.
#   sh cmake/gallery.sh <case> ...     in the project's directory
set -eu
is_of_the_paper() { # a case
  grep -qs '^paper *= *"..*"' "cases/$1/case.toml"
}
show() { # a figure, by its caption's file
  name=$(basename "$(dirname "$1")")
  echo
  cat "$1"
  printf '\nData: [results/%s](../results/%s)\n' "$name" "$name"
}
for directory in figures/*/; do
  id=$(basename "$directory")
  [ -d "cases/$id" ] || [ -d "validation/$id" ] || {
    rm -f "$directory"*.svg "$directory"*.png "$directory"*.md
    rmdir "$directory" 2>/dev/null || true # somebody else's
  }
done
{
  echo '# Figures and tables'
  for id in "$@"; do
    is_of_the_paper "$id" || continue
    for file in figures/"$id"/*.md; do
      [ ! -e "$file" ] || echo "$(basename "$file") $file"
    done
  done | sort | while read -r _ file; do show "$file"; done
  for file in tables/table[0-9].md; do
    [ -e "$file" ] || continue
    number=${file#tables/table}
    printf '\n## Table %s, computed beside published\n\n' "${number%.md}"
    cat "$file"
  done
  for id in "$@"; do
    [ -d "figures/$id" ] && ! is_of_the_paper "$id" || continue
    printf '\n## %s\n' "$id"
    for file in figures/"$id"/*.md; do
      [ ! -e "$file" ] || show "$file"
    done
  done
  printf '\n# Comparisons\n'
  for id in "$@"; do
    [ -s "tables/$id.md" ] || continue
    printf '\n## %s\n\n' "$id"
    cat "tables/$id.md"
  done
  if [ -s tables/ledger.md ]; then
    printf '\n# The claims of the paper\n\n'
    cat tables/ledger.md
  fi
} >figures/gallery.md
sh cmake/orphans.sh
