// Axial velocity from axis to wall at the shown cells, at every state.
function profiles(host) {
  const { controls, place, words } = frame(host);
  const field = page.profiles;
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run, page.variants.length - 1);
  const i = choice(controls, "cell i", page.i.map((k) => `i = ${k}, x = ${number(page.x[k - 1], 3)} mm`), run, Math.floor(page.i.length / 2));
  const j = choice(controls, "row j", page.j.map((k) => `j = ${k}, φ = ${page.phi[k - 1].toFixed(0)}°`), run, page.j.length - 1);
  const time = timeSlider(controls, run);
  const drawn = drawnWhenSeen(place, async () => {
    const models = await bothModels(field, variant.value);
    const start = ((time.value * page.i.length + i.value) * page.j.length + j.value) * count.y;
    const ray = (values) => [...values.slice(start, start + count.y)];
    const largest = [models.reference, models.rom].map((all) => all.reduce((most, value) => Math.max(most, value), 0));
    const reference = ray(models.reference), rom = ray(models.rom);
    const said = (name) => `${name} %{y:.4~g} ${field.unit}<extra></extra>`;
    plot(place, [
      { x: page.y, y: reference, name: "3D", mode: "markers", marker: { color: css("--reference"), size: 6 }, hovertemplate: said("3D") },
      { x: page.y, y: rom, name: "2D", mode: "lines", line: { color: css("--rom"), width: 2.5 }, hovertemplate: said("2D") },
    ], layoutOf(place, 380, {
      hovermode: "x unified", showlegend: true, legend: { orientation: "h", x: 0, y: 1.16 },
      xaxis: axisOf("r/R (–)", { hoverformat: ".3f" }),
      yaxis: axisOf(named(field.symbol, field.unit), { range: [Math.min(0, ...reference, ...rom), 1.05 * Math.max(...largest)] }),
    }));
    words.textContent = `${moment(time.value)}: on the axis 3D ${withUnit(number(reference[0]), field.unit)}, `
      + `2D ${withUnit(number(rom[0]), field.unit)}.`;
  });
}
