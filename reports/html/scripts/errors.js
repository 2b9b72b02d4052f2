// How far the closest profile with exponent γ is from 3D, at the shown cells and instants.
function errors(host) {
  const { controls, place, words } = frame(host);
  const { gamma, values } = page.errors;
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run, page.variants.length - 1);
  const time = choice(controls, "time", page.named.map((entry) => moment(entry.state)), run);
  const i = choice(controls, "cell i", page.i, run, Math.floor(page.i.length / 2));
  const j = choice(controls, "row j", page.j, run, page.j.length - 1);
  const drawn = drawnWhenSeen(place, async () => {
    const all = await unpack(values[variant.value]);
    const start = ((time.value * page.i.length + i.value) * page.j.length + j.value) * gamma.length;
    const error = gamma.map((_, k) => all[start + k]);
    const field = page.fields.profile_exponent;
    const models = await bothModels(field, variant.value);
    const at = cellAt(page.named[time.value].state, page.i[i.value] - 1, page.j[j.value] - 1);
    const marks = [["closest to 3D", models.reference[at], css("--reference")], ["2D", models.rom[at], css("--rom")]];
    plot(place, [
      { x: gamma, y: error, name: "error against 3D", mode: "lines", line: { color: css("--reference"), width: 2 },
        hovertemplate: "γ = %{x:.3~g}: error %{y:.3~g} %<extra></extra>" },
      ...marks.map(([name, value, color]) => ({ x: [value, value], y: [0, Math.max(...error.filter(Number.isFinite), 0)],
        name: `γ ${name}`, mode: "lines", line: { color, width: 1.5, dash: "dash" }, hovertemplate: `γ ${name}: ${number(value, 3)}<extra></extra>` })),
    ], layoutOf(place, 340, {
      hovermode: "closest", showlegend: true, legend: { orientation: "h", x: 0, y: 1.18 },
      xaxis: axisOf("exponent γ (–)", { type: "log" }), yaxis: axisOf("error (%)", { rangemode: "tozero" }),
    }));
    words.textContent = `Variant ${page.variants[variant.value]}, i = ${page.i[i.value]}, j = ${page.j[j.value]}, `
      + `${moment(page.named[time.value].state)}: γ closest to 3D ${number(marks[0][1], 3)}, of 2D ${number(marks[1][1], 3)}.`;
  });
}
