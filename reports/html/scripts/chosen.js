// The one choice of variant, model, quantity, time and place that all views follow; the page's address states it.
const KEYS = ["variant", "model", "quantity", "time", "i", "j"];
const count = { time: page.time.length, x: page.x.length, phi: page.phi.length, y: page.y.length };
const quantities = Object.keys(page.fields);
const chosen = {
  variant: page.variants.length - 1, model: 0, quantity: Math.max(0, quantities.indexOf("radius")),
  time: page.named.length ? page.named[0].state : 0, i: page.i[Math.floor(page.i.length / 2)] - 1, j: page.j[page.j.length - 1] - 1,
};
const followers = [];
const controlsOf = {};
let anchor = "";

// How each choice is written in the address: names, seconds, cells counted from 1.
const written = {
  variant: () => page.variants[chosen.variant], model: () => page.models[chosen.model].name, quantity: () => quantities[chosen.quantity],
  time: () => page.time[chosen.time].toFixed(4), i: () => chosen.i + 1, j: () => chosen.j + 1,
};
const nearest = (values, value) => values.reduce((best, other, k) => (Math.abs(other - value) < Math.abs(values[best] - value) ? k : best), 0);
const read = {
  variant: (text) => page.variants.indexOf(text), model: (text) => page.models.findIndex((model) => model.name === text),
  quantity: (text) => quantities.indexOf(text), time: (text) => (Number.isFinite(Number(text)) ? nearest(page.time, Number(text)) : -1),
  i: (text) => cellNumber(text, count.x), j: (text) => cellNumber(text, count.phi),
};
const cellNumber = (text, most) => (Number.isInteger(Number(text)) && Number(text) <= most ? Number(text) - 1 : -1);

function choose(changes) {
  Object.assign(chosen, changes);
  for (const key of KEYS) if (controlsOf[key]) controlsOf[key].value = chosen[key];
  chosenWords.textContent = `${page.variants[chosen.variant]}, t = ${page.time[chosen.time].toFixed(3)} s, ${placeWords(chosen.i, chosen.j)}`;
  followers.forEach((follow) => follow(Object.keys(changes)));
}

// What the reader does, beside what the address says when the page opens.
function chooseNow(changes) {
  choose(changes);
  writeAddress();
}

// A view's wish to be drawn whenever one of `keys` is chosen anew.
function follow(keys, wish) {
  followers.push((changed) => { if (changed.some((key) => keys.includes(key))) wish(); });
}

let writing = null;
function writeAddress() {
  clearTimeout(writing); // browsers allow few changes of the address a second
  writing = setTimeout(() => {
    const stated = KEYS.map((key) => `${key}=${encodeURIComponent(written[key]())}`);
    history.replaceState(null, "", `#${[...(anchor ? [anchor] : []), ...stated].join("&")}`);
  }, 250);
}

function readAddress() {
  const parts = location.hash.slice(1).split("&").filter(Boolean);
  anchor = parts.length && !parts[0].includes("=") ? parts[0] : anchor;
  const found = {};
  for (const [key, text] of new URLSearchParams(parts.filter((part) => part.includes("=")).join("&"))) {
    const value = KEYS.includes(key) ? read[key](text) : -1;
    if (value >= 0) found[key] = value;
  }
  return found;
}

const chosenWords = element("output", { className: "place" });
const inside = page.calcified.map(() => null);
Promise.all(page.calcified.map(unpack)).then((all) => { all.forEach((cells, k) => { inside[k] = cells; }); choose({}); });

function placeWords(i, j) {
  const cells = inside[chosen.variant];
  const where = cells && cells[i * count.phi + j] ? ", in the calcification" : "";
  return `x = ${page.x[i].toFixed(1)}\u00a0mm, φ = ${page.phi[j].toFixed(0)}°${where}`;
}

// The controls of the choice, in the bar that stays in sight.
function choosing(host) {
  const at = element("div", { className: "controls" });
  const wish = (key) => () => chooseNow({ [key]: controlsOf[key].value });
  const list = (key, label, words) => { if (words.length > 1) controlsOf[key] = choice(at, label, words, wish(key), chosen[key]); };
  list("variant", "variant", page.variants);
  list("model", "2D model", page.models.map((model) => model.label));
  list("quantity", "quantity", quantities.map((name) => page.fields[name].label));
  controlsOf.time = slider(at, "time", count.time - 1, chosen.time, moment, wish("time"));
  at.append(playing());
  controlsOf.i = slider(at, "x", count.x - 1, chosen.i, (k) => `${page.x[k].toFixed(2)} mm`, wish("i"));
  controlsOf.j = slider(at, "φ", count.phi - 1, chosen.j, (k) => `${page.phi[k].toFixed(0)}°`, wish("j"));
  host.querySelector("summary").append(chosenWords);
  host.append(at);
  host.hidden = false;
  choose(readAddress());
  addEventListener("hashchange", () => chooseNow(readAddress()));
}

function playing() {
  const button = element("button", { type: "button" }, "Play");
  let timer = null;
  button.addEventListener("click", () => {
    if (timer) timer = clearInterval(timer);
    else timer = setInterval(() => chooseNow({ time: (chosen.time + 1) % count.time }), 250);
    button.textContent = timer ? "Stop" : "Play";
  });
  return button;
}

// Where the models' values stand in the page's numbers: states, sections x, rows φ.
const isOnCells = (field) => field.values.reference[0].shape.length === 3;
const cellAt = (state, i, j) => (state * count.x + i) * count.phi + j;
const sectionAt = (state, i) => state * count.x + i;
const chosenField = () => page.fields[quantities[chosen.quantity]];

async function bothModels(field) {
  const name = page.models[chosen.model].name;
  const [reference, rom] = await Promise.all([field.values.reference, field.values[name]].map((all) => unpack(all[chosen.variant])));
  return { reference, rom };
}
// Exponents beyond 100 are packed as absent: such a profile is flat to the eye.
const exponentWords = (value, digits) => (Number.isFinite(value) ? stated(value, digits) : "> 100 (plug flow)");
const valueWords = (value, field) => (field === page.fields.profile_exponent ? exponentWords(value) : withUnit(stated(value), field.unit));
const modelLabel = () => page.models[chosen.model].label;
const modelColour = () => `var(--model-${chosen.model % 3})`;

function moment(state) {
  const entry = page.named.find((other) => other.state === state);
  return `t = ${page.time[state].toFixed(3)} s${entry ? `, ${entry.name}` : ""}`;
}

// The shown cell that is nearest to the chosen place, for what is known at few cells only.
const shownCell = () => [nearest(page.i, chosen.i + 1), nearest(page.j, chosen.j + 1)];
