// The deformed lumen in both models, turned together by pointer, keyboard or slider.
const COLOURED_BY = ["lumen radius", "pressure", "calcification"];
const SEEN_AT_FIRST = 16; // degrees from the side towards the inlet
const MOST_PIXELS = 300000; // of a picture: finer ones would be slower than the eye

function artery(host) {
  const { controls, place, words } = frame(host);
  const colour = choice(controls, "coloured by", COLOURED_BY, () => wish());
  const times = [...new Set([1, 2, 3, 5, 10, 20, page.artery.exaggeration])].sort((a, b) => a - b);
  const exaggeration = choice(controls, "deformation", times.map((k) => (k === 1 ? "true to scale" : `× ${k}`)), () => wish(), times.indexOf(page.artery.exaggeration));
  const aim = { turn: 5 * Math.round(page.artery.seen_from / 5), tilt: SEEN_AT_FIRST, nearer: 1 };
  const turn = slider(controls, "turn about the axis", 71, (aim.turn / 5) % 72, (k) => `${5 * k}°`, () => { aim.turn = 5 * turn.value; wish(); });
  const nearer = slider(controls, "nearer to the chosen place", 6, 0, (k) => `× ${(1 + k / 2).toFixed(1)}`, () => { aim.nearer = 1 + nearer.value / 2; wish(); });
  const pair = element("div", { className: "pair" });
  place.append(pair);
  const views = ["reference", "rom"].map((model) => {
    const title = element("div", { className: "view-title" });
    const canvas = element("canvas", { "aria-hidden": "true" });
    pair.append(element("div", {}, title, canvas));
    return { model, title, canvas, raster: null, projected: null };
  });
  const bar = element("canvas", { "aria-hidden": "true" });
  place.append(bar);
  let state = null;
  const wish = drawnWhenSeen(place, async () => {
    const [radius, pressure] = await Promise.all(["radius", "pressure"].map((name) => bothModels(page.fields[name])));
    const cells = await unpack(page.calcified[chosen.variant]);
    const size = count.x * count.phi;
    const now = (values) => values.subarray(chosen.time * size, (chosen.time + 1) * size);
    const shade = (model) => [now(radius[model]), now(pressure[model]), cells][colour.value];
    const [low, high] = colour.value === 2 ? [0, 1] : extent(["reference", "rom"].map(shade));
    const colours = colour.value === 2 ? ramp(["#56b4e9", "#d55e00"]).map((_, k, all) => all[k < 128 ? 0 : 255]) : ramp(VIRIDIS);
    for (const view of views) {
      view.title.textContent = view.model === "rom" ? modelLabel() : "3D";
      const on = canvasSize(view, view.title.clientWidth);
      view.projected = projected(on, now(radius[view.model]), shade(view.model), [low, high], times[exaggeration.value], aim);
      drawLumen(view, colours, cells);
    }
    const pen = penOn(bar, place.clientWidth, 46);
    drawScale(pen, place.clientWidth, colour.value, colours, [low, high]);
    state = { radius: Object.fromEntries(views.map(({ model }) => [model, now(radius[model])])), pressure: Object.fromEntries(views.map(({ model }) => [model, now(pressure[model])])), cells };
    place.drawn = { aim: { ...aim }, shades: Object.fromEntries(views.map(({ model }) => [model, shade(model)])), views };
    words.textContent = `${page.variants[chosen.variant]}, ${moment(chosen.time)}: radius ${range(state.radius.reference, "mm")} in 3D, `
      + `${range(state.radius.rom, "mm")} in ${modelLabel()}; pressure ${range(state.pressure.reference, "kPa")} in 3D, ${range(state.pressure.rom, "kPa")} in ${modelLabel()}.`;
  });
  const turned = () => { turn.value = Math.round((((aim.turn % 360) + 360) % 360) / 5) % 72; wish(); };
  for (const view of views) {
    const cellOf = (event) => cellUnder(view, event);
    pointed(place, view.canvas, (event) => {
      const cell = cellOf(event);
      if (!cell) return null;
      const k = cell[0] * count.phi + cell[1];
      return [placeWords(...cell), ...views.map(({ model, title }) => `${title.textContent}: R ${number(state.radius[model][k])} mm, P ${number(state.pressure[model][k])} kPa`)];
    });
    draggable(view.canvas, aim, turned, (event) => { const cell = cellOf(event); if (cell) chooseNow({ i: cell[0], j: cell[1] }); });
  }
  follow(["variant", "model", "time", "i", "j"], wish);
}

const range = (values, unit) => `${extent([values]).map((value) => number(value, 5)).join(" … ")} ${unit}`;

// Drags turn; what moved by less than three pixels was a click.
function draggable(canvas, aim, turned, clicked) {
  let from = null, moved = 0;
  canvas.addEventListener("pointerdown", (event) => { from = event; moved = 0; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!from || !event.buttons) return;
    const right = event.clientX - from.clientX, down = event.clientY - from.clientY;
    moved += Math.abs(right) + Math.abs(down);
    aim.turn -= 0.6 * down;
    aim.tilt = Math.max(-85, Math.min(85, aim.tilt + 0.4 * right));
    from = event;
    turned();
  });
  canvas.addEventListener("pointerup", (event) => { from = null; if (moved < 3) clicked(event); });
  canvas.addEventListener("pointercancel", () => { from = null; });
}

function canvasSize(view, width) {
  const height = Math.round(Math.min(260, 0.48 * width));
  const fine = Math.min(2, Math.sqrt(MOST_PIXELS / (width * height)));
  const [across, down] = [Math.round(width * fine), Math.round(height * fine)];
  if (view.raster?.width !== across || view.raster.height !== down) {
    Object.assign(view.canvas, { width: across, height: down });
    Object.assign(view.canvas.style, { width: `${width}px`, height: `${height}px` });
    view.raster = rasterOf(across, down);
  }
  return view.raster;
}

// Corners at the cells' centres, the first row of φ again at the end: pixels, depth, place on the ramp, brightness.
function projected({ width, height }, radius, shade, [low, high], exaggeration, aim) {
  const round = count.phi + 1, at = new Float32Array(count.x * round * 5);
  const tilt = (Math.PI * aim.tilt) / 180, middle = (page.x[0] + page.x[count.x - 1]) / 2;
  const long = page.x[count.x - 1] - page.x[0], wide = 2.5 * page.artery.rest_radius;
  const scale = aim.nearer * Math.min(width / (long * Math.abs(Math.cos(tilt)) + wide * Math.abs(Math.sin(tilt)) + 0.04 * long), height / wide);
  const centre = middle + (1 - 1 / aim.nearer) * (page.x[chosen.i] - middle);
  const turns = Array.from({ length: round }, (_, j) => (Math.PI * (page.phi[j % count.phi] - aim.turn)) / 180);
  const towards = turns.map(Math.cos), up = turns.map((angle) => -Math.sin(angle));
  const [cosine, sine] = [Math.cos(tilt), Math.sin(tilt)];
  for (let i = 0, k = 0; i < count.x; i++) {
    const x = page.x[i] - centre;
    for (let j = 0; j < round; j++, k += 5) {
      const cell = i * count.phi + (j % count.phi);
      const r = page.artery.rest_radius + exaggeration * (radius[cell] - page.artery.rest_radius);
      at[k] = width / 2 + scale * (x * cosine + r * towards[j] * sine);
      at[k + 1] = height / 2 - scale * r * up[j];
      at[k + 2] = scale * (r * towards[j] * cosine - x * sine);
      at[k + 3] = Math.max(0, Math.min(255, (255 * (shade[cell] - low)) / (high - low)));
      at[k + 4] = 0.6 + 0.4 * Math.abs(towards[j] * cosine);
    }
  }
  return at;
}

function drawLumen({ raster, canvas, projected: at }, colours, cells) {
  cleared(raster);
  const round = count.phi + 1;
  for (let i = 0; i + 1 < count.x; i++) {
    for (let j = 0; j < count.phi; j++) {
      const a = 5 * (i * round + j), c = a + 5 * round, quad = i * count.phi + j;
      fillTriangle(raster, colours, quad, at, a, a + 5, c);
      fillTriangle(raster, colours, quad, at, c, a + 5, c + 5);
    }
  }
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.putImageData(new ImageData(new Uint8ClampedArray(raster.pixels.buffer), raster.width, raster.height), 0, 0);
  outlined(pen, raster, at, cells);
  ringed(pen, raster, at);
}

const isSeen = (raster, u, v, depth) => {
  const x = Math.round(u), y = Math.round(v);
  return x >= 0 && y >= 0 && x < raster.width && y < raster.height && depth > raster.depth[y * raster.width + x] - 0.03 * raster.height;
};

// The calcified cells' frame, where nothing hides it.
function outlined(pen, raster, at, cells) {
  const round = count.phi + 1;
  const middle = (i, j, down, right) => {
    const near = 5 * (i * round + j), far = 5 * ((i + down) * round + j + right);
    return [0, 1, 2].map((k) => (at[near + k] + at[far + k]) / 2);
  };
  const is = (i, j) => cells[i * count.phi + (j % count.phi)] > 0;
  pen.beginPath();
  for (let i = 0; i + 1 < count.x; i++) {
    for (let j = 0; j < count.phi; j++) {
      const crossings = [];
      if (is(i, j) !== is(i + 1, j)) crossings.push(middle(i, j, 1, 0));
      if (is(i, j + 1) !== is(i + 1, j + 1)) crossings.push(middle(i, j + 1, 1, 0));
      if (is(i, j) !== is(i, j + 1)) crossings.push(middle(i, j, 0, 1));
      if (is(i + 1, j) !== is(i + 1, j + 1)) crossings.push(middle(i + 1, j, 0, 1));
      if (crossings.length < 2 || !crossings.every((point) => isSeen(raster, ...point))) continue;
      pen.moveTo(crossings[0][0], crossings[0][1]);
      pen.lineTo(crossings[1][0], crossings[1][1]);
    }
  }
  for (const [colour, wide] of [["#ffffff", 5], ["#000000", 2]]) {
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    pen.stroke();
  }
}

function ringed(pen, raster, at) {
  const k = 5 * (chosen.i * (count.phi + 1) + chosen.j);
  if (!isSeen(raster, at[k], at[k + 1], at[k + 2])) return;
  for (const [colour, wide] of [["#000000", 6], ["#ffffff", 2.5]]) {
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    pen.beginPath();
    pen.arc(at[k], at[k + 1], 10, 0, 7);
    pen.stroke();
  }
}

// The cell at the pointer: the corner of the quad there that is nearest.
function cellUnder({ canvas, raster, projected: at }, event) {
  if (!raster) return null;
  const area = canvas.getBoundingClientRect();
  const x = Math.floor(((event.clientX - area.left) / area.width) * raster.width), y = Math.floor(((event.clientY - area.top) / area.height) * raster.height);
  const quad = x < 0 || y < 0 || x >= raster.width || y >= raster.height ? -1 : raster.quad[y * raster.width + x];
  if (quad < 0) return null;
  const i = Math.floor(quad / count.phi), j = quad % count.phi;
  const far = ([u, v]) => { const k = 5 * (u * (count.phi + 1) + v); return Math.hypot(at[k] - x, at[k + 1] - y); };
  const [u, v] = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]].reduce((best, corner) => (far(corner) < far(best) ? corner : best));
  return [u, v % count.phi];
}

function drawScale(pen, width, by, colours, [low, high]) {
  const left = 12, long = Math.min(420, width - 100);
  for (let k = 0; k < long; k++) {
    pen.fillStyle = `rgb(${colours[Math.round((255 * k) / (long - 1))]})`;
    pen.fillRect(left + k, 6, 1, 12);
  }
  pen.fillStyle = css("--ink");
  const across = linear([low, high], [left, left + long]);
  pen.textAlign = "center";
  const ticks = by === 2 ? [[0.25, "not calcified"], [0.75, "calcified"]] : across.ticks;
  for (const [value, text] of ticks) pen.fillText(text, across.at(value), 34);
  pen.textAlign = "left";
  if (by < 2) pen.fillText(["R (mm)", "P (kPa)"][by], left + long + 10, 17);
}
