#!/bin/sh
# Several capsules in one pore: a run that is killed, and one that is stopped again and again, end with the files of one that
# never was, those of the second capsule too. `show` has a table with four digits of each capsule.
#   sh validation/resume_pair.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
short_case | sed 's/^accuracy.*/accuracy = 1e-5/; s/^capsule.start_x.*/capsule.start_x = [-1.4, -3.4]/' >pair.toml
printf 'until.time = 1\nmesh.membrane = [140, 100]\noutput.profiles_at_time = [0.3, 0.7]\n' >>pair.toml

"$capsule" run pair.toml --out whole
numbers whole >expected
for file in series.csv series-2.csv profiles-2.csv membrane-2_0003.vtp; do
  grep -qx "$file" expected || fail "there is no $file"
done

killed_on_the_way pair.toml killed
"$capsule" run pair.toml --out killed
numbers killed | cmp - expected || fail 'a pair that was killed is another one'

in_parts pair.toml parts whole 5
numbers parts | cmp - expected || fail 'a pair in parts is another one'

"$capsule" show pair.toml --set flow.capillary_number=[0.0123456789,0.06] >shown
grep -q '^# pair .* 0\.01235 0\.06 ' shown || fail 'show has no digits of a pair, or all of them'
echo 'interrupted pairs end as the others do'
