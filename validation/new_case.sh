#!/bin/sh
# Cases made by `capsule new`, of the example and of another one, are computed and drawn by the target `figures`, by their
# being there, though one sweeps fewer values and no published number speaks of them.
#   sh validation/new_case.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"

mkdir cases tables figures
cp "$project/cases/common.toml" cases
cp "$project/tables/published.csv" tables
cp "$project/figures/style.gp" figures
ln -s "$project/cmake" cmake
cp -r "$project/cases/example" cases
sed -i "s|^title.*|&\naccuracy = 1e-2|" cases/example/case.toml
"$capsule" new first-case
"$capsule" new my-case --like "$project/cases/fig07-viscosity-sphere"
sed -i 's/^"flow.viscosity_ratio" = .*/"flow.viscosity_ratio" = [0.5, 1]/; s/^accuracy = .*/accuracy = 1e-2/' cases/my-case/case.toml

cat >CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(copy LANGUAGES NONE)
enable_testing()
add_executable(capsule IMPORTED)
set_target_properties(capsule PROPERTIES IMPORTED_LOCATION $capsule)
include(cmake/cases.cmake)
CMAKE
LC_ALL=C cmake -G Ninja -S . -B build >log 2>&1 || fail 'cmake'
mkdir -p figures/deleted-case
: >figures/deleted-case/fig99.md
LC_ALL=C cmake --build build --target figures >log 2>&1 || fail 'the target figures'
grep -E '"cases/.*line [0-9]+:|^awk' log && fail 'gnuplot complains'

for figure in fig05a fig07a fig07b fig08; do
  for format in svg png md; do
    [ -s figures/my-case/$figure.$format ] || fail "no $figure.$format"
  done
  grep -q "my-case/$figure.png" figures/gallery.md || fail "$figure is not in the gallery"
done
for figure in pressure shapes; do
  [ -s figures/first-case/$figure.svg ] || fail "no $figure.svg of the example's copy"
done
grep -q 'first-case: AS RECORDED: 9 of 9 rows agree' log || fail "the example's copy does not begin green"
grep -q '^title = "first-case"' cases/first-case/case.toml || fail 'the copy has no title of its own'
grep -q '^paper' cases/my-case/case.toml && fail 'the copy is of an item of the paper'
grep -q 'λ = 0.5' figures/my-case/fig07a.md || fail 'the captions do not speak of the runs'
grep -i -E '(^|[^a-z])-?nan' figures/my-case/*.md figures/my-case/*.svg tables/*.md && fail 'a number is missing'
[ ! -e figures/deleted-case ] || fail 'the pictures of a case that is no longer there stay'

# A mistake in a figure.gp leaves the pictures that were there; without it they are drawn anew, and nothing else is left.
pictures() { (cd figures/my-case && find . -type f -name '*.*g' | sort && cat ./*.md); }
pictures >before
echo 'plot (' >>cases/my-case/figure.gp
LC_ALL=C cmake --build build --target figure-my-case >log 2>&1 && fail 'a mistake in figure.gp is not noticed'
pictures | grep -v drawing >after
cmp before after || fail 'a mistake in figure.gp takes the pictures away'
sed -i '$d' cases/my-case/figure.gp
: >figures/my-case/fig99.svg
LC_ALL=C cmake --build build --target figure-my-case >log 2>&1 || fail 'it is not drawn again'
pictures >after
cmp before after && [ ! -e figures/my-case/.drawing ] || fail 'other pictures than before'
echo "a new case is computed and drawn"
