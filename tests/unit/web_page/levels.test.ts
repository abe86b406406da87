import { describe, expect, test } from "vitest";
import { chooseLevel, CHUNK_POINTS, makeLevels, pointsUpTo, visibleRuns } from "../../../clients/web/page/src/path/levels";
import { squaredDistance } from "../../../clients/web/page/src/path/simplify";

const all = () => true;
const now = () => Promise.resolve();

/** A spiral that climbs, with some noise from a fixed seed. */
function spiral(points: number): Float32Array {
  const at = new Float32Array(3 * points);
  let seed = 1;
  for (let i = 0; i < points; ++i) {
    seed = (seed * 48271) % 0x7fffffff;
    const angle = i / 40, radius = 5 + i / 200 + (seed % 1000) / 1e6;
    at.set([radius * Math.cos(angle), radius * Math.sin(angle), i / 5000], 3 * i);
  }
  return at;
}

function farthestFromLevel(at: Float32Array, points: Uint32Array): number {
  let most = 0;
  for (let i = 1; i < points.length; ++i) {
    for (let p = points[i - 1]! + 1; p < points[i]!; ++p) most = Math.max(most, squaredDistance(at, p, points[i - 1]!, points[i]!));
  }
  return Math.sqrt(most);
}

describe("levels of detail", async () => {
  const at = spiral(20_000), kind = new Uint8Array(20_000);
  const levels = await makeLevels(at, kind, now);

  test("become coarser, and each keeps its tolerance", () => {
    expect(levels.length).toBeGreaterThan(3);
    for (const [i, level] of levels.entries()) {
      expect(farthestFromLevel(at, level.points)).toBeLessThanOrEqual(level.tolerance_mm + 1e-6);
      if (i > 0) expect(level.points.length).toBeLessThan(levels[i - 1]!.points.length);
      expect([level.points[0], level.points.at(-1)]).toEqual([0, 19_999]);
    }
  });

  test("keep every change between cut and rapid", async () => {
    const line = new Float32Array(3 * 3000).map((_, i) => (i % 3 === 0 ? i : 0));
    const rapid = new Uint8Array(3000).map((_, i) => (i > 1000 && i <= 1200 ? 1 : 0));
    for (const { points } of await makeLevels(line, rapid, now)) expect([...points]).toEqual(expect.arrayContaining([1000, 1200]));
  });

  test("differ from the path by at most half a pixel where that is not too much to draw", () => {
    const { level } = chooseLevel(levels, 0.1, Infinity, all);
    expect(level.tolerance_mm).toBeLessThanOrEqual(0.05);
    const few = chooseLevel(levels, 0.0001, 3000, all);
    expect(few.runs.reduce((sum, run) => sum + run.last - run.first, 0)).toBeLessThanOrEqual(3000);
  });

  test("draw only what is in view, and join what is beside each other", () => {
    const finest = levels[0]!;
    expect(visibleRuns(finest, all)).toEqual([{ first: 0, last: 19_999 }]);
    const right = visibleRuns(finest, (bounds, i) => bounds[i + 3]! > 90);
    for (const run of right) expect(run.last - run.first).toBeLessThanOrEqual(20 * CHUNK_POINTS);
    expect(visibleRuns(finest, () => false)).toEqual([]);
  });

  test("know what of them is done", () => {
    for (const level of levels) {
      for (const point of [0, 1, 777, 19_999]) expect(pointsUpTo(level, point)).toBe(level.points.filter((p) => p <= point).length);
    }
  });

  test("of an empty path are empty", async () => {
    const [level] = await makeLevels(new Float32Array(0), new Uint8Array(0), now);
    expect(chooseLevel([level!], 1, 100, all).runs).toEqual([]);
  });

  test("of a million points are made", async () => {
    const points = 1_000_000;
    const made = await makeLevels(spiral(points), new Uint8Array(points), now);
    expect(made.at(-1)!.points.length).toBeLessThan(points / 8);
  });
});
