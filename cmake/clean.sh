#!/bin/sh
# Removes what was built, computed and drawn, in the project's directory: build directories, results/ and, in figures/ and
# tables/, files by the names of cases and studies. What anybody else has put there stays.
set -eu
for directory in build build-*; do
  [ ! -e "$directory/CMakeCache.txt" ] || rm -rf "$directory"
done
rm -rf results report.html figures/gallery.md
drawn_of() { # NAME: of a case, of what is stored with it, or of a study
  rm -f "tables/$1.csv" "tables/$1.md" "figures/$1"/*.svg "figures/$1"/*.png "figures/$1"/*.md
  [ ! -d "figures/$1" ] || rmdir "figures/$1" 2>/dev/null || echo "figures/$1 holds more than what was drawn, and stays"
}
for directory in cases/*/ validation/*/; do
  id=$(basename "$directory")
  drawn_of "$id"
  for file in "$directory"*.toml; do
    drawn_of "$id-$(basename "$file" .toml)"
  done
done
rm -f tables/ledger.csv tables/ledger.md
for file in tables/table[0-9]*; do
  case ${file#tables/table} in
  *[!0-9]*.csv | *[!0-9]*.md) ;;
  *.csv | *.md) rm -f "$file" ;;
  esac
done
sh cmake/orphans.sh
