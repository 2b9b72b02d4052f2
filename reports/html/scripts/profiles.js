// Axial velocity from axis to wall at the chosen time, at the shown cell nearest to the chosen place.
function profiles(host) {
  const { place, words } = frame(host);
  const field = page.profiles;
  const wish = drawnWhenSeen(place, async () => {
    const models = await bothModels(field);
    const [i, j] = shownCell();
    const start = ((chosen.time * page.i.length + i) * page.j.length + j) * count.y;
    const ray = (values) => [...values.slice(start, start + count.y)];
    const [, most] = extent([models.reference, models.rom]);
    const reference = ray(models.reference), rom = ray(models.rom);
    const [least] = extent([reference, rom]);
    const two = modelLabel();
    const told = (k) => [`r/R = ${page.y[k].toFixed(3)}`, `3D ${withUnit(stated(reference[k]), field.unit)}`, `${two} ${withUnit(stated(rom[k]), field.unit)}`];
    chart(place, {
      height: 340, told, x: { title: "r/R (–)", range: [-0.02, 1.02] },
      panels: [{ title: named(field.symbol, field.unit), share: 1, low: Math.min(0, least), high: 1.05 * most }],
      lines: [
        { name: "3D", panel: 0, x: page.y, y: reference, colour: "var(--reference)", kind: "points" },
        { name: two, panel: 0, x: page.y, y: rom, colour: modelColour(), kind: "line" },
      ],
    });
    words.textContent = `Variant ${page.variants[chosen.variant]}, ${placeWords(page.i[i] - 1, page.j[j] - 1)} (the shown cell nearest to the chosen place), `
      + `${moment(chosen.time)}: on the axis 3D ${withUnit(stated(reference[0]), field.unit)}, ${two} ${withUnit(stated(rom[0]), field.unit)}.`;
  });
  follow(["variant", "model", "time", "i", "j"], wish);
}
