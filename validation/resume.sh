#!/bin/sh
# A run that is killed, interrupted or stopped by its time limit goes on and ends with the files of one that never was.
#   sh validation/resume.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
cat >case.toml <<'TOML'
accuracy = 1e-6 # long enough to be interrupted
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
until.x_g = 11
output.profiles_at_x_g = [-1, 2]
TOML

"$capsule" run case.toml --out whole

# Killed as soon as there is a checkpoint.
"$capsule" run case.toml --out killed &
process=$!
while [ ! -e killed/checkpoint.json ] && kill -0 "$process" 2>/dev/null; do sleep 0.05; done
kill -9 "$process" || fail 'finished without a checkpoint'
wait "$process" && fail 'survived being killed'
[ ! -e killed/summary.json ] || fail 'a killed run has a summary'
"$capsule" show case.toml --out killed | grep -q '% done' || fail 'show does not know the checkpoint'
"$capsule" run case.toml --out killed

# Interrupted by the user, and by the time limit, until it is done.
"$capsule" run case.toml --out interrupted &
process=$!
while [ ! -d interrupted ]; do sleep 0.05; done
sleep 0.2
kill -INT "$process"
code=0
wait "$process" || code=$?
[ "$code" -eq 130 ] || fail "exit code $code after SIGINT"
[ -e interrupted/checkpoint.json ] || fail 'no checkpoint after SIGINT'
code=0
"$capsule" run case.toml --out interrupted --time-limit 0.2 || code=$?
[ "$code" -eq 130 ] || fail "exit code $code after the time limit"
"$capsule" run case.toml --out interrupted

# A checkpoint with a position that is not a number, and half of one: said to be damaged, and the run begins again.
for damage in 's/"position":\[[^,]*/"position":["nan"/' 's/"position".*//'; do
  code=0
  "$capsule" run case.toml --out damaged --time-limit 1 || code=$?
  [ "$code" -eq 130 ] || fail "exit code $code after the time limit"
  sed -i "$damage" damaged/checkpoint.json
  "$capsule" show case.toml --out damaged | grep -q '% done' && fail 'show believes a damaged checkpoint'
done
"$capsule" run case.toml --out damaged >log 2>&1 || fail 'a damaged checkpoint'
grep -q "^case: the checkpoint in 'damaged' is damaged .*: the run begins again" log || fail 'nothing is said of the damage'

# A sweep whose first process is killed: its children save and end, or finish; then it goes on.
sweep='sweep."membrane.dilatation"=[0, 1]'
"$capsule" run case.toml --set "$sweep" --jobs 2 --out sweep &
process=$!
while [ ! -d sweep/dilatation=1 ]; do sleep 0.05; done
sleep 0.2
kill -9 "$process"
wait "$process" && fail 'survived being killed'
"$capsule" run case.toml --set "$sweep" --jobs 2 --out sweep

numbers whole >expected
for directory in killed interrupted damaged sweep/dilatation=0; do
  numbers "$directory" >got
  cmp expected got || fail "$directory is not the run that was never interrupted"
done
echo 'interrupted runs end as the others do'
