// The samples of a sweep: any output over any parameter; pointing at a sample tells all that was varied.
function samples(host) {
  const { controls, place, words } = frame(host);
  const run = () => wish();
  const variant = choice(controls, "variant", page.variants, run);
  const output = choice(controls, "output", page.outputs.map((entry) => entry.label), run, page.start);
  const parameter = choice(controls, "over", page.parameters.map((entry) => entry.label), run);
  const unitOf = (entry) => (entry.unit === "1" ? "" : entry.unit);
  const varied = (k) => [`sample ${page.sample[k]}`,
    ...page.parameters.map((entry) => `${entry.label}: ${withUnit(number(entry.values[k]), unitOf(entry))}`)];
  const wish = drawnWhenSeen(place, async () => {
    const up = page.outputs[output.value], across = page.parameters[parameter.value];
    const limit = up.limits[variant.value];
    const all = page.sample.map((_, k) => k).filter((k) => page.variant[k] === variant.value && up.values[k] !== null);
    const within = all.filter((k) => limit === null || Math.abs(up.values[k]) <= limit);
    const beyond = all.filter((k) => limit !== null && Math.abs(up.values[k]) > limit);
    const limits = limit === null ? [] : all.some((k) => up.values[k] < 0) ? [-limit, limit] : [limit];
    const points = (which, name, colour, kind) => ({ name, panel: 0, which, x: which.map((k) => across.values[k]), y: which.map((k) => up.values[k]), colour, kind });
    const lines = [
      points(within, limit === null ? "sample" : "within the band", "var(--model-0)", "points"),
      points(beyond, "beyond", "var(--difference)", "crosses"),
    ];
    const [least, most] = extent([...lines.map((line) => line.y), limits]);
    const spare = 0.06 * (most - least);
    const [first, last] = extent(lines.map((line) => line.x));
    chart(place, {
      height: 400, lines, limits, panels: [{ title: isNarrow(place) ? unitOf(up) || "–" : named(up.label, unitOf(up) || "–"), share: 1, low: least - spare, high: most + spare }],
      x: { title: named(across.label, unitOf(across) || "–"), log: across.logarithmic,
        range: across.logarithmic ? [first / 1.05, last * 1.05] : [first - 0.03 * (last - first), last + 0.03 * (last - first)] },
      told: (k, n) => [withUnit(number(lines[n].y[k]), unitOf(up)), ...varied(lines[n].which[k])],
    });
    const judged = limit === null ? "no band judges it" : `${within.length} of ${all.length} within ${withUnit(number(limit), unitOf(up))}`;
    words.textContent = `${up.label}, variant ${page.variants[variant.value]}: ${judged}.`;
  });
}
