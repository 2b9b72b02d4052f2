// Axes: from values to pixels and back, with ticks at round numbers; colours over values.
function linear([low, high], [from, to]) {
  const perUnit = (to - from) / (high - low);
  return { at: (value) => from + (value - low) * perUnit, back: (pixel) => low + (pixel - from) / perUnit, ticks: roundTicks(low, high) };
}

function logarithmic([low, high], [from, to]) {
  const inner = linear([Math.log10(low), Math.log10(high)], [from, to]);
  return { at: (value) => inner.at(Math.log10(value)), back: (pixel) => 10 ** inner.back(pixel), ticks: powerTicks(low, high) };
}

function roundTicks(low, high, most = 6) {
  const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((size) => size >= rough);
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step).map((value) => [value, tickText(value, step, digits)]);
}

function tickText(value, step, digits) {
  const text = Math.abs(value) >= 1e5 || (step < 1e-4 && value) ? value.toExponential(2).replace(/\.?0+e\+?/, "e") : value.toFixed(Math.min(digits, 6));
  return text.replace("-", "−");
}

function powerTicks(low, high) {
  const steps = high / low > 1000 ? [1] : [1, 2, 5];
  const found = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const step of steps) if (step * 10 ** power >= low * (1 - 1e-9) && step * 10 ** power <= high * (1 + 1e-9)) found.push(step * 10 ** power);
  }
  return found.map((value) => [value, number(value)]);
}

// The least and the largest finite value, apart from each other.
function extent(arrays) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high && value < Infinity) high = value;
    }
  }
  if (low > high) return [0, 1];
  return high - low > 1e-6 * Math.max(Math.abs(low), Math.abs(high)) ? [low, high] : [low - 0.05 * Math.abs(low || 1), high + 0.05 * Math.abs(high || 1)];
}

const VIRIDIS = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"];
const DIVERGING = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f"];
const MISSING = [176, 176, 176];

// 256 colours between some, each as [red, green, blue].
function ramp(colours) {
  const parts = colours.map((text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16)));
  return Array.from({ length: 256 }, (_, k) => {
    const along = (k / 255) * (parts.length - 1), first = Math.min(Math.floor(along), parts.length - 2);
    return parts[first].map((value, channel) => Math.round(value + (along - first) * (parts[first + 1][channel] - value)));
  });
}
