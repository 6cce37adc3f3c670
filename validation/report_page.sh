#!/bin/sh
# The report's page in a browser without a screen: the slider, the curve and the keyboard move the capsule, it plays by place
# and by time, two runs can be overlaid, pictures saved and enlarged, the ledger filtered; it fits a narrow screen, where
# a finger scrolls it; nothing is fetched and nothing complains.
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
session=
leave() { # the browser ends with its session, not with its driver
  test -z "$session" || call DELETE "/session/$session" > /dev/null || true
  test -z "$driver" || kill "$driver" 2> /dev/null || true
  rm -rf "$place"
}
trap leave EXIT

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
sed '/^start_x/s/-2.5/[-2.5, -4.2]/; /sweep/,$d; /^radius/d; /^.flow/d; /^capillary/d' cases/small/case.toml > cases/two/case.toml
cat >> cases/two/case.toml << 'END'
[physical]
tube_radius = "50 um"
capsule_radius = "35 um"
viscosity = "1 Pa.s"
flow_rate = "20 nl/s"
shear_modulus = "51 mN/m"
END
"$capsule" run cases/small > /dev/null 2>&1
"$capsule" run cases/two > /dev/null 2>&1
mkdir -p figures/small tables validation/uncomputed
echo '<svg xmlns="http://www.w3.org/2000/svg" width="600" height="400"><rect width="600" height="400" fill="#fff"/></svg>' > figures/small/shape.svg
echo '**Figure 5a.** Profiles at x_g = 2: they differ by 1e-05 in max_stretch, like N^-1.05 and 10^4.' > figures/small/shape.md
cat > tables/ledger.csv << 'END'
claim,row,where,kind,statement,published,with the paper's numerics,converged,own error,distance,allowed,verdict,cause,reading and evidence,run,quantity
A,A-1,Table 2,number,"v_g, lambda 1",1.3012,,1.30174231,2e-06,+0.04 %,0.1 %,agrees,,one digit,,
A,A-2,Table 2,number,"v_g, lambda 5",1.29,,1.2902,2e-06,+0.02 %,0.1 %,agrees,,one digit,,
B,B-0,Table 3,number,"Delta P, lambda 5",17.2,,17.21,0.006,+0.01,0.05,agrees,,,,
B,B-1,Table 3,number,"Delta P, lambda 1",18.30,18.31,17.64103,0.006,-0.66,0.05,differs,mesh,an error of the paper's mesh,,
C,C-1,Figure 8,number,x_g at t 18.7,3.44,,3.398205,7e-06,-0.042,0.005,differs,,nothing gives it,,
D,D-1,Table 1,number,"x_g, N_M 60",11.7255558,,11.7254,,,,not decidable,,not said,,
END
cat > tables/small.csv << 'END'
id,where,run,quantity,computed,converged,own error,expected,distance,allowed,verdict
film,,viscosity_ratio=1,min_film,0.1234,,1e-05,>0,+0.12,,agrees
drop,,viscosity_ratio=3,"max(pressure_drop@x_g=-1..0, 2)",3.21,,0.001,4.5,-29 %,1 %,"differs, NOT AS RECORDED"
ALL-dV,Section 4.2,viscosity_ratio=3,volume_change,1e-9,,,<0.001,-0.001,,agrees
END
echo '# What is not computed?' > validation/uncomputed/README.md
"$report" page.html cases/small cases/two validation/uncomputed
mkdir -p cases/passes
sed '/^profiles_at/d; /sweep/,$d' cases/small/case.toml > cases/passes/case.toml
printf 'profiles_every = 0.1\n[pore]\nshape = "two-mouths"\nexit_x = 2\n' >> cases/passes/case.toml
"$capsule" run cases/passes > /dev/null 2>&1
"$report" passes.html cases/passes
grep -q 'What is not computed? <code>cmake --build build --target study-uncomputed</code>' page.html || fail "a missing study is not named"
grep -q '<figcaption><strong>Figure 5a.</strong> Profiles at x<sub>g</sub> = 2: they differ by 1·10<sup>−5</sup> in max_stretch, like N<sup>−1.05</sup> and 10<sup>4</sup>[.]' page.html ||
  fail "the caption's symbols"
grep -q '<li><a href="#small-shape">Figure 5a</a> Profiles at x<sub>g</sub> = 2</li>' page.html || fail "the list of figures"
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
drawing='document.getElementById("pore").toDataURL()'
instant='document.getElementById("instant").valueAsNumber'
readout() { # a column of the readout, of this row
  script "document.querySelectorAll('#readout td[data-column=$1]')[${2:-0}].textContent"
}

call POST "$at/url" "{\"url\": \"file://$place/page.html\"}" > /dev/null
expect "the page loads" "A capsule enters a pore: report" "$(script document.title)"
expect "all runs can be chosen" 3 "$(script 'document.getElementById("run").length')"
expect "it starts before the mouth" -1 "$(script "Number('$(readout x_g)')")"
expect "the readout has as many decimals as the estimated error leaves" true "$(script '(() => {
  const { runs } = JSON.parse(document.getElementById("player-data").textContent), { decimals } = runs[0].series.pressure_drop;
  return document.querySelector("#readout td[data-column=pressure_drop]").textContent.split(".")[1].length === decimals })()')"
expect "the solid around the pore is drawn" '#c9ced4' "$(script '(() => {
  const pore = document.getElementById("pore"), corner = pore.getContext("2d").getImageData(pore.width - 3, 3, 1, 1).data;
  return "#" + [...corner.slice(0, 3)].map((part) => part.toString(16)).join("") })()')"
expect "a run is called by what differs in its case" "λ = 1 / λ = 3 / sphere, Skalak C = 1, radius 35 um, Q = 20 nl/s, G = 51 mN/m, viscosity 1 Pa.s, tube 50 um, λ = 1, starting at −2.5 and −4.2" \
  "$(script '[...document.getElementById("run").options].map((option) => option.text).join(" / ").replace(/, \d+ nodes/, "")')"
expect "what is shown is described" "small: sphere, Skalak C = 1, size 0.7, ε = 0.05, λ = 1" "$(script 'document.getElementById("which").textContent.replace(/, \d+ nodes/, "")')"
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
drag instant 0 0.9
test "$(readout x_g)" != -1.000 || fail "the slider does not follow the mouse"
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the slider"
echo "ok: dragging the slider moves the capsule"
before=$(readout x_g)
drag curve 0.5 -0.5
test "$(readout x_g)" != "$before" || fail "the curve does not follow the mouse"
echo "ok: dragging on the curve moves the capsule"

before=$(script "$instant")
call POST "$at/element/$(element instant)/value" '{"text": "\uE014\uE014"}' > /dev/null # right arrow, twice
expect "the arrow keys move the capsule" 0.2 "$(script "($instant - $before).toFixed(1)")"
axes='(() => { const curve = document.getElementById("curve"), strip = document.createElement("canvas");
  strip.width = 50;
  strip.height = curve.height;
  strip.getContext("2d").drawImage(curve, 0, 0);
  return strip.toDataURL() })()'
axes_before=$(script "$axes" | cksum)
before=$(script "$drawing" | cksum)
call POST "$at/element/$(element run)/value" '{"text": "\uE015"}' > /dev/null # down arrow
expect "the keyboard chooses the other run" 1 "$(script 'document.getElementById("run").value')"
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not follow the run"
expect "the axes are those of the other run" "$axes_before" "$(script "$axes" | cksum)"
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
expect "the files of both capsules are linked" "series.csv profiles.csv series-2.csv profiles-2.csv true" "$(script '(() => {
  const links = [...document.querySelectorAll("#data a")];
  return [...links.map((link) => link.textContent), links.every(({ href }) => href.includes("results/two/"))].join(" ") })()')"
test -s "$(script 'decodeURIComponent(new URL(document.querySelectorAll("#data a")[2].href).pathname)')" || fail "the link to series-2.csv"
picture two
choose() { # element, value
  script "(() => { const choice = document.getElementById('$1'); choice.value = '$2'; choice.dispatchEvent(new Event('change')) })()" > /dev/null
}
choose run 0
before=$(script "$drawing" | cksum)
choose other-run 1
test "$(script "$drawing" | cksum)" != "$before" || fail "the picture does not show the second run"
# Each has as many digits as are known of it.
expect "two runs are overlaid at one place" true "$(script "Math.abs($(readout x_g) - $(readout x_g 1)) < 1e-3")"
picture overlaid
before=$(readout x_g)
choose clock time
expect "the other clock shows the same instant" "$before" "$(readout x_g)"
expect "two runs are overlaid at one time, but for the distance of their rows" true "$(script "Math.abs($(readout time) - $(readout time 1)) < 0.1")"
choose clock x_g
choose other-run ""
script 'document.getElementById("instant").value = -2' > /dev/null
choose speed 0.25
call POST "$at/element/$(element play)/click" '{}' > /dev/null
sleep 0.5
expect "playing moves the capsule" true "$(script "$instant > -2")"
call POST "$at/element/$(element loop)/click" '{}' > /dev/null
choose speed 4
sleep 1.5
expect "a loop goes on" true "$(script 'document.getElementById("play").getAttribute("aria-pressed")')"
call POST "$at/element/$(element play)/click" '{}' > /dev/null
picture played

call POST "$at/goog/cdp/execute" "{\"cmd\": \"Browser.setDownloadBehavior\", \"params\": {\"behavior\": \"allow\", \"downloadPath\": \"$place/saved\"}}" > /dev/null
call POST "$at/element/$(element save)/click" '{}' > /dev/null
for _ in $(seq 50); do
  [ -s saved/small-viscosity_ratio=1.png ] && break
  sleep 0.1
done
expect "the picture is saved" PNG "$(head -c 4 saved/small-viscosity_ratio=1.png | tail -c 3)"
test -s "$(script 'decodeURIComponent(new URL(document.querySelector("#data a").href).pathname)')" || fail "the link to series.csv"
echo "ok: the data are linked"

shown='[...document.querySelectorAll("#claims tbody")].filter((row) => !row.hidden).map((row) => row.dataset.outcome).join()'
expect "the ledger begins with its sums, of claims" "4 claims in 6 rows,1 agree,1 cannot be decided,1 differ because the paper's mesh is too coarse,1 are not reproduced,1 check of a case fails" \
  "$(script '[...document.querySelectorAll("#sums button")].map((button) => button.textContent).join()')"
expect "a check of a case that fails is among them, in red" "small differs, NOT AS RECORDED 600 rgb(192, 0, 24)" "$(script '(() => {
  const row = document.querySelector("#claims tbody"), verdict = row.querySelector(".failed"), { fontWeight, color } = getComputedStyle(verdict);
  return [row.querySelector("a").textContent, verdict.textContent, fontWeight > 600 ? 600 : fontWeight, color].join(" ") })()')"
expect "checks are counted" "1 of 2 agree, 1 fail." "$(script 'document.getElementById("counted").textContent.match(/1 of .*/)[0]')"
expect "the case says so, too" "true 1 of 3 rows not as recorded" "$(script '(() => { const comparison = document.querySelector("#small details");
  return [comparison.open, comparison.querySelector(".failed").textContent].join(" ") })()')"
script 'document.querySelector("#sums button.mesh").click()' > /dev/null
expect "a sum is a filter, of all rows of its claims" mesh,mesh "$(script "$shown")"
script 'document.querySelector("#sums button").click()' > /dev/null
call POST "$at/element/$(element find)/value" '{"text": "table v"}' > /dev/null
expect "words are found" agrees,agrees "$(script "$shown")"
expect "a number has the digits that its error leaves" "1.301742 ± 2·10−6" "$(script 'document.querySelector("#claims tbody[data-outcome=agrees] td[data-label=ours]").textContent')"

expect "figures begin small" false "$(script 'document.getElementById("enlarged").open')"
script 'document.querySelector("button.enlarge").click()' > /dev/null
expect "a figure is enlarged" true "$(script 'document.getElementById("enlarged").open && document.querySelector("#enlarged img").getBoundingClientRect().width > 900')"
script 'document.querySelector("#enlarged button").click()' > /dev/null
expect "it can be closed" false "$(script 'document.getElementById("enlarged").open')"

call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setDeviceMetricsOverride",
  "params": {"width": 1400, "height": 900, "deviceScaleFactor": 1, "mobile": false}}' > /dev/null
expect "player and curve are seen together" true "$(script '(() => { const at = (id) => document.getElementById(id).getBoundingClientRect();
  return at("curve").bottom - at("player-title").top < 900 })()')"
call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setDeviceMetricsOverride",
  "params": {"width": 360, "height": 740, "deviceScaleFactor": 2, "mobile": true}}' > /dev/null
call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setEmulatedMedia",
  "params": {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}}' > /dev/null
expect "it fits a narrow screen" true "$(script 'document.documentElement.scrollWidth <= 360')"
expect "it is dark where dark is wanted" 'rgb(20, 23, 27)' "$(script 'getComputedStyle(document.body).backgroundColor')"
expect "figures follow" true "$(script 'getComputedStyle(document.querySelector("figure img")).filter.includes("invert")')"
expect "claims are cards" block "$(script 'getComputedStyle(document.querySelector("#claims tbody:not([hidden])")).display')"
script 'document.querySelector("button.enlarge").click()' > /dev/null
expect "an enlarged figure keeps its size there, and moves sideways" "600 true" "$(script '(() => {
  const image = document.querySelector("#enlarged img"), { scrollWidth, clientWidth } = image.parentElement;
  return [image.getBoundingClientRect().width, scrollWidth > clientWidth].join(" ") })()')"
script 'document.querySelector("#enlarged button").click()' > /dev/null
script 'document.getElementById("player").scrollIntoView()' > /dev/null
picture narrow-dark
call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.setTouchEmulationEnabled", "params": {"enabled": true}}' > /dev/null
before=$(script scrollY)
call POST "$at/actions" "$(jq -n --argjson y "$(script 'Math.round(document.getElementById("curve").getBoundingClientRect().top + 40)')" '
  {actions: [{type: "pointer", id: "finger", parameters: {pointerType: "touch"}, actions: [
    {type: "pointerMove", x: 180, y: $y}, {type: "pointerDown", button: 0},
    {type: "pointerMove", duration: 300, x: 180, y: ($y - 250)}, {type: "pointerUp", button: 0}]}]}')" > /dev/null
expect "a finger on the curve scrolls the page" true "$(script "scrollY > $before + 100")"

call POST "$at/goog/cdp/execute" '{"cmd": "Emulation.clearDeviceMetricsOverride", "params": {}}' > /dev/null
call POST "$at/url" "{\"url\": \"file://$place/passes.html\"}" > /dev/null
expect "a second mouth is known" 2 "$(script 'JSON.parse(document.getElementById("player-data").textContent).runs[0].second_mouth')"
expect "the solid ends behind it" "true false" "$(script "(() => {
  const pore = document.getElementById('pore'), scale = pore.height / 4.4, x_g = Number('$(readout x_g)');
  const row = pore.getContext('2d').getImageData(0, 3, pore.width, 1).data;
  const colour = (x) => row.slice(4 * Math.round((x - x_g) * scale + pore.width / 2)).slice(0, 4).join();
  return [colour(0.3) === colour(1.7), colour(1.7) === colour(3)].join(' ') })()")"
picture second-mouth

expect "nothing complains" 0 "$(call POST "$at/se/log" '{"type": "browser"}' | jq '.value | length')"
