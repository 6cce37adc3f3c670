#!/bin/sh
# Every law by the whole program: a steady state and an entrance of each. Laws that are the same by an identity give the
# same numbers: Skalak's with C = 0 and the generalised Hooke's with nu_s = 0, Mooney and Rivlin's with Psi = 1 and the
# neo-Hookean one.
#   sh validation/laws.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
cat >capsule.toml <<'TOML'
accuracy = 1e-3
capsule.radius = 0.8
membrane.law = "neo-hookean"
membrane.bending_ratio = 1e-3
flow.capillary_number = 0.06
until.x_g = 1
TOML
try() { # NAME LAW [--set KEY=VALUE]
  name=$1
  law=$2
  shift 2
  ends 0 steady capsule.toml --set "membrane.law=$law" "$@" --out "steady-$name"
  ends 0 run capsule.toml --set "membrane.law=$law" "$@" --out "entrance-$name"
}
value() { # FILE NAME
  sed -n "s/^  \"$2\": \([-+.e0-9]*\),*$/\1/p" "$1"
}
equal() { # RUN RUN
  for name in v_g pressure_drop max_stretch length; do
    awk -v a="$(value "$1/summary.json" $name)" -v b="$(value "$2/summary.json" $name)" \
      'BEGIN { exit !(a != "" && b > 0 && (a - b)^2 < (1e-5 * b)^2) }' || return 1
  done
}

for law in $("$capsule" keys | sed -n "/^membrane.law/,/^membrane.dil/s/^ *\([a-z-]*\): .*[()].*/\1/p"); do
  try "$law" "$law"
  [ "$law" = neo-hookean ] || ! equal steady-neo-hookean "steady-$law" || fail "$law gives what neo-hookean gives"
done
[ -d steady-evans-skalak ] || fail 'the laws are not found in the list of keys'
try psi mooney-rivlin --set membrane.psi=1
try no-dilatation skalak --set membrane.dilatation=0
try hooke generalised-hooke --set membrane.poisson_ratio=0
for what in steady entrance; do
  equal $what-neo-hookean $what-psi || fail "$what: Mooney-Rivlin with Psi = 1 is not neo-Hookean"
  equal $what-no-dilatation $what-hooke || fail "$what: Skalak with C = 0 is not generalised Hooke with nu_s = 0"
done
echo "each law has a steady state and an entrance; the same laws give the same"
