#!/bin/sh
# A disk that is full, and one that nothing can be written to: exit code 4 and the reason, nothing half-written, nothing
# lost; with room again the same command goes on and ends as a run with room from the start. A finished case can be
# read where nothing can be written.
#   sh validation/disk.sh path/to/capsule
# Skipped (77) where no small disk can be mounted: that needs root, or user namespaces.
set -u
capsule=$(realpath "$1")
if [ $# -eq 1 ]; then # again, where mounts are seen by nobody else
  unshare --mount true 2>/dev/null && exec unshare --mount sh "$0" "$capsule" mounts
  unshare --map-root-user --mount true 2>/dev/null && exec unshare --map-root-user --mount sh "$0" "$capsule" mounts
  echo 'skipped: needs root, or namespaces of users, to mount a disk'
  exit 77
fi
place=$(mktemp -d)
trap 'cd / && umount -R "$place" && rmdir "$place"' EXIT
mount -t tmpfs -o size=32m none "$place" || exit 77
cd "$place" || exit 1
cat >case.toml <<'TOML'
accuracy = 1e-3
capsule.radius = 0.9
membrane.law = "skalak"
membrane.dilatation = 0
flow.capillary_number = 0.04
flow.viscosity_ratio = 5
until.x_g = 2
sweep."membrane.bending_ratio" = [1e-5, 1e-4]
TOML

fail() {
  echo "FAILED: $*"
  exit 1
}
# expect CODE PATTERN COMMAND...
expect() {
  code=$1
  pattern=$2
  shift 2
  output=$("$@" 2>&1)
  got=$?
  [ "$got" -eq "$code" ] && printf '%s\n' "$output" | grep -Eq -e "$pattern" ||
    fail "$* ended with $got instead of $code, or without '$pattern': $output"
}
numbers() { # all files of the runs but for what tells of the way there
  (cd "$1" && find . -type f ! -name run.json | sort | while read -r file; do
    echo "$file" && grep -v '_seconds"' "$file"
  done)
}
"$capsule" run case.toml --out whole --jobs 2 || fail 'no run'
numbers whole >expected

# The disk grows until there is room; what was computed before is not lost.
mkdir disk
mount -t tmpfs -o size=4k none disk || fail 'mount'
full=0
for size in 4k 8k 16k 64k 128k 256k 512k 1m 2m 4m 8m 16m; do
  mount -o "remount,size=$size" disk || fail 'remount'
  output=$("$capsule" run case.toml --out disk/out --jobs $((full % 2 + 1)) 2>&1) && break
  code=$?
  [ "$code" -eq 4 ] || fail "ended with $code with $size: $output"
  echo "$output" | grep -Eq "^error: (bending_ratio=[^:]*: )?cannot (write|create directory) 'disk/out.*': No space left on device" || fail "$output"
  full=$((full + 1))
  for run in disk/out/*/; do
    [ ! -e "$run/summary.json" ] || [ ! -e "$run/checkpoint.json" ] || fail "$run is finished and is not"
  done
  [ -z "$(find disk -name '.writing-*')" ] || fail "with $size something is half-written"
done
[ "$full" -gt 3 ] || fail 'the disk was never full'
numbers disk/out >got
cmp expected got || fail 'not the run with room from the start'

# Nothing can be written: a finished case is used, another is not begun.
mount -o remount,ro disk || fail 'remount'
expect 0 'computed before' "$capsule" run case.toml --out disk/out
expect 0 'finished in' "$capsule" show case.toml --out disk/out
expect 0 'NOTHING TO COMPARE' "$capsule" check case.toml --out disk/out
expect 4 "error: .*cannot .*'disk/out/.*': Read-only file system" "$capsule" run case.toml --out disk/out --fresh
expect 4 "error: .*cannot .*'disk/other.*': Read-only file system" "$capsule" run case.toml --out disk/other
expect 4 "error: cannot .*'disk/table.csv': Read-only file system" "$capsule" check case.toml --out disk/out --table disk/table
numbers disk/out >got
cmp expected got || fail 'something is lost'
umount disk
echo "a full disk $full times, and one that cannot be written to: said, and nothing lost"
