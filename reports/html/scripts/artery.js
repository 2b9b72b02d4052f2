// The deformed lumen in both models side by side, to be turned by pointer or slider.
const COLOURED_BY = ["lumen radius", "pressure", "calcification"];

function hasWebGL() {
  const canvas = document.createElement("canvas");
  return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
}

function artery(host) {
  if (!hasWebGL()) {
    host.append(element("p", { className: "readout" },
      "This browser draws no WebGL, so the artery cannot be turned here; the still picture shows it."));
    host.hidden = false;
    return;
  }
  const { controls, place, words } = frame(host);
  const run = () => drawn();
  const variant = choice(controls, "variant", page.variants, run, page.variants.length - 1);
  const colour = choice(controls, "coloured by", COLOURED_BY, run);
  const times = [...new Set([1, 2, 3, 5, 10, 20, page.artery.exaggeration])].sort((a, b) => a - b);
  const exaggeration = choice(controls, "deformation", times.map((k) => (k === 1 ? "true to scale" : `× ${k}`)), run,
    times.indexOf(page.artery.exaggeration));
  const time = timeSlider(controls, run);
  const turn = slider(controls, "turn about the axis", 35, Math.round(page.artery.seen_from / 10) % 36, (k) => `${10 * k}°`, () => aim(place, 10 * turn.value));
  const drawn = drawnWhenSeen(place, async () => {
    const [radius, pressure] = await Promise.all(["radius", "pressure"].map((name) => bothModels(page.fields[name], variant.value)));
    const inside = await unpack(page.calcified[variant.value]);
    const size = count.x * count.phi;
    const now = (values) => values.subarray(time.value * size, (time.value + 1) * size);
    const shade = (model) => [now(radius[model]), now(pressure[model]), inside][colour.value];
    const scale = colourScale(colour.value, [shade("reference"), shade("rom")]);
    const narrow = isNarrow(place);
    const traces = ["reference", "rom"].map((model, k) => ({
      type: "surface", scene: k ? "scene2" : "scene", ...lumen(now(radius[model]), times[exaggeration.value]),
      surfacecolor: around(shade(model)), ...scale, showscale: k === 1,
      text: around(vertexWords(now(radius[model]), now(pressure[model]), inside)), hovertemplate: `${k ? "2D" : "3D"}<br>%{text}<extra></extra>`,
      lighting: { ambient: 0.75, diffuse: 0.4, specular: 0.05 }, contours: { x: { highlight: false }, y: { highlight: false }, z: { highlight: false } },
    }));
    await plot(place, traces, arteryLayout(place, narrow, cameraAt(10 * turn.value)));
    words.textContent = `${page.variants[variant.value]}, ${moment(time.value)}: radius ${range(now(radius.reference), "mm")} in 3D, `
      + `${range(now(radius.rom), "mm")} in 2D; pressure ${range(now(pressure.reference), "kPa")} in 3D, ${range(now(pressure.rom), "kPa")} in 2D.`;
  });
}

const range = (values, unit) => `${extent([values]).map((value) => number(value, 5)).join(" … ")} ${unit}`;

// Rows along x; the last value of a row is its first, so that the surface closes.
function around(values) {
  return page.x.map((_, i) => [...page.phi.map((_, j) => values[i * count.phi + j]), values[i * count.phi]]);
}

function lumen(radius, exaggeration) {
  const angles = [...page.phi, page.phi[0] + 360].map((degrees) => (Math.PI * degrees) / 180);
  const r = around(radius.map((value) => page.artery.rest_radius + exaggeration * (value - page.artery.rest_radius)));
  return {
    x: page.x.map((x) => angles.map(() => x)),
    y: r.map((row) => row.map((value, k) => value * Math.cos(angles[k]))),
    z: r.map((row) => row.map((value, k) => value * Math.sin(angles[k]))),
  };
}

function vertexWords(radius, pressure, inside) {
  return Array.from(radius, (value, k) => `x = ${page.x[Math.floor(k / count.phi)].toFixed(2)} mm, φ = ${page.phi[k % count.phi].toFixed(0)}°<br>`
    + `R ${number(value)} mm, P ${number(pressure[k])} kPa${inside[k] ? "<br>calcified" : ""}`);
}

function colourScale(by, shades) {
  const [cmin, cmax] = by === 2 ? [0, 1] : extent(shades);
  const words = by === 2 ? { tickvals: [0.25, 0.75], ticktext: ["not calcified", "calcified"] } : { title: { text: ["R (mm)", "P (kPa)"][by], side: "right" } };
  return {
    cmin, cmax, colorscale: by === 2 ? [[0, "#56b4e9"], [0.5, "#56b4e9"], [0.5, "#d55e00"], [1, "#d55e00"]] : "Viridis",
    colorbar: { thickness: 12, len: 0.7, x: 1, outlinewidth: 0, ...words },
  };
}

// Seen from the side φ = `degrees`, a little from upstream.
function cameraAt(degrees) {
  const angle = (Math.PI * degrees) / 180;
  return { eye: { x: -0.45, y: 1.55 * Math.cos(angle), z: 1.55 * Math.sin(angle) }, up: { x: 0, y: Math.sin(angle), z: -Math.cos(angle) },
    projection: { type: "orthographic" } };
}

function aim(place, degrees) {
  if (place.layout) Plotly.relayout(place, { "scene.camera": cameraAt(degrees), "scene2.camera": cameraAt(degrees) });
}

function arteryLayout(place, narrow, camera) {
  const axis = (title) => ({ title: { text: title }, color: css("--ink"), gridcolor: css("--line"), showbackground: false, zeroline: false });
  const across = { ...axis(""), showticklabels: false };
  const scene = { aspectmode: "data", camera, xaxis: axis("x (mm)"), yaxis: across, zaxis: across };
  const areas = narrow ? [{ x: [0, 0.9], y: [0.52, 1] }, { x: [0, 0.9], y: [0, 0.48] }] : [{ x: [0, 0.46], y: [0, 1] }, { x: [0.48, 0.94], y: [0, 1] }];
  const titles = ["3D", "2D"].map((text, k) => ({ text: `<b>${text}</b>`, showarrow: false, xref: "paper", yref: "paper", xanchor: "left", yanchor: "top",
    x: areas[k].x[0], y: areas[k].y[1] }));
  return layoutOf(place, narrow ? 520 : 320, { margin: { l: 0, r: 0, t: 8, b: 8 }, annotations: titles,
    scene: { ...scene, domain: areas[0] }, scene2: { ...scene, domain: areas[1] } });
}
