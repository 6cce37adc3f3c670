#!/bin/sh
# Steady states and branches by the program: a branch begins and ends at the states that `steady` finds, both know the
# fold, on whose far side there is none, and the end of a march leads to the same state.
#   sh validation/branch.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
cat >case.toml <<'TOML'
accuracy = 1e-3
capsule.radius = 0.8
membrane.law = "neo-hookean"
membrane.bending_ratio = 0.01
flow.capillary_number = 0.1
until.x_g = 10
TOML

# near A B DISTANCE WHAT
near() {
  awk -v a="$1" -v b="$2" -v d="$3" 'BEGIN { exit !(a != "" && b != "" && (a - b)^2 <= d * d) }' || fail "$4: $1 and $2"
}
# of DIRECTORY QUANTITY: in its summary, that of the end before that of a fold
of() { sed -n "s/^ *\"$2\": \([^,]*\),*\$/\1/p" "$1/summary.json" | head -n 1; }
# point DIRECTORY ROW COLUMN: of a branch; rows count from 1, "$" is the last one
point() {
  sed -n "1p;$(echo "$2" | awk '/[0-9]/ { $1 += 1 } 1')p" "$1/branch.csv" |
    awk -F, -v name="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i } NR == 2 { print $column }'
}
key=flow.capillary_number

ends 0 steady case.toml --out begin
[ "$(of begin status)" = '"steady"' ] || fail 'no steady state'
ends 0 steady case.toml --out end --set $key=0.15
ends 0 branch case.toml --along $key --to 0.15 --out branch
[ "$(of branch status)" = '"reached"' ] && [ "$(of branch folds)" = '[]' ] || fail 'the branch is cut off, or has folds'
near "$(point branch 1 $key)" 0.1 0 'the first point'
near "$(point branch '$' $key)" 0.15 0 'the last point'
for quantity in v_g pressure_drop max_stretch min_film growth_rate; do
  near "$(point branch 1 $quantity)" "$(of begin $quantity)" 1e-5 "$quantity where the branch begins"
  near "$(point branch '$' $quantity)" "$(of end $quantity)" 1e-5 "$quantity where the branch ends"
done
cp branch/branch.csv before
ends 0 branch case.toml --along $key --to 0.15 --out branch
grep -q 'computed before' log && cmp before branch/branch.csv || fail 'a finished branch is computed again'

ends 0 branch case.toml --along $key --to 0.3 --out folded
[ "$(of folded status)" = '"unbounded"' ] || fail 'the branch does not run away'
grep -q "  end at $key 0\.[0-9]*  v_g" log || fail 'the line of a branch does not say where it ends'
sed -n '/"folds"/,/\]/p' folded/summary.json >folds
[ "$(grep -c '"growth_rate"' folds)" -eq 1 ] || fail 'not one fold'
fold=$(of folded $key)
near "$(sed -n "s/.*  fold at $key \([0-9.]*\) +- .*, stretch .*/\1/p" log)" "$fold" 1e-6 'the line of a branch tells another fold'
grep -q "behind the fold at $key = 0\.[0-9]* +- .*, the critical capillary number;" log || fail 'the message does not tell the fold'
grep -A 20 '"error_estimate"' folds | grep -q "\"$key\": [0-9.]*e-" || fail 'the fold has no error estimate'
sed -n 's/.*timestep="\([^"]*\)".*/\1/p' folded/membrane.pvd >times
sort -nu times | cmp - times && grep -q "Name=\"$key\"" folded/membrane_0001.vtp ||
  fail 'a reader that sorts by time shows another branch'
awk -F, -v fold="$fold" 'NR > 1 && $1 >= fold { exit 1 }' folded/branch.csv || fail "a point beyond the fold at $fold"
near "$(point folded '$' growth_rate)" 10 9.999 'beyond the fold small motions grow'
ends 3 steady case.toml --out beyond --set $key="$(awk -v f="$fold" 'BEGIN { print 1.002 * f }')"
said=$(sed -n "s/.*fold at $key = \([0-9.]*\) +- .*, the critical capillary number;.*/\1/p" log)
near "$said" "$fold" "$(awk -v f="$fold" 'BEGIN { print 1e-4 * f }')" 'the fold'
ends 0 steady case.toml --out below --set $key="$(awk -v f="$fold" 'BEGIN { print 0.998 * f }')"

# The fold followed to a stiffer membrane ends at the fold of that one's own branch.
stiffer=membrane.bending_ratio
ends 0 branch case.toml --along $key --to 0.3 --fold-along $stiffer --fold-to 0.02 --out curve
said=$(sed -n "s/.* at $stiffer = 0.02 the last one at \([0-9.]*\) +- .*/\1/p" log)
ends 0 branch case.toml --set $stiffer=0.02 --along $key --to 0.3 --out stiffer
cmp folded/branch.csv curve/branch.csv || fail 'a branch whose fold is followed is another one'
[ "$(head -n 1 curve/fold_curve.csv | cut -d, -f1,2)" = $stiffer,$key ] || fail 'the columns of the fold'
awk -F, 'NR == 2' curve/fold_curve.csv | grep -q '^0.01,' || fail 'the fold does not begin at the membrane of the case'
near "$(awk -F, 'NR == 2 { print $2 }' curve/fold_curve.csv)" "$fold" 1e-7 'the fold where it begins'
near "$(awk -F, 'END { print $2 }' curve/fold_curve.csv)" "$(of stiffer $key)" 1e-6 'the fold of a stiffer membrane'
sed -n '/"fold_curve_end"/,/^  }/p' curve/summary.json >last
near "$(sed -n "s/^    \"$key\": \([^,]*\),*/\1/p" last)" "$(of stiffer $key)" 1e-6 'the end of the curve in the summary'
grep -q "^      \"$key\": [0-9.]*e-" last || fail 'the end of the curve has no error estimate'
near "$said" "$(of stiffer $key)" 1e-5 'the end of the curve on the line'
near "$(awk -F, 'END { print $NF }' curve/fold_curve.csv)" 0 1e-3 'the growth rate at a fold'
ends 3 branch case.toml --along $key --to 0.101 --fold-along $stiffer --fold-to 0.02 --out no-curve
grep -q 'no fold on the way' log || fail 'there is nothing to follow'
ends 2 branch case.toml --along $key --to 0.3 --fold-along $key --fold-to 0.02 --out no-curve
ends 2 branch case.toml --along $key --to 0.3 --fold-along membrane.bending_rato --fold-to 0.02 --out no-curve
grep -q "did you mean '$stiffer'" log || fail 'nothing is suggested'

# The same branch in physical units: eps = 0.1 at 10 nl/s.
cat >physical.toml <<'TOML'
accuracy = 1e-3
[physical]
tube_radius = "50 um"
capsule_radius = "40 um"
viscosity = "1 Pa.s"
flow_rate = "10 nl/s"
shear_modulus = "12.732395447 mN/m"
[membrane]
law = "neo-hookean"
bending_ratio = 0.01
TOML
ends 0 branch physical.toml --along physical.flow_rate --to '30 nl/s' --out physical
near "$(of physical $key)" "$fold" 1e-6 'the fold in physical units'
awk -F, -v key="$key" '
  FNR == 1 { for (i = 1; i <= NF; ++i) column[$i, NR == FNR] = i; next }
  NR == FNR { eps[FNR] = $column[key, 1]; drop[FNR] = $column["pressure_drop", 1]; next }
  function apart(a, b) { return a / b - 1 > 1e-9 || a / b - 1 < -1e-9 }
  # 1e-10 m3/s at eps = 1, and mu Q/(pi R_t^3)
  { rate = $column["physical.flow_rate [m3/s]", 0]; pressure = rate / (3.14159265358979 * 50e-6 ^ 3) }
  $1 != eps[FNR] || apart(rate, 1e-10 * eps[FNR]) || apart($column["pressure_drop [Pa]", 0], drop[FNR] * pressure) { exit 1 }
  ' physical/branch.csv physical/branch_physical.csv || fail 'the branch in SI units'
grep -q 'fold at a flow rate of .* nl/s, the critical flow rate' log || fail 'the critical flow rate is not named'
near "$(sed -n 's/.*fold at a flow rate of \(.*\) nl\/s.*/\1/p' log | awk '{ print $1 / 100 }')" "$fold" 1e-4 'its flow rate'
ends 3 steady physical.toml --out critical --set physical.flow_rate="$(awk -v f="$fold" 'BEGIN { print 100.2 * f }') nl/s"
near "$(sed -n 's/.*(\([0-9.]*\) nl\/s), the critical flow rate;.*/\1/p' log | awk '{ print $1 / 100 }')" "$fold" 1e-4 'the critical flow rate'
# Along other physical keys it is the branch along the one dimensionless key that they change.
ends 0 branch case.toml --along membrane.bending_ratio --to 0.012 --out stiffer
ends 0 branch physical.toml --along physical.bending_modulus --to '381.97186341 fJ' --out physical
near "$(point physical '$' pressure_drop)" "$(point stiffer '$' pressure_drop)" 1e-9 'a branch along the bending modulus'
head -n 1 physical/branch_physical.csv | grep -q 'physical.bending_modulus \[J\]' || fail 'its values in SI units'
ends 2 branch physical.toml --along physical.shear_modulus --to '10 mN/m' --out physical
grep -q 'changes flow.capillary_number' log && grep -q 'branches go along physical.flow_rate, ' log ||
  fail 'nothing is said of the shear modulus'
ends 2 branch case.toml --along eps --to 0.3 --out physical && grep -q "did you mean '$key'" log || fail 'a symbol is no key'
for rates in '"10 nl/s", "12 nl/s"' '"12 nl/s", "10 nl/s"'; do
  ends 0 branch physical.toml --along physical.flow_rate --to '30 nl/s' --set "sweep.physical.flow_rate=[$rates]" --list
  [ "$(grep -c 'flow_rate=' log)" = 1 ] && grep -q 'flow_rate=10nl_per_s' log || fail 'a branch and a part of it'
done
ends 2 branch physical.toml --along physical.flow_rate --to 30 --out physical && grep -q "'30' has no unit" log ||
  fail 'a flow rate without a unit'
ends 2 branch case.toml --along physical.flow_rate --to '30 nl/s' --out physical && grep -q 'no physical units' log ||
  fail 'a flow rate of a case without units'
ends 2 branch case.toml --along $key --to 0,3 --out physical && grep -q '0.3' log || fail 'a comma in --to'

# From a march through the whole pore, and from what is no profile. Of a loose accuracy, which velocities at the end keep
# in any build: those of a march to 1e-3 may be off by 1.5e-3 for the length of a few steps.
ends 0 run case.toml --out march --set accuracy=1e-2
grep -q 'not steady yet' log && fail 'the end of the march is not taken for steady'
ends 0 steady case.toml --out from --from march
for quantity in v_g pressure_drop max_stretch min_film; do
  near "$(of from $quantity)" "$(of begin $quantity)" 1e-5 "$quantity from a march"
  near "$(of march $quantity)" "$(of begin $quantity)" 3e-2 "$quantity at the end of the march"
done
ends 0 steady case.toml --out from --from march
grep -q 'computed before' log || fail 'from the same march it is computed again'
ends 0 run case.toml --out march --set accuracy=1e-2 --set until.x_g=2
grep -q 'not steady yet: the membrane still moves with 0\.[0-9]* relative' log || fail 'an early end is taken for steady'
ends 0 steady case.toml --out from --from march
grep -q 'computed before' log && fail 'from another march nothing is computed'
near "$(of from v_g)" "$(of begin v_g)" 1e-5 'v_g from another march'
ends 4 steady case.toml --out from --from none
mkdir bad
for text in 'time,x_g' "$(head -n 1 march/profiles.csv)" "$(head -n 1 march/profiles.csv; echo '1,2,three')"; do
  echo "$text" >bad/profiles.csv
  ends 2 steady case.toml --out from --from bad
  grep -q '^bad/profiles.csv:[1-9]:1: error: ' log || fail "nothing is said of '$text'"
done
sed '3s/[^,]*$/nan/' march/profiles.csv >bad/profiles.csv
ends 2 steady case.toml --out from --from bad
grep -q "^bad/profiles.csv:3:1: error: 'nan' in the column 'velocity_r' is not finite" log || fail 'a nan is not named'
ends 3 steady case.toml --out from --from march --set capsule.radius=0.95
grep -q 'of another capsule: radius 0.8 there, 0.95 here' log || fail 'another radius is not named'
ends 0 steady case.toml --out from --from march
grep -q 'another capsule' log && fail 'a march is taken for that of another capsule'
for other in capsule.radius=0.82 capsule.aspect_ratio=0.9; do # from where a steady state is found all the same
  ends 0 steady case.toml --out from --from march --set $other
  grep -q '^from: the profile to begin with is of another capsule: ' log || fail "nothing is said of $other"
done

# A case's march and its steady states have places of their own; what takes another's place says so.
ends 0 run case.toml --set until.x_g=-3.5
home=results/$(basename "$place")
cp "$home/summary.json" marched
ends 0 steady case.toml
ends 0 branch case.toml --along $key --to 0.101
cmp marched "$home/summary.json" || fail 'the march is gone'
for method in steady branch; do
  grep -q "\"task\": \"$method" "$home/$method/run.json" || fail "no $method in $home/$method"
done
grep -q replaces log && fail 'something is replaced'
ends 0 run case.toml --set until.x_g=-3.4
grep -q "^$home: replaces a run with until.x_g = -3.5\$" log || fail 'a run is replaced without a word'
ends 0 steady case.toml --out march
grep -q '^march: replaces the results of `capsule run`$' log || fail 'a march is replaced without a word'
ends 0 steady case.toml --out march --fresh
grep -q replaces log && fail 'the same again replaces nothing'

# Of a sweep one run, by its number.
ends 0 steady case.toml --out swept --set "sweep.\"$key\"=[0.1, 0.15]" --only 2
near "$(of swept/capillary_number=0.15 v_g)" "$(of end v_g)" 0 'one run of a sweep'
ends 0 steady case.toml --out swept --set "sweep.\"$key\"=[0.1, 0.15]" --list
[ "$(cut -f 2,4 log | tr '\t\n' '= ')" = 'capillary_number=0.1=to be computed capillary_number=0.15=steady ' ] || fail 'another list'
ends 2 steady case.toml --out swept --set "sweep.\"$key\"=[0.1, 0.15]" --only 3
echo "branches, steady states and marches agree; a fold at $fold"
