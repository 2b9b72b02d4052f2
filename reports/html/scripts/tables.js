// Tables that can be sorted by a click on a heading and narrowed by variant, quantity and verdict.
const VERDICTS = { FAIL: 0, MISSING: 1, OK: 2 };

function sortKey(text) {
  if (text in VERDICTS) return VERDICTS[text];
  const found = text.replace(/−/g, "-").replace(/^<\s*/, "").match(/^[+-]?\d+(\.\d+)?(e[+-]?\d+)?/);
  return found ? Number(found[0]) : text;
}

function compare(a, b) {
  if (typeof a === "number" && typeof b === "number") return a - b;
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1; // what is absent comes last
  return a.localeCompare(b);
}

const words = (cell) => (cell.dataset.value ?? cell.textContent).trim();

function sortable(table) {
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  heads.forEach((head, column) => {
    const button = element("button", { type: "button", className: "sort" }, ...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => sortBy(table, heads, column));
  });
}

function sortBy(table, heads, column) {
  const body = table.tBodies[0];
  const down = heads[column].getAttribute("aria-sort") === "ascending";
  heads.forEach((other) => other.removeAttribute("aria-sort"));
  heads[column].setAttribute("aria-sort", down ? "descending" : "ascending");
  const keyed = [...body.rows].map((row) => [sortKey(words(row.cells[column])), row]);
  keyed.sort(([a], [b]) => (down ? compare(b, a) : compare(a, b)));
  body.append(...keyed.map(([, row]) => row));
}

function filterable(table) {
  const columns = [...table.tHead.rows[table.tHead.rows.length - 1].cells]
    .map((head, column) => ({ name: head.textContent.trim(), column, filter: head.dataset.filter !== undefined }))
    .filter((entry) => entry.filter);
  const all = [...table.tBodies[0].rows];
  const bar = element("div", { className: "controls filters", role: "group", "aria-label": "Show only some rows of the table" });
  const count = element("output", { className: "count" });
  const filters = columns.flatMap(({ name, column }) => {
    const options = [...new Set(all.map((row) => words(row.cells[column])))];
    if (options.length < 2) return [];
    const picked = choice(bar, name, [`all (${options.length})`, ...options], narrow);
    return [(row) => picked.value === 0 || words(row.cells[column]) === options[picked.value - 1]];
  });
  if (!filters.length) return;
  function narrow() {
    for (const row of all) row.hidden = !filters.every((passes) => passes(row));
    const shown = all.filter((row) => !row.hidden).length;
    count.textContent = shown === all.length ? `${all.length} rows` : `${shown} of ${all.length} rows`;
  }
  bar.append(count);
  table.closest(".scroll").before(bar);
  narrow();
}
