#!/bin/sh
# Numbers in prose are those of the results. Behind a number that comes from a run stands a mark, a comment that no page shows:
#   7.1764<!-- table1-mesh/: pressure_drop -->                  CASE/RUN: QUANTITY; RUN may be empty, for all
#   14.31<!-- viscosity_ratio=1: pressure_drop -->              in the README.md of a case or a study, of this one
#   1e-5<!-- < : max(abs(volume_change@x_g=-100..1000)) -->     a bound, or with > one from below
#   0.2349<!-- folds.csv: capillary_number; radius=0.7 -->      in the README.md of a study: FILE.csv: COLUMN; COLUMN=VALUE; ...
#   6.2<!-- folds.csv: max max_stretch; capsule=sphere -->      one row, or the max, min or count of several
# RUN and QUANTITY are written as in tables/published.csv (solver/compare/expectations.hpp). The printed number may be off by half
# a unit of its last digit and the estimated error of the result. Marks become rows of a table of expectations, and
# `capsule ledger` compares them. Then one digit of a copy is changed, and a run and a quantity are misspelt: each must be found.
#   sh validation/prose_numbers.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
[ -d "$project/results/runs" ] || {
  echo "skipped: needs the results of the cases, by make figures"
  exit 77
}
ln -s "$project/cases" "$project/results" .

# table_of FILE...: the rows of the marks in these files, in a project's directory. Says where a comment is no mark.
table_of() {
  awk '
    function quoted(text) { gsub(/"/, "\"\"", text); return "\"" text "\"" }
    function complain(what) { print FILENAME ":" FNR ": " what > "/dev/stderr"; bad = 1 }
    BEGIN { print "id,where,case,run,quantity,published,allowed,reason,claim,kind,statement,converged,verdict,cause,evidence" }
    {
      for (line = $0; at = index(line, "<!--"); line = substr(line, at + 4 + end + 2)) {
        before = substr(line, 1, at - 1)
        end = index(substr(line, at + 4), "-->")
        mark = substr(line, at + 4, end - 1)
        colon = index(mark, ":")
        if (end == 0 || colon == 0) { complain("a comment is \"CASE/RUN: QUANTITY\", on one line"); next }
        if (!match(before, /[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?$/)) {
          complain("the mark" mark "stands behind no number")
          continue
        }
        printed = substr(before, RSTART)
        sub(/^\+/, "", printed)
        run = substr(mark, 1, colon - 1)
        quantity = substr(mark, colon + 1)
        gsub(/^ +| +$/, "", run)
        gsub(/^ +| +$/, "", quantity)
        bound = match(run, /^[<>]/) ? substr(run, 1, 1) : ""
        sub(/^[<>] */, "", run)
        split(FILENAME, folders, "/")
        of = folders[1] == "cases" || folders[1] == "validation" ? folders[2] : ""
        slash = index(run, "/")
        if (slash && index(substr(run, 1, slash), "=") == 0) {
          of = substr(run, 1, slash - 1)
          run = substr(run, slash + 1)
        }
        if (of == "") { complain("the mark" mark "names no case"); continue }
        if (run ~ /[.]csv$/) {
          printf "%s\t%s\t%s\t%s\n", FILENAME ":" FNR, bound printed, "results/" of "/" run, quantity >"csv_marks"
          continue
        }
        digits = printed
        exponent = sub(/e.*/, "", digits) ? substr(printed, index(printed, "e") + 1) : 0
        decimals = index(digits, ".") ? length(digits) - index(digits, ".") : 0
        allowed = bound == "" ? "5e" (exponent - decimals - 1) : ""
        ++count
        print count "," FILENAME ":" FNR "," of "," quoted(run) "," quoted(quantity) "," bound printed "," allowed ",," count \
          ",behaviour,,,agrees,,"
      }
    }
    END { exit bad }' "$@"
}

# compare_csv: what the marks in csv_marks say, against the files that they name.
compare_csv() {
  awk -F '\t' '
    function complain(what) { print place ": " what; bad = 1 }
    function trimmed(text) { gsub(/^ +| +$/, "", text); return text }
    function is_number(text) { return text ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/ }
    function same(a, b) { return is_number(a) && is_number(b) ? a + 0 == b + 0 : a == b }
    function half_a_unit(text,  digits, exponent) { # of the last digit
      digits = text
      exponent = sub(/e.*/, "", digits) ? substr(text, index(text, "e") + 1) : 0
      return 0.5 * 10 ^ (exponent - (index(digits, ".") ? length(digits) - index(digits, ".") : 0))
    }
    function is_right(text, value,  printed, apart) {
      printed = text
      if (sub(/^</, "", printed)) return value < printed + 0
      if (sub(/^>/, "", printed)) return value > printed + 0
      apart = value - printed
      return (apart < 0 ? -apart : apart) <= half_a_unit(printed) * (1 + 1e-9)
    }
    {
      place = $1; file = $3; asked = file ": " $4
      n = split($4, parts, ";")
      column = trimmed(parts[1])
      which = match(column, /^(max|min|count) /) ? substr(column, 1, RLENGTH - 1) : ""
      sub(/^(max|min|count) +/, "", column)
      found = 0; missing = ""; line = ""
      if ((getline line <file) <= 0) { # a study need not be computed
        directory = file
        sub(/[/][^/]*$/, "", directory)
        if (system("test -d " directory) == 0) complain("there is no " file)
        next
      }
      fields = split(line, head, ",")
      split("", at)
      for (i = 1; i <= fields; ++i) at[head[i]] = i
      for (i = 1; i <= n; ++i) {
        key[i] = trimmed(parts[i]); wanted[i] = ""
        if (i == 1) key[i] = column
        else { wanted[i] = substr(key[i], index(key[i], "=") + 1); key[i] = substr(key[i], 1, index(key[i], "=") - 1) }
        if (!(key[i] in at)) missing = key[i]
      }
      while (missing == "" && (getline line <file) > 0) {
        split(line, cell, ",")
        for (i = 2; i <= n && same(cell[at[key[i]]], wanted[i]); ++i) ;
        if (i <= n || (which != "count" && !is_number(cell[at[column]]))) continue
        now = cell[at[column]] + 0
        value = which == "count" ? found + 1 : found == 0 || (which == "max" && now > value) || (which == "min" && now < value) ? now : value
        ++found
      }
      close(file)
      if (missing != "") complain("no column " missing " in " asked)
      else if (found == 0) complain("no such row in " asked)
      else if (found > 1 && which == "") complain(found " rows in " asked)
      else if (!is_right($2, value)) complain("printed " $2 ", computed " value " (" asked ")")
    }
    END { exit bad }' csv_marks
}

# compare FILE...: what the marks in these files say, against results/. Names each number that is not so; ends as the program.
compare() {
  mkdir -p tables
  : >csv_marks
  table_of "$@" >tables/published.csv || return
  code=0
  "$capsule" ledger --table compared >log 2>&1 || code=$?
  [ $code -eq 0 ] || [ $code -eq 1 ] || { # a row that cannot be read is named by its place
    awk -F, 'NR == FNR { place[FNR] = $2; next }
             match($0, /published.csv:[0-9]+:1: /) {
               $0 = place[substr($0, RSTART + 14, RLENGTH - 18)] ": " substr($0, RSTART + RLENGTH)
             }
             { print }' tables/published.csv log
    return $code
  }
  right=0
  compare_csv || right=1
  # Digits within the estimated error of a result are another machine's.
  awk -F, 'function apart(a, b) { return a > b ? a - b : b - a }
           NR == FNR { split($0, text, "\""); asked[$1] = text[2] ": " text[4]; next }
           $12 == "NOT AS RECORDED" && ($6 ~ /^[<>]/ || $8 !~ /^[-+.0-9e]+$/ || apart($6, $8) > $11 + $9) {
             print $3 ": printed " $6 ", computed " $8 " (" asked[$1] ")"
             wrong = 1
           }
           END { exit wrong }' tables/published.csv compared.csv && [ $right -eq 0 ]
}

(cd "$project" && ls README.md cases/*/README.md paper-notes/*.md) >files
for computed in results/*/; do # studies among them
  study=validation/$(basename "$computed")
  [ ! -e "$project/$study/README.md" ] || echo "$study/README.md" >>files
done
while read -r file; do
  case $file in cases/*) ;; *) mkdir -p "$(dirname "$file")" && cp "$project/$file" "$file" ;; esac
done <files
# shellcheck disable=SC2046 # names of files, without spaces
compare $(cat files) || fail "numbers in prose are not those of the results: put them right, or make figures"
echo "$(($(wc -l <tables/published.csv) - 1 + $(wc -l <csv_marks))) numbers in prose are those of the results"

# README.md shows the output of a command, and its estimated error.
shown=$(sed -n 's/^    table1-mesh: steady  \(.*\)  CPU seconds .*/\1/p' README.md)
ends 0 steady cases/table1-mesh --out shown
grep -qF "table1-mesh: steady  ${shown:?}  CPU seconds" log || fail "README.md shows '$shown' of table1-mesh"
error=$(sed -n '/"error_estimate"/,/}/s/^ *"pressure_drop": \([^,]*\),*$/\1/p' shown/summary.json | xargs printf '%.0e' | sed 's/e-0/e-/')
grep -q "(here $error)" README.md || fail "README.md shows another error of table1-mesh than $error"

# A changed copy of this line must be found, and named by its place.
says() { # LINE PATTERN: what is said of it
  printf '\n%s\n' "$1" >copy.md
  ! compare copy.md >said 2>&1 || fail "'$1' is taken for right"
  grep -q "^copy.md:2: .*$2" said || { cat said && fail "nothing like '$2' is said of '$1'"; }
}
line=$(grep -ho '[0-9.]*<!-- table1-mesh-paper-numerics/membrane=60: pressure_drop -->' paper-notes/findings.md | head -1)
[ -n "$line" ] || fail "paper-notes/findings.md has no mark for the first mesh of Table 1"
echo "$line" >copy.md
compare copy.md >said || fail "'$line' is not taken for right"
last=$(echo "$line" | sed 's/.*\([0-9]\)<!--.*/\1/')
says "$(echo "$line" | sed "s/[0-9]<!--/$(((last + 1) % 10))<!--/")" 'printed 7.1.*, computed 7.1'
says "$(echo "$line" | sed 's/=60/=61/')" 'no such run'
says "$(echo "$line" | sed 's/table1/table0/')" 'no such run'
says "$(echo "$line" | sed 's/membrane=/membrance=/')" membrance
says "$(echo "$line" | sed 's/_drop/_dorp/')" 'no value'
says "$(echo "$line" | sed 's/.*<!--/about <!--/')" 'behind no number'
says '5<!-- < table1-mesh-paper-numerics/membrane=60: pressure_drop -->' 'printed <5, computed 7.1'
# The same of a table, here that of a march.
echo '-4<!-- table1-mesh/series.csv: x_g; time=0 -->' >copy.md
compare copy.md >said || fail 'the first row of a series is not taken for right'
says '-3<!-- table1-mesh/series.csv: x_g; time=0 -->' 'printed -3, computed -4'
says '-4<!-- < table1-mesh/series.csv: max x_g -->' 'printed <-4, computed 11.7'
says '-4<!-- table1-mesh/series.csv: x_g -->' '[0-9] rows in'
says '-4<!-- table1-mesh/series.csv: x_g; time=-1 -->' 'no such row'
says '-4<!-- table1-mesh/series.csv: y_g; time=0 -->' 'no column y_g'
says '-4<!-- table1-mesh/sries.csv: x_g; time=0 -->' 'there is no results/table1-mesh/sries.csv'
echo 'a changed digit, an unknown run, quantity, row and column are found'
