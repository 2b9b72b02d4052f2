// Triangles with colours and depths in an image: needs no graphics card, and tells what each point shows.
function rasterOf(width, height) {
  return { width, height, pixels: new Uint32Array(width * height), depth: new Float32Array(width * height), quad: new Int32Array(width * height) };
}

function cleared(raster) {
  raster.pixels.fill(0);
  raster.depth.fill(-Infinity);
  raster.quad.fill(-1);
}

// `at`: of each corner, pixels right and down, depth towards the reader, place on the ramp 0 … 255, brightness.
function fillTriangle(raster, colours, quad, at, a, b, c) {
  const ax = at[a], ay = at[a + 1], bx = at[b], by = at[b + 1], cx = at[c], cy = at[c + 1];
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (area === 0) return;
  const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx))), right = Math.min(raster.width - 1, Math.floor(Math.max(ax, bx, cx)));
  const top = Math.max(0, Math.ceil(Math.min(ay, by, cy))), bottom = Math.min(raster.height - 1, Math.floor(Math.max(ay, by, cy)));
  const vRight = (cy - ay) / area, vDown = -(cx - ax) / area, wRight = -(by - ay) / area, wDown = (bx - ax) / area;
  const { width, pixels, depth, quad: quads } = raster;
  for (let y = top; y <= bottom; y++) {
    let v = (left - ax) * vRight + (y - ay) * vDown, w = (left - ax) * wRight + (y - ay) * wDown;
    for (let x = left; x <= right; x++, v += vRight, w += wRight) {
      const u = 1 - v - w;
      if (u < 0 || v < 0 || w < 0) continue;
      const pixel = y * width + x;
      const near = u * at[a + 2] + v * at[b + 2] + w * at[c + 2];
      if (near <= depth[pixel]) continue;
      depth[pixel] = near;
      quads[pixel] = quad;
      const colour = colours[Math.round(u * at[a + 3] + v * at[b + 3] + w * at[c + 3])];
      const light = u * at[a + 4] + v * at[b + 4] + w * at[c + 4];
      pixels[pixel] = 0xff000000 | ((colour[2] * light) << 16) | ((colour[1] * light) << 8) | (colour[0] * light);
    }
  }
}
