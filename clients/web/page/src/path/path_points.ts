// The path of a program as the server sends it: 16 bytes a point, little-endian.

export interface Path {
  /** x, y, z of each point, mm of the machine's coordinates. */
  readonly at: Float32Array;
  /** The program's line that leads to the point; 0 for the point where the program begins. */
  readonly line: Uint32Array;
  /** 1 if a rapid move leads to the point, else 0. */
  readonly rapid: Uint8Array;
}

const POINT_BYTES = 16;
const RAPID_BIT = 0x80000000;

export function readPath(bytes: ArrayBuffer): Path {
  const count = Math.floor(bytes.byteLength / POINT_BYTES);
  const view = new DataView(bytes);
  const path = { at: new Float32Array(3 * count), line: new Uint32Array(count), rapid: new Uint8Array(count) };
  for (let i = 0, from = 0; i < count; ++i, from += POINT_BYTES) {
    for (let axis = 0; axis < 3; ++axis) path.at[3 * i + axis] = view.getFloat32(from + 4 * axis, true);
    const word = view.getUint32(from + 12, true);
    path.line[i] = word & ~RAPID_BIT;
    path.rapid[i] = word >= RAPID_BIT ? 1 : 0;
  }
  return path;
}

/** Least and greatest x, y, z; undefined for a path without points. */
export function pathBounds(at: Float32Array): { low: [number, number, number]; high: [number, number, number] } | undefined {
  if (at.length === 0) return undefined;
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < at.length; ++i) {
    const axis = (i % 3) as 0 | 1 | 2, value = at[i]!;
    if (value < low[axis]) low[axis] = value;
    if (value > high[axis]) high[axis] = value;
  }
  return { low, high };
}
