// Both models over the cycle at any cell, their difference below.
function curves(host) {
  const { controls, place, words } = frame(host);
  const names = Object.keys(page.fields);
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run, page.variants.length - 1);
  const quantity = choice(controls, "quantity", names.map((name) => page.fields[name].label), run, names.indexOf("radius"));
  const i = slider(controls, "cell i", count.x - 1, page.i[Math.floor(page.i.length / 2)] - 1,
    (k) => `i = ${k + 1}, x = ${number(page.x[k], 3)} mm`, run);
  const j = slider(controls, "row j", count.phi - 1, page.j[page.j.length - 1] - 1,
    (k) => `j = ${k + 1}, φ = ${page.phi[k].toFixed(0)}°`, run);
  const drawn = drawnWhenSeen(place, async () => {
    const field = page.fields[names[quantity.value]];
    const onCells = isOnCells(field);
    j.disabled = !onCells;
    const models = await bothModels(field, variant.value);
    const calcified = await unpack(page.calcified[variant.value]);
    const at = (state) => (onCells ? cellAt(state, i.value, j.value) : sectionAt(state, i.value));
    const reference = page.time.map((_, state) => models.reference[at(state)]);
    const rom = page.time.map((_, state) => models.rom[at(state)]);
    const difference = rom.map((value, state) => field.difference_factor * (value - reference[state]));
    plot(place, curveTraces(field, reference, rom, difference), layoutOf(place, 460, {
      hovermode: "x unified", showlegend: true, legend: { orientation: "h", x: 0, y: 1.14 },
      xaxis: axisOf("time into the cycle (s)", { anchor: "y2", hoverformat: ".3f", range: [-0.01, 1.01].map((share) => share * page.time[count.time - 1]) }),
      yaxis: axisOf(named(field.symbol, field.unit), { domain: [0.4, 1] }),
      yaxis2: axisOf(named("2D − 3D", field.difference_unit), { domain: [0, 0.28] }),
      shapes: page.named.map((entry) => ({ type: "line", xref: "x", yref: "paper", y0: 0, y1: 1,
        x0: page.time[entry.state], x1: page.time[entry.state], line: { color: css("--quiet"), width: 1, dash: "dot" } })),
    }));
    const sizes = difference.map((value) => (Number.isFinite(value) ? Math.abs(value) : -1));
    const worst = sizes.indexOf(Math.max(...sizes));
    const inside = onCells && calcified[i.value * count.phi + j.value] ? " This cell is calcified." : "";
    words.textContent = `${field.label}, variant ${page.variants[variant.value]}: farthest apart at ${moment(worst)}: `
      + `3D ${withUnit(number(reference[worst]), field.unit)}, 2D ${withUnit(number(rom[worst]), field.unit)}, `
      + `2D − 3D = ${withUnit(signed(difference[worst]), field.difference_unit)}.${inside}`;
  });
}

function curveTraces(field, reference, rom, difference) {
  const said = (name, unit) => `${name} %{y:.4~g}${unit ? ` ${unit}` : ""}<extra></extra>`;
  return [
    { x: page.time, y: reference, name: "3D", mode: "markers", marker: { color: css("--reference"), size: 6 },
      hovertemplate: said("3D", field.unit) },
    { x: page.time, y: rom, name: "2D", mode: "lines", line: { color: css("--rom"), width: 2.5 },
      hovertemplate: said("2D", field.unit) },
    { x: page.time, y: difference, yaxis: "y2", name: "2D − 3D", mode: "lines",
      line: { color: css("--difference"), width: 2, dash: "dash" }, hovertemplate: said("2D − 3D", field.difference_unit) },
  ];
}
