#!/bin/sh
# Writes figures/gallery.md: the figures and tables of the given cases in the order of the paper, and how they compare.
# Pictures of cases and studies that are no longer there go.
#   sh cmake/gallery.sh <case> ...     in the project's directory
set -eu
for directory in figures/*/; do
  id=$(basename "$directory")
  [ -d "cases/$id" ] || [ -d "validation/$id" ] || rm -r "$directory"
done
{
  echo '# Figures and tables'
  for id in "$@"; do
    for file in figures/"$id"/*.md; do
      [ ! -e "$file" ] || echo "$(basename "$file") $file"
    done
  done | sort | while read -r _ file; do
    id=$(basename "$(dirname "$file")")
    echo
    cat "$file"
    printf '\nData: [results/%s](../results/%s)\n' "$id" "$id"
  done
  for file in tables/table[0-9].md; do
    [ -e "$file" ] || continue
    number=${file#tables/table}
    printf '\n## Table %s, computed beside published\n\n' "${number%.md}"
    cat "$file"
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
