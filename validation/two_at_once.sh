#!/bin/sh
# Two processes at the same case at once: both end well with the same results, and nothing is computed twice; with
# different input in the same place, what stays there is of one of them.
#   sh validation/two_at_once.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
mkdir case
cat >case/case.toml <<'TOML'
accuracy = 1e-2
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
until.x_g = 0
output.profiles_at_x_g = [-3, -1]
TOML

# at_once FIRST SECOND: `capsule run case` twice, side by side, with these words behind it; their exit codes
at_once() {
  set -f # words are no patterns
  "$capsule" run case $1 >first.log 2>&1 &
  first=$!
  code_2=0
  "$capsule" run case $2 >second.log 2>&1 || code_2=$?
  code_1=0
  wait $first || code_1=$?
  set +f
}
for lambda in 1 2; do
  "$capsule" run case --set flow.viscosity_ratio=$lambda --out alone-$lambda >alone.log
  numbers alone-$lambda >expected-$lambda
done
sweep='--set sweep."flow.viscosity_ratio"=[1,2] --jobs 2'

for where in '' '--out chosen'; do
  at_once "$where" "$where"
  [ $code_1 -eq 0 ] && [ $code_2 -eq 0 ] || fail "the same run: $code_1, $code_2"
  [ "$(cat first.log second.log | grep -c 'computed before')" -eq 1 ] || fail 'the run was computed twice'
  numbers "$([ -z "$where" ] && echo results/case || echo chosen)" | cmp - expected-1 || fail 'another result'
done

at_once "$sweep --out swept" "$sweep --out swept"
[ $code_1 -eq 0 ] && [ $code_2 -eq 0 ] || fail "the same sweep: $code_1, $code_2"
[ "$(cat first.log second.log | grep -c 'computed before')" -eq 2 ] || fail 'runs were computed twice'
for lambda in 1 2; do
  numbers swept/viscosity_ratio=$lambda | cmp - expected-$lambda || fail 'another result of the sweep'
done

# Other input, shared from where it is computed: each speaks of its own result.
rm -rf results
at_once '' '--set flow.viscosity_ratio=2'
[ $code_1 -eq 0 ] && [ $code_2 -eq 0 ] || fail "other input: $code_1, $code_2"
numbers results/case >got
cmp -s got expected-1 || cmp -s got expected-2 || fail 'the results are of neither'

# Computed in the same place: one after the other, or the loser is told.
at_once '--out same' '--set flow.viscosity_ratio=2 --out same'
for code in $code_1 $code_2; do
  [ $code -eq 0 ] || { [ $code -eq 4 ] && cat first.log second.log | grep -q 'give each its own --out'; } ||
    fail "other input in one place: $code_1, $code_2"
done
numbers same >got
cmp -s got expected-1 || cmp -s got expected-2 || fail 'the results in one place are of neither'
[ -z "$(find . -name '.writing-*' -o -name checkpoint.json)" ] || fail 'something is left over'
echo 'two processes at once do no harm'
