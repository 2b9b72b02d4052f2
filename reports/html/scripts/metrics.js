// Every row of metrics.json, to be searched; a page of rows at a time.
const ROWS_SHOWN = 25;
const FILTERS = ["model", "variant", "quantity", "statistic", "status"];
function metrics(host) {
  const { controls, place, words } = frame(host);
  drawnWhenSeen(place, async () => {
    if (!place.hasChildNodes()) searched(await unpackedJson(page.metrics), controls, place, words, host.dataset.label);
  });
}

function searched(all, controls, place, words, label) {
  const total = all.i.length;
  let first = 0, order = null, ascending = true;
  const changed = () => { first = 0; draw(); };
  const kept = FILTERS.filter((name) => name in all); // one model needs no column
  const filters = kept.map((name) => {
    const { names, rows } = all[name];
    const picked = choice(controls, name === "status" ? "verdict" : name, ["all", ...names.map((text) => text || "not judged")], changed);
    return (k) => picked.value === 0 || rows[k] === picked.value - 1;
  });
  const word = (name, k) => all[name].names[all[name].rows[k]];
  const heads = [...kept.map((name) => [name === "status" ? "verdict" : name, name, (k) => word(name, k)]),
    ["at", "at", (k) => spot(all, k)], ["3D", "reference", (k) => all.reference[k]], ["2D", "rom", (k) => all.rom[k]],
    ["error", "error", (k) => all.error[k]], ["limit", "band", (k) => all.band[k]]];
  const table = element("table", { role: "table" });
  const head = element("tr", { role: "row" }, ...heads.map(([title, , value]) => {
    const button = element("button", { type: "button", className: "sort" }, title);
    const cell = element("th", { scope: "col", role: "columnheader" }, button);
    button.addEventListener("click", () => {
      ascending = order === value ? !ascending : true;
      order = value;
      [...head.cells].forEach((other) => other.removeAttribute("aria-sort"));
      cell.setAttribute("aria-sort", ascending ? "ascending" : "descending");
      changed();
    });
    return cell;
  }));
  const body = element("tbody", { role: "rowgroup" });
  table.append(element("thead", { role: "rowgroup" }, head), body);
  table.setAttribute("aria-label", label);
  place.className = "scroll";
  place.setAttribute("role", "region");
  place.setAttribute("aria-label", `${label}: rows`);
  place.tabIndex = 0;
  place.append(table);
  const back = element("button", { type: "button" }, "Earlier rows");
  const on = element("button", { type: "button" }, "Later rows");
  back.addEventListener("click", () => { first -= ROWS_SHOWN; draw(); });
  on.addEventListener("click", () => { first += ROWS_SHOWN; draw(); });
  place.after(element("div", { className: "controls" }, back, on));

  function draw() {
    const found = [];
    for (let k = 0; k < total; k++) if (filters.every((passes) => passes(k))) found.push(k);
    if (order) found.sort((a, b) => (ascending ? 1 : -1) * missingLast(order(a), order(b)));
    body.replaceChildren(...found.slice(first, first + ROWS_SHOWN).map((k) => element("tr", { role: "row" },
      ...heads.map(([title, name, value]) => metricCell(title, name, value(k), word("unit", k), all.relative[k])))));
    back.disabled = first === 0;
    on.disabled = first + ROWS_SHOWN >= found.length;
    const last = Math.min(first + ROWS_SHOWN, found.length);
    words.textContent = found.length ? `Rows ${first + 1} to ${last} of ${found.length} found among ${total}.` : `No row of ${total} is so.`;
  }
  draw();
}

function missingLast(a, b) {
  if (a === null || b === null) return (a === null) - (b === null);
  return typeof a === "number" ? a - b : a.localeCompare(b);
}

function spot(all, k) {
  const parts = [["i", all.i[k]], ["j", all.j[k]], ["t", all.t_s[k]]].filter(([, value]) => value !== null);
  return parts.map(([name, value]) => (name === "t" ? `t\u00a0=\u00a0${value.toFixed(3)}\u00a0s` : `${name}\u00a0=\u00a0${value}`)).join(", ");
}

function metricCell(title, name, value, unit, relative) {
  const cell = element("td", { role: "cell", className: name === "status" ? "status" : typeof value === "number" ? "number" : "prose" });
  if (value === null || value === "") cell.append("—");
  else if (name === "status") cell.append(element("span", { className: value.toLowerCase() }, value));
  else if (typeof value !== "number") cell.append(value);
  else if (relative && (name === "error" || name === "band")) cell.append(withUnit(number(100 * value), "%"));
  else cell.append(withUnit(scientific(value), unit === "1" ? "" : unit));
  return cell;
}

const scientific = (value) => number(value, 5).replace(/e\+?(.*)$/, " × 10^$1");
