// Everything that needs scripts begins here; without them the page is complete but still.
function themes() {
  const place = document.getElementById("theme");
  const choices = ["as the system", "light", "dark"];
  const picked = choice(place, "colours", choices, () => {
    if (picked.value) document.documentElement.dataset.theme = choices[picked.value];
    else delete document.documentElement.dataset.theme;
    drawings.forEach((again) => again());
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawings.forEach((again) => again()));
  place.hidden = false;
}

// A figure too small to read on a telephone opens at its full size.
function enlargeable(figure) {
  const image = figure.querySelector("img");
  const large = element("dialog", { className: "large", "aria-label": image.alt });
  const close = element("button", { type: "button" }, "Close");
  const copy = image.cloneNode();
  large.append(close, element("div", { tabIndex: 0 }, copy));
  close.addEventListener("click", () => large.close());
  const open = element("button", { type: "button", className: "enlarge" }, "Enlarge");
  open.addEventListener("click", () => { if (!large.isConnected) figure.append(large); large.showModal(); });
  figure.querySelector(".card").after(open);
}

themes();
document.querySelectorAll("main table").forEach((table) => { if (table.tBodies[0].rows.length > 1) filterable(table, sortable(table)); });
document.querySelectorAll("figure").forEach(enlargeable);
document.querySelectorAll("[data-interactive]").forEach((host) => PICTURES[host.dataset.interactive](host));
document.documentElement.dataset.scripts = "ready";
