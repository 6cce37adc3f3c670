#!/bin/sh
# Bad input of every kind ends with exit code 2 and a located message, before anything is written.
#   sh validation/bad_input.sh path/to/capsule
set -u
capsule=$(realpath "$1")
place=$(mktemp -d)
failed=$place.failed # a file: pipes give each side a shell of its own, whose variables end with it
trap 'rm -rf "$place" "$failed"' EXIT
cd "$place" || exit 1

# expect CODE PATTERN COMMAND...: the code, a line of the output that fits the pattern, and nothing new on the disk
expect() {
  code=$1
  pattern=$2
  shift 2
  before=$(find . | sort)
  output=$("$@" 2>&1)
  got=$?
  if [ "$got" -ne "$code" ] || ! printf '%s\n' "$output" | grep -Eq -e "$pattern" || [ "$(find . | sort)" != "$before" ]; then
    printf 'FAILED: %s\n  exit code %s instead of %s, or nothing like "%s", or new files:\n%s\n' \
      "$*" "$got" "$code" "$pattern" "$output" | tee -a "$failed"
  fi
}

# bad PATTERN: a case directory with the text of standard input as case.toml is refused by run, check and show
bad() {
  mkdir -p bad
  cat >bad/case.toml
  for command in run check show; do
    expect 2 "^bad/case.toml:$1" "$capsule" "$command" bad
  done
}

# good KEY=VALUE...: a good file, but for what is added
good='capsule.radius = 0.9
membrane.law = "skalak"
flow.capillary_number = 0.04'

echo "$good
flow.viscosty_ratio = 1" | bad "4:1: error: unknown key 'flow.viscosty_ratio'"
echo "$good
flow.viscosity_ratio = \"one\"" | bad '4:24: error: .* must be a number'
for typed in 1.0d-3 1d-3 0,05 .05; do
  echo "$good" | sed "s/0.04/$typed/" | bad "3:25: error: '$typed' is not a number; write [01].[0-9e.-]*$"
done
# hint TEXT LINE: what is said of the line, behind its error
hint() {
  echo "$2" >hint.toml
  expect 2 "^$1\$" "$capsule" show hint.toml
  rm hint.toml
}
hint 'a word stands in quotes: "skalak"' 'membrane.law = skalak'
hint 'a word stands in quotes: "neo-hookean"' 'membrane.law=neo-hookean # mine'
hint 'a word stands in quotes: "skalak"' 'sweep."membrane.law" = ["neo-hookean", skalak]'
hint 'quotes are straight: "skalak"' 'membrane.law = “skalak”'
hint 'quotes are straight: "skalak"' "membrane.law = ‘skalak’"
hint 'quotes are straight: "skalak"' 'membrane.law = "skalak”'
hint "'=' stands between a key and its value: radius = 0.9" 'radius: 0.9'
hint 'write true' 'output.resistance = True'
hint "did you mean 'capsule.radius'[?]" 'radius = 0.9'
hint "did you mean 'membrane.law'[?]" "flow.law = 'skalak'"
hint "did you mean 'membrane.dilatation'[?]" 'membrane.C = 10'
hint 'write a number without a unit: lengths in tube radii; .*' 'capsule.radius = "6 mm"'
printf 'flow.type = "extension"\nuntil.time = 1\n%s\noutput.resistance = true\n' "$good" | sed /radius/d |
  bad '5:21: error: output.resistance means nothing to flow.type = "extension"'
printf 'flow.type = "extension"\nuntil.time = 1\n%s\nflow.drive = "pressure"\n' "$good" | sed /radius/d |
  bad '5:14: error: flow.drive means nothing to flow.type = "extension"'
echo "$good
until.tension = 0" | bad '4:17: error: until.tension = 0 is out of range'
echo "$good
until.tension = -0.1" | bad '4:17: error: until.tension = -0.1 is out of range'
echo "$good
until.area_stretch = 1" | bad '4:22: error: until.area_stretch = 1 is out of range'
echo "$good
output.resistance = 1" | bad '4:21: error: output.resistance must be true or false, not 1'
printf '%s\noutput.resistance = true\nnumerics = "paper"\n' "$good" |
  bad '4:21: error: numerics = "paper" computes no resistance'
several=$(printf '%s\npore.shape = "tube"\npore.entrance_distance = 8' "$good")
printf '%s\ncapsule.start_x = [0, -3, -6]\nmembrane.bending_ratio = [0, 1]\n' "$several" |
  bad '7:26: error: membrane.bending_ratio has 2 values for 3 capsules'
printf '%s\ncapsule.start_x = [0, -1]\n' "$several" | bad '6:19: error: capsules 1 and 2 overlap at their start'
printf '%s\ncapsule.start_x = [0, 3]\n' "$several" | bad '6:19: error: capsule 2 starts before the one that is to lead it'
printf '%s\ncapsule.start_x = [0, -9]\n' "$several" | bad '6:19: error: capsule 2: capsule outside the tube'
printf '%s\ncapsule.start_x = []\n' "$several" | bad '6:19: error: capsule.start_x has no value for any capsule'
printf '%s\ncapsule.start_x = [0, -3]\n' "$several" | sed 's/radius = .*/radius = [0.8, 1.2]/' |
  bad '6:19: error: capsule 2: capsule larger than the pore'
printf '%s\ncapsule.start_x = [0, "-3"]\n' "$several" | bad '6:19: error: capsule.start_x must be a number'
printf '%s\nuntil.last_x_g = 3\n' "$several" | bad '6:18: error: until.last_x_g is of several capsules'
printf '%s\ncapsule.start_x = [0, -3]\nuntil.last_x_g = 20\n' "$several" |
  bad '7:18: error: at until.last_x_g = 20 the last capsule would be at the end of the way'
printf '%s\ncapsule.start_x = [0, -3]\noutput.resistance = true\n' "$several" |
  bad '7:21: error: the resistance of several capsules is not computed'
mkdir train
echo "$good
flow.period = 3" >train/case.toml
for command in run check; do
  expect 2 '^train/case.toml:4:15: error: an infinite train is computed as a steady state only' "$capsule" "$command" train
done
expect 0 '^period = 3$' "$capsule" show train
rm -r train
printf 'flow.type = "extension"\nuntil.time = 1\n%s\nflow.period = 3\n' "$good" | sed /radius/d |
  bad '5:15: error: flow.period means nothing to flow.type = "extension"'
echo "$good
pore.opening_angle_deg = 120" | bad '4:26: error: .* is out of range'
echo 'membrane.law = "skalak"
capsule.radius = 0.9' | bad "1:1: error: missing key 'flow.capillary_number'"
printf 'accuracy = 1\n%s\nmesh.wall = 1.5\n' "$good" | bad '5:13: error: mesh.wall must be a whole number'
printf 'accuracy = 1\n%s\nmesh.wall = 1.5\n' "$good" | bad '1:12: error: accuracy = 1 is out of range'
printf '' | bad '1:1: error: the file holds no keys'
printf '\000\001\002\377' | bad '1:1: error: not a text file'
printf 'title = "\377\376"\n%s\n' "$good" | bad '1:[0-9]+: error: '
printf 'title = "\303\251" # \303\251\n%s\nr\303\251 = 1\n' "$good" | bad '5:2: error: '
echo "$good" | sed 's/skalak/mooney/' | bad "2:16: error: unknown membrane.law 'mooney'"
echo "$good" | sed 's/0.04/-0.04/' | bad '3:25: error: flow.capillary_number = -0.04 is out of range'
echo "$good" | sed 's/0.04/nan/' | bad '3:25: error: .* must be a finite number, not nan'
echo "$good" | sed 's/0.04/inf/' | bad '3:25: error: .* must be a finite number, not inf'
echo "$good
capsule.aspect_ratio = 0" | bad '4:24: error: capsule.aspect_ratio = 0 is out of range'
echo "$good
capsule.shape = \"biconcave\"
capsule.aspect_ratio = 0.5" | bad '5:24: error: capsule.aspect_ratio means nothing to capsule.shape = "biconcave"'
echo "$good
capsule.start_x = -40" | bad '4:19: error: capsule outside the reservoir'
echo "$good
capsule.start_x = 0" | sed 's/0.9/1.1/' | bad "4:19: error: capsule larger than the pore's entrance at its start"
echo "$good
until.x_g = 14.5" | bad '4:13: error: at until.x_g = 14.5 the capsule would cross the exit section'
two_mouths='pore.shape = "two-mouths"'
printf '%s\n%s\ncapsule.start_x = 16\n' "$good" "$two_mouths" |
  bad '5:19: error: the capsule starts behind the pore, at x = 16'
printf '%s\n%s\nuntil.x_g = 24.5\n' "$good" "$two_mouths" |
  bad '5:13: error: at until.x_g = 24.5 the capsule would cross the end of its way'
printf '%s\n%s\noutput.transit_to = 20\n' "$good" "$two_mouths" |
  bad '5:21: error: the capsule never comes to x_g = 20'
printf '%s\n%s\noutput.transit_from = 3\noutput.transit_to = 2\n' "$good" "$two_mouths" |
  bad '6:21: error: the transit ends at 2, before it begins'
echo "$good
output.transit_from = 0" | bad '4:23: error: output.transit_from means nothing to pore.shape = "hyperbolic"'
printf '%s\n%s\npore.entrance_distance = 8\n' "$good" "$two_mouths" |
  bad '5:26: error: reservoirs of 8 radii are too short for two mouths'
echo "$good
[sweep]
\"flow.viscosity\" = [1, 2]" | bad "5:1: error: unknown key 'flow.viscosity' in sweep"
echo "$good
[sweep]
\"flow.viscosity_ratio\" = [1, \"a\"]" | bad '5:30: error: .* must be a number'
echo "$good
[mesh" | bad '4:[0-9]+: error: '
echo "$good
flow.capillary_number = 0.1" | bad '4:[0-9]+: error: .*capillary_number'
echo "inherit = 'none.toml'
$good" | bad "1:11: error: .*none.toml': no such file"
echo "inherit = 'case.toml'
$good" | bad "1:11: error: .* inherits from itself"
echo "$good
mesh.exit = 20" | bad '4:13: error: mesh.exit means nothing to numerics = "standard"'
echo "$good
membrane.shear_viscosity = -1" | bad '4:28: error: membrane.shear_viscosity = -1 is out of range'
printf '%s\nmembrane.dilatational_viscosity = 1\nnumerics = "paper"\n' "$good" |
  bad '4:35: error: membrane.dilatational_viscosity means nothing to numerics = "paper"'
for wrong in 'time.scheme = "bdf"' 'pore.shape = "tube"' 'flow.type = "extension"'; do
  printf '%s\nnumerics = "paper"\n%s\n' "$good" "$wrong" | bad '5:[0-9]+: error: numerics = "paper" '
done
echo "$good
pore.entrance_distance = 1" | bad '4:26: error: .* is out of range'
echo "$good
flow.viscosity_ratio = 1e-5" | bad '4:24: error: .* is out of range'
physical='[physical]
tube_radius = "5 um"
viscosity = "1 mPa s"
flow_rate = "0.1 nL/s"
shear_modulus = "20 pN/µm"
capsule_radius = "4 µm"
[membrane]
law = "neo-hookean"'
echo "$physical" | sed 's/5 um/5 umm/' | bad "2:15: error: physical.tube_radius: unknown unit 'umm' in '5 umm'"
echo "$physical" | sed 's/nL.s/nL/' | bad "4:13: error: physical.flow_rate: '0.1 nL' is a quantity in m3, not a flow rate"
printf '%s\nshear_viscosity = 200\n' "$physical" | sed '/^flow_rate/a membrane_shear_viscosity = "200 mPa.s"' |
  bad "5:28: error: physical.membrane_shear_viscosity: '200 mPa.s' is a viscosity, not a surface viscosity"
for typed in 'resistivity = "0.65 ohm.m"' 'pore_length = "1 mm"'; do
  printf '%s\n' "$physical" | sed "/^flow_rate/a $typed" | bad '5:[0-9]*: error: physical.[a-z_]* means nothing without '
done
printf 'output.resistance = true\n%s\n' "$physical" | sed '/^flow_rate/a resistivity = "0.65 ohm"' |
  bad "6:15: error: physical.resistivity: '0.65 ohm' is a resistance, not a resistivity"
echo "$physical" | sed 's/^flow_rate.*/pressure = "20 Pa"/' | bad '4:12: error: physical.pressure needs physical.pore_length'
printf 'pore.shape = "two-mouths"\n%s\n' "$physical" | sed 's/^flow_rate.*/pressure = "20 Pa"\npore_length = "8 um"/' |
  bad '6:15: error: physical.pressure sets no flow rate in a pore of 1.6 radii'
echo "$physical" | sed '/viscosity/d' | bad "2:15: error: missing key 'physical.viscosity'"
echo "$physical" | sed 's/tube_radius/tube_radus/' | bad "2:1: error: unknown key 'physical.tube_radus'"
rm -r bad
# Line ends of other systems mean nothing.
for end in '\r' '\r\n'; do
  echo "$good" | while read -r line; do printf "%s$end" "$line"; done >ends.toml
  expect 0 '^capillary_number = 0.04' "$capsule" show ends.toml
  rm ends.toml
done
# What isn't ASCII is shown as it is, the caret below the character that is meant.
echo 'title = "µ日" x' >shown.toml
expect 2 '^    1 [|] title = "µ日" x$' "$capsule" show shown.toml
expect 2 '^      [|]              [\^]$' "$capsule" show shown.toml
rm shown.toml
echo "$physical" >physical.toml
expect 0 '^tube_radius = "5 um"' "$capsule" show physical.toml
expect 2 "^did you mean '4 um'" "$capsule" show physical.toml --set 'physical.capsule_radius=4 ym'
expect 2 "^--set:1:25: error: physical.capsule_radius: '4 s' is a time, not a length" \
  "$capsule" show physical.toml --set 'physical.capsule_radius=4 s'
expect 0 '^# Re is the Reynolds number of a liquid of 1000 kg/m3$' "$capsule" show physical.toml
expect 0 '^# physical  neo-hookean  0.8   0.06366  .*  0.1 nL/s  0.0064  ' "$capsule" show physical.toml
expect 0 '^# the Reynolds number is 32 .*: not small, but the model has no inertia$' \
  "$capsule" show physical.toml --set physical.flow_rate=0.5ul/s
expect 0 '^capillary_number = 0.0636619' "$capsule" show physical.toml --set flow.capillary_number=0.06366
expect 2 'or let them agree to four digits' "$capsule" show physical.toml --set flow.capillary_number=0.0636
rm physical.toml

# What a case expects, as a spreadsheet may save it.
mkdir bad
echo "$good" >bad/case.toml
rows='id;run;quantity;expected;allowed;reason
a;;v_g;1,3;0,1 %;'
echo "$rows" >bad/expected.csv
expect 2 '^bad/expected.csv:1:1: error: semicolons' "$capsule" check bad
echo "$rows" | tr ';' ',' | iconv -t UTF-16 >bad/expected.csv
expect 2 '^bad/expected.csv:1:1: error: the text is in UTF-16' "$capsule" check bad
expect 2 '^save it as CSV in UTF-8 with commas' "$capsule" check bad
for bytes in UTF-32 UTF-32LE UTF-32BE; do
  echo "$good" | iconv -t $bytes >bad/case.toml
  expect 2 '^bad/case.toml:1:1: error: the text (is|seems to be) in UTF-32; save it in UTF-8$' "$capsule" check bad
done
echo "$good" | iconv -t UTF-16 >bad/case.toml
expect 2 '^bad/case.toml:1:1: error: the text is in UTF-16; save it in UTF-8$' "$capsule" check bad
rm -r bad

expect 2 '^none:1:1: error: no such file' "$capsule" run none
mkdir -p cases/prolate-c1
echo "$good" >cases/prolate-c1/case.toml
expect 2 "^did you mean 'cases/prolate-c1'" "$capsule" run prolate-c1
expect 2 "^did you mean 'cases/prolate-c1'" "$capsule" steady cases/prolat-c1/
rm -r cases
mkdir empty
expect 2 '^empty/case.toml:1:1: error: no such file' "$capsule" run empty
echo "$good" >file.toml
expect 2 '^file.toml/below:1:1: error: no such file' "$capsule" run file.toml/below
truncate -s 1G huge.toml
expect 2 '^huge.toml:1:1: error: is larger' "$capsule" run huge.toml
ln -s /proc/self/mem unreadable.toml
expect 2 '^unreadable.toml:1:1: error: cannot be read' "$capsule" run unreadable.toml
expect 2 '^--set:1:1: error: unknown key' "$capsule" run file.toml --set flow.viscosity=1
expect 2 '^--set:1:1: error: ' "$capsule" run file.toml --set 'ωflow.viscosity=1'
expect 2 "^did you mean 'flow.viscosity_ratio'" "$capsule" run file.toml --set flow.viscosity_rato=1
expect 2 '^--set:1:1: error: expected key=value' "$capsule" run file.toml --set flow.viscosity_ratio
expect 2 '^--set:1:22: error: flow.viscosity_ratio = -1' "$capsule" run file.toml --set flow.viscosity_ratio=-1
expect 2 '^--set:1:13: error: a steady state under constant pressure needs a pore of 2 radii or more' \
  "$capsule" steady file.toml --set flow.drive=pressure --set pore.exit_x=1.5
expect 2 '^--set:1:12: error: an infinite train has no pore that a pressure drives' \
  "$capsule" steady file.toml --set flow.drive=pressure --set flow.period=3
expect 2 '^--set:1:16: error: a steady state is of one capsule, or of a train of equal ones' \
  "$capsule" steady file.toml --set "capsule.radius=[0.7, 0.8]" --set "capsule.start_x=[1, -3]"
expect 2 '^--set:1:16: error: the capsules of a train are equal' \
  "$capsule" steady file.toml --set "capsule.radius=[0.7, 0.8]" --set flow.period=3
expect 2 '^--set:1:13: error: flow.period = 0.9 of the tube holds less than one capsule' \
  "$capsule" steady file.toml --set flow.period=0.9
for along in eps epsilon Ca; do
  expect 2 "^did you mean 'flow.capillary_number'[?]$" "$capsule" branch file.toml --along $along --to 0.1
done
expect 2 "^did you mean 'physical.flow_rate'[?]$" "$capsule" branch file.toml --along flow_rate --to '5 nl/s'
expect 2 "^error: no branch along 'flow.period': the case has no train" \
  "$capsule" branch file.toml --along flow.period --to 3
expect 2 "^--set:1:12: error: unknown flow.drive 'pump'" "$capsule" run file.toml --set flow.drive=pump
for typed in 1.0d-3 1d-3 0,04 .04; do
  expect 2 '^write [01].[0-9e.-]*$' "$capsule" run file.toml --set "flow.capillary_number=$typed"
done
expect 0 '^membrane = 60$' "$capsule" show file.toml --set mesh.membrane=60.0
expect 2 'a whole number, not 60.5' "$capsule" show file.toml --set mesh.membrane=60.5
expect 2 "--to: '0,3' is not a number; write 0.3" "$capsule" branch file.toml --along capsule.radius --to 0,3
expect 2 "'1,5' is not a number; write 1.5" "$capsule" run file.toml --time-limit 1,5
expect 2 'capsule.radius = 1e-100 is out of range' "$capsule" run file.toml --set capsule.radius=1e-100
expect 2 'until.time = 5e-324 is out of range' "$capsule" run file.toml --set until.time=5e-324
expect 2 'time.step = 5e-324 is out of range' \
  "$capsule" run file.toml --set time.scheme=euler --set time.step=5e-324
# A sweep whose runs' directories could not be made.
{
  printf '%s\n[sweep]\n' "$good" | sed '/0.9/d; /0.04/d'
  for key in capsule.radius flow.capillary_number flow.viscosity_ratio capsule.aspect_ratio capsule.start_x \
    membrane.bending_ratio pore.opening_angle_deg pore.exit_x pore.entrance_distance time.tolerance; do
    case $key in
    capsule.start_x) value=-4.1234567890123456 ;;
    pore.opening_angle_deg) value=78.123456789012345 ;;
    pore.*) value=15.123456789012345 ;;
    time.tolerance | membrane.*) value=1.1234567890123456e-5 ;;
    *) value=0.81234567890123456 ;;
    esac
    echo "\"$key\" = [$value]"
  done
} >long.toml
expect 2 '^long.toml:3:1: error: the sweeps give the runs names of [0-9]* bytes; the directory of a run can have 255$' \
  "$capsule" run long.toml
rm long.toml
expect 2 'CASE' "$capsule" run
expect 2 'subcommand' "$capsule"
expect 2 'jobs' "$capsule" run file.toml --jobs 0
expect 2 'time-limit' "$capsule" run file.toml --time-limit -1
expect 2 'time-limit' "$capsule" run file.toml --time-limit nan
expect 2 "^did you mean 'steady'" "$capsule" stedy file.toml
expect 2 "^did you mean 'capsule.radius'" "$capsule" branch file.toml --along capsule.raduis --to 1
expect 2 '^error: --to nan: .*finite number, not nan' "$capsule" branch file.toml --along capsule.radius --to nan
expect 2 '^error: there is no directory cases/ here' "$capsule" new fresh
mkdir cases
expect 2 'error: is not a case directory' "$capsule" new fresh --like none
rmdir cases
expect 0 'capillary_number' "$capsule" keys
expect 0 "a viscosity such as '1 mPa.s'" "$capsule" keys
expect 0 '^ *symbol: epsilon, eps, Ca, ε$' "$capsule" keys
expect 0 '^membrane.law ' "$capsule" keys membrane
expect 0 '^flow.capillary_number ' "$capsule" keys eps
expect 1 'no empty line' sh -c "'$capsule' keys eps | sed 1q | grep '^$' || { echo no empty line; false; }"
expect 1 'no such key' sh -c "'$capsule' keys membrane | grep '^flow[.]' || { echo no such key; false; }"
expect 2 "^did you mean 'membrane.bending_ratio'[?]$" "$capsule" keys bendin_ratio
for command in run steady branch fit check ledger new; do
  expect 0 '^Usage' "$capsule" "$command" --help
  expect 1 'no such word' sh -c "'$capsule' $command --help | grep -E 'TEXT|UINT|FLOAT' || { echo no such word; false; }"
done
expect 0 '^  --set KEY=VALUE' "$capsule" run --help
expect 0 '^capsule [0-9]' "$capsule" --version
expect 0 'to be computed' "$capsule" show file.toml
expect 4 'No space left' sh -c "'$capsule' keys >/dev/full"
expect 4 'file.toml/below' "$capsule" run file.toml --out file.toml/below
expect 3 'not enough memory' \
  sh -c "ulimit -v 600000; '$capsule' run file.toml --set mesh.membrane=10000 --out '$place.out'"
rm -rf "$place.out"

[ ! -s "$failed" ] && echo "every kind of bad input is refused"
