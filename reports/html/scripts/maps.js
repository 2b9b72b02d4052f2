// The unrolled lumen at the chosen time: 3D, 2D and their difference; a click chooses a place and opens its curves.
function maps(host) {
  const { controls, place, words } = frame(host);
  const canvas = element("canvas", { "aria-hidden": "true" });
  place.append(canvas);
  const scale = choice(controls, "colours", ["of this instant", "of the whole cycle"], () => wish());
  let told = () => null;
  const wish = drawnWhenSeen(place, async () => {
    const field = mapField();
    const models = await bothModels(field);
    const size = count.x * count.phi;
    const difference = models.rom.map((value, k) => field.difference_factor * (value - models.reference[k]));
    const now = (values) => values.subarray(chosen.time * size, (chosen.time + 1) * size);
    const scaled = scale.value ? (values) => values : now;
    const [low, high] = extent([scaled(models.reference), scaled(models.rom)]);
    const most = Math.max(...extent([scaled(difference)]).map(Math.abs)) || 1;
    const two = modelLabel();
    const panels = [
      { title: "3D", values: now(models.reference), unit: field.unit, symbol: field.symbol, low, high, colours: VIRIDIS },
      { title: two, values: now(models.rom), unit: field.unit, symbol: field.symbol, low, high, colours: VIRIDIS },
      { title: `${two} − 3D`, values: now(difference), unit: field.difference_unit, symbol: "", low: -most, high: most, colours: DIVERGING },
    ];
    const cellUnder = drawMaps(canvas, place.clientWidth, panels, await unpack(page.calcified[chosen.variant]));
    place.drawn = panels;
    const values = (k) => panels.map((panel, n) => `${panel.title} ${n < 2 ? valueWords(panel.values[k], field) : withUnit(signed(panel.values[k]), panel.unit)}`);
    told = (event) => {
      const cell = cellUnder(event);
      return cell && { cell, lines: [placeWords(...cell), ...values(cell[0] * count.phi + cell[1])] };
    };
    const worst = largestAt(panels[2].values);
    const instead = field === chosenField() ? "" : `${chosenField().label} has one value a section, so the maps show the ${field.label}. `;
    const here = `${instead}${field.label}, variant ${page.variants[chosen.variant]}, ${moment(chosen.time)}`;
    const said = (k) => `at ${placeWords(Math.floor(k / count.phi), k % count.phi)}: ${values(k).join(", ")}`;
    words.textContent = worst === null ? `${here}: nowhere finite.`
      : `${here}. Ringed, ${said(chosen.i * count.phi + chosen.j)}. Farthest apart ${said(worst)}.`;
  });
  pointed(place, canvas, (event) => told(event)?.lines ?? null);
  opensCurves(host, canvas, (event) => told(event)?.cell);
  follow(KEYS, wish);
}

// The chosen quantity, or the radius where that one has no values around the section.
const mapField = () => (isOnCells(chosenField()) ? chosenField() : page.fields.radius);

// Below a picture, the curves of a place that was clicked there.
function opensCurves(host, target, cellOf) {
  const words = element("p", { className: "readout" });
  const below = element("div", { className: "plot", role: "figure", "aria-label": "Curves over the cycle at the chosen place" });
  const fold = element("details", {}, element("summary", {}, "Curves over the cycle at the chosen place"), below, words);
  host.querySelector("details").append(fold);
  followed(below, words);
  target.addEventListener("click", (event) => {
    const cell = cellOf(event);
    if (!cell) return;
    fold.open = true;
    chooseNow({ i: cell[0], j: cell[1] });
  });
}

function largestAt(values) {
  let found = null;
  values.forEach((value, k) => {
    if (Number.isFinite(value) && (found === null || Math.abs(value) > Math.abs(values[found]))) found = k;
  });
  return found;
}

// Borders of cells: halfway between centres.
function bordersOf(centres) {
  const inner = centres.slice(1).map((value, k) => (value + centres[k]) / 2);
  const last = centres.length - 1;
  return last ? [2 * centres[0] - inner[0], ...inner, 2 * centres[last] - inner[last - 1]] : [centres[0] - 0.5, centres[0] + 0.5];
}

const ROOM = { left: 46, top: 24, bottom: 40, gap: 26, bar: 96 };

// Draws the panels side by side, or above each other where there is little room; returns what tells the cell under an event.
function drawMaps(canvas, width, panels, inside) {
  const narrow = width < 620;
  const across = narrow ? width - ROOM.left - ROOM.bar : (width - ROOM.left - 2 * ROOM.bar - ROOM.gap) / 3;
  const high = narrow ? 170 : 230;
  const height = narrow ? 3 * (ROOM.top + high) + ROOM.bottom : ROOM.top + high + ROOM.bottom;
  const pen = penOn(canvas, width, height);
  const borders = [bordersOf(page.x), bordersOf(page.phi)];
  const areas = panels.map((panel, k) => {
    const left = narrow ? ROOM.left : ROOM.left + k * across + (k > 0) * ROOM.gap + (k > 1) * ROOM.bar;
    const top = ROOM.top + (narrow ? k * (ROOM.top + high) : 0);
    const x = linear([borders[0][0], borders[0][count.x]], [left, left + across]);
    const phi = linear([borders[1][0], borders[1][count.phi]], [top + high, top]);
    drawCells(pen, panel, x, phi, borders);
    drawOutline(pen, x, phi, borders, inside);
    drawAxes(pen, panel.title, { left, top, across, high }, x, [!narrow || k === 2, narrow || k === 0]);
    if (narrow || k > 0) drawBar(pen, panel, left + across + 8, top, high);
    return { left, top, x, phi };
  });
  return (event) => {
    const area = canvas.getBoundingClientRect();
    const u = event.clientX - area.left, v = event.clientY - area.top;
    const over = areas.find(({ left, top }) => u >= left && u < left + across && v > top && v < top + high);
    const cellOf = (edges, value) => Math.max(0, edges.findIndex((edge) => edge > value) - 1);
    return over ? [cellOf(borders[0], over.x.back(u)), cellOf(borders[1], over.phi.back(v))] : null;
  };
}

function penOn(canvas, width, height) {
  const fine = Math.min(2, devicePixelRatio);
  canvas.width = width * fine;
  canvas.height = height * fine;
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const pen = canvas.getContext("2d", { willReadFrequently: true }); // drawn by the processor: small and often
  pen.scale(fine, fine);
  pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  pen.fillStyle = pen.strokeStyle = css("--ink");
  return pen;
}

function drawCells(pen, { values, low, high, colours }, x, phi, [alongX, alongPhi]) {
  const shades = ramp(colours);
  const fine = pen.getTransform().a;
  const pixels = (edges, axis) => edges.map((edge) => Math.round(fine * axis.at(edge)));
  const us = pixels(alongX, x), vs = pixels(alongPhi, phi);
  const top = vs[count.phi], image = pen.createImageData(us[count.x] - us[0], vs[0] - top);
  const all = new Uint32Array(image.data.buffer);
  for (let j = 0; j < count.phi; j++) {
    const start = (vs[j + 1] - top) * image.width;
    for (let i = 0; i < count.x; i++) {
      const value = values[i * count.phi + j];
      const [red, green, blue] = Number.isFinite(value) ? shades[Math.max(0, Math.min(255, Math.round((255 * (value - low)) / (high - low))))] : MISSING;
      all.fill(0xff000000 | (blue << 16) | (green << 8) | red, start + us[i] - us[0], start + us[i + 1] - us[0]);
    }
    for (let row = 1; row < vs[j] - vs[j + 1]; row++) all.copyWithin(start + row * image.width, start, start + image.width);
  }
  pen.putImageData(image, us[0], top);
  pen.save();
  const ring = (radius, colour, wide) => {
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    pen.beginPath();
    pen.arc(x.at(page.x[chosen.i]), phi.at(page.phi[chosen.j]), radius, 0, 7);
    pen.stroke();
  };
  ring(6, "#000000", 3.5);
  ring(6, "#ffffff", 1.5);
  pen.restore();
}

// Where calcified cells end, black on white dashes, seen on any colour.
function drawOutline(pen, x, phi, [alongX, alongPhi], inside) {
  const is = (i, j) => i >= 0 && j >= 0 && i < count.x && j < count.phi && inside[i * count.phi + j] > 0;
  pen.save();
  pen.beginPath();
  for (let i = 0; i <= count.x; i++) {
    for (let j = 0; j <= count.phi; j++) {
      if (i > 0 && i < count.x && j < count.phi && is(i - 1, j) !== is(i, j)) { pen.moveTo(x.at(alongX[i]), phi.at(alongPhi[j])); pen.lineTo(x.at(alongX[i]), phi.at(alongPhi[j + 1])); }
      if (j > 0 && j < count.phi && i < count.x && is(i, j - 1) !== is(i, j)) { pen.moveTo(x.at(alongX[i]), phi.at(alongPhi[j])); pen.lineTo(x.at(alongX[i + 1]), phi.at(alongPhi[j])); }
    }
  }
  pen.lineWidth = 2.5;
  pen.strokeStyle = "#ffffff";
  pen.stroke();
  pen.lineWidth = 1.2;
  pen.strokeStyle = "#000000";
  pen.stroke();
  pen.restore();
}

function drawAxes(pen, title, { left, top, across, high }, x, [below, beside]) {
  pen.textAlign = "center";
  pen.fillText(title, left + across / 2, top - 8, across - 30); // a long name is set closer
  for (const [value, text] of below ? x.ticks : []) pen.fillText(text, x.at(value), top + high + 15);
  if (below) pen.fillText("x (mm)", left + across / 2, top + high + 32);
  pen.textAlign = "right";
  for (const degrees of beside ? [0, 90, 180, 270, 360] : []) pen.fillText(`${degrees}°`, left - 5, top + high * (1 - degrees / 360) + 4);
  if (beside) pen.fillText("φ", left - 5, top - 10);
}

function drawBar(pen, { colours, low, high, symbol, unit }, left, top, tall) {
  const shades = ramp(colours);
  const down = linear([low, high], [top + tall, top]);
  pen.save();
  for (let k = 0; k < tall; k++) {
    pen.fillStyle = `rgb(${shades[Math.round((255 * (tall - 1 - k)) / (tall - 1))]})`;
    pen.fillRect(left, top + k, 12, 1);
  }
  pen.restore();
  pen.textAlign = "left";
  for (const [value, text] of down.ticks) pen.fillText(text, left + 16, down.at(value) + 4);
  pen.fillText(named(symbol, unit), left - 4, top - 8);
}
