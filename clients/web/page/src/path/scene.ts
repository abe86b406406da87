// Draws what surrounds the path: the machine's travel with a grid below the path, and the head above it.
import { project, type Bounds, type Camera, type Size, type Vector } from "./camera";

export interface SceneColours {
  readonly grid: string;
  readonly frame: string;
  readonly label: string;
  readonly axes: readonly [string, string, string];
  readonly head: string;
  readonly halo: string;
  readonly done: string;
}

type Pen = CanvasRenderingContext2D;

/** A round distance between grid lines in mm, at least so many pixels. */
export function gridStep(mm_per_pixel: number, least_pixels = 28): number {
  const least = mm_per_pixel * least_pixels;
  const decade = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((n) => n * decade).find((step) => step >= least * 0.999999) ?? 10 * decade;
}

function placer(camera: Camera, view: Size): (point: Vector) => [number, number] {
  return (point) => {
    const [right, up] = project(camera, point);
    return [view.width / 2 + right, view.height / 2 - up];
  };
}

function line(pen: Pen, from: [number, number], to: [number, number]): void {
  pen.moveTo(...from);
  pen.lineTo(...to);
}

/** The floor of the travel with its grid, and the letters of the axes at its edges. */
export function drawFloor(pen: Pen, camera: Camera, view: Size, travel: Bounds, colours: SceneColours): void {
  const at = placer(camera, view);
  const { low, high } = travel, z = low[2];
  const step = gridStep(camera.mm_per_pixel);
  pen.lineWidth = 1;
  pen.strokeStyle = colours.grid;
  pen.beginPath();
  for (let x = Math.ceil(low[0] / step) * step; x <= high[0] + 1e-9; x += step) line(pen, at([x, low[1], z]), at([x, high[1], z]));
  for (let y = Math.ceil(low[1] / step) * step; y <= high[1] + 1e-9; y += step) line(pen, at([low[0], y, z]), at([high[0], y, z]));
  pen.stroke();
  drawBox(pen, at, travel, colours, Math.abs(camera.pitch) < Math.PI / 2 - 0.01);
  drawAxes(pen, at, travel, camera, colours);
}

function drawBox(pen: Pen, at: (p: Vector) => [number, number], { low, high }: Bounds, colours: SceneColours, isSolid: boolean): void {
  const corners: [number, number][] = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
  pen.strokeStyle = colours.frame;
  pen.beginPath();
  for (const z of isSolid ? [low[2], high[2]] : [low[2]]) {
    corners.forEach(([x, y], i) => line(pen, at([x, y, z]), at([...corners[(i + 1) % 4]!, z])));
  }
  if (isSolid) corners.forEach(([x, y]) => line(pen, at([x, y, low[2]]), at([x, y, high[2]])));
  pen.stroke();
}

function drawAxes(pen: Pen, at: (p: Vector) => [number, number], { low }: Bounds, camera: Camera, colours: SceneColours): void {
  const length = 46 * camera.mm_per_pixel;
  pen.font = "600 12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  (["X", "Y", "Z"] as const).forEach((letter, i) => {
    const end = low.map((c, axis) => c + (axis === i ? length : 0)) as unknown as Vector;
    const name = low.map((c, axis) => c + (axis === i ? 1.25 * length : 0)) as unknown as Vector;
    const [x0, y0] = at(low), [x1, y1] = at(end);
    if (Math.hypot(x1 - x0, y1 - y0) < 6) return; // seen from its end
    pen.strokeStyle = pen.fillStyle = colours.axes[i]!;
    pen.lineWidth = 2.5;
    pen.beginPath();
    line(pen, [x0, y0], [x1, y1]);
    pen.stroke();
    pen.fillText(letter, ...at(name));
  });
}

/** The head: a ring, and a line down to the floor. */
export function drawHead(pen: Pen, camera: Camera, view: Size, head: Vector, floor: number, isLive: boolean, colours: SceneColours): void {
  const at = placer(camera, view);
  const [x, y] = at(head), [fx, fy] = at([head[0], head[1], floor]);
  pen.setLineDash([3, 3]);
  pen.strokeStyle = colours.head;
  pen.lineWidth = 1;
  pen.beginPath();
  line(pen, [x, y], [fx, fy]);
  pen.stroke();
  pen.setLineDash(isLive ? [] : [3, 3]);
  for (const [paint, width] of [[colours.halo, 6], [colours.head, 2.5]] as const) {
    pen.strokeStyle = paint;
    pen.lineWidth = width;
    pen.beginPath();
    pen.arc(x, y, 8, 0, 2 * Math.PI);
    line(pen, [x - 13, y], [x - 4, y]);
    line(pen, [x + 4, y], [x + 13, y]);
    line(pen, [x, y - 13], [x, y - 4]);
    line(pen, [x, y + 4], [x, y + 13]);
    pen.stroke();
  }
  pen.setLineDash([]);
}

/** Draws the points up to the head that the path's painter has not yet drawn as done. */
export function drawTrail(pen: Pen, camera: Camera, view: Size, points: readonly Vector[], colours: SceneColours): void {
  const at = placer(camera, view);
  pen.strokeStyle = colours.done;
  pen.lineWidth = 1.8;
  pen.beginPath();
  points.forEach((point, i) => (i === 0 ? pen.moveTo(...at(point)) : pen.lineTo(...at(point))));
  pen.stroke();
}

/** A scale in the lower left corner. */
export function drawScale(pen: Pen, camera: Camera, view: Size, colours: SceneColours): void {
  const step = gridStep(camera.mm_per_pixel, 60);
  const pixels = step / camera.mm_per_pixel, x = 14, y = view.height - 14;
  pen.strokeStyle = pen.fillStyle = colours.label;
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(x, y - 5);
  pen.lineTo(x, y);
  pen.lineTo(x + pixels, y);
  pen.lineTo(x + pixels, y - 5);
  pen.stroke();
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "left";
  pen.textBaseline = "bottom";
  pen.fillText(`${Number(step.toPrecision(3))} mm`, x + 5, y - 4);
}
