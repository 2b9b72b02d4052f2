// The unrolled lumen at every state: 3D, 2D and their difference.
function maps(host) {
  const { controls, place, words } = frame(host);
  const names = Object.keys(page.fields).filter((name) => isOnCells(page.fields[name]));
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run, page.variants.length - 1);
  const quantity = choice(controls, "quantity", names.map((name) => page.fields[name].label), run, names.indexOf("radius"));
  const scale = choice(controls, "colours", ["of this instant", "of the whole cycle"], run);
  const time = timeSlider(controls, run);
  const drawn = drawnWhenSeen(place, async () => {
    const field = page.fields[names[quantity.value]];
    const models = await bothModels(field, variant.value);
    const inside = await unpack(page.calcified[variant.value]);
    const size = count.x * count.phi;
    const difference = models.rom.map((value, k) => field.difference_factor * (value - models.reference[k]));
    const now = (values) => values.subarray(time.value * size, (time.value + 1) * size);
    const scaled = scale.value ? (values) => values : now;
    const [low, high] = extent([scaled(models.reference), scaled(models.rom)]);
    const most = Math.max(...extent([scaled(difference)]).map(Math.abs)) || 1;
    const panels = [
      { title: "3D", values: now(models.reference), unit: field.unit, low, high, colours: "Viridis" },
      { title: "2D", values: now(models.rom), unit: field.unit, low, high, colours: "Viridis" },
      { title: "2D − 3D", values: now(difference), unit: field.difference_unit, low: -most, high: most, colours: DIVERGING },
    ];
    const narrow = isNarrow(place);
    plot(place, panels.flatMap((panel, k) => mapTraces(panel, k, field, inside, narrow)),
      mapLayout(place, panels, narrow));
    const worst = largestAt(now(difference));
    words.textContent = worst === null ? `${moment(time.value)}: nowhere finite.`
      : `${moment(time.value)}: farthest apart at i = ${Math.floor(worst / count.phi) + 1}, j = ${(worst % count.phi) + 1}: `
      + `3D ${withUnit(number(now(models.reference)[worst]), field.unit)}, 2D ${withUnit(number(now(models.rom)[worst]), field.unit)}, `
      + `2D − 3D = ${withUnit(signed(now(difference)[worst]), field.difference_unit)}.`;
  });
}

function extent(arrays) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays) for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  return high - low > 1e-6 * Math.max(Math.abs(low), Math.abs(high)) ? [low, high] : [low - 0.05 * Math.abs(low || 1), high + 0.05 * Math.abs(high || 1)];
}

function largestAt(values) {
  let found = null;
  values.forEach((value, k) => {
    if (Number.isFinite(value) && (found === null || Math.abs(value) > Math.abs(values[found]))) found = k;
  });
  return found;
}

const rows = (values) => page.phi.map((_, j) => page.x.map((_, i) => values[i * count.phi + j]));

function mapTraces(panel, k, field, inside, narrow) {
  const axes = { x: page.x, y: page.phi, xaxis: `x${k + 1}`, yaxis: `y${k + 1}` };
  const unit = panel.unit ? ` ${panel.unit}` : "";
  const bar = {
    title: { text: named(panel.title === "2D − 3D" ? panel.title : field.symbol, panel.unit), side: "right" }, thickness: 12,
    x: narrow ? 1.01 : [0, 0.6, 1][k] + 0.005, xpad: 2, y: narrow ? [0.84, 0.5, 0.16][k] : 0.5, len: narrow ? 0.3 : 1, outlinewidth: 0,
  };
  const cells = { ...axes, type: "heatmap", z: rows(panel.values), zmin: panel.low, zmax: panel.high, colorscale: panel.colours,
    showscale: k > 0 || narrow, colorbar: bar, hoverongaps: false,
    hovertemplate: `x = %{x:.2f} mm, φ = %{y:.0f}°<br>${panel.title} %{z:.4~g}${unit}<extra></extra>` };
  if (!inside.some((value) => value) || inside.every((value) => value)) return [cells];
  const outline = { ...axes, type: "contour", z: rows(inside), autocontour: false, showscale: false, hoverinfo: "skip",
    contours: { start: 0.5, end: 0.5, size: 1, coloring: "none" }, line: { color: "#000000", width: 1.5, dash: "dash" } };
  return [cells, outline];
}

function mapLayout(place, panels, narrow) {
  const across = narrow ? [[0, 1], [0, 1], [0, 1]] : [[0, 0.29], [0.31, 0.6], [0.71, 1]];
  const down = narrow ? [[0.7, 0.98], [0.36, 0.64], [0.02, 0.3]] : [[0, 1], [0, 1], [0, 1]];
  const layout = layoutOf(place, narrow ? 760 : 330, { showlegend: false, annotations: [], margin: { l: 52, r: 72, t: 30, b: 46 } });
  panels.forEach((panel, k) => {
    layout[`xaxis${k + 1}`] = axisOf(narrow && k < 2 ? "" : "x (mm)", { domain: across[k], anchor: `y${k + 1}`, showgrid: false });
    layout[`yaxis${k + 1}`] = axisOf(k === 0 || narrow ? "φ (°)" : "", { domain: down[k], anchor: `x${k + 1}`, tickvals: [0, 90, 180, 270, 360],
      showgrid: false, showticklabels: k === 0 || narrow });
    layout.annotations.push({ text: panel.title, showarrow: false, xref: "paper", yref: "paper", xanchor: "center", yanchor: "bottom",
      x: (across[k][0] + across[k][1]) / 2, y: down[k][1] });
  });
  return layout;
}
