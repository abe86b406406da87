// Reduces the points of a line, within a tolerance, by Douglas and Peucker's method, block by block.
// Source: D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points required to represent a
// digitized line", 1973. Blocks bound the work, so that a million points take a fraction of a second.

/** Positions as x, y, z, x, y, z, ... in mm. */
export type Positions = Float32Array;

const BLOCK_POINTS = 128;

/** The square of the distance of point p from the line between a and b, all indices of points. mm². */
export function squaredDistance(at: Positions, p: number, a: number, b: number): number {
  const ax = at[3 * a]!, ay = at[3 * a + 1]!, az = at[3 * a + 2]!;
  const dx = at[3 * b]! - ax, dy = at[3 * b + 1]! - ay, dz = at[3 * b + 2]! - az;
  const px = at[3 * p]! - ax, py = at[3 * p + 1]! - ay, pz = at[3 * p + 2]! - az;
  const length2 = dx * dx + dy * dy + dz * dz;
  const share = length2 > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy + pz * dz) / length2)) : 0;
  const ex = px - share * dx, ey = py - share * dy, ez = pz - share * dz;
  return ex * ex + ey * ey + ez * ez;
}

/** The point between `first` and `last` that is farthest from the line between these two: its place in `from`, or -1 if
 * none is farther than the tolerance. It is the innermost loop, so it calls no function. */
function farthest(at: Positions, from: Uint32Array, first: number, last: number, tolerance2: number): number {
  const a = 3 * from[first]!, b = 3 * from[last]!;
  const ax = at[a]!, ay = at[a + 1]!, az = at[a + 2]!;
  const dx = at[b]! - ax, dy = at[b + 1]! - ay, dz = at[b + 2]! - az;
  const length2 = dx * dx + dy * dy + dz * dz;
  let index = -1, most = tolerance2;
  for (let i = first + 1; i < last; ++i) {
    const p = 3 * from[i]!;
    const px = at[p]! - ax, py = at[p + 1]! - ay, pz = at[p + 2]! - az;
    const along = length2 > 0 ? (px * dx + py * dy + pz * dz) / length2 : 0;
    const share = along < 0 ? 0 : along > 1 ? 1 : along;
    const ex = px - share * dx, ey = py - share * dy, ez = pz - share * dz;
    const squared = ex * ex + ey * ey + ez * ez;
    if (squared > most) {
      most = squared;
      index = i;
    }
  }
  return index;
}

/**
 * Returns the points of `from` (rising indices into `at`) to keep. No left-out point is farther than
 * `tolerance_mm` from the line of the kept points. Points where `kind` changes are always kept.
 */
export function simplify(at: Positions, kind: Uint8Array, from: Uint32Array, tolerance_mm: number): Uint32Array {
  const keep = new Uint8Array(from.length);
  const tolerance2 = tolerance_mm * tolerance_mm;
  const stack: number[] = [];
  let first = 0;
  while (first < from.length) {
    let last = Math.min(first + BLOCK_POINTS, from.length - 1);
    for (let i = first + 1; i < last; ++i) {
      if (kind[from[i]!] !== kind[from[i + 1]!]) last = i; // the segment after this point is of another kind
    }
    keep[first] = keep[last] = 1;
    stack.push(first, last);
    while (stack.length > 0) {
      const b = stack.pop()!, a = stack.pop()!;
      if (b - a < 2) continue;
      const index = farthest(at, from, a, b, tolerance2);
      if (index < 0) continue;
      keep[index] = 1;
      stack.push(a, index, index, b);
    }
    if (last === from.length - 1) break;
    first = last;
  }
  return from.filter((_, i) => keep[i] === 1);
}
