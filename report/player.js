// The player: a run, the capsule in its pore at an instant, coloured by a field on the membrane, and a cursor on the curve
// of a quantity; another run in dashes over it. The clock goes by place, x_g, or by time. The data are written into the page
// by player_data.cpp:
//   fields[]: name, neutral (the value of the undeformed membrane)
//   quantities[]: column, name, symbol, base (where its axis begins)
//   runs[]: case, name, label (of what differs between the runs of the case), directory, walls, opening_angle (radians), second_mouth (or null),
//     series {x_g, time, and quantities by their columns: {decimals, values[]}},
//     frames[] {time, x_g, capsules[] {x[], r[], fields[][]}}, the leading capsule first
"use strict";
(() => {
  const { fields, quantities, runs } = JSON.parse(document.getElementById("player-data").textContent);
  const by_id = (id) => document.getElementById(id);
  const run_choice = by_id("run"), other_choice = by_id("other-run"), colour_choice = by_id("colour");
  const quantity_choice = by_id("quantity"), clock_choice = by_id("clock"), slider = by_id("instant");
  const play_button = by_id("play"), pore = by_id("pore"), curve = by_id("curve");
  if (runs.length === 0) {
    by_id("player-none").hidden = false;
    by_id("player-controls").hidden = true;
    return;
  }
  other_choice.append(new Option("none", ""));
  for (const choice of [run_choice, other_choice])
    runs.forEach((run, i) => {
      if (i === 0 || run.case !== runs[i - 1].case)
        choice.append(Object.assign(document.createElement("optgroup"), { label: run.case }));
      choice.lastElementChild.append(new Option(run.label, i));
    });
  run_choice.value = 0;
  fields.forEach((field, i) => colour_choice.add(new Option(field.name, i)));
  const shown_quantities = quantities.filter(({ column }) => runs.some(({ series }) => series[column]));
  shown_quantities.forEach((quantity, i) => quantity_choice.add(new Option(quantity.name, i)));

  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const mix = (a, b, share) => a + (b - a) * share;
  // From blue over grey to red, as light on dark paper as on white.
  const colour_stops = [[49, 104, 190], [160, 160, 160], [205, 60, 40]];
  const colour_of = (share) => {
    const place = 2 * Math.min(1, Math.max(0, share)), lower = Math.min(1, Math.floor(place));
    const parts = colour_stops[lower].map((part, i) => Math.round(mix(part, colour_stops[lower + 1][i], place - lower)));
    return `rgb(${parts.join(",")})`;
  };
  const chosen_run = () => runs[run_choice.value];
  const other_run = () => runs[other_choice.value];
  const shown_runs = () => [chosen_run(), other_run()].filter((run) => run);
  const quantity = () => shown_quantities[quantity_choice.value];
  const range_of = (values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
  // What the run's field takes, and the neutral value in its middle: as many colours above as below.
  const field_scale = () => {
    const [low, high] = range_of(chosen_run().frames.flatMap((frame) =>
      frame.capsules.flatMap((capsule) => capsule.fields[colour_choice.value])));
    const { neutral } = fields[colour_choice.value];
    const reach = Math.max(Math.abs(low - neutral), Math.abs(high - neutral)) || 1;
    return { low: Math.min(low, neutral), high: Math.max(high, neutral), neutral,
             share: (value) => 0.5 + (value - neutral) / (2 * reach) };
  };
  const draw_scale = ({ low, high, neutral, share }) => {
    by_id("scale-low").textContent = low.toFixed(2);
    by_id("scale-high").textContent = high.toFixed(2);
    const inside = low < neutral && neutral < high;
    by_id("scale-neutral").textContent = inside ? neutral : "";
    by_id("scale-neutral").style.visibility = inside ? "visible" : "hidden";
    by_id("scale-neutral").style.left = `${(100 * (neutral - low)) / (high - low || 1)}%`;
    const stops = [0, 0.25, 0.5, 0.75, 1].map((part) => colour_of(share(mix(low, high, part))));
    by_id("scale-bar").style.background = `linear-gradient(to right, ${stops.join(",")})`;
  };

  // A run that goes nowhere, in a flow without a pore, has a clock by time alone.
  const moves = ({ frames }) => frames[0].x_g !== frames[frames.length - 1].x_g;
  const clock = () => (shown_runs().every(moves) ? clock_choice.value : "time");
  // The last index at which the rising values are not beyond the instant, and the share of the way to the next.
  const locate = (values, instant) => {
    let i = 0;
    while (i + 2 < values.length && values[i + 1] <= instant)
      i++;
    const width = values[i + 1] - values[i];
    return [i, width > 0 ? Math.min(1, Math.max(0, (instant - values[i]) / width)) : 0];
  };
  const frame_at = ({ frames }, instant) => {
    const [i, share] = locate(frames.map((frame) => frame[clock()]), instant);
    const between = (a, b) => a.map((value, k) => mix(value, b[k], share));
    const [before, after] = [frames[i], frames[i + 1]];
    const capsules = before.capsules.map((a, k) => {
      const b = after.capsules[k];
      return { x: between(a.x, b.x), r: between(a.r, b.r),
               field: between(a.fields[colour_choice.value], b.fields[colour_choice.value]) };
    });
    return { x_g: mix(before.x_g, after.x_g, share), capsules };
  };
  const nearest_row = ({ series }, instant) => {
    const [i, share] = locate(series[clock()].values, instant);
    return share < 0.5 ? i : i + 1;
  };

  // A canvas as sharp as the screen, with its size in units of the page.
  const open_canvas = (canvas) => {
    const { width, height } = canvas.getBoundingClientRect(), dots = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(height * dots);
    const pen = canvas.getContext("2d");
    pen.scale(dots, dots);
    return { pen, width, height };
  };

  // Text in the middle of a place, or with another part of it to the left of there; the letter after _ is set lower, that
  // after ^ higher.
  const write_label = (pen, text, x, y, part = 0.5) => {
    const parts = [...text.matchAll(/([_^]?)([^_^])/g)].map(([, mark, letter]) => {
      pen.font = `${mark ? 10 : 13}px sans-serif`;
      return { mark, letter, width: pen.measureText(letter).width };
    });
    pen.textAlign = "left";
    let at = x - part * parts.reduce((sum, { width }) => sum + width, 0);
    for (const { mark, letter, width } of parts) {
      pen.font = `${mark ? 10 : 13}px sans-serif`;
      pen.fillText(letter, at, y + { "": 0, _: 4, "^": -5 }[mark]);
      at += width;
    }
    pen.font = "13px sans-serif";
  };
  const as_html = (symbol) => symbol.replace(/_(.)/g, "<sub>$1</sub>").replace(/\^(.)/g, "<sup>$1</sup>");

  const dashes = [7, 5];
  const draw_walls = (pen, { opening_angle, second_mouth, walls }, solid, { width, height, left, scale }) => {
    if (!walls)
      return;
    const middle = height / 2;
    const outside = (x) => Math.max(-x, second_mouth === null ? 0 : x - second_mouth, 0); // of the nearer mouth
    const wall_r = (x) => Math.sqrt(1 + (outside(x) * Math.tan(opening_angle)) ** 2);
    for (const side of [1, -1]) {
      const wall = new Path2D();
      for (let pixel = 0; pixel <= width; pixel++)
        wall.lineTo(pixel, middle - side * Math.min(height, wall_r(left + pixel / scale) * scale));
      if (solid) {
        const around = new Path2D(wall);
        around.lineTo(width, middle - side * height);
        around.lineTo(0, middle - side * height);
        pen.fill(around);
      }
      pen.stroke(wall);
    }
  };
  const same_walls = (a, b) =>
    a.walls === b.walls && a.opening_angle === b.opening_angle && a.second_mouth === b.second_mouth;
  const draw_pore = (instant) => {
    const { pen, width, height } = open_canvas(pore);
    const scale = height / 4.4; // radii from wall to wall, and of the solid around
    const frame = frame_at(chosen_run(), instant), scale_of_field = field_scale();
    const middle = height / 2, left = frame.x_g - width / scale / 2;
    const at = (x, r) => [(x - left) * scale, middle - r * scale];
    pen.fillStyle = style("--solid");
    pen.strokeStyle = style("--ink");
    pen.lineWidth = 1.5;
    draw_walls(pen, chosen_run(), true, { width, height, left, scale });
    pen.setLineDash([12, 4, 2, 4]);
    pen.strokeStyle = style("--faint");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(0, middle);
    pen.lineTo(width, middle);
    pen.stroke();
    pen.setLineDash([]);
    const outline = ({ x, r }) => {
      pen.beginPath();
      x.forEach((place, i) => pen.lineTo(...at(place, r[i])));
      [...x.keys()].reverse().forEach((i) => pen.lineTo(...at(x[i], -r[i])));
    };
    for (const capsule of frame.capsules) {
      const { x, r, field } = capsule;
      outline(capsule);
      pen.fillStyle = style("--card");
      pen.fill();
      pen.lineWidth = 4;
      pen.lineCap = "round";
      for (const side of [1, -1])
        for (let i = 0; i + 1 < x.length; i++) {
          pen.beginPath();
          pen.moveTo(...at(x[i], side * r[i]));
          pen.lineTo(...at(x[i + 1], side * r[i + 1]));
          pen.strokeStyle = colour_of(scale_of_field.share((field[i] + field[i + 1]) / 2));
          pen.stroke();
        }
    }
    if (other_run()) {
      pen.setLineDash(dashes);
      pen.strokeStyle = style("--ink");
      pen.lineWidth = 1.5;
      if (!same_walls(chosen_run(), other_run()))
        draw_walls(pen, other_run(), false, { width, height, left, scale });
      for (const capsule of frame_at(other_run(), instant).capsules) {
        outline(capsule);
        pen.stroke();
      }
      pen.setLineDash([]);
    }
    draw_scale(scale_of_field);
  };

  // The axes are those of all runs of the cases that are shown: what is seen of one can be compared with another.
  const values_of_all = (column) => runs.filter((run) => shown_runs().some((shown) => shown.case === run.case))
    .flatMap(({ series }) => series[column]?.values ?? []);
  const axes = () => {
    const [left, right] = range_of(values_of_all(clock())), values = values_of_all(quantity().column);
    const [low, high] = values.length ? range_of(values) : [0, 1];
    const bottom = Math.min(low, quantity().base);
    return { left, right, bottom, top: high + 0.05 * (high - bottom) };
  };
  const step_of = (range, wanted) => {
    const size = 10 ** Math.floor(Math.log10(range / wanted));
    return size * [1, 2, 5, 10].find((factor) => range / (factor * size) <= wanted);
  };
  const tick = (value) => String(+value.toPrecision(6)).replace("-", "−");
  const margin = { left: 56, right: 12, top: 12, bottom: 40 };
  const draw_curve = (instant) => {
    const { pen, width, height } = open_canvas(curve);
    const { left, right, bottom, top } = axes(), { column, symbol } = quantity();
    const at_x = (x) => mix(margin.left, width - margin.right, (x - left) / (right - left));
    const at_y = (y) => mix(height - margin.bottom, margin.top, (y - bottom) / (top - bottom));
    pen.font = "13px sans-serif";
    pen.fillStyle = pen.strokeStyle = style("--ink");
    pen.beginPath();
    pen.moveTo(margin.left, margin.top);
    pen.lineTo(margin.left, height - margin.bottom);
    pen.lineTo(width - margin.right, height - margin.bottom);
    pen.stroke();
    pen.textAlign = "center";
    const step_x = step_of(right - left, width / 50), step_y = step_of(top - bottom, height / 28);
    for (let k = Math.ceil(left / step_x); k * step_x <= right; ++k)
      pen.fillText(tick(k * step_x), at_x(k * step_x), height - margin.bottom + 16);
    write_label(pen, clock() === "time" ? "t / (πR_t^3/Q)" : "x_g / R_t", (margin.left + width - margin.right) / 2, height - 8);
    pen.textAlign = "right";
    for (let k = Math.ceil(bottom / step_y); k * step_y <= top; ++k)
      pen.fillText(tick(k * step_y), margin.left - 6, at_y(k * step_y) + 4);
    pen.save();
    pen.translate(14, (height - margin.bottom + margin.top) / 2);
    pen.rotate(-Math.PI / 2);
    write_label(pen, symbol, 0, 0);
    pen.restore();
    pen.strokeStyle = style("--faint");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(at_x(instant), margin.top);
    pen.lineTo(at_x(instant), height - margin.bottom);
    pen.stroke();
    for (const run of shown_runs()) {
      const is_other = run !== chosen_run(), values = run.series[column]?.values;
      if (!values) {
        pen.textAlign = "center";
        pen.fillText(`not in ${is_other ? "the second" : "this"} run`, width / 2, height / (is_other ? 2.6 : 3));
        continue;
      }
      const places = run.series[clock()].values, row = nearest_row(run, instant);
      pen.setLineDash(is_other ? dashes : []);
      pen.strokeStyle = style(is_other ? "--ink" : "--accent");
      pen.lineWidth = 2;
      pen.beginPath();
      places.forEach((x, i) => pen.lineTo(at_x(x), at_y(values[i])));
      pen.stroke();
      pen.setLineDash([]);
      pen.fillStyle = style(is_other ? "--ink" : "--bad");
      pen.beginPath();
      pen.arc(at_x(places[row]), at_y(values[row]), is_other ? 4 : 5, 0, 2 * Math.PI);
      pen.fill();
    }
  };

  // A row for each run: the computed row that is nearest to the instant.
  const write_readout = (instant) => {
    const columns = [{ column: "x_g", symbol: "x_g" }, { column: "time", symbol: "t" }, ...shown_quantities]
      .filter(({ column }) => shown_runs().some(({ series }) => series[column]));
    const short = (symbol) => as_html(symbol.split(" / ")[0].replace("largest ", ""));
    const value = ({ series }, column, row) => series[column] ? series[column].values[row].toFixed(series[column].decimals) : "";
    by_id("readout").innerHTML = `<tr>${columns.map(({ symbol }) => `<th scope="col">${short(symbol)}</th>`).join("")}</tr>` +
      shown_runs().map((run) => `<tr>${columns.map(({ column }) =>
        `<td data-column="${column}">${value(run, column, nearest_row(run, instant))}</td>`).join("")}</tr>`).join("");
    slider.setAttribute("aria-valuetext", `${clock() === "time" ? "t" : "x_g"} = ${instant.toFixed(2)}`);
  };

  const draw = () => {
    const instant = slider.valueAsNumber;
    draw_pore(instant);
    draw_curve(instant);
    write_readout(instant);
  };

  const described_runs = () => shown_runs().map((run, i) => `${i ? "dashed: " : ""}${run.case}: ${run.name}`);
  // Other runs keep the instant, as far as they go.
  const choose = () => {
    const instant = slider.valueAsNumber;
    [slider.min, slider.max] = range_of(shown_runs().flatMap(({ frames }) => [frames[0][clock()], frames[frames.length - 1][clock()]]));
    slider.value = instant;
    const links = shown_runs().flatMap(({ directory, frames }, i) => frames[0].capsules.flatMap((capsule, k) =>
      ["series", "profiles"].map((table) => `${table}${k ? `-${k + 1}` : ""}.csv`)).map((name) => {
      const path = [...directory.split("/"), name].map(encodeURIComponent).join("/");
      return Object.assign(document.createElement("a"), { href: path, textContent: i ? `second run: ${name}` : name });
    }));
    by_id("which").textContent = described_runs().join("; ");
    by_id("data").replaceChildren("Data, beside this page:", ...links);
    draw();
  };
  // The same instant by the other clock.
  let last_clock = clock();
  const choose_clock = () => {
    const { series } = chosen_run(), instant = slider.valueAsNumber;
    const [i, share] = locate(series[last_clock].values, instant), values = series[clock()].values;
    last_clock = clock();
    [slider.min, slider.max] = [-1e9, 1e9];
    slider.value = mix(values[i], values[i + 1], share);
    choose();
  };
  // A run whose pulse is the point shows it.
  const choose_run = () => {
    const of_pulse = shown_quantities.findIndex(({ column }) => column === "resistance");
    if (chosen_run().series.resistance)
      quantity_choice.value = of_pulse;
    else if (Number(quantity_choice.value) === of_pulse)
      quantity_choice.value = 0;
    if (last_clock === clock())
      choose();
    else
      choose_clock();
  };

  let playing = false, last_instant = 0;
  const play = (now) => {
    if (!playing)
      return;
    const units_per_second = 2 * Number(by_id("speed").value); // radii, or units of time
    slider.value = slider.valueAsNumber + units_per_second * Math.min(0.1, (now - last_instant) / 1000);
    last_instant = now;
    const at_end = slider.valueAsNumber >= Number(slider.max);
    if (at_end && by_id("loop").checked)
      slider.value = slider.min;
    draw();
    if (at_end && !by_id("loop").checked)
      set_playing(false);
    else
      requestAnimationFrame(play);
  };
  const set_playing = (wanted) => {
    playing = wanted;
    play_button.textContent = playing ? "Pause" : "Play";
    play_button.setAttribute("aria-pressed", playing);
    if (!playing)
      return;
    if (slider.valueAsNumber >= Number(slider.max))
      slider.value = slider.min;
    last_instant = performance.now();
    requestAnimationFrame(play);
  };

  // Both pictures on one sheet, with the names of the runs.
  const save = () => {
    const sheet = document.createElement("canvas"), dots = window.devicePixelRatio || 1, line = 22;
    const names = described_runs(), below = (names.length + 1.5) * line;
    sheet.width = pore.width;
    sheet.height = pore.height + curve.height + below * dots;
    const pen = sheet.getContext("2d");
    pen.fillStyle = style("--paper");
    pen.fillRect(0, 0, sheet.width, sheet.height);
    pen.drawImage(pore, 0, below * dots);
    pen.drawImage(curve, 0, below * dots + pore.height);
    pen.scale(dots, dots);
    pen.fillStyle = style("--ink");
    pen.font = "13px sans-serif";
    names.forEach((name, i) => pen.fillText(name, 8, (i + 0.8) * line));
    write_label(pen, `${clock() === "time" ? "t" : "x_g"} = ${slider.valueAsNumber.toFixed(2).replace("-", "−")}`, 8, (names.length + 0.8) * line, 0);
    const name = `${chosen_run().directory.replace(/^results\//, "").replace(/[^\w.=,-]+/g, "-")}.png`;
    Object.assign(document.createElement("a"), { href: sheet.toDataURL(), download: name }).click();
  };

  const drag = (event) => {
    if (event.buttons === 0)
      return;
    const { left: edge, width } = curve.getBoundingClientRect(), { left, right } = axes();
    slider.value = mix(left, right, (event.clientX - edge - margin.left) / (width - margin.left - margin.right));
    draw();
  };
  curve.addEventListener("pointerdown", (event) => { curve.setPointerCapture(event.pointerId); drag(event); });
  curve.addEventListener("pointermove", drag);
  slider.addEventListener("input", draw);
  // The browser's own step of a slider without steps is too small to travel with.
  slider.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.1, ArrowDown: -0.1, ArrowRight: 0.1, ArrowUp: 0.1, PageDown: -1, PageUp: 1 }[event.key];
    if (step === undefined)
      return;
    event.preventDefault();
    slider.value = slider.valueAsNumber + step;
    draw();
  });
  run_choice.addEventListener("change", choose_run);
  other_choice.addEventListener("change", choose_run);
  clock_choice.addEventListener("change", choose_clock);
  colour_choice.addEventListener("change", draw);
  quantity_choice.addEventListener("change", draw);
  play_button.addEventListener("click", () => set_playing(!playing));
  by_id("save").addEventListener("click", save);
  window.addEventListener("resize", draw);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  slider.min = -100;
  slider.value = -1; // just before the mouth
  choose_run();
})();
