#!/bin/sh
# A sweep shared out by GNU parallel, of a case with any name: as many results as runs, the failed one listed, the same
# bytes as of one process, and nothing computed twice. A job that is lost costs its run alone, jobs that cannot run are
# said to be so, and a signal stops all of them.
#   sh validation/sweep.sh path/to/capsule
# Skipped (77) where GNU parallel is missing.
if ! command -v parallel > /dev/null; then
  echo "skipped: needs the package parallel"
  exit 77
fi
. "$(dirname "$0")/lib/program.sh"
mkdir build cases
ln -s "$capsule" build/capsule
case="cases/my small \$HOME (it's {1} & \`touch evil\`; touch evil).toml"
results="results/$(basename "$case" .toml)"
short_case >"$case"
cat >>"$case" <<'TOML'
until.time = 2
[sweep]
"pore.exit_x" = [4, 5, 0.6]
TOML

sweep() { # CODE ARGUMENT...; what is said goes into log
  expected=$1
  shift
  code=0
  sh "$project/sweep/parallel.sh" "$case" "$@" > log 2>&1 || code=$?
  [ $code -eq "$expected" ] || fail "ended with $code, not with $expected"
}
ended() { # how many runs did so
  build/capsule run "$case" --list | grep -c "$1" || true
}
# In place of the program: a job, which computes one run, does this.
jobs_do() {
  rm build/capsule
  printf '#!/bin/sh\ncase "$*" in *--only*) %s ;; esac\nexec "%s" "$@"\n' "$1" "$capsule" > build/capsule
  chmod +x build/capsule
}

jobs_do 'exit 1'
sweep 4 2
grep -q 'error: no job has computed anything: 3 of 3 runs are to be computed' log || fail 'jobs that cannot run'
[ ! -e results ] || fail 'what no job could compute is computed nevertheless'

# The third leaves the pore: it fails, and the others don't mind. Nor if the first is lost.
jobs_do 'case "$*" in *--only\ 1) kill -9 $$ ;; esac'
sweep 130 2
grep -q '^1	exit_x=4	.*	to be computed$' log || fail 'the lost run is not named'
grep -q 'interrupted: 1 of 3 runs to finish; the same command goes on' log || fail 'what is to do is not said'
[ "$(ended reached)" -eq 1 ] && [ "$(ended 'failed: ')" -eq 1 ] || fail 'a lost job costs others'
rm build/capsule
ln -s "$capsule" build/capsule
first=$(cat "$results"/exit_x=5/run.json)
sweep 3 2
[ "$(ended reached)" -eq 2 ] || fail 'not both good runs reached their end'
[ "$(ended 'failed: ')" -eq 1 ] || fail 'the failed run is not listed'
[ "$(cat "$results"/exit_x=5/run.json)" = "$first" ] || fail 'a finished run was computed again'

# Again: nothing is computed.
before=$(cat "$results"/*/run.json)
sweep 3 2
[ "$(cat "$results"/*/run.json)" = "$before" ] || fail 'a finished run was computed again'

# One process alone gives the same bytes.
build/capsule run "$case" --jobs 1 --out alone > alone.log 2>&1 || true
for file in series.csv profiles.csv resolved.toml; do
  for run in alone/*/; do
    run=${run%/}
    cmp "$run/$file" "$results/${run##*/}/$file" || fail "$file differs"
  done
done

# A signal: each job leaves a checkpoint, from which the same command goes on.
sed 's/^accuracy.*/accuracy = 1e-7/; s/^until.*/until.time = 3\nflow.viscosity_ratio = 5/' "$case" > cases/long.toml
case=cases/long.toml
sh "$project/sweep/parallel.sh" "$case" 2 > log 2>&1 &
process=$!
for _ in $(seq 600); do
  [ "$(ls results/runs | wc -l)" -lt 5 ] || break # the three of before and two that are under way
  sleep 0.1
done
sleep 1
kill "$process" || fail "the sweep ended early"
code=0
wait "$process" || code=$?
[ $code -eq 130 ] && grep -q 'interrupted: 3 of 3 runs to finish' log || fail "a signal ended the sweep with $code"
[ "$(find results -name checkpoint.json | wc -l)" -eq 2 ] || fail 'the jobs that were under way left no checkpoint'
[ ! -e evil ] || fail 'a name is executed'
echo "2 runs reached their end, 1 failed and was listed, none was computed twice"
