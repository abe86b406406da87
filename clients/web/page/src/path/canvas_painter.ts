// Draws a path on a canvas, for browsers without WebGL on a graphics processor.
import { basis, type Camera, type Size, type Vector } from "./camera";
import { LevelledPainter } from "./levelled_painter";
import type { Level } from "./levels";
import type { Colour, Picture } from "./painter";

const STROKE_POINTS = 400; // long polylines are slower to fill than many short ones
const MOST_DASHED = 1500; // segments; dashes are slow

function css([red, green, blue, opacity]: Colour): string {
  return `rgba(${255 * red}, ${255 * green}, ${255 * blue}, ${opacity})`;
}

export class CanvasPainter extends LevelledPainter {
  private camera!: Camera;
  private view!: Size;
  private right!: Vector;
  private up!: Vector;
  private x = 0;
  private y = 0;

  constructor(private readonly pen: CanvasRenderingContext2D) {
    super();
  }

  protected override prepare({ camera, view, density }: Picture): void {
    this.pen.setTransform(density, 0, 0, density, 0, 0);
    this.pen.lineJoin = "bevel";
    ({ right: this.right, up: this.up } = basis(camera));
    this.camera = camera;
    this.view = view;
  }

  protected override clear({ view }: Picture): void {
    this.pen.clearRect(0, 0, view.width, view.height);
  }

  protected override paint(level: Level, first: number, last: number, cut: Colour, rapid: Colour): void {
    const rapids = this.path!.rapid;
    for (let from = first; from < last; ) {
      const kind = rapids[level.points[from + 1]!];
      let to = from + 1;
      while (to < last && to - from < STROKE_POINTS && rapids[level.points[to + 1]!] === kind) ++to;
      this.stroke(level, from, to, kind === 1, kind === 1 ? rapid : cut, last - first < MOST_DASHED);
      from = to;
    }
  }

  private stroke(level: Level, first: number, last: number, isRapid: boolean, paint: Colour, mayDash: boolean): void {
    const { pen } = this;
    pen.beginPath();
    this.place(level, first);
    pen.moveTo(this.x, this.y);
    for (let i = first + 1; i <= last; ++i) {
      this.place(level, i);
      pen.lineTo(this.x, this.y);
    }
    pen.strokeStyle = css(paint);
    pen.lineWidth = isRapid ? 1 : 1.4;
    pen.setLineDash(isRapid && (mayDash || last - first < 4) ? [5, 4] : []);
    pen.stroke();
  }

  private place(level: Level, i: number): void {
    const { right, up, view, camera: { target, mm_per_pixel } } = this;
    const { at } = this.path!;
    const p = 3 * level.points[i]!;
    const x = at[p]! - target[0], y = at[p + 1]! - target[1], z = at[p + 2]! - target[2];
    this.x = view.width / 2 + (x * right[0] + y * right[1] + z * right[2]) / mm_per_pixel;
    this.y = view.height / 2 - (x * up[0] + y * up[1] + z * up[2]) / mm_per_pixel;
  }
}
