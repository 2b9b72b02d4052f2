// The page's numbers: read once, unpacked when first asked for.
const page = JSON.parse(document.getElementById("page-data").textContent);
const unpacked = new Map();

// What page_data.py packed: differences along each axis, low and high bytes apart, zlib, base 64.
function unpack(packed) {
  if (!unpacked.has(packed)) unpacked.set(packed, numbersOf(packed));
  return unpacked.get(packed);
}

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

const unpackedJson = async (text) => JSON.parse(new TextDecoder().decode(await inflated(text)));

async function numbersOf({ shape, low, step, data }) {
  const octets = new Uint8Array(await inflated(data));
  const count = octets.length / 2;
  const whole = new Uint16Array(count);
  for (let k = 0; k < count; k++) whole[k] = octets[k] | (octets[k + count] << 8);
  let stride = 1;
  for (const size of [...shape].reverse()) {
    const block = stride * size;
    for (let start = 0; start < count; start += block) {
      for (let k = start + stride; k < start + block; k++) whole[k] += whole[k - stride];
    }
    stride = block;
  }
  const values = new Float64Array(count);
  for (let k = 0; k < count; k++) values[k] = whole[k] === 65535 ? NaN : low + step * whole[k];
  return values;
}

function number(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "—";
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}
// A value beside others: with its last zeros, so that all tell as many digits.
function stated(value, digits = 4) {
  const size = Math.abs(value);
  return size >= 1e-3 && size < 10 ** digits ? value.toPrecision(digits).replace("-", "−") : number(value, digits);
}
const signed = (value, digits = 3) => (value > 0 ? "+" : "") + stated(value, digits);
const withUnit = (text, unit) => (unit ? `${text}\u00a0${unit}` : text);
