// The player: one run, the capsule in its pore at a place x_g, coloured by a field on the membrane, and a cursor on the
// pressure-drop curve. The data are written into the page by report_page.cpp:
//   fields[]: name, neutral (the value of the undeformed membrane)
//   runs[]: case, name, opening_angle (radians), series {x_g, pressure_drop},
//     frames[] {time, x_g, capsules[] {x[], r[], fields[][]}}, the leading capsule first
"use strict";
(() => {
  const { fields, runs } = JSON.parse(document.getElementById("player-data").textContent);
  const by_id = (id) => document.getElementById(id);
  const run_choice = by_id("run"), colour_choice = by_id("colour"), slider = by_id("place");
  const play_button = by_id("play"), pore = by_id("pore"), curve = by_id("curve");
  if (runs.length === 0) {
    by_id("player-none").hidden = false;
    by_id("player-controls").hidden = true;
    return;
  }
  runs.forEach((run, i) => {
    if (i === 0 || run.case !== runs[i - 1].case)
      run_choice.append(Object.assign(document.createElement("optgroup"), { label: run.case }));
    run_choice.lastElementChild.append(new Option(run.name, i));
  });
  run_choice.value = 0;
  fields.forEach((field, i) => colour_choice.add(new Option(field.name, i)));

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

  // The last index at which the rising values are not beyond the place, and the share of the way to the next.
  const locate = (values, place) => {
    let i = 0;
    while (i + 2 < values.length && values[i + 1] <= place)
      i++;
    const width = values[i + 1] - values[i];
    return [i, width > 0 ? Math.min(1, Math.max(0, (place - values[i]) / width)) : 0];
  };
  const interpolated = (values, [i, share]) => mix(values[i], values[i + 1], share);
  const frame_at = (place) => {
    const { frames } = chosen_run();
    const [i, share] = locate(frames.map((frame) => frame.x_g), place);
    const between = (a, b) => a.map((value, k) => mix(value, b[k], share));
    const [before, after] = [frames[i], frames[i + 1]];
    const capsules = before.capsules.map((a, k) => {
      const b = after.capsules[k];
      return { x: between(a.x, b.x), r: between(a.r, b.r),
               field: between(a.fields[colour_choice.value], b.fields[colour_choice.value]) };
    });
    return { time: mix(before.time, after.time, share), capsules };
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

  // Text in the middle of a place; the letter after _ is set lower, that after ^ higher.
  const write_label = (pen, text, x, y) => {
    const parts = [...text.matchAll(/([_^]?)([^_^])/g)].map(([, mark, letter]) => {
      pen.font = `${mark ? 10 : 13}px sans-serif`;
      return { mark, letter, width: pen.measureText(letter).width };
    });
    pen.textAlign = "left";
    let at = x - parts.reduce((sum, { width }) => sum + width, 0) / 2;
    for (const { mark, letter, width } of parts) {
      pen.font = `${mark ? 10 : 13}px sans-serif`;
      pen.fillText(letter, at, y + { "": 0, _: 4, "^": -5 }[mark]);
      at += width;
    }
    pen.font = "13px sans-serif";
  };

  const draw_pore = (place) => {
    const { pen, width, height } = open_canvas(pore);
    const scale = height / 4.4; // radii from wall to wall, and of the solid around
    const middle = height / 2, left = place - width / scale / 2;
    const at = (x, r) => [(x - left) * scale, middle - r * scale];
    const { opening_angle, second_mouth } = chosen_run();
    const outside = (x) => Math.max(-x, second_mouth === null ? 0 : x - second_mouth, 0); // of the nearer mouth
    const wall_r = (x) => Math.sqrt(1 + (outside(x) * Math.tan(opening_angle)) ** 2);
    pen.fillStyle = style("--solid");
    pen.strokeStyle = style("--ink");
    pen.lineWidth = 1.5;
    for (const side of [1, -1]) {
      const wall = new Path2D();
      for (let pixel = 0; pixel <= width; pixel++)
        wall.lineTo(pixel, middle - side * Math.min(height, wall_r(left + pixel / scale) * scale));
      const solid = new Path2D(wall);
      solid.lineTo(width, middle - side * height);
      solid.lineTo(0, middle - side * height);
      pen.fill(solid);
      pen.stroke(wall);
    }
    pen.setLineDash([12, 4, 2, 4]);
    pen.strokeStyle = style("--faint");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(0, middle);
    pen.lineTo(width, middle);
    pen.stroke();
    pen.setLineDash([]);
    const frame = frame_at(place), scale_of_field = field_scale();
    for (const { x, r, field } of frame.capsules) {
      pen.beginPath();
      x.forEach((place_of_point, i) => pen.lineTo(...at(place_of_point, r[i])));
      [...x.keys()].reverse().forEach((i) => pen.lineTo(...at(x[i], -r[i])));
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
    draw_scale(scale_of_field);
    return frame.time;
  };

  const margin = { left: 56, right: 12, top: 12, bottom: 40 };
  const span = () => range_of(chosen_run().series.x_g);
  const draw_curve = (place) => {
    const { pen, width, height } = open_canvas(curve);
    const { x_g, pressure_drop } = chosen_run().series;
    const [left, right] = span(), top = 1.05 * Math.max(...pressure_drop);
    const at_x = (x) => mix(margin.left, width - margin.right, (x - left) / (right - left));
    const at_y = (y) => mix(height - margin.bottom, margin.top, y / top);
    pen.font = "13px sans-serif";
    pen.fillStyle = pen.strokeStyle = style("--ink");
    pen.beginPath();
    pen.moveTo(margin.left, margin.top);
    pen.lineTo(margin.left, height - margin.bottom);
    pen.lineTo(width - margin.right, height - margin.bottom);
    pen.stroke();
    pen.textAlign = "center";
    for (let x = 2 * Math.ceil(left / 2); x <= right; x += 2)
      pen.fillText(x, at_x(x), height - margin.bottom + 16);
    write_label(pen, "x_g / R_t", (margin.left + width - margin.right) / 2, height - 8);
    pen.textAlign = "right";
    const step = 10 ** Math.floor(Math.log10(top)) / (top / 10 ** Math.floor(Math.log10(top)) > 4 ? 1 : 2);
    for (let y = 0; y <= top; y += step)
      pen.fillText(+y.toPrecision(6), margin.left - 6, at_y(y) + 4);
    pen.save();
    pen.translate(16, (height - margin.bottom + margin.top) / 2);
    pen.rotate(-Math.PI / 2);
    write_label(pen, "ΔP / (μQ/πR_t^3)", 0, 0);
    pen.restore();
    pen.beginPath();
    x_g.forEach((x, i) => pen.lineTo(at_x(x), at_y(pressure_drop[i])));
    pen.strokeStyle = style("--accent");
    pen.lineWidth = 2;
    pen.stroke();
    const value = interpolated(pressure_drop, locate(x_g, place));
    pen.strokeStyle = style("--faint");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(at_x(place), margin.top);
    pen.lineTo(at_x(place), height - margin.bottom);
    pen.stroke();
    pen.fillStyle = style("--bad");
    pen.beginPath();
    pen.arc(at_x(place), at_y(value), 5, 0, 2 * Math.PI);
    pen.fill();
    return value;
  };

  const draw = () => {
    const place = slider.valueAsNumber;
    const time = draw_pore(place), pressure_drop = draw_curve(place);
    by_id("readout").innerHTML =
      `x<sub>g</sub> = ${place.toFixed(2)}, t = ${time.toFixed(2)}, ΔP = ${pressure_drop.toFixed(3)}`;
    slider.setAttribute("aria-valuetext", by_id("readout").textContent);
  };

  // Another run keeps the place, as far as it goes.
  const choose_run = () => {
    const { frames } = chosen_run(), place = slider.valueAsNumber;
    slider.min = frames[0].x_g;
    slider.max = frames[frames.length - 1].x_g;
    slider.value = place;
    draw();
  };

  let playing = false, last_instant = 0;
  const play = (instant) => {
    if (!playing)
      return;
    const radii_per_second = 2;
    slider.value = slider.valueAsNumber + radii_per_second * Math.min(0.1, (instant - last_instant) / 1000);
    last_instant = instant;
    draw();
    if (slider.valueAsNumber >= Number(slider.max))
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

  const drag = (event) => {
    if (event.buttons === 0)
      return;
    const { left, width } = curve.getBoundingClientRect(), [low, high] = span();
    const share = (event.clientX - left - margin.left) / (width - margin.left - margin.right);
    slider.value = mix(low, high, share);
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
  colour_choice.addEventListener("change", draw);
  play_button.addEventListener("click", () => set_playing(!playing));
  window.addEventListener("resize", draw);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  slider.min = -100;
  slider.value = -1; // just before the mouth
  choose_run();
})();
