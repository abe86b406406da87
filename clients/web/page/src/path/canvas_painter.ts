// Draws a path on a canvas, for browsers without WebGL.
import { basis, boxSight } from "./camera";
import { chooseLevel, pointsUpTo, type Level } from "./levels";
import type { Colour, PathColours, PathPainter, Picture } from "./painter";
import type { Path } from "./path_points";

const MOST_POINTS_MOVING = 20_000;
const MOST_POINTS_AT_REST = 100_000;

function css([red, green, blue, opacity]: Colour): string {
  return `rgba(${255 * red}, ${255 * green}, ${255 * blue}, ${opacity})`;
}

export class CanvasPainter implements PathPainter {
  private path: Path | undefined;
  private levels: readonly Level[] = [];
  private drawnDone = -1;
  private drawnPoint = 0;

  constructor(private readonly context: CanvasRenderingContext2D) {}

  show(path: Path, levels: readonly Level[]): void {
    this.path = path;
    this.levels = levels;
  }

  draw(picture: Picture, colours: PathColours): void {
    const { context, path } = this;
    const { camera, view, density } = picture;
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, view.width, view.height);
    this.drawnDone = picture.reached;
    if (path === undefined || path.line.length < 2) return;
    const most = picture.isMoving ? MOST_POINTS_MOVING : MOST_POINTS_AT_REST;
    const { level, runs } = chooseLevel(this.levels, camera.mm_per_pixel, most, boxSight(camera, view));
    const done = Math.max(0, pointsUpTo(level, picture.reached - 1) - 1);
    this.drawnPoint = level.points[done] ?? 0;
    for (const run of runs) {
      const middle = Math.min(run.last, Math.max(run.first, done));
      this.stroke(picture, level, middle, run.last, false, colours.ahead);
      this.stroke(picture, level, middle, run.last, true, colours.rapid);
      this.stroke(picture, level, run.first, middle, false, colours.done);
      this.stroke(picture, level, run.first, middle, true, colours.done);
    }
  }

  advance(picture: Picture, colours: PathColours): void {
    if (picture.reached !== this.drawnDone) this.draw(picture, colours);
  }

  drawnTo(): number {
    return this.drawnPoint;
  }

  private stroke(picture: Picture, level: Level, first: number, last: number, rapid: boolean, paint: Colour): void {
    const { context, path } = this;
    const { right, up } = basis(picture.camera);
    const { target, mm_per_pixel } = picture.camera;
    const place = (i: number): [number, number] => {
      const p = 3 * level.points[i]!;
      const x = path!.at[p]! - target[0], y = path!.at[p + 1]! - target[1], z = path!.at[p + 2]! - target[2];
      return [
        picture.view.width / 2 + (x * right[0] + y * right[1] + z * right[2]) / mm_per_pixel,
        picture.view.height / 2 - (x * up[0] + y * up[1] + z * up[2]) / mm_per_pixel,
      ];
    };
    context.beginPath();
    for (let i = first + 1; i <= last; ++i) {
      if ((path!.rapid[level.points[i]!] === 1) !== rapid) continue;
      context.moveTo(...place(i - 1));
      context.lineTo(...place(i));
    }
    context.strokeStyle = css(paint);
    context.lineWidth = rapid ? 1 : 1.5;
    context.setLineDash(rapid ? [5, 4] : []);
    context.stroke();
  }
}
