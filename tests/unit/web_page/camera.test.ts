import { describe, expect, test } from "vitest";
import { boxSight, clipMatrix, fit, FROM_A_CORNER, FROM_ABOVE, orbit, pan, project, zoom, type Camera, type Vector } from "../../../clients/web/page/src/path/camera";
import { gridStep } from "../../../clients/web/page/src/path/scene";

const view = { width: 800, height: 400 };
const box = { low: [0, 10, -5], high: [200, 60, 20] } as const;
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [0, 1, 2].map((i) => ((n >> i) & 1 ? box.high[i] : box.low[i])) as unknown as Vector);

describe("the camera", () => {
  test.each([FROM_ABOVE, FROM_A_CORNER])("shows all of what it is fitted to, and not much more", (direction) => {
    const camera = fit(box, view, direction);
    const seen = corners.map((corner) => project(camera, corner));
    const most = Math.max(...seen.map(([x, y]) => Math.max(Math.abs(x) / (view.width / 2), Math.abs(y) / (view.height / 2))));
    expect(most).toBeLessThanOrEqual(1);
    expect(most).toBeGreaterThan(0.8);
  });

  test("sees X to the right and Y upwards from above", () => {
    const camera: Camera = { target: [0, 0, 0], mm_per_pixel: 0.5, ...FROM_ABOVE };
    const [x, y] = project(camera, [10, 5, 99]);
    expect([x, y].map(Math.round)).toEqual([20, 10]);
  });

  test("keeps what is under the pointer while it zooms", () => {
    const camera = fit(box, view, FROM_A_CORNER);
    const point: Vector = [30, 20, 0];
    const [x, y] = project(camera, point);
    const after = project(zoom(camera, 3, x, y), point);
    expect(after[0]).toBeCloseTo(x, 6);
    expect(after[1]).toBeCloseTo(y, 6);
  });

  test("moves with the pointer, and never tips over", () => {
    const camera = fit(box, view, FROM_ABOVE);
    const [x, y] = project(pan(camera, 12, -7), camera.target);
    expect([Math.round(x), Math.round(y)]).toEqual([12, -7]);
    expect(orbit(camera, 0, 9).pitch).toBeCloseTo(Math.PI / 2);
  });

  test("has a matrix that agrees with its projection", () => {
    const camera = fit(box, view, FROM_A_CORNER);
    const m = clipMatrix(camera, view), [px, py, pz]: Vector = [50, 33, 4];
    const [x, y] = project(camera, [px, py, pz]);
    expect((m[0]! * px + m[4]! * py + m[8]! * pz + m[12]!) * view.width / 2).toBeCloseTo(x, 2);
    expect((m[1]! * px + m[5]! * py + m[9]! * pz + m[13]!) * view.height / 2).toBeCloseTo(y, 2);
  });

  test("leaves out boxes beside the view, and none in it", () => {
    const camera = { ...fit(box, view, FROM_ABOVE), mm_per_pixel: 0.01 }; // 8 x 4 mm about the middle
    const sees = boxSight(camera, view);
    expect(sees(new Float32Array([99, 34, 0, 101, 36, 0]), 0)).toBe(true);
    expect(sees(new Float32Array([110, 34, 0, 112, 36, 0]), 0)).toBe(false);
    expect(sees(new Float32Array([0, 0, 0, 200, 60, 0]), 0)).toBe(true);
  });

  test("has round distances in its grid", () => {
    expect([0.1, 0.5, 1, 3].map((scale) => gridStep(scale, 28))).toEqual([5, 20, 50, 100]);
  });
});
