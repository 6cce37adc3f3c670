#!/bin/sh
# A run that is killed, interrupted or stopped by its time limit goes on and ends with the files of one that never was.
#   sh validation/resume.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
cat >case.toml <<'TOML'
accuracy = 1e-5
mesh.membrane = 200 # long enough to be interrupted
pore.shape = "two-mouths"
pore.exit_x = 6
flow.drive = "pressure"
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
until.x_g = 3
output.profiles_at_x_g = [-1, 2]
TOML

"$capsule" run case.toml --out whole

killed_on_the_way case.toml killed
cp -r killed at_the_kill
"$capsule" run case.toml --out killed

# Stopped again and again: each time it gets further, at last into the march that its errors are
# estimated by.
short_case | sed 's/^accuracy.*/accuracy = 1e-5/' >stops.toml
printf 'until.time = 1\nmesh.membrane = 200\n' >>stops.toml
"$capsule" run stops.toml --out stops
numbers stops >expected
in_parts stops.toml parts stops 8
numbers parts | cmp - expected || fail 'a march in parts is another one'

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
for damage in 's/"position":.*/"position":/' 's/"position":\[[^,]*/"position":["nan"/'; do
  rm -rf damaged
  cp -r at_the_kill damaged
  sed -i "$damage" damaged/checkpoint.json
  "$capsule" show case.toml --out damaged >log || fail 'show'
  grep -q '% done' log && fail 'show believes a damaged checkpoint'
done
"$capsule" run case.toml --out damaged >log 2>&1 || fail 'a damaged checkpoint'
grep -q ": the checkpoint in 'damaged' is damaged .*: the run begins again" log || fail 'nothing is said of the damage'

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
