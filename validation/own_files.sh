#!/bin/sh
# What the program has not written is neither overwritten nor removed, in whatever directory results are to go; what
# somebody has altered in results is noticed, kept, and reaches no other case; no case takes the place of the runs that
# all share.
#   sh validation/own_files.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
mkdir first second
short_case >first/case.toml
echo 'until.time = 0.2
output.profiles_at_time = [0.1]' >>first/case.toml
cp first/case.toml second

# Files of somebody else by the names of a run's.
mkdir mine
for name in series.csv profiles.csv runs.txt membrane_0001.vtp membrane_smoothed.vtp summary.json run.json checkpoint.json; do
  echo "my $name" >"mine/$name"
done
cp -r mine before
ends 4 run first --out mine
grep -q "'mine/runs.txt'.*no list of runs; move it away, or give another --out" log || fail 'my list of runs'
mv mine/runs.txt before/runs.txt notes 2>/dev/null || rm mine/runs.txt before/runs.txt
for arguments in '' --fresh '--set flow.viscosity_ratio=2'; do
  ends 4 run first --out mine $arguments
  for name in series.csv profiles.csv membrane_0001.vtp summary.json run.json checkpoint.json; do
    grep -q "cannot write into 'mine': .*$name.* not of a run; move them away" log || fail "nothing is said of $name"
  done
  rm -f mine/runs.txt # the program's own
  diff -r before mine || fail "with '$arguments' my files are not what they were"
done
# One that is in nobody's way stays, whatever runs come and go.
mkdir beside
for name in membrane_smoothed.vtp series-mine.csv notes.txt; do echo mine >beside/$name; done
ends 0 run first --out beside
ends 0 run first --out beside --set until.time=0.1
ends 0 run first --out beside --set 'sweep."flow.viscosity_ratio"=[1, 2]'
ends 0 run first --out beside --set 'sweep."flow.viscosity_ratio"=[1]'
[ "$(cat beside/membrane_smoothed.vtp beside/series-mine.csv beside/notes.txt | sort -u)" = mine ] || fail 'a file beside a run'

# An edit in place.
ends 0 run first
numbers results/first >expected
echo edited >>results/first/series.csv
cp results/first/series.csv edited
ends 0 run second
grep -q 'computed before' log || fail 'the run is not shared'
numbers results/second | cmp - expected || fail 'an edit in one case reaches another'
ends 0 run first
grep -q '^results/first/series.csv.altered: altered since it was computed' log || fail 'an edit is not noticed'
cmp edited results/first/series.csv.altered || fail 'an edit is lost'
rm results/first/series.csv.altered
numbers results/first | cmp - expected || fail 'what was computed is not back'
# Where the runs are kept: it is computed again.
for file in results/runs/*/summary.json; do sed -i 's/"v_g": ./&7/' "$file"; done
ends 0 run second
grep -q 'summary.json.altered: altered since' log || fail 'an edit of a shared run is not noticed'
grep -q 'computed before' log && fail 'an edited run is used'
numbers results/second | cmp - expected || fail 'an edited run is used'
# Where the user has it computed.
ends 0 run first --out chosen
cp chosen/profiles.csv profiles
echo edited >>chosen/profiles.csv
ends 0 run first --out chosen
[ -e chosen/profiles.csv.altered ] && cmp profiles chosen/profiles.csv || fail 'an edit where --out says'
# What says whose the files are: its own alteration is noticed, and nothing is taken for somebody else's.
sed -i 's/"processor": "/&my /' chosen/run.json
cp chosen/run.json edited
ends 0 show first --out chosen
grep -q '^# .* to be computed' log || fail 'results without provenance are taken for whole'
ends 0 run first --out chosen
grep -q '^chosen/run.json.altered: altered since it was computed' log || fail 'an altered run.json is not noticed'
cmp edited chosen/run.json.altered || fail 'an edit is lost'
rm chosen/*.altered
numbers chosen | cmp - expected || fail 'what was computed is not back'
cp chosen/run.json whole
sed -i '/"files"/,$d' chosen/run.json
ends 4 run first --out chosen
grep -q "not of a run, or of one whose run.json was altered" log || fail 'nothing is said of a run.json that is cut off'
mv whole chosen/run.json
# A profile from which a steady state begins.
ends 0 steady first --from chosen --out steady
ends 0 steady first --from chosen --out steady
grep -q 'computed before' log || fail 'from the same profile it is computed again'
sed -i 's/^0.2,/0.2000001,/' chosen/profiles.csv
ends 0 steady first --from chosen --out steady
grep -q 'computed before' log && fail 'another profile is taken for the same'

# Names: the place of all runs is no case's; a link goes by its own name.
echo 'id,run,quantity,expected,allowed,reason' >first/expected.csv
ends 2 check first --table first/expected
grep -q "'first/expected.csv' holds what is expected" log && [ -s first/expected.csv ] || fail 'a table takes the place of another'
for end in csv md; do
  echo mine >mine.$end
  ends 2 check first --table mine
  grep -q "'mine.$end' is no such table" log && [ "$(cat mine.$end)" = mine ] || fail "a table takes the place of the user's .$end"
  rm mine.*
done
mkdir elsewhere
cp -r first elsewhere/runs
ends 2 run elsewhere/runs
grep -q "'results/runs' holds the runs of all cases" log || fail 'a case in the place of the runs'
ends 0 run elsewhere/runs --out elsewhere/out
ln -s first link
ends 0 run link
[ -e results/link/summary.json ] || fail 'a link goes by another name'
echo "what somebody else has written stays, edits are noticed"
