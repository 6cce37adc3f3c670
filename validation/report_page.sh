#!/bin/sh
# The report's page in a browser without a screen: it loads, the slider and the curve move the capsule, the keyboard
# does, it plays, another run can be chosen, it fits a narrow screen, nothing is fetched and nothing complains.
#   report_page.sh CAPSULE     with the program `report_page` beside it
# Skipped (77) where Debian's chromium-driver is missing. Pictures: report-page-*.png in the current directory.
set -eu
capsule=$(realpath "$1")
report=$(dirname "$capsule")/report_page
if ! command -v chromedriver > /dev/null || ! command -v jq > /dev/null; then
  echo "skipped: needs the packages chromium-driver and jq"
  exit 77
fi
pictures=$PWD
place=$(mktemp -d)
cd "$place"
driver=
trap 'test -z "$driver" || kill "$driver" 2> /dev/null || true; rm -rf "$place"' EXIT

fail() {
  echo "FAILS: $1"
  exit 1
}
expect() { # what, wanted, found
  test "$2" = "$3" || fail "$1: wanted '$2', found '$3'"
  echo "ok: $1"
}

mkdir -p cases/small
cat > cases/small/case.toml << 'END'
accuracy = 1e-2
[capsule]
radius = 0.7
start_x = -2.5
[membrane]
law = "skalak"
bending_ratio = 1e-3
[flow]
capillary_number = 0.05
[until]
x_g = 0.5
[output]
profiles_at_x_g = [-2.4, -2.3, -2.2, -2.1, -2, -1.9, -1.8, -1.7, -1.6, -1.5, -1.4, -1.3, -1.2, -1.1, -1, -0.8, -0.6, -0.4, -0.2, 0, 0.2]
[sweep]
"flow.viscosity_ratio" = [1, 3]
END
mkdir -p cases/two
sed '/^start_x/s/-2.5/[-2.5, -4.2]/; /sweep/,$d' cases/small/case.toml > cases/two/case.toml
"$capsule" run cases/small > /dev/null 2>&1
"$capsule" run cases/two > /dev/null 2>&1
"$report" page.html cases/small cases/two
if grep -Eo '(src|href)="(https?:)?//[^"]*"' page.html; then
  fail "the page refers to another place"
fi

port=$((20000 + $$ % 20000))
chromedriver --port=$port > driver.log 2>&1 &
driver=$!
server=http://127.0.0.1:$port
for _ in $(seq 100); do
  curl -s "$server/status" > /dev/null && break
  sleep 0.1
done

call() { # method, path, body
  curl -s -X "$1" -H 'Content-Type: application/json' ${3:+-d "$3"} "$server$2"
}
session=$(call POST /session '{"capabilities": {"alwaysMatch": {"goog:loggingPrefs": {"browser": "ALL"},
  "goog:chromeOptions": {"args": ["--headless=new", "--no-sandbox", "--window-size=1200,1400"]}}}}' |
  jq -r .value.sessionId)
test "$session" != null || fail "no browser: $(cat driver.log)"
at=/session/$session
script() { # the value of a JavaScript expression
  call POST "$at/execute/sync" "$(jq -n --arg code "return $1" '{script: $code, args: []}')" | jq -r .value
}
element() { # the handle of the element with this identifier
  call POST "$at/element" "{\"using\": \"css selector\", \"value\": \"#$1\"}" | jq -r '.value | to_entries[0].value'
}
picture() {
  call GET "$at/screenshot" | jq -r .value | base64 -d > "$pictures/report-page-$1.png"
}
readout='document.getElementById("readout").textContent'
drawing='document.getElementById("pore").toDataURL()'

call POST "$at/url" "{\"url\": \"file://$place/page.html\"}" > /dev/null
expect "the page loads" "A capsule enters a pore: report" "$(script document.title)"
expect "all runs can be chosen" 3 "$(script 'document.getElementById("run").length')"
expect "it starts before the mouth" "xg = -1.00" "$(script "$readout" | cut -d, -f1)"
expect "the solid around the pore is drawn" '#c9ced4' "$(script '(() => {
  const pore = document.getElementById("pore"), corner = pore.getContext("2d").getImageData(pore.width - 3, 3, 1, 1).data;
  return "#" + [...corner.slice(0, 3)].map((part) => part.toString(16)).join("") })()')"
expect "the colours have a scale" true "$(script '(() => {
  const end = (which) => Number(document.getElementById("scale-" + which).textContent);
  return end("low") <= 1 && 1 < end("high") })()')"
picture load

drag() { # element, from and to: horizontal shares of its half width, from its centre
  half=$(script "document.getElementById('$1').getBoundingClientRect().width / 2")
  call POST "$at/actions" "$(jq -n --arg id "$(element "$1")" --argjson half "$half" --argjson from "$2" --argjson to "$3" '
    {"element-6066-11e4-a52e-4f735466cecf": $id} as $origin |
    {actions: [{type: "pointer", id: "mouse", actions: [
      {type: "pointerMove", origin: $origin, x: ($from * $half | floor), y: 0}, {type: "pointerDown", button: 0},
      {type: "pointerMove", origin: $origin, x: ($to * $half | floor), y: 0}, {type: "pointerUp", button: 0}]}]}')" > /dev/null
}
call POST "$at/execute/sync" '{"script": "document.getElementById(\"player\").scrollIntoView()", "args": []}' > /dev/null
before=$(script "$drawing" | cksum)
drag place 0 0.9
test "$(script "$readout" | cut -d, -f1)" != "xg = -1.00" || fail "the slider does not follow the mouse"
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the slider"
echo "ok: dragging the slider moves the capsule"
before=$(script "$readout")
drag curve 0.5 -0.5
test "$(script "$readout")" != "$before" || fail "the curve does not follow the mouse"
echo "ok: dragging on the curve moves the capsule"

before=$(script 'document.getElementById("place").valueAsNumber')
call POST "$at/element/$(element place)/value" '{"text": "\uE014\uE014"}' > /dev/null # right arrow, twice
expect "the arrow keys move the capsule" 0.2 "$(script "(document.getElementById('place').valueAsNumber - $before).toFixed(1)")"
before=$(script "$drawing" | cksum)
call POST "$at/element/$(element run)/value" '{"text": "\uE015"}' > /dev/null # down arrow
expect "the keyboard chooses the other run" 1 "$(script 'document.getElementById("run").value')"
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the run"
before=$(script "$drawing" | cksum)
call POST "$at/element/$(element colour)/value" '{"text": "\uE015"}' > /dev/null
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the colour"
echo "ok: run and colour change the picture"
expect "a run of two capsules has both in each frame" true "$(script '(() => {
  const { runs } = JSON.parse(document.getElementById("player-data").textContent);
  return runs[2].frames.every((frame) => frame.capsules.length === 2) })()')"
before=$(script "$drawing" | cksum)
call POST "$at/element/$(element run)/value" '{"text": "\uE015"}' > /dev/null
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the run of two capsules"
picture two
script 'document.getElementById("place").value = -2' > /dev/null
call POST "$at/element/$(element play)/click" '{}' > /dev/null
sleep 0.5
expect "playing moves the capsule" true "$(script "document.getElementById('place').valueAsNumber > -2")"
picture dragged

call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setDeviceMetricsOverride",
  "params": {"width": 360, "height": 740, "deviceScaleFactor": 2, "mobile": true}}' > /dev/null
call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setEmulatedMedia",
  "params": {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}}' > /dev/null
expect "it fits a narrow screen" true "$(script 'document.documentElement.scrollWidth <= 360')"
expect "it is dark where dark is wanted" 'rgb(20, 23, 27)' "$(script 'getComputedStyle(document.body).backgroundColor')"
script 'document.getElementById("player").scrollIntoView()' > /dev/null
picture narrow-dark

expect "nothing complains" 0 "$(call POST "$at/se/log" '{"type": "browser"}' | jq '.value | length')"
call DELETE "$at" > /dev/null
