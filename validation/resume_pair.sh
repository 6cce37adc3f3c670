#!/bin/sh
# Several capsules in one pore: a run that is killed, and one that is stopped again and again, end with the files of one that
# never was, those of the second capsule too.
#   sh validation/resume_pair.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
short_case | sed 's/^accuracy.*/accuracy = 1e-5/; s/^capsule.start_x.*/capsule.start_x = [-1.4, -3.4]/' >pair.toml
printf 'until.time = 1\nmesh.membrane = [140, 100]\noutput.profiles_at_time = [0.3, 0.7]\n' >>pair.toml

"$capsule" run pair.toml --out whole
numbers whole >expected
for file in series.csv series-2.csv profiles-2.csv membrane-2_0003.vtp; do
  grep -qx "$file" expected || fail "there is no $file"
done

# Killed as soon as there is a checkpoint of a part of the way.
"$capsule" run pair.toml --out killed &
process=$!
until "$capsule" show pair.toml --out killed | grep -q '% done'; do
  kill -0 "$process" || fail 'show does not know the checkpoint'
  sleep 0.05
done
kill -9 "$process" || fail 'finished without a checkpoint'
wait "$process" && fail 'survived being killed'
[ ! -e killed/summary.json ] || fail 'a killed run has a summary'
"$capsule" run pair.toml --out killed
numbers killed | cmp - expected || fail 'a pair that was killed is another one'

# In parts, on any machine.
limit=$(sed -n 's/.*"wall_seconds": \([0-9.]*\).*/\1/p' whole/summary.json | awk '{ print 0.1 + $1 / 5 }')
calls=0
code=130
while [ "$code" -eq 130 ]; do
  calls=$((calls + 1))
  [ "$calls" -lt 60 ] || fail 'a march does not get further'
  code=0
  "$capsule" run pair.toml --out parts --time-limit "$limit" || code=$?
done
[ "$code" -eq 0 ] && [ "$calls" -gt 2 ] || fail "ended with $code after $calls calls"
numbers parts | cmp - expected || fail 'a pair in parts is another one'
echo 'interrupted pairs end as the others do'
