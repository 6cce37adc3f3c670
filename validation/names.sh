#!/bin/sh
# The project's directory may be called anything that CMake and ninja bear, and says so where they do not. A case whose
# name cannot be used is refused by name, by `capsule new` and when CMake configures, and no other case suffers.
#   sh validation/names.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"

# What CMake cannot do is refused before it tries; what ninja cannot do is said.
configure_in() { # a directory with this in its name; sets the code
  rm -rf "$place"/small
  mkdir -p "$place/small/a$1b"
  cp -r "$project/cmake" "$place/small/a$1b"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'include(cmake/place.cmake)' 'project(small LANGUAGES NONE)' \
    >"$place/small/a$1b/CMakeLists.txt"
  code=0
  (cd "$place/small/a$1b" && cmake -G Ninja -S . -B build) >log 2>&1 || code=$?
}
for part in '[' ']' ';' '"' '#' '*' '?' '<' '>' '|' '${HOME}' '$ENV{HOME}'; do
  configure_in "$part"
  [ $code -ne 0 ] && grep -qF "do not bear '${part%HOME*}" log || fail "a directory with $part"
done
for part in '&' "'" '`' '^'; do
  configure_in "$part"
  [ $code -eq 0 ] && grep -qF "ninja does not bear '$part'" log || fail "a directory with $part"
done
for part in ' ' '(' ')' '$' '%' '{' '~' '!' ',' ':' '@' 'ö'; do
  configure_in "$part"
  [ $code -eq 0 ] && ! grep -q 'bear' log || fail "a directory with $part"
done

# All of it in a directory with such a name: tables, figures, studies and the gallery; with cases beside it whose names
# cannot be used, and one whose runs are called like a case from elsewhere.
mkdir -p "$place/my capsule (copy) & it's \$HOME"
cd "$place"/my*
mkdir cases tables figures program "elsewhere (it's)"
ln -s "$capsule" program/capsule
ln -s "$project/cmake" cmake
cp "$project/figures/style.gp" figures
cp "$project/tables/published.csv" tables
cp "$project/cases/common.toml" cases
cp -r "$project/cases/example" cases/small
rm cases/small/expected.csv
sed 's|^title.*|&\naccuracy = 1e-2|; s|^"physical.flow_rate".*|"physical.flow_rate" = ["20 nl/s", "30 nl/s"]|' \
  cases/small/case.toml >"elsewhere (it's)/case.toml"
echo "inherit = [\"../../elsewhere (it's)\"]" >cases/small/case.toml
mkdir -p validation/counted validation/compared
cp "elsewhere (it's)/case.toml" validation/compared
cp cases/small/figure.gp validation/compared
echo 'int main() { return 1; }' >validation/counted/study.cpp
echo 'int nothing;' | tee validation/study.cpp validation/estimates.cpp >validation/steady_folds.cpp
echo 'eval figure("line", 4, 4); plot x; print "**A line.**"' >validation/counted/figure.gp
unusable() { # PATTERN NAME...: names that the pattern's rule refuses
  rule=$1
  shift
  for name in "$@"; do
    "$capsule" new "$name" --like small >log 2>&1 && fail "'$name' is a new case"
    cp -r cases/small "cases/$name"
    printf '%s\n' "$name" "$rule" >>unusable
  done
}
unusable 'a name is made of' 'small (copy)' 'a b' 'a;b' 'a[b' 'a"b' 'a${HOME}b' 'a$b' "it's" 'a&b' 'a\b' 'größe' -x .x
unusable 'is taken' benchmark branch ledger published runs steady table1 gallery.md style.gp
unusable 'is taken' all clean test help install edit_cache figures tables capsule
unusable 'at most 100' "$(printf '%0101d' 0)"
"$capsule" new compared --like small >log 2>&1 && fail 'a case is called as a study is'

cat >CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(copy LANGUAGES CXX)
enable_testing()
add_library(solver INTERFACE)
add_library(warnings INTERFACE)
add_executable(capsule IMPORTED)
set_target_properties(capsule PROPERTIES IMPORTED_LOCATION ${CMAKE_CURRENT_SOURCE_DIR}/program/capsule)
include(cmake/cases.cmake)
include(cmake/studies.cmake)
CMAKE
cmake -G Ninja -S . -B build >log 2>&1 || fail 'cmake'
while read -r name && read -r rule; do
  grep -F "cases/$name is left out" log | grep -q "$rule" || fail "'$name' is not refused by its name and rule"
done <unusable
cmake --build build --target figures >log 2>&1 || fail 'the target figures'
cmake --build build --target study-counted >log 2>&1 && fail "a study's verdict is lost"
cmake --build build --target study-compared >log 2>&1
for file in small/pressure.svg small/shapes.png counted/line.svg compared/pressure.svg gallery.md; do
  [ -s "figures/$file" ] || fail "no figures/$file"
done
ctest --test-dir build -R small >log 2>&1 || fail 'the tests of the case'
grep -q '20 nl/s' figures/small/pressure.md || fail 'no caption'
cmp tables/published.csv "$project/tables/published.csv" || fail 'the published values are overwritten'
# What comes or goes is seen, the others' names or not.
cp -r cases/small cases/next
rm -r 'cases/a"b'
cmake --build build --target help >log 2>&1 || fail 'the next build'
grep -q 'figure-next: ' log || fail 'a new case is not seen'
# A figure's published values are those of its case, of another file in the case's directory, and of cases whose runs it
# shows; that one name begins as another does means nothing.
mkdir -p drawn/cases/small drawn/tables drawn/results/small
touch drawn/cases/small/file.toml
printf '%s\n' 'id,where,case,run,quantity,published' a,T,small,,v_g,1 b,T,small-file,,v_g,2 c,T,small-two,,v_g,3 \
  d,T,smal,,v_g,4 e,T,other,,v_g,5 >drawn/tables/published.csv
echo 'other,radius=0.9' >drawn/results/small/runs.txt
echo 'print published("a"), published("b"), published("c"), published("d"), published("e")' >drawn/cases/small/figure.gp
found=$(cd drawn && gnuplot -c ../figures/style.gp cases/small figures 2>&1 | head -n 1)
[ "$found" = '1.0 2.0 NaN NaN 5.0' ] || fail "published values: $found"
echo 'a case and a directory may be called anything, or are refused by name'
