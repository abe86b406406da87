// A screenshot with at most 256 colours: a fraction of the bytes, and no visible difference.
import { deflateSync } from "node:zlib";

/** Red, green, blue, opacity of each pixel; the browser decodes the picture. */
async function decode(page, png) {
  const base64 = png.toString("base64");
  const pixels = await page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
    pen.drawImage(picture, 0, 0);
    const { data: seen, width, height } = pen.getImageData(0, 0, picture.width, picture.height);
    let text = "";
    for (let i = 0; i < seen.length; i += 32768) text += String.fromCharCode(...seen.subarray(i, i + 32768));
    return { width, height, text: btoa(text) };
  }, base64);
  return { ...pixels, data: Buffer.from(pixels.text, "base64") };
}

const TOO_CLOSE = 100; // squared distance of two colours of the palette

/** The most frequent colours, and for each colour of the picture the nearest of them. */
function quantise({ data }) {
  const counts = new Map();
  for (let i = 0; i < data.length; i += 4) {
    const colour = data.readUIntBE(i, 3);
    counts.set(colour, (counts.get(colour) ?? 0) + 1);
  }
  const parts = (c) => [c >> 16, (c >> 8) & 255, c & 255];
  const palette = [];
  for (const [colour] of [...counts].sort((a, b) => b[1] - a[1])) {
    const [r, g, b] = parts(colour);
    const isNew = palette.every(([pr, pg, pb]) => (r - pr) ** 2 + (g - pg) ** 2 + (b - pb) ** 2 > TOO_CLOSE);
    if (isNew && palette.push([r, g, b]) === 256) break;
  }
  const nearest = (colour) => {
    const [r, g, b] = parts(colour);
    let best = 0, least = Infinity;
    palette.forEach(([pr, pg, pb], i) => {
      const distance = (r - pr) ** 2 + (g - pg) ** 2 + (b - pb) ** 2;
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  };
  return { palette, index: new Map([...counts.keys()].map((colour) => [colour, nearest(colour)])) };
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function chunk(type, content) {
  const body = Buffer.concat([Buffer.from(type), content]);
  const whole = Buffer.alloc(body.length + 8);
  whole.writeUInt32BE(content.length, 0);
  body.copy(whole, 4);
  whole.writeUInt32BE(crc32(body), body.length + 4);
  return whole;
}

export async function smallPng(page, png) {
  const picture = await decode(page, png);
  const { width, height, data } = picture;
  const { palette, index } = quantise(picture);
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) rows[y * (width + 1) + 1 + x] = index.get(data.readUIntBE(4 * (y * width + x), 3));
  }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", head), chunk("PLTE", Buffer.from(palette.flat())),
    chunk("IDAT", deflateSync(rows, { level: 9 })), chunk("IEND", Buffer.alloc(0)),
  ]);
}
