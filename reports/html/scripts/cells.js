// Where both models' values stand in the page's numbers: states, sections x, rows φ.
const count = { time: page.time.length, x: page.x.length, phi: page.phi.length, y: page.y.length };
const isOnCells = (field) => field.reference[0].shape.length === 3;
const cellAt = (state, i, j) => (state * count.x + i) * count.phi + j;
const sectionAt = (state, i) => state * count.x + i;

async function bothModels(field, variant) {
  const [reference, rom] = await Promise.all([unpack(field.reference[variant]), unpack(field.rom[variant])]);
  return { reference, rom };
}

const moment = (state) => {
  const named = page.named.find((entry) => entry.state === state);
  return `t = ${page.time[state].toFixed(3)} s${named ? `, ${named.name}` : ""}`;
};
