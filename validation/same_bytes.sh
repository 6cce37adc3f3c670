#!/bin/sh
# The same runs give the same bytes again, one at a time or two.
#   sh validation/same_bytes.sh path/to/capsule
. "$(dirname "$0")/lib/program.sh"
cat >case.toml <<'TOML'
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
mesh.membrane = 32
until.x_g = -2.5
output.profiles_at_x_g = [-3]
sweep."flow.viscosity_ratio" = [1, 5]
TOML

"$capsule" run case.toml --out first
"$capsule" run case.toml --out again
"$capsule" run case.toml --out two --jobs 2

for other in again two; do
  for run in first/*/; do
    for file in "$run"*; do
      name=${file#first/}
      case $name in
      */run.json) continue ;; # when, where and how long
      */summary.json) grep -v '_seconds"' "$file" >expected && grep -v '_seconds"' "$other/$name" >got ;;
      *) cp "$file" expected && cp "$other/$name" got ;;
      esac
      cmp expected got || fail "$other/$name differs"
    done
  done
done
echo 'the same bytes'
