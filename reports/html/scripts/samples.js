// The samples of a sweep: any output over any parameter; pointing at a sample tells all that was varied.
function samples(host) {
  const { controls, place, words } = frame(host);
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run);
  const output = choice(controls, "output", page.outputs.map((entry) => entry.label), run, page.start);
  const parameter = choice(controls, "over", page.parameters.map((entry) => entry.label), run);
  const unitOf = (entry) => (entry.unit === "1" ? "" : entry.unit);
  const told = (k) => [`sample ${page.sample[k]}`,
    ...page.parameters.map((entry) => `${entry.label}: ${withUnit(number(entry.values[k]), unitOf(entry))}`)].join("<br>");
  const drawn = drawnWhenSeen(place, async () => {
    const up = page.outputs[output.value], across = page.parameters[parameter.value];
    const limit = up.limits[variant.value];
    const all = page.sample.map((_, k) => k).filter((k) => page.variant[k] === variant.value && up.values[k] !== null);
    const within = all.filter((k) => limit === null || Math.abs(up.values[k]) <= limit);
    const beyond = all.filter((k) => limit !== null && Math.abs(up.values[k]) > limit);
    const limits = limit === null ? [] : all.some((k) => up.values[k] < 0) ? [-limit, limit] : [limit];
    const points = (which, name, marker) => ({
      x: which.map((k) => across.values[k]), y: which.map((k) => up.values[k]), text: which.map(told), name, mode: "markers", marker,
      hovertemplate: `%{y:.4~g}${unitOf(up) ? ` ${unitOf(up)}` : ""}<br>%{text}<extra></extra>`,
    });
    plot(place, [
      points(within, limit === null ? "sample" : "within the band", { color: css("--rom"), size: 6, opacity: 0.8 }),
      points(beyond, "beyond", { color: css("--difference"), size: 8, symbol: "x", opacity: 0.8 }),
    ], layoutOf(place, 420, {
      hovermode: "closest", showlegend: true, legend: { orientation: "h", x: 0, y: 1.14 },
      xaxis: axisOf(named(across.label, unitOf(across) || "–"), { type: across.logarithmic ? "log" : "linear", automargin: true }),
      yaxis: axisOf(isNarrow(place) ? unitOf(up) || "–" : named(up.label, unitOf(up) || "–"), { automargin: true, zeroline: false }),
      shapes: limits.map((y) => ({ type: "line", xref: "paper", x0: 0, x1: 1, y0: y, y1: y,
        line: { color: css("--ink"), width: 1.5, dash: "dash" } })),
    }));
    const judged = limit === null ? "no band judges it" : `${within.length} of ${all.length} within ${withUnit(number(limit), unitOf(up))}`;
    words.textContent = `${up.label}, variant ${page.variants[variant.value]}: ${judged}.`;
  });
}
