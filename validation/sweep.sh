#!/bin/sh
# A sweep shared out by GNU parallel, and by Slurm where it runs: as many results as runs, the failed one listed, the same bytes as of one process,
# and nothing computed twice.
#   sh validation/sweep.sh path/to/capsule
# Skipped (77) where GNU parallel is missing.
if ! command -v parallel > /dev/null; then
  echo "skipped: needs the package parallel"
  exit 77
fi
. "$(dirname "$0")/lib/program.sh"
mkdir build cases
ln -s "$capsule" build/capsule
cat > cases/small.toml << 'TOML'
accuracy = 1e-2
capsule.radius = 0.7
capsule.start_x = -1.4
membrane.law = "skalak"
membrane.bending_ratio = 1e-3
flow.capillary_number = 0.05
until.time = 2
[sweep]
"pore.exit_x" = [4, 5, 0.6]
TOML

# The third leaves the pore: it fails, and the others don't mind.
status=0
sh "$project/sweep/parallel.sh" cases/small.toml 2 > first.log 2>&1 || status=$?
cat first.log
[ $status -eq 3 ] || fail "ended with $status, not with 3, as a failed run does"
[ "$(build/capsule run cases/small.toml --list | grep -c reached)" -eq 2 ] || fail 'not both good runs reached their end'
[ "$(build/capsule run cases/small.toml --list | grep -c 'failed: ')" -eq 1 ] || fail 'the failed run is not listed'

# Again: nothing is computed.
before=$(cat results/small/*/run.json)
sh "$project/sweep/parallel.sh" cases/small.toml 2 > second.log 2>&1 || true
[ "$(cat results/small/*/run.json)" = "$before" ] || fail 'a finished run was computed again'

# One process alone gives the same bytes.
build/capsule run cases/small.toml --jobs 1 --out alone > alone.log 2>&1 || true
same_bytes() {
  for file in series.csv profiles.csv resolved.toml; do
    for run in alone/*/; do
      run=${run%/}
      cmp "$run/$file" "results/small/${run##*/}/$file" || fail "$file differs"
    done
  done
}
same_bytes

# The same as a job array, where there is a cluster, be it of one machine.
if sinfo --noheader > sinfo.log 2>&1; then
  rm -rf results
  status=0
  sh "${script%parallel.sh}slurm.sh" cases/small.toml --wait > array.log 2>&1 || status=$?
  [ $status -eq 3 ] || fail "the job array ended with $status, not with 3"
  [ "$(build/capsule run cases/small.toml --list | grep -c 'failed: ')" -eq 1 ] || fail 'the failed job is not listed'
  same_bytes
else
  echo "no Slurm here: the job array was not tried"
fi
echo "2 runs reached their end, 1 failed and was listed, none was computed twice"
