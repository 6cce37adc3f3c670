#!/bin/sh
# A run is killed at fifty random moments, half of them about its end, where its files are written: whatever it leaves
# is whole, and the same command, given again and again, ends with the files of a run that was never killed.
#   sh validation/kill.sh path/to/capsule [SEED]
seed=${2:-2002}
. "$(dirname "$0")/lib/program.sh"
cat >case.toml <<'TOML'
accuracy = 1e-3
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
flow.viscosity_ratio = 5
until.x_g = 8
output.resistance = true
output.profiles_at_x_g = [-3, -1, 0, 1, 2, 3, 4, 5, 6, 7]
TOML

now() { date +%s.%N; }

# Without --out, so that runs are computed in one place and shared with another.
began=$(now)
(mkdir whole && cd whole && "$capsule" run ../case.toml)
duration=$(echo "$began $(now)" | awk '{ print $2 - $1 }')

# What is there must be what a whole run has, but for when and how long; a checkpoint and run.json must be whole JSON.
check_files() {
  find "$1" -type f ! -name '.writing-*' | while read -r file; do
    case $file in
    */checkpoint.json | */run.json) [ "$(tail -c 2 "$file")" = '}' ] || fail "$file is half-written" ;;
    */summary.json)
      grep -v '_seconds"' "$file" >got
      grep -v '_seconds"' "whole/${file#*/}" | cmp - got || fail "$file differs"
      ;;
    *) cmp "$file" "whole/${file#*/}" || fail "$file differs" ;;
    esac
  done
}

awk -v seed="$seed" -v duration="$duration" 'BEGIN {
  srand(seed)
  for (i = 0; i < 50; ++i)
    print i % 2 ? duration * rand() : duration * (0.85 + 0.2 * rand())
}' >moments

mkdir killed
kills=0
finished=0
share=1
while read -r moment; do
  while :; do # until it is killed while it runs
    (cd killed && exec "$capsule" run ../case.toml) >log 2>&1 &
    process=$!
    sleep "$(echo "$share $moment" | awk '{ print $1 * $2 }')"
    kill -9 "$process" 2>/dev/null || true
    code=0
    { wait "$process"; } 2>/dev/null || code=$?
    check_files killed
    [ "$code" -ne 137 ] || break
    [ "$code" -eq 0 ] || fail "ended with $code: $(cat log)"
    finished=$((finished + 1))
    rm -rf killed/results
    share=$(echo "$share" | awk '{ print 0.9 * $1 }') # it came too late: runs are faster than the first one was
  done
  kills=$((kills + 1))
done <moments

(cd killed && "$capsule" run ../case.toml)
check_files killed
[ -z "$(find killed -name '.writing-*' -o -name checkpoint.json)" ] || fail 'something is left over'
[ "$(cd killed && find . | sort)" = "$(cd whole && find . | sort)" ] || fail 'a file is missing'
echo "$kills kills, the run was finished $((finished + 1)) times, each time as if it had never been killed"
