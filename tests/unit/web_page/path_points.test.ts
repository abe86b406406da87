import { describe, expect, test } from "vitest";
import { pathBounds, readPath } from "../../../clients/web/page/src/path/path_points";
import { PathProgress } from "../../../clients/web/page/src/path/progress";

type Point = readonly [x: number, y: number, z: number, line: number, rapid?: boolean];

function encode(points: readonly Point[]): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(16 * points.length));
  points.forEach(([x, y, z, line, rapid], i) => {
    [x, y, z].forEach((value, axis) => view.setFloat32(16 * i + 4 * axis, value, true));
    view.setUint32(16 * i + 12, line + (rapid ? 2 ** 31 : 0), true);
  });
  return view.buffer;
}

const SQUARE: Point[] = [[0, 0, 0, 0], [10, 0, 0, 3, true], [10, 10, 0, 4], [0, 10, 0, 5], [0, 0, 0, 6]];

describe("a path", () => {
  test("is read with its lines and rapid moves", () => {
    const path = readPath(encode(SQUARE));
    expect([...path.line]).toEqual([0, 3, 4, 5, 6]);
    expect([...path.rapid]).toEqual([0, 1, 0, 0, 0]);
    expect([...path.at.slice(6, 9)]).toEqual([10, 10, 0]);
    expect(pathBounds(path.at)).toEqual({ low: [0, 0, 0], high: [10, 10, 0] });
  });

  test("without points has no bounds, and a broken one ends at its last whole point", () => {
    expect(pathBounds(readPath(new ArrayBuffer(0)).at)).toBeUndefined();
    expect(readPath(encode(SQUARE).slice(0, 40)).line.length).toBe(2);
  });
});

describe("progress along a path", () => {
  test("stays where it was when a job ends early and no line is in motion", () => {
    const progress = new PathProgress(readPath(encode(SQUARE)));
    const reached = progress.advance(5, [3, 10, 0]);
    expect(progress.advance(0, [0, 0, 0])).toBe(reached);
  });


  test("is the point that the head is on its way to", () => {
    const progress = new PathProgress(readPath(encode(SQUARE)));
    expect(progress.advance(3, [4, 0, 0])).toBe(1);
    expect(progress.advance(5, [3, 10, 0])).toBe(3);
  });

  test("finds the place within a line of many points", () => {
    const arc: Point[] = [[0, 0, 0, 0], ...[1, 2, 3, 4, 5].map((x): Point => [x, 0, 0, 7])];
    const progress = new PathProgress(readPath(encode(arc)));
    expect([0.5, 2.5, 4.2].map((x) => progress.advance(7, [x, 0, 0]))).toEqual([1, 3, 5]);
  });

  test("goes on in the repetition of a line, and begins again with a new job", () => {
    const loop: Point[] = [[0, 0, 0, 0], [1, 0, 0, 2], [0, 0, 0, 3], [1, 0, 0, 2], [0, 0, 0, 3]];
    const progress = new PathProgress(readPath(encode(loop)));
    expect([2, 3, 2, 3].map((line) => progress.advance(line, [0.5, 0, 0]))).toEqual([1, 2, 3, 4]);
    progress.restart();
    expect(progress.advance(2, [0.5, 0, 0])).toBe(1);
  });

  test("takes a later line where a line's points were left out", () => {
    const progress = new PathProgress(readPath(encode(SQUARE)));
    const sparse = new PathProgress(readPath(encode([[0, 0, 0, 0], [9, 0, 0, 10], [9, 9, 0, 20]])));
    expect(sparse.advance(15, [9, 4, 0])).toBe(2);
    expect(progress.advance(99, [0, 0, 0])).toBe(0);
  });
});
