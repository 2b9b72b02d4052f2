// Curves and points in SVG, in panels above each other over one axis; pointing tells their values.
function drawn(tag, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const MARGIN = { left: 66, right: 14, top: 16, bottom: 42, gap: 26 };

// `lines`: name, panel, x, y, colour, kind ("line", "points", "crosses"), dash; `panels`: title, share of the height, low, high.
// `marks`: abscissas and names of upright lines, `limits`: ordinates of level ones, `now`: the chosen abscissa.
function chart(place, { height, x, panels, lines, marks = [], limits = [], now = null, told, chosenAt }) {
  const width = Math.max(place.clientWidth, 240);
  const across = (x.log ? logarithmic : linear)(x.range, [MARGIN.left, width - MARGIN.right]);
  const room = height - MARGIN.top - MARGIN.bottom - MARGIN.gap * (panels.length - 1);
  let top = MARGIN.top;
  const downs = panels.map((panel, k) => {
    const bottom = top + room * panel.share;
    const down = linear(rangeOf(panel, lines.filter((line) => line.panel === k)), [bottom, top]);
    top = bottom + MARGIN.gap;
    return { ...down, top: bottom - room * panel.share, bottom };
  });
  const svg = drawn("svg", { width, height, viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
  panels.forEach((panel, k) => svg.append(...frameOf(panel.title, across, downs[k], width)));
  const last = downs[downs.length - 1];
  for (const [value, text] of across.ticks) svg.append(drawn("text", { x: across.at(value), y: last.bottom + 16, "text-anchor": "middle" }, text));
  svg.append(drawn("text", { x: (MARGIN.left + width - MARGIN.right) / 2, y: height - 6, "text-anchor": "middle" }, x.title));
  const upright = (value, name) => drawn("line", { class: name, x1: across.at(value), x2: across.at(value), y1: downs[0].top, y2: last.bottom });
  svg.append(...marks.flatMap(({ at, name }) => [upright(at, "mark"), drawn("text", { x: across.at(at) + 3, y: downs[0].top - 4, "text-anchor": across.at(at) > 0.85 * width ? "end" : "start" }, name)]), ...(now === null ? [] : [upright(now, "now")]));
  svg.append(...limits.map((y) => drawn("line", { class: "limit", x1: MARGIN.left, x2: width - MARGIN.right, y1: downs[0].at(y), y2: downs[0].at(y) })));
  for (const line of lines) svg.append(shape(line, across, downs[line.panel]));
  place.replaceChildren(legend(lines), svg);
  place.drawn = lines;
  listen(place, svg, lines, across, downs, told, chosenAt);
}

function rangeOf(panel, lines) {
  const [low, high] = extent(lines.map((line) => line.y));
  const spare = 0.06 * (high - low);
  return [panel.low ?? low - spare, panel.high ?? high + spare];
}

function frameOf(title, across, down, width) {
  const right = width - MARGIN.right;
  const grid = [
    ...down.ticks.map(([y]) => drawn("line", { class: y === 0 ? "zero" : "grid", x1: MARGIN.left, x2: right, y1: down.at(y), y2: down.at(y) })),
    ...across.ticks.map(([x]) => drawn("line", { class: "grid", x1: across.at(x), x2: across.at(x), y1: down.top, y2: down.bottom })),
  ];
  const words = down.ticks.map(([y, text]) => drawn("text", { x: MARGIN.left - 6, y: down.at(y) + 4, "text-anchor": "end" }, text));
  const middle = (down.top + down.bottom) / 2;
  return [...grid, ...words, drawn("text", { transform: `translate(14 ${middle}) rotate(-90)`, "text-anchor": "middle" }, title)];
}

function shape({ kind, x, y, colour, dash }, across, down) {
  const points = Array.from(x, (value, k) => [across.at(value), down.at(y[k])]).filter((point) => point.every(Number.isFinite));
  if (kind === "line") {
    return drawn("polyline", { class: "curve", points: points.map((point) => point.map((value) => value.toFixed(1)).join(",")).join(" "),
      style: `stroke: ${colour}`, ...(dash ? { "stroke-dasharray": "6 4" } : {}) });
  }
  const marks = points.map(([u, v]) => (kind === "crosses" ? drawn("path", { d: `M${u - 3.5} ${v - 3.5}l7 7m0 -7l-7 7`, style: `stroke: ${colour}; stroke-width: 2` })
    : drawn("circle", { cx: u, cy: v, r: 3, style: `fill: ${colour}` })));
  return drawn("g", { class: "points" }, ...marks);
}

const SIGNS = { line: "━", points: "●", crosses: "×" };
function legend(lines) {
  return element("ul", { className: "legend" }, ...lines.map(({ name, kind, colour, dash }) =>
    element("li", {}, element("span", { style: `color: ${colour}`, "aria-hidden": "true" }, dash ? "╍" : SIGNS[kind]), ` ${name}`)));
}

// The point of any line that is nearest to the pointer, upright distance counting little where all lines share their x.
function listen(place, svg, lines, across, downs, told, chosenAt) {
  const flat = told.length === 1 ? 0 : 1;
  const found = (event) => {
    const area = svg.getBoundingClientRect();
    let best = null, least = Infinity;
    lines.forEach((line, n) => Array.from(line.x, (value, k) => {
      const far = Math.hypot(across.at(value) - (event.clientX - area.left), flat * (downs[line.panel].at(line.y[k]) - (event.clientY - area.top)));
      if (far < least) { least = far; best = [k, n]; }
    }));
    return best;
  };
  pointed(place, svg, (event) => { const best = found(event); return best && told(...best); });
  if (chosenAt) svg.addEventListener("click", (event) => { const best = found(event); if (best) chosenAt(best[0]); });
}
