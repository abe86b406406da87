// The interface of path painters: with WebGL if the browser has it, else with a canvas.
import type { Camera, Size } from "./camera";
import type { Path } from "./path_points";
import type { Level } from "./levels";

export interface Picture {
  readonly camera: Camera;
  /** CSS pixels. */
  readonly view: Size;
  /** Device pixels in a CSS pixel. */
  readonly density: number;
  /** The point of the path that the head is on its way to; the points before it are done. */
  readonly reached: number;
  readonly most_points: number;
}

/** Red, green, blue, opacity: 0 ... 1. */
export type Colour = readonly [number, number, number, number];

export interface PathColours {
  readonly ahead: Colour;
  readonly rapid: Colour;
  readonly done: Colour;
}

export interface PathPainter {
  show(path: Path, levels: readonly Level[]): void;
  draw(picture: Picture, colours: PathColours): void;
  /** Draws what was done since the last picture, on top of it. */
  advance(picture: Picture, colours: PathColours): void;
  /** The last point of the path that is drawn as done. */
  drawnTo(): number;
}

/** "#rrggbb" with an opacity. */
export function colour(hex: string, opacity = 1): Colour {
  const value = Number.parseInt(hex.trim().slice(1), 16);
  return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255, opacity];
}
