#!/bin/sh
# A sweep as arrays of jobs: none longer than the cluster allows, all together each run once; submitted again, what is
# missing; an array that is refused stops no other. Where there is a cluster, be it of one machine, it computes one.
#   sh validation/slurm.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
mkdir build bin
ln -s "$capsule" build/capsule
values() { seq "$1" | awk '{ printf "%s%g", (NR > 1 ? ", " : ""), 1 + $1 / 1000 }'; }
short_case >"many (it's).toml"
cat >>"many (it's).toml" <<TOML
until.time = 0.01
sweep."flow.viscosity_ratio" = [$(values 1200)]
TOML
# In place of Slurm: one line for each array, with the numbers of its runs, in the file submitted; longer arrays are refused.
cat >bin/scontrol <<'SH'
#!/bin/sh
printf 'MaxArraySize            = %s\nMaxJobCount             = 10000\n' "${LIMIT:-1001}"
SH
cat >bin/sbatch <<'SH'
#!/bin/sh
indices=${1#--array=}
shift
while [ "$1" != "${1#--}" ]; do shift; done # options
script=$1
case=$2
before=$3
last=${indices##*[,-]}
if [ "$last" -ge "${LIMIT:-1001}" ] || [ "$last" -ge "${REFUSED:-10000}" ]; then
  echo 'sbatch: error: Batch job submission failed: Invalid job array specification' >&2
  exit 1
fi
for range in $(echo "$indices" | tr ',' ' '); do seq "${range%-*}" "${range#*-}"; done |
  awk -v before="$before" '{ printf "%d ", before + $1 } END { print "" }' >>submitted
for index in ${COMPUTE:-}; do
  SLURM_ARRAY_TASK_ID=$index sh "$script" "$case" "$before" >job.log 2>&1 || exit
done
SH
chmod +x bin/*
submit() { # as tasks of a cluster that is not there
  rm -f submitted
  PATH=$place/bin:$PATH sh "$project/sweep/slurm.sh" "many (it's).toml" --time=10 >log 2>&1
}
numbers_are() { # LINES, and all numbers
  [ "$(wc -l <submitted)" -eq "$1" ] || fail "$(wc -l <submitted) arrays, not $1"
  tr ' ' '\n' <submitted | grep . >got
  cmp "$2" got || fail 'not these runs'
}
seq 1200 >all
submit || fail 'submitted'
numbers_are 2 all
LIMIT=501 submit || fail 'submitted in arrays of 500'
numbers_are 3 all
LIMIT=20001 submit || fail 'submitted in one array'
numbers_are 1 all
LIMIT=0 submit && fail 'a cluster without arrays'
grep -q 'allows no arrays' log || fail 'a cluster without arrays is not said to be one'

# The second and third run of each array are computed.
COMPUTE='2 3' submit || fail "a job fails: $(cat job.log)"
[ "$("$capsule" run "many (it's).toml" --list | awk -F '\t' '$4 == "reached" { printf "%d ", $1 }')" = '2 3 1002 1003 ' ] || fail 'not the runs of the jobs'
submit || fail 'submitted again'
grep -vxE '2|3|1002|1003' all >missing
numbers_are 2 missing
# An array that is refused does not keep the next from being submitted, and is told by the code.
LIMIT=1001 REFUSED=1000 submit && fail 'a refusal is lost'
grep -q 'Invalid job array' log || fail 'a refusal is not shown'
awk '$1 > 1000' missing >late
numbers_are 1 late

if sinfo --noheader >sinfo.log 2>&1; then
  sed -i 's/^sweep.*/sweep."pore.exit_x" = [4, 5, 0.6]/; s/0.01$/2/' "many (it's).toml" # the third leaves the pore: it fails
  code=0
  sh "$project/sweep/slurm.sh" "many (it's).toml" --wait >log 2>&1 || code=$?
  [ $code -eq 3 ] || fail "the array ended with $code, not with 3, as a failed run does"
  [ "$("$capsule" run "many (it's).toml" --list | grep -c 'reached$')" -eq 2 ] || fail 'not both good runs are computed'
else
  echo 'skipped: the array on a cluster needs one, which answers sinfo'
fi
echo '1200 runs are submitted once each, those that are missing again'
