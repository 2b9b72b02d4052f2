// How far the closest profile with exponent γ is from 3D, at the shown cell and instant nearest to the chosen ones.
function errors(host) {
  const { place, words } = frame(host);
  const { gamma, values } = page.errors;
  const wish = drawnWhenSeen(place, async () => {
    const all = await unpack(values[chosen.variant]);
    const instant = nearest(page.named.map((entry) => page.time[entry.state]), page.time[chosen.time]);
    const [i, j] = shownCell();
    const start = ((instant * page.i.length + i) * page.j.length + j) * gamma.length;
    const error = gamma.map((_, k) => all[start + k]);
    const models = await bothModels(page.fields.profile_exponent);
    const at = cellAt(page.named[instant].state, page.i[i] - 1, page.j[j] - 1);
    const two = modelLabel();
    const marks = [["closest to 3D", models.reference[at], "var(--reference)"], [`of ${two}`, models.rom[at], modelColour()]];
    const [, most] = extent([error]);
    chart(place, {
      height: 320, x: { title: "exponent γ (–)", range: [gamma[0], gamma[gamma.length - 1]], log: true },
      panels: [{ title: "error (%)", share: 1, low: 0, high: 1.05 * most }],
      lines: [
        { name: "error against 3D", panel: 0, x: gamma, y: error, colour: "var(--reference)", kind: "line" },
        ...marks.filter(([, value]) => Number.isFinite(value)).map(([name, value, colour]) => ({ name: `γ ${name}`, panel: 0, x: [value, value], y: [0, most], colour, kind: "line", dash: true })),
      ],
      told: (k, n) => (n ? [`γ ${marks[n - 1][0]}: ${exponentWords(marks[n - 1][1], 3)}`] : [`γ = ${number(gamma[k], 3)}: error ${stated(error[k], 3)} %`]),
    });
    words.textContent = `Variant ${page.variants[chosen.variant]}, ${placeWords(page.i[i] - 1, page.j[j] - 1)} (the shown cell nearest to the chosen place), `
      + `${moment(page.named[instant].state)}: γ closest to 3D ${exponentWords(marks[0][1], 3)}, of ${two} ${exponentWords(marks[1][1], 3)}.`;
  });
  follow(["variant", "model", "time", "i", "j"], wish);
}
