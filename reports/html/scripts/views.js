// What all interactive pictures share: a frame, and the moment at which they are drawn.
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const isNarrow = (place) => place.clientWidth < 620;
const SUBSCRIPTS = { x: "ₓ", r: "ᵣ", φ: "ᵩ" };
const named = (symbol, unit) => [symbol.replace(/_([xrφ])/g, (_, letter) => SUBSCRIPTS[letter]), unit && `(${unit})`].filter(Boolean).join(" ");
const drawings = []; // to be called when the page's colours change

// A picture inside a page section: where its controls, its drawing and its words go.
function frame(host) {
  const controls = element("div", { className: "controls" });
  const place = element("div", { className: "plot", role: "figure", "aria-label": host.dataset.label });
  const words = element("p", { className: "readout", "aria-live": "polite" });
  host.querySelector("details").append(controls, place, words);
  host.hidden = false;
  return { controls, place, words };
}

const idle = window.requestIdleCallback ?? ((call) => setTimeout(call, 1));

// Draws one after the other, and only the newest wish of those that came meanwhile.
function latest(draw) {
  let running = false, again = false;
  return async function run() {
    if (running) { again = true; return; }
    running = true;
    do { again = false; await draw(); } while (again);
    running = false;
  };
}

// First drawings wait for their turn in idle time, so that the page answers between them.
let queue = Promise.resolve();
function inTurn(run) {
  queue = queue.then(() => new Promise((done) => idle(() => run().finally(done), { timeout: 400 })));
}

// Draws when a place is near the window, then at each wish while it is; a wish from afar waits.
function drawnWhenSeen(place, draw) {
  const run = latest(draw);
  let near = false, stale = true;
  new IntersectionObserver((entries) => {
    near = entries[entries.length - 1].isIntersecting;
    if (near && stale) { stale = false; inTurn(run); }
  }, { rootMargin: "300px" }).observe(place);
  const wish = () => { if (near) run(); else stale = true; };
  let width = place.clientWidth;
  new ResizeObserver(() => {
    if (place.clientWidth === width) return;
    width = place.clientWidth;
    wish();
  }).observe(place);
  drawings.push(wish);
  return wish;
}

// A box beside the pointer that tells what it points at; `at` returns the words, or null for nowhere.
function pointed(place, target, at) {
  const tip = element("div", { className: "tip", hidden: true });
  place.append(tip);
  target.addEventListener("pointerleave", () => { tip.hidden = true; });
  target.addEventListener("pointermove", (event) => {
    const lines = event.buttons ? null : at(event);
    tip.hidden = lines === null;
    if (tip.hidden) return;
    tip.replaceChildren(...lines.map((line) => element("div", {}, line)));
    const area = place.getBoundingClientRect();
    const x = event.clientX - area.left, y = event.clientY - area.top;
    tip.style.left = `${Math.max(0, x + 14 + tip.offsetWidth > area.width ? x - 14 - tip.offsetWidth : x + 14)}px`;
    tip.style.top = `${Math.max(0, Math.min(y + 14, area.height - tip.offsetHeight))}px`;
  });
}
