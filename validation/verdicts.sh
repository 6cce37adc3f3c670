#!/bin/sh
# Verdicts by the program: `check` and `ledger` end with 0 where every comparison finds what the table of published values
# records, be it that they differ, with 1 where one finds another, and with 3 where a run fails and no row expects it.
#   sh validation/verdicts.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"

says() {
  grep -q -e "$1" log || fail "nothing like '$1' is said"
}

# The second run crosses the exit section and fails.
mkdir -p cases/small tables
short_case >cases/small/case.toml
cat >>cases/small/case.toml <<'TOML'
until.time = 2
[sweep]
"pore.exit_x" = [5, 0.6]
TOML
head='id,where,case,run,quantity,published,allowed,reason,claim,kind,statement,converged,verdict,cause,evidence'
good="t,Table 9,small,pore.exit_x=5,time,2,0.01,,t,number,the time,,agrees,,
v,Table 9,small,pore.exit_x=5,v_g,9,0.1,,v,number,a velocity,,differs,,nobody measured it"
exit_row='x,Table 9,small,pore.exit_x=0.6,status,failed:exit,,,x,behaviour,the capsule leaves,,agrees,,'

ends 2 ledger --table all
says 'no tables/published.csv'
ends 3 check cases/small
says 'no expectations for small'
ends 0 check cases/small --set 'sweep."pore.exit_x"=[5]'
says 'NOTHING TO COMPARE'

printf '%s\n' "$head" "$good" >tables/published.csv
ends 3 check cases/small
says 'computed before'
says '; 1 run failed unexpectedly'
printf '%s\n' "$head" "$good" "$exit_row" >tables/published.csv
ends 0 check cases/small --table table
says 'small: AS RECORDED: 2 of 3 rows agree, 1 differ, 0 not decidable; 0 runs failed'
for word in agrees differs 'Table 9' failed:exit; do
  grep -q "$word" table.csv && grep -q "$word" table.md || fail "no '$word' in the table"
done
ends 0 ledger --table all
says 'all: .*; 0 rows not as recorded'
for claim in t v x; do
  grep -q "^$claim," all.csv || fail "no claim $claim in the ledger"
done

# What is recorded is not what is found, on either side.
for wrong in "$(echo "$good" | sed 's/,2,0.01,/,3,0.01,/')" "$(echo "$good" | sed 's/,9,0.1,/,9,20,/')"; do
  printf '%s\n' "$head" "$wrong" "$exit_row" >tables/published.csv
  ends 1 check cases/small
  says 'NOT AS RECORDED'
  ends 1 ledger --table all
  says '; 1 row not as recorded'
done

# Who chooses a run does not ask for the others.
printf '%s\n' "$head" "$good" "$exit_row" >tables/published.csv
ends 0 check cases/small --set 'sweep."pore.exit_x"=[5]'
says '1 of 2 rows agree, 1 differ'
ends 130 check cases/small --fresh --time-limit 1e-9
echo 'what differs, fails or cannot be compared is told apart'
