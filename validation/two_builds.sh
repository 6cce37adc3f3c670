#!/bin/sh
# What computes a march, built by another compiler and with less optimisation, gives the same numbers within the error
# estimates. Files, cases and the command line are those of the first build: they compute nothing here. That the other
# compiler takes them, too, and that the fuzzers link where it is clang++, is tried beside.
#   sh validation/two_builds.sh path/to/capsule
# Skipped (77) where the other compiler is missing: clang++, or g++ where clang++ has built the first. The second build
# stays beside the first, so that only what has changed is built again.
. "$(dirname "$0")/lib/program.sh"
second=$(dirname "$capsule")/second-build
cat >case.toml <<'TOML'
capsule.radius = 0.9
membrane.law = "neo-hookean"
flow.capillary_number = 0.05
until.x_g = 1
output.profiles_at_x_g = [-1]
sweep."flow.viscosity_ratio" = [1, 5]
TOML

"$capsule" run case.toml --jobs 2 --out first
compiler=clang++
if grep -q '"compiler": "Clang' first/viscosity_ratio=1/run.json; then compiler=g++; fi
if ! command -v $compiler >/dev/null; then
  echo "skipped: needs the package $([ $compiler = g++ ] && echo g++ || echo clang)"
  exit 77
fi
cmake -G Ninja -S "$project" -B "$second" -DCMAKE_CXX_COMPILER=$compiler -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG' -DREST_OF_SOLVER="$(dirname "$capsule")/libsolver.a" >log 2>&1 &&
  cmake --build "$second" --target capsule rest -j 2 >log 2>&1 || fail "the build by $compiler"
if [ $compiler = clang++ ]; then
  cmake --build "$second" --target fuzzers -j 2 >log 2>&1 || fail 'the build of the fuzzers'
fi
"$second/capsule" run case.toml --jobs 2 --out second

# One line a number: its name, its value. Those of error_estimate are called "error of ...".
values() {
  sed -n '/"error_estimate"/,/^  }/s/^    "\(.*\)": \([^,]*\),*$/error-of-\1 \2/p
          /^  "\(steps\|.*_seconds\)"/d
          s/^  "\([a-z_]*\)": \([-0-9][^,]*\),*$/\1 \2/p' "$1"
}
for run in first/*/; do
  run=${run#first/}
  values "first/$run/summary.json" >numbers-1
  values "second/$run/summary.json" >numbers-2
  awk -v run="${run%/}" '
    NR == FNR { first[$1] = $2; next }
    { second[$1] = $2 }
    END {
      for (name in first) {
        if (name ~ /^error-of-/ || name ~ /^(dents|roughness)$/) continue # how many, and how rough, is no result
        if (!(name in second)) { print "FAILED: no " name " in the second build"; exit 1 }
        # Both may be wrong. What has no estimate must agree to the accuracy asked for; 1e-12 is rounding.
        error = ("error-of-" name in first) ? first["error-of-" name] + second["error-of-" name] : 1e-4
        distance = first[name] - second[name]
        if (distance < 0) distance = -distance
        if (first[name] != second[name]) ++different
        if (distance > error + 1e-12) { print "FAILED: " run ": " name ": " first[name] " and " second[name] ", error " error; failed = 1 }
        if (distance / (error + 1e-12) > largest) { largest = distance / (error + 1e-12); worst = name }
        ++count
      }
      if (count < 15) { print "FAILED: only " count " numbers"; failed = 1 }
      if (!different) { print "FAILED: " run ": the same to the last digit, as if nothing had been built anew"; failed = 1 }
      printf "%s: %d numbers agree; the largest difference is %.2g of the estimated errors, in %s\n", run, count, largest, worst
      exit failed
    }' numbers-1 numbers-2 || fail 'the builds differ'
done
first_compiler=$(sed -n 's/.*"compiler": "\([A-Za-z]*\).*/\1/p' "first/$run/run.json")
echo "$first_compiler and $compiler agree"
