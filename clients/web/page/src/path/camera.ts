// The camera: a parallel projection, so that a millimetre has the same length everywhere.

export type Vector = readonly [number, number, number];

export interface Camera {
  /** The point in the middle of the view, mm. */
  readonly target: Vector;
  readonly mm_per_pixel: number;
  /** Rotation about Z, radians. At 0 the X axis points to the right. */
  readonly yaw: number;
  /** Elevation of the eye, radians. At PI / 2 it looks from above. */
  readonly pitch: number;
}

export interface Bounds {
  readonly low: Vector;
  readonly high: Vector;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

const LEAST_MM_PER_PIXEL = 1e-4;
const MOST_MM_PER_PIXEL = 100;
const MARGIN = 0.88; // of the view that a fitted path takes

export const FROM_ABOVE = { yaw: 0, pitch: Math.PI / 2 };
export const FROM_A_CORNER = { yaw: -0.62, pitch: 0.62 };

/** The directions of the screen's right and up, and towards the eye. */
export function basis(camera: Pick<Camera, "yaw" | "pitch">): { right: Vector; up: Vector; eye: Vector } {
  const sy = Math.sin(camera.yaw), cy = Math.cos(camera.yaw);
  const sp = Math.sin(camera.pitch), cp = Math.cos(camera.pitch);
  return { right: [cy, sy, 0], up: [-sy * sp, cy * sp, cp], eye: [sy * cp, -cy * cp, sp] };
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Pixels from the middle of the view: right, up. */
export function project(camera: Camera, point: Vector): [number, number] {
  const { right, up } = basis(camera);
  const from: Vector = [point[0] - camera.target[0], point[1] - camera.target[1], point[2] - camera.target[2]];
  return [dot(from, right) / camera.mm_per_pixel, dot(from, up) / camera.mm_per_pixel];
}

/** A camera in the same direction that shows all of the bounds. */
export function fit(bounds: Bounds, view: Size, direction: Pick<Camera, "yaw" | "pitch">): Camera {
  const middle = bounds.low.map((low, i) => (low + bounds.high[i]!) / 2) as unknown as Vector;
  const half = bounds.low.map((low, i) => (bounds.high[i]! - low) / 2) as unknown as Vector;
  const { right, up } = basis(direction);
  const reach = (along: Vector) => along.reduce((sum, part, i) => sum + Math.abs(part) * half[i]!, 0);
  const needed = Math.max((2 * reach(right)) / view.width, (2 * reach(up)) / view.height) / MARGIN;
  return { target: middle, mm_per_pixel: clampScale(needed || 0.1), yaw: direction.yaw, pitch: direction.pitch };
}

function clampScale(mm_per_pixel: number): number {
  return Math.min(MOST_MM_PER_PIXEL, Math.max(LEAST_MM_PER_PIXEL, mm_per_pixel));
}

/** Moves the view with the pointer by pixels to the right and up. */
export function pan(camera: Camera, right_px: number, up_px: number): Camera {
  const { right, up } = basis(camera);
  const scale = camera.mm_per_pixel;
  const target = camera.target.map((c, i) => c - (right_px * right[i]! + up_px * up[i]!) * scale) as unknown as Vector;
  return { ...camera, target };
}

/** Zooms in (factor > 1) or out. The point under the pointer (pixels from the middle) stays there. */
export function zoom(camera: Camera, factor: number, right_px: number, up_px: number): Camera {
  const mm_per_pixel = clampScale(camera.mm_per_pixel / factor);
  const moved = pan(camera, -right_px, -up_px);
  return pan({ ...moved, mm_per_pixel }, right_px, up_px);
}

export function orbit(camera: Camera, yaw: number, pitch: number): Camera {
  return { ...camera, yaw: camera.yaw + yaw, pitch: Math.min(Math.PI / 2, Math.max(-Math.PI / 2, camera.pitch + pitch)) };
}

/** Tests whether a part of a box (least x, y, z, greatest x, y, z from `at` on) may be in the view. */
export function boxSight(camera: Camera, view: Size): (bounds: Float32Array, at: number) => boolean {
  const { right, up } = basis(camera);
  const across = (view.width / 2) * camera.mm_per_pixel, above = (view.height / 2) * camera.mm_per_pixel;
  return (bounds, at) => {
    let x = 0, y = 0, reach_x = 0, reach_y = 0;
    for (let i = 0; i < 3; ++i) {
      const low = bounds[at + i]!, high = bounds[at + 3 + i]!;
      const from = (low + high) / 2 - camera.target[i]!, half = (high - low) / 2;
      x += from * right[i]!;
      y += from * up[i]!;
      reach_x += half * Math.abs(right[i]!);
      reach_y += half * Math.abs(up[i]!);
    }
    return Math.abs(x) - reach_x <= across && Math.abs(y) - reach_y <= above;
  };
}

/** A column-major matrix of WebGL from millimetres to the view's -1 ... 1. */
export function clipMatrix(camera: Camera, view: Size): Float32Array {
  const { right, up } = basis(camera);
  const sx = 2 / (view.width * camera.mm_per_pixel), sy = 2 / (view.height * camera.mm_per_pixel);
  return new Float32Array([
    right[0] * sx, up[0] * sy, 0, 0,
    right[1] * sx, up[1] * sy, 0, 0,
    right[2] * sx, up[2] * sy, 0, 0,
    -dot(camera.target, right) * sx, -dot(camera.target, up) * sy, 0, 1,
  ]);
}
