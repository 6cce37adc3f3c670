#!/bin/sh
# `capsule fit`: the example comes out as its capsule was made, bad profiles are refused with their place and nothing is
# written, a directory of profiles is finished after an interruption, several flow rates are one fit.
#   sh validation/fit.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"

# within NAME LOW HIGH: a value of fit.json in the directory `fit`
within() {
  value=$(sed -n '/"values"/,/}/s/^ *"'"$1"'": \([^,]*\),*$/\1/p' fit/fit.json | head -n 1)
  echo "$value $2 $3" | awk '{ exit !($1 >= $2 && $1 <= $3) }' || fail "$1 is $value, not in $2 ... $3"
}
# The capsule of profile.csv: 44 um, 6 mN/m, inflated by 2.5 %, neo-Hookean; 0.5 um a pixel with a noise of half of one.
cp "$project"/cases/fit-example/* .
ends 0 fit fit-example.toml --profile profile.csv --out fit
grep -q '"law": "neo-hookean"' fit/fit.json || fail 'the law is another'
within physical.capsule_radius 43.95e-6 44.05e-6
within physical.shear_modulus 5.8e-3 6.2e-3
within capsule.inflation .0235 .0265
for file in fit.json fit.csv profiles.csv points.csv; do [ -s "fit/$file" ] || fail "no $file"; done

# Whatever the order, the half and the origin of its points are.
sed -n '1,3p' profile.csv >half.csv
sed '1,3d' profile.csv | awk -F, '$2 < 0 { printf "%.2f,%s\n", $1 - 400, $2 }' | sort >>half.csv
ends 0 fit fit-example.toml --profile half.csv --out fit --set 'fit.laws=["neo-hookean"]'
within physical.capsule_radius 43.9e-6 44.1e-6

# Pixels are half a micrometre.
sed 's/\[um\]/[px]/g' profile.csv | awk -F, 'NR > 3 { $0 = sprintf("%.2f,%.2f", $1 * 2, $2 * 2) } { print }' >pixels.csv
ends 0 fit fit-example.toml --profile pixels.csv --out fit --set 'fit.laws=["neo-hookean"]' --set 'fit.pixel="0.5 um"'
within physical.capsule_radius 43.95e-6 44.05e-6

# bad PATTERN [ARGUMENT...]: bad.csv, from standard input, is refused
bad() {
  pattern=$1
  shift
  cat >bad.csv
  rm -rf bad
  ends 2 fit fit-example.toml --profile bad.csv --out bad "$@"
  grep -q "^bad.csv:$pattern" log || fail "a bad profile: not '$pattern'"
  [ ! -e bad/fit.json ] || fail "a fit of a bad profile: $pattern"
}
head -n 9 profile.csv | bad '3:1: error: 6 points are too few'
sed 's/^181.25,0.66$/181.25,60/' profile.csv | bad '5:1: error: the point lies outside the tube: r = 1.2 R_t'
sed 's/^181.25,/nan,/' profile.csv | bad "5:1: error: 'nan' in the column 'x' is not finite"
sed 's/^181.25,/,/' profile.csv | bad "5:1: error: '' in the column 'x' is not a number"
sed 's/x \[um\],r \[um\]/x,r/' profile.csv | bad '4:1: error: the point lies outside the tube\|'
sed 's/10.7 mm.s/10.7/' profile.csv | bad '2:1: error: velocity = 10.7 has no unit'
sed 's/10.7 mm.s/10.7 mm/' profile.csv | bad '2:1: error: velocity: '
sed 's/\[um\]/[px]/g' profile.csv | bad '3:1: error: points in pixels need fit.pixel'
sed 's/r \[um\]/r [mm]/' profile.csv | bad "3:1: error: x is in 'um', r in 'mm'"
sed 's/\[um\]/[ug]/g' profile.csv | bad "3:1: error: the unit 'ug' of a column"
sed 's/x \[um\],r \[um\]/r [um],x [um]/' profile.csv | bad '[0-9]*:1: error: the point lies outside the tube'
sed 's/,r/,radius/' profile.csv | bad "3:1: error: there is no column 'r'"
{ echo x,r && seq -f '%g,.5' 0 .01 1; } | bad '1:1: error: no capsule: no point near the axis in front'
{ echo x,r && seq -f '0.3,%g' 0 .01 .9; } | bad '1:1: error: no capsule: the points are 0 R_t long'
awk -F, 'NR == 3 { print "x,r" } NR > 3 && $2 > 0 { printf "%.4f,%.4f\n", $2 / 60, ($1 - 213.4) / 60 }' profile.csv |
  bad '1:1: error: no capsule: no point near the axis behind'
: | bad '1:1: error: no points in it'
ends 4 fit fit-example.toml --profile nothing.csv --out bad
# No other command computes it, and each says so.
for command in show run; do
  ends 2 $command fit-example.toml
  grep -q '^fit-example.toml:1:1: error: .*`capsule fit`, which finds capsule.radius, flow.capillary_number, capsule.inflation and the law$' log &&
    [ "$(grep -c error: log)" -eq 1 ] || fail "$command of a fit"
done
ends 2 show "$place"
grep -q "^did you mean '.*/fit-example.toml'" log || fail 'the only case of a directory is not named'
ends 2 fit fit-example.toml --profile . --set 'fit.unknowns=["eps"]'
grep -q "did you mean 'flow.capillary_number'?" log || fail 'a symbol of an unknown'
ends 2 fit fit-example.toml --profile . --set 'fit.unknowns=["capsule.radios"]'
grep -q "1:14: error: 'capsule.radios' is nothing that a fit can find" log || fail 'a misspelt unknown'
ends 2 fit fit-example.toml --profile profile.csv --set 'fit.unknowns=["capsule.radius","membrane.dilatation"]' \
  --set 'fit.laws=["neo-hookean"]'
grep -q "means nothing to the laws" log || fail 'an unknown of another law'
ends 2 fit fit-example.toml --profile profile.csv --set 'physical.shear_modulus="6 mN/m"'
grep -q "physical.shear_modulus means nothing to a fit" log || fail 'a modulus that is to be found'

# What is not of a fit is not overwritten.
mkdir own && echo mine >own/profiles.csv
ends 4 fit fit-example.toml --profile profile.csv --out own
[ "$(cat own/profiles.csv)" = mine ] || fail 'a file that is not of a fit is overwritten'

# A film, whose second half is finished by the same command; a bad image stops no other.
mkdir film
for k in $(seq -w 30); do sed "1s/^/# image $k\n/" profile.csv >film/image-$k.csv; done
"$capsule" fit fit-example.toml --profile film --out films --jobs 1 --time-limit 1 --set 'fit.laws=["neo-hookean"]' >log 2>&1 || code=$?
[ "$code" -eq 130 ] || [ "$code" -eq 0 ] || fail 'an interrupted film'
echo 'x,r' >film/image-bad.csv
ends 2 fit fit-example.toml --profile film --out films --jobs 2 --set 'fit.laws=["neo-hookean"]'
grep -q '^film/image-bad.csv:1:1: error: 0 points are too few' log || fail 'a bad image is not named'
[ "$(wc -l <films/fit.csv)" -eq 31 ] || fail 'a film without a row for each image'
grep -q '^physical.shear_modulus,30,' films/population.csv || fail 'no population'
grep -q '^capsule.radius,' films/histogram.csv || fail 'no histogram'

# Two flow rates, in one fit: the second outline is made by the program.
cat >second.toml <<'TOML'
capsule.radius = 0.88
capsule.inflation = 0.025
membrane.law = "neo-hookean"
membrane.bending_ratio = 1e-4
flow.capillary_number = 0.04
TOML
for flow in 0.04 0.06; do
  ends 0 steady second.toml --set flow.capillary_number=$flow --out steady-$flow
  { echo "# flow_rate = $flow" && echo x,r && sed 1d steady-$flow/profiles.csv | cut -d, -f4,5; } >flow-$flow.csv
done
cat >together.toml <<'TOML'
membrane.law = "neo-hookean"
membrane.bending_ratio = 1e-4
fit.unknowns = ["capsule.radius", "flow.capillary_number", "capsule.inflation"]
TOML
ends 0 fit together.toml --profile flow-0.04.csv --profile flow-0.06.csv --together --out fit
within capsule.radius .87999 .88001
within flow.capillary_number .039999 .040001
within capsule.inflation .02499 .02501
# A flow rate is given for all of them, in their files, or for none.
sed 1d flow-0.06.csv >flow-none.csv
ends 2 fit together.toml --profile flow-0.04.csv --profile flow-none.csv --together --out fit
grep -q '^flow-none.csv:1:1: error: no flow rate' log || fail 'flow rates of some files only'
cp profile.csv again.csv
ends 2 fit fit-example.toml --profile profile.csv --profile again.csv --together --set 'physical.flow_rate="60 nl/s"'
grep -q 'physical.flow_rate is of one contour' log || fail 'a flow rate of the case for several contours'

# Noise gives no warning; what is no capsule, or another one, does not pass as one.
ends 0 fit fit-example.toml --profile profile.csv --out fit
grep -q '"warnings": \[\]' fit/fit.json || fail 'a warning of a good fit'
# refused: odd.csv, from standard input, is no capsule
refused() {
  cat >odd.csv
  ends 3 fit fit-example.toml --profile odd.csv --out odd --set 'fit.laws=["neo-hookean"]'
  grep -q 'odd.csv: no capsule has this outline' log || fail "$1 is fitted"
}
{ echo x,r && seq -f %g -1 .01 1 | awk '{ printf "%.4f,%.4f\n", 2.5 * $1, .2 * sqrt(1 - $1 * $1) }'; } |
  refused 'an ellipse'
awk -F, 'NR > 3 { $0 = -$1 "," $2 } { print }' profile.csv | refused 'a reversed outline'
# warned TEXT [ARGUMENT...]: odd.csv, from standard input, is fitted with this warning
warned() {
  pattern=$1
  shift
  cat >odd.csv
  ends 0 fit fit-example.toml --profile odd.csv --out odd --set 'fit.laws=["neo-hookean"]' "$@"
  grep -q "warning: .*$pattern" log || fail "no warning: $pattern"
}
awk -F, 'NR > 3 { $0 = $1 "," $2 + 4 } { print }' profile.csv | warned 'deviate from the fit to one side'
warned 'deviate from the fit to one side' --set 'fit.unknowns=["capsule.radius"]' --set flow.capillary_number=0.02 \
  <profile.csv
warned 'is [0-9.]* of its standard deviations from' --set 'physical.flow_rate="50 nl/s"' <profile.csv
ends 2 fit fit-example.toml --profile profile.csv --set 'fit.unknowns=[]'
grep -q 'fit.unknowns needs at least one text' log || fail 'no unknowns'

echo 'capsules are found from their outlines, and bad outlines are refused'
