// Both models over the cycle at the chosen place, their difference below.
function curves(host) {
  const { place, words } = frame(host);
  followed(place, words);
}

function followed(place, words) {
  const wish = drawnWhenSeen(place, async () => drawCurves(place, words));
  follow(KEYS, wish);
  return wish;
}

async function drawCurves(place, words) {
  const field = chosenField();
  const models = await bothModels(field);
  const at = (state) => (isOnCells(field) ? cellAt(state, chosen.i, chosen.j) : sectionAt(state, chosen.i));
  const reference = page.time.map((_, state) => models.reference[at(state)]);
  const rom = page.time.map((_, state) => models.rom[at(state)]);
  const difference = rom.map((value, state) => field.difference_factor * (value - reference[state]));
  const two = modelLabel(), apart = `${two} − 3D`;
  const lines = [
    { name: "3D", panel: 0, y: reference, colour: "var(--reference)", kind: "points" },
    { name: two, panel: 0, y: rom, colour: modelColour(), kind: "line" },
    { name: apart, panel: 1, y: difference, colour: "var(--difference)", kind: "line", dash: true },
  ].map((line) => ({ ...line, x: page.time }));
  const told = (k) => [moment(k), `3D ${valueWords(reference[k], field)}`, `${two} ${valueWords(rom[k], field)}`,
    `${apart} ${withUnit(signed(difference[k]), field.difference_unit)}`];
  const last = page.time[count.time - 1];
  chart(place, {
    height: 420, lines, told, chosenAt: (k) => chooseNow({ time: k }), marks: page.named.map((entry) => ({ at: page.time[entry.state], name: entry.name })), now: page.time[chosen.time],
    x: { title: "time into the cycle (s)", range: [-0.01 * last, 1.01 * last] },
    panels: [{ title: named(field.symbol, field.unit), share: 0.66 }, { title: named(apart, field.difference_unit), share: 0.34 }],
  });
  const sizes = difference.map((value) => (Number.isFinite(value) ? Math.abs(value) : -1));
  const worst = sizes.indexOf(Math.max(...sizes));
  const where = isOnCells(field) ? placeWords(chosen.i, chosen.j) : `section at x = ${page.x[chosen.i].toFixed(1)} mm`;
  const values = (k) => `${told(k).slice(1, 3).join(", ")}, ${apart} = ${withUnit(signed(difference[k]), field.difference_unit)}`;
  words.textContent = `${field.label}, variant ${page.variants[chosen.variant]}, ${where}. At ${moment(chosen.time)}: ${values(chosen.time)}. `
    + `Farthest apart at ${moment(worst)}: ${values(worst)}.`;
}
