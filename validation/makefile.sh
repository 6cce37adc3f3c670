#!/bin/sh
# What the Makefile does beyond CMake: a build directory that came with a copy of the tree, or was moved with it, is
# configured anew and nothing is written where it came from; `make test` ends with the tests that were skipped; `make
# sweep` takes the case's name as it is typed; `make clean` removes what it has made, and what belongs to no case is named.
#   sh validation/makefile.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
# What a make that runs this test hands down is not for the make that is tested: it would speak of levels.
unset MAKEFLAGS MFLAGS MAKELEVEL
make_in() { # DIRECTORY ARGUMENT...; what is said goes into log
  (cd "$1" && shift && make "$@") >log 2>&1
}
mkdir -p first/sweep
cp "$project/Makefile" "$project/CMakePresets.json" first
cp -r "$project/cmake" first
: >first/apt.txt # nothing to install
cat >first/sweep/parallel.sh <<'SH'
#!/bin/sh
printf '<%s>' "$@" >swept
SH
chmod +x first/sweep/parallel.sh
cat >first/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(first LANGUAGES NONE)
add_custom_target(capsule COMMAND ${CMAKE_COMMAND} -E touch built WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
enable_testing()
add_test(NAME good COMMAND sh -c "exit $GOOD")
add_test(NAME rare COMMAND sh -c "echo 'skipped: needs the packages one-thing and another'; exit 77")
add_test(NAME part COMMAND sh -c "echo 'skipped: needs the package one-thing'")
set_tests_properties(rare PROPERTIES SKIP_RETURN_CODE 77)
CMAKE

make_in first || fail 'make'
[ -e first/built ] || fail 'nothing is built'
rm first/built
cp -r first copy
make_in copy || fail 'make in a copy'
[ -e copy/built ] && [ ! -e first/built ] || fail 'a copy builds where it came from'
make_in copy || fail 'make again'
grep -q 'configured anew' log && fail 'a copy is configured each time'
rm copy/built
mv copy moved
make_in moved || fail 'make in a tree that was moved'
[ -e moved/built ] && [ ! -e copy ] || fail 'a tree that was moved builds where it came from'
ln -s moved link
make_in link || fail 'make by way of a link'
grep -q 'configured anew' log && fail 'a link is taken for a copy'

skipped_are_listed() { # by a line that fits each of these
  for part in 'rare (needs the packages one-thing and another)' 'part (needs the package one-thing)' 'apt-get install one-thing another'; do
    grep '^skipped: ' log | grep -qF "$part" || fail "the skipped tests are not listed: $part"
  done
}
GOOD=0 make_in first test || fail 'make test'
skipped_are_listed
tail -n 1 log | grep -q '^skipped: ' || fail 'make test does not end with the skipped tests'
GOOD=1 make_in first test && fail 'a test that fails is lost'
skipped_are_listed

mkdir first/cases
for name in 'my case.toml' "it's (a) \$HOME & \`touch evil\`; touch evil #" '$(shell touch evil)' '100%'; do
  : >"first/cases/$name"
  make_in first sweep CASE="cases/$name" JOBS='1; touch evil' || fail "make sweep: $name"
  [ "$(cat first/swept)" = "<cases/$name><1; touch evil>" ] || fail "not as it is typed: $(cat first/swept)"
  make_in first sweep CASE="cases/not $name" && fail 'no such case, and swept'
  grep -qF "CASE='cases/not $name' is no case" log || fail 'a case that is not there is not named'
done
make_in first sweep CASE='cases/my case.toml' SSH='one,two two,:' || fail 'make sweep'
[ "$(cat first/swept)" = '<cases/my case.toml><100%><one,two two,:>' ] || fail "not as it is typed: $(cat first/swept)"
[ ! -e first/evil ] || fail 'a name is executed'
# `make clean` leaves what nobody has built, computed or drawn.
mkdir -p first/build-notes first/tables first/figures/one first/figures/mine first/results first/cases/one
for file in cases/one/case.toml tables/one.csv tables/one.md tables/ledger.csv tables/table2.md figures/one/drawn.svg; do
  : >"first/$file"
done
for file in tables/published.csv tables/mine.csv tables/mine.md tables/table.csv tables/table2-mine.csv \
  figures/mine/photo.png figures/style.gp build-notes/notes; do
  : >"first/$file"
  echo "first/$file" >>stay
done
make_in first clean || fail 'make clean'
(cd first && find tables figures build* results -type f 2>/dev/null | sed 's|^|first/|' | sort) >left
sort stay | cmp - left || fail "make clean leaves this: $(cat left)"
for file in tables/mine.csv tables/mine.md tables/table.csv tables/table2-mine.csv figures/mine/; do
  grep -qxF "$file belongs to no case and no study, and stays" log || fail "$file is not named"
done
[ "$(grep -c 'and stays' log)" -eq 5 ] || fail "make clean names: $(cat log)"
# So do pictures of a case that was removed; its table is named where figures are drawn.
mkdir first/cases/two first/figures/two first/figures/one
for file in cases/one/case.toml cases/one/stored.toml cases/two/case.toml tables/one.csv tables/one-stored.csv tables/two.csv \
  tables/ledger.csv tables/table3.md figures/two/drawn.svg figures/one/drawn.svg; do
  : >"first/$file"
done
rm -r first/cases/two
(cd first && sh cmake/gallery.sh one) >log || fail 'the gallery'
[ ! -e first/figures/two ] && [ -e first/figures/one/drawn.svg ] || fail 'pictures of a case that was removed'
grep -q '^tables/two.csv belongs to no case' log || fail "the table of a case that was removed: $(cat log)"
! grep -E 'one|ledger|table3|published' log || fail 'a table that belongs to a case is named'
echo 'a copy is configured anew, skipped tests are listed, names are taken as they are typed'
