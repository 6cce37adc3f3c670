#!/bin/sh
# paper-notes/files.md says what every column and every entry means that a run, a steady state and a branch leave.
#   sh validation/files.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
notes=$project/paper-notes/files.md
cat >case.toml <<'TOML'
accuracy = 1e-2
membrane.law = "skalak"
membrane.bending_ratio = 1e-3
until.time = 0.1
output.resistance = true
[physical]
tube_radius = "5 um"
capsule_radius = "3 um"
viscosity = "1 mPa.s"
shear_modulus = "20 uN/m"
flow_rate = "0.1 nl/s"
TOML
ends 0 run case.toml --out run
grep -Eq "^  in the case's units:  t [0-9.e-]+ s  x_g [0-9.-]+ um  v_g [0-9.]+ um/s  pressure drop [0-9.]+ Pa$" log ||
  fail "the end in the case's units is not told"
ends 0 steady case.toml --out steady
sed '/physical/,$d' case.toml >branch.toml
printf '[capsule]\nradius = 0.5\n[flow]\ncapillary_number = 0.05\n' >>branch.toml
ends 0 branch branch.toml --along flow.capillary_number --to 0.051 --out branch
ends 0 branch case.toml --along physical.flow_rate --to '0.11 nl/s' --out units
ends 0 branch branch.toml --set membrane.law=neo-hookean --set membrane.bending_ratio=0.02 --set capsule.radius=0.8 \
  --set flow.capillary_number=0.2 --along flow.capillary_number --to 0.3 --fold-along capsule.radius --fold-to 0.81 --out fold
ends 0 steady branch.toml --set flow.period=2 --set output.resistance=false --out train
ends 0 run branch.toml --set until.time=0.1 --set "capsule.start_x=[-2, -4]" --set output.resistance=false --out pair
grep -Eq '  x_g -[0-9.]+  v_g [0-9.]+  x_g#2 -[0-9.]+  v_g#2 [0-9.]+  pressure drop' log || fail 'the second capsule is not told'
sed 's/until.time = 0.1/pore.shape = "two-mouths"/' case.toml >transit.toml
ends 0 run transit.toml --set pore.exit_x=2 --set until.x_g=3.5 --out transit
grep -Eq '  transit time [0-9.]+  pulse height [0-9.]+  CPU' log || fail 'the transit is not told'
# The start is written once, however its place is rounded, if a profile is asked for there.
for start in -1.3 -1.4 -1.5 -1.6 -1.7; do
  ends 0 run case.toml --set until.time=1e-3 --set capsule.start_x=$start --set "output.profiles_at_x_g=[$start]" --out start
  [ "$(cut -d, -f1,2 start/profiles.csv | uniq | wc -l)" -eq 3 ] || fail "the profile at the start, $start, stands there twice"
done
missing=0
for word in $(ls run branch units fold pair | sed '/:$/d; s/_000[1-9]/_0000/' | sort -u) \
  $(cat */series.csv */profiles.csv */branch.csv | grep '^[a-z]' | tr ',' '\n' | sort -u) \
  $(sed -n 's/^  "\([a-z_]*\)": .*/\1/p' */summary.json | sort -u); do
  case $word in flow.*) continue ;; esac # the key that varies
  grep -qF "\`$word\`" "$notes" || { echo "paper-notes/files.md does not speak of '$word'"; missing=$((missing + 1)); }
done
[ "$missing" -eq 0 ] || exit 1
# The other way round: the names in the first column of its tables.
for word in $(sed -n 's/^| \(`[^|]*`\) .*|.*|$/\1/p' "$notes" | grep -o '`[a-z_A-Z0-9.]*`' | tr -d '`'); do
  ls run branch units fold pair | grep -qxF "$word" || grep -qwF "$word" */*.csv */summary.json || [ "$word" = checkpoint.json ] ||
    fail "paper-notes/files.md speaks of '$word', which nothing leaves"
done
echo 'the notes speak of what runs leave'
