// What all interactive pictures share: colours of the page, fonts, no buttons of the library's own.
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const DIVERGING = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582",
  "#d6604d", "#b2182b", "#67001f"].map((colour, k) => [k / 10, colour]);
const isNarrow = (place) => place.clientWidth < 620;
const drawings = [];

function layoutOf(place, height, more) {
  const ink = css("--ink"), line = css("--line");
  return {
    height, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: "system-ui, 'DejaVu Sans', sans-serif", size: 12, color: ink },
    hoverlabel: { bgcolor: css("--paper"), bordercolor: line, font: { color: ink } },
    margin: { l: 64, r: 16, t: 34, b: 48 }, uirevision: "kept", ...more,
  };
}

function axisOf(title, more = {}) {
  return { title: { text: title }, gridcolor: css("--line"), zerolinecolor: css("--quiet"), linecolor: css("--quiet"), ...more };
}

const named = (symbol, unit) => (unit ? `${symbol} (${unit})` : symbol);

function plot(place, traces, layout) {
  return Plotly.react(place, traces, layout, { displayModeBar: false, responsive: true });
}

// A picture inside a page section: where its controls, its drawing and its words go.
function frame(host) {
  const controls = element("div", { className: "controls" });
  const place = element("div", { className: "plot", role: "figure", "aria-label": host.dataset.label });
  const words = element("p", { className: "readout", "aria-live": "polite" });
  host.append(controls, place, words);
  host.hidden = false;
  return { controls, place, words };
}

// Drawn when first seen, again when the page's colours or width change.
function drawnWhenSeen(place, draw) {
  const run = latest(draw);
  let seen = false;
  new IntersectionObserver((entries, observer) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    seen = true;
    observer.disconnect();
    run();
  }, { rootMargin: "400px" }).observe(place);
  let width = place.clientWidth;
  new ResizeObserver(() => {
    if (!seen || place.clientWidth === width) return;
    width = place.clientWidth;
    run();
  }).observe(place);
  drawings.push(() => seen && run());
  return run;
}
