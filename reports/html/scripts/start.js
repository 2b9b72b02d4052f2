// Everything that needs scripts begins here; without them the page is complete but still.
function themes() {
  const place = document.getElementById("theme");
  const choices = ["as the system", "light", "dark"];
  const again = () => drawings.forEach((wish) => wish());
  const picked = choice(place, "colours", choices, () => {
    if (picked.value) document.documentElement.dataset.theme = choices[picked.value];
    else delete document.documentElement.dataset.theme;
    again();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  place.hidden = false;
}

// Figures come when the reader is near them; the others follow one by one while the browser is idle.
async function figures() {
  const images = [...document.querySelectorAll("figure noscript")].map((still) => {
    const inert = element("template", { innerHTML: still.textContent });
    const image = inert.content.firstElementChild;
    const source = image.getAttribute("src");
    const [width, height] = [image.getAttribute("width"), image.getAttribute("height")];
    image.src = `data:image/svg+xml,<svg xmlns='http://www.w3.org/2000/svg' width='${width}' height='${height}'/>`;
    still.replaceWith(image);
    enlargeable(image.closest("figure"), image);
    let there = null;
    const draw = () => (there ??= new Promise((done) => { image.onload = image.onerror = done; image.src = source; }));
    return { image, draw };
  });
  const seen = new IntersectionObserver((entries) => entries.filter((entry) => entry.isIntersecting)
    .forEach((entry) => { seen.unobserve(entry.target); images.find(({ image }) => image === entry.target).draw(); }), { rootMargin: "800px" });
  images.forEach(({ image }) => seen.observe(image));
  for (const { image, draw } of images) {
    await new Promise((next) => idle(next));
    await draw();
  }
}

// A figure too small to read on a telephone opens at its full size.
function enlargeable(figure, image) {
  const large = element("dialog", { className: "large", "aria-label": image.alt });
  const close = element("button", { type: "button" }, "Close");
  const place = element("div", { tabIndex: 0 });
  large.append(close, place);
  close.addEventListener("click", () => large.close());
  const open = element("button", { type: "button", className: "enlarge" }, "Enlarge");
  open.addEventListener("click", () => {
    place.replaceChildren(image.cloneNode());
    if (!large.isConnected) figure.append(large);
    large.showModal();
  });
  figure.querySelector(".card").after(open);
}

// What an address or a link leads to is unfolded; so is all when it is printed.
function unfolding() {
  const unfold = () => {
    const found = document.getElementById(location.hash.slice(1).split("&")[0]);
    if (!found) return;
    for (let at = found; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    found.scrollIntoView();
  };
  addEventListener("hashchange", unfold);
  addEventListener("beforeprint", () => document.querySelectorAll("main details").forEach((fold) => { fold.open = true; }));
  unfold();
}

const isSmall = matchMedia("(max-width: 70rem)");
const arranged = () => document.querySelectorAll(".bar details").forEach((fold) => { fold.open = !isSmall.matches; });
isSmall.addEventListener("change", arranged);
arranged();
document.querySelector(".bar").classList.add("sticky");
themes();
figures();
document.querySelectorAll("main table").forEach((table) => {
  if (table.tBodies[0].rows.length < 2) return;
  filterable(table);
  if (!("fixed" in table.dataset)) sortable(table);
});
fillBar?.(document.getElementById("choice"));
document.querySelectorAll("[data-interactive]").forEach((host) => PICTURES[host.dataset.interactive](host));
unfolding();
document.documentElement.dataset.scripts = "ready";
