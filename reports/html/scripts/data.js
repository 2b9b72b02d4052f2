// The page's numbers: read once, unpacked when first asked for.
const page = JSON.parse(document.getElementById("page-data").textContent);
const unpacked = new Map();

// What packed.py made: differences along each axis, low and high bytes apart, zlib, base 64.
function unpack(packed) {
  if (!unpacked.has(packed)) unpacked.set(packed, inflate(packed));
  return unpacked.get(packed);
}

async function inflate({ shape, low, step, data }) {
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const octets = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = octets.length / 2;
  const whole = new Uint16Array(count);
  for (let k = 0; k < count; k++) whole[k] = octets[k] | (octets[k + count] << 8);
  let stride = 1;
  for (const size of [...shape].reverse()) {
    for (let k = 0; k < count; k++) if (Math.floor(k / stride) % size) whole[k] += whole[k - stride];
    stride *= size;
  }
  return Float64Array.from(whole, (value) => (value === 65535 ? NaN : low + step * value));
}

function number(value, digits = 4) {
  if (value === null) return "—";
  if (!Number.isFinite(value)) return "> 100 (plug flow)";
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}
const signed = (value, digits = 3) => (value > 0 ? "+" : "") + number(value, digits);
const withUnit = (text, unit) => (unit ? `${text}\u00a0${unit}` : text);
