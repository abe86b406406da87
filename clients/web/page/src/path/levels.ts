// Levels of detail of a path: each has fewer points than the one before, and a greater tolerance.
import { simplify, type Positions } from "./simplify";

export interface Level {
  /** No left-out point is farther from the drawn line than this. 0 if all points are drawn. */
  readonly tolerance_mm: number;
  /** Rising indices of the points that are drawn. */
  readonly points: Uint32Array;
  /** Bounds of each run of CHUNK_POINTS points and the first point of the next: least x, y, z, greatest x, y, z. */
  readonly bounds: Float32Array;
}

/** Points `first` to `last` of a level, both drawn. */
export interface Run {
  readonly first: number;
  readonly last: number;
}

export const CHUNK_POINTS = 512;
const FINEST_MM = 0.002;
const FACTOR = 4;
const MOST_LEVELS = 9;
const PIECE_POINTS = 16_384;
const FEWEST_POINTS = 2000;
const MOST_SHARE = 0.8; // of the level before: otherwise a level is not worth its memory

function chunkBounds(at: Positions, points: Uint32Array): Float32Array {
  const chunks = Math.ceil(Math.max(0, points.length - 1) / CHUNK_POINTS);
  const bounds = new Float32Array(6 * chunks);
  for (let chunk = 0; chunk < chunks; ++chunk) {
    const low = bounds.subarray(6 * chunk, 6 * chunk + 3).fill(Infinity);
    const high = bounds.subarray(6 * chunk + 3, 6 * chunk + 6).fill(-Infinity);
    const end = Math.min((chunk + 1) * CHUNK_POINTS, points.length - 1);
    for (let i = chunk * CHUNK_POINTS; i <= end; ++i) {
      for (let axis = 0; axis < 3; ++axis) {
        const value = at[3 * points[i]! + axis]!;
        if (value < low[axis]!) low[axis] = value;
        if (value > high[axis]!) high[axis] = value;
      }
    }
  }
  return bounds;
}

/** Simplifies piece by piece, so that the page stays responsive. Ends of pieces are kept. */
async function simplified(
  at: Positions, kind: Uint8Array, points: Uint32Array, tolerance_mm: number, pause: () => Promise<void>,
): Promise<Uint32Array> {
  const kept = new Uint32Array(points.length);
  let count = 0;
  for (let first = 0; first < points.length; first += PIECE_POINTS) {
    const piece = simplify(at, kind, points.subarray(first, first + PIECE_POINTS), tolerance_mm);
    kept.set(piece, count);
    count += piece.length;
    await pause();
  }
  return kept.slice(0, count);
}

/**
 * Levels from the finest (all points) to the coarsest. Tolerances add up from level to level; tolerance_mm is the sum.
 * @param pause is awaited after each piece of the work, some milliseconds long
 */
export async function makeLevels(at: Positions, kind: Uint8Array, pause: () => Promise<void>): Promise<Level[]> {
  let points: Uint32Array = Uint32Array.from({ length: at.length / 3 }, (_, i) => i);
  const levels: Level[] = [{ tolerance_mm: 0, points, bounds: chunkBounds(at, points) }];
  let step_mm = FINEST_MM, total_mm = 0;
  for (let i = 1; i < MOST_LEVELS && points.length > FEWEST_POINTS; ++i, step_mm *= FACTOR) {
    points = await simplified(at, kind, points, step_mm, pause);
    total_mm += step_mm;
    if (points.length < MOST_SHARE * levels.at(-1)!.points.length) {
      levels.push({ tolerance_mm: total_mm, points, bounds: chunkBounds(at, points) });
    }
  }
  return levels;
}

/** The runs of a level in the chunks for which `sees` returns true. */
export function visibleRuns(level: Level, sees: (bounds: Float32Array, at: number) => boolean): Run[] {
  const runs: { first: number; last: number }[] = [];
  for (let chunk = 0; chunk < level.bounds.length / 6; ++chunk) {
    if (!sees(level.bounds, 6 * chunk)) continue;
    const first = chunk * CHUNK_POINTS;
    const last = Math.min(first + CHUNK_POINTS, level.points.length - 1);
    const before = runs.at(-1);
    if (before?.last === first) before.last = last;
    else runs.push({ first, last });
  }
  return runs;
}

/**
 * Chooses the level to draw and its runs in view: the coarsest level within half a pixel of the path.
 * If that has more points in view than the painter can draw in a frame, the finest that has not.
 */
export function chooseLevel(
  levels: readonly Level[], mm_per_pixel: number, most_points: number, sees: (bounds: Float32Array, at: number) => boolean,
): { level: Level; runs: Run[] } {
  let chosen = 0;
  levels.forEach((level, i) => {
    if (level.tolerance_mm <= mm_per_pixel / 2) chosen = i;
  });
  for (;; ++chosen) {
    const level = levels[chosen]!;
    const runs = visibleRuns(level, sees);
    const points = runs.reduce((sum, run) => sum + run.last - run.first, 0);
    if (points <= most_points || chosen + 1 === levels.length) return { level, runs };
  }
}

/** How many of the level's points are at or before a point of the path, that is, are done. */
export function pointsUpTo(level: Level, point: number): number {
  let low = 0, high = level.points.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (level.points[middle]! <= point) low = middle + 1;
    else high = middle;
  }
  return low;
}
