#!/bin/sh
# Names the tables and the directories of figures that belong to no case and no study: of one that was removed, or somebody
# else's. They stay.
#   sh cmake/orphans.sh     in the project's directory
set -eu
is_known() { # NAME: of a case, of what is stored with it, or of a study
  [ ! -d "cases/$1" ] && [ ! -d "validation/$1" ] || return 0
  for stored in cases/*/*.toml; do
    [ "$(basename "$(dirname "$stored")")-$(basename "$stored" .toml)" != "$1" ] || return 0
  done
  return 1
}
for file in tables/*.csv tables/*.md figures/*/; do
  [ -e "$file" ] || continue
  id=$(basename "${file%.*}")
  case $file in
  tables/published.csv | tables/ledger.* | tables/table[0-9].*) ;;
  *) is_known "$id" || echo "$file belongs to no case and no study, and stays" ;;
  esac
done
