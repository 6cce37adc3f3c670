#!/bin/sh
# Each run of a sweep stands alone: the one whose process is killed, or that finds no memory, is named, all others are
# computed, and the same command computes the rest.
#   sh validation/lost.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
short_case | sed '/^accuracy/d' >case.toml
echo 'until.time = 3
sweep.accuracy = [1e-8, 1e-2, 5e-3, 2e-3]' >>case.toml # the first one is long enough to be killed

signal_first() { # SIGNAL CODE: to the process of the first run
  "$capsule" run case.toml --out out --jobs 2 >log 2>&1 &
  parent=$!
  while kill -0 "$parent" 2>/dev/null && [ -z "${child:=$(cut -d ' ' -f 1 "/proc/$parent/task/$parent/children" 2>/dev/null)}" ]; do sleep 0.02; done
  sleep 0.3
  kill "-$1" "$child" || fail 'the first run is over'
  code=0
  wait "$parent" || code=$?
  [ "$code" -eq "$2" ] || fail "ended with $code, not with $2"
  [ "$(ls out/*/summary.json | wc -l)" -eq 3 ] && [ ! -e out/accuracy=1e-8/summary.json ] || fail 'a lost run costs others'
  child=
}
signal_first KILL 4
grep -q '^error: accuracy=1e-8: its process was ended by signal 9' log || fail 'the lost run is not named'
grep -q '^error: 1 of 4 runs could not be computed; the same command' log || fail 'what is to do is not said'
signal_first TERM 130
grep -q '^interrupted: 1 of 4 runs to finish; the same command goes on' log || fail 'what is to do is not said'
ends 0 run case.toml --out out --jobs 2
[ "$(grep -c 'computed before' log)" -eq 3 ] || fail 'what was computed is lost'

# No memory for one of them.
sed -i 's/^sweep.*/accuracy = 1e-2/; s/^until.*/until.time = 0.1/' case.toml
for jobs in 1 2; do
  code=0
  (ulimit -v 600000 && "$capsule" run case.toml --set sweep.mesh.membrane='[10000, 24, 30]' --out "large-$jobs" \
    --jobs "$jobs") >log 2>&1 || code=$?
  [ "$code" -eq 3 ] && grep -q '^error: membrane=10000: not enough memory' log || fail "without memory: $code"
  [ -e "large-$jobs/membrane=24/summary.json" ] && [ -e "large-$jobs/membrane=30/summary.json" ] || fail 'no others'
done
echo 'a lost run is named, and costs no other'
