// Draws a path with WebGL.
import { boxSight, clipMatrix } from "./camera";
import { lineProgram, type LineProgram } from "./gl_program";
import { chooseLevel, pointsUpTo, type Level, type Run } from "./levels";
import type { Colour, PathColours, PathPainter, Picture } from "./painter";
import type { Path } from "./path_points";

const POINT_BYTES = 16;
const MOST_POINTS_MOVING = 60_000;
const MOST_POINTS_AT_REST = 300_000;

function clip(run: Run, first: number, last: number): Run {
  return { first: Math.max(run.first, first), last: Math.min(run.last, last) };
}

export class GlPainter implements PathPainter {
  private readonly lines: LineProgram;
  private readonly corners: WebGLBuffer;
  private readonly buffers = new Map<Level, WebGLBuffer>();
  private path: Path | undefined;
  private levels: readonly Level[] = [];
  private drawn: { level: Level; runs: Run[]; done: number } | undefined;

  /** Nothing where the browser has no WebGL 2. */
  static on(canvas: HTMLCanvasElement): GlPainter | undefined {
    const gl = canvas.getContext("webgl2", { antialias: true, depth: false, preserveDrawingBuffer: true });
    if (gl === null) return undefined;
    try {
      return new GlPainter(gl);
    } catch {
      return undefined;
    }
  }

  private constructor(private readonly gl: WebGL2RenderingContext) {
    this.lines = lineProgram(gl);
    this.corners = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 0, 1, 1, -1, 1, 1]), gl.STATIC_DRAW);
  }

  show(path: Path, levels: readonly Level[]): void {
    this.buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
    this.buffers.clear();
    this.path = path;
    this.levels = levels;
    this.drawn = undefined;
  }

  draw(picture: Picture, colours: PathColours): void {
    const { gl } = this;
    this.prepare(picture);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (this.path === undefined || this.path.line.length < 2) return;
    const most = picture.isMoving ? MOST_POINTS_MOVING : MOST_POINTS_AT_REST;
    const { level, runs } = chooseLevel(this.levels, picture.camera.mm_per_pixel, most, boxSight(picture.camera, picture.view));
    const done = Math.max(0, pointsUpTo(level, picture.reached - 1) - 1);
    this.paint(level, runs, done, Infinity, colours.ahead, colours.rapid);
    this.paint(level, runs, 0, done, colours.done, colours.done);
    this.drawn = { level, runs, done };
  }

  advance(picture: Picture, colours: PathColours): void {
    const before = this.drawn;
    if (before === undefined) return;
    const done = Math.max(0, pointsUpTo(before.level, picture.reached - 1) - 1);
    if (done < before.done) return this.draw(picture, colours);
    if (done === before.done) return;
    this.prepare(picture);
    this.paint(before.level, before.runs, before.done, done, colours.done, colours.done);
    this.drawn = { ...before, done };
  }

  drawnTo(): number {
    return this.drawn?.level.points[this.drawn.done] ?? 0;
  }

  private prepare({ camera, view, density }: Picture): void {
    const { gl, lines } = this;
    const canvas = gl.canvas as HTMLCanvasElement;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.useProgram(lines.program);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.uniformMatrix4fv(lines.uniform("clip"), false, clipMatrix(camera, view));
    gl.uniform2f(lines.uniform("view"), canvas.width, canvas.height);
    gl.uniform1f(lines.uniform("width"), 1.5 * density);
    gl.uniform1f(lines.uniform("dash"), 9 * density);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.enableVertexAttribArray(lines.corner);
    gl.vertexAttribPointer(lines.corner, 2, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(lines.corner, 0);
  }

  /** The segments between points `first` and `last` of a level, of what is in view. */
  private paint(level: Level, runs: readonly Run[], first: number, last: number, cut: Colour, rapid: Colour): void {
    const { gl, lines } = this;
    gl.uniform4fv(lines.uniform("cutColour"), cut);
    gl.uniform4fv(lines.uniform("rapidColour"), rapid);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer(level));
    for (const attribute of [lines.from, lines.to]) {
      gl.enableVertexAttribArray(attribute);
      gl.vertexAttribDivisor(attribute, 1);
    }
    for (const run of runs.map((r) => clip(r, first, last))) {
      if (run.last <= run.first) continue;
      gl.vertexAttribPointer(lines.from, 4, gl.FLOAT, false, POINT_BYTES, run.first * POINT_BYTES);
      gl.vertexAttribPointer(lines.to, 4, gl.FLOAT, false, POINT_BYTES, (run.first + 1) * POINT_BYTES);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, run.last - run.first);
    }
  }

  /** The points of a level on the graphics processor; made when the level is first drawn. */
  private buffer(level: Level): WebGLBuffer {
    const known = this.buffers.get(level);
    if (known !== undefined) return known;
    const { at, rapid } = this.path!;
    const points = new Float32Array(4 * level.points.length);
    level.points.forEach((point, i) => {
      points[4 * i] = at[3 * point]!;
      points[4 * i + 1] = at[3 * point + 1]!;
      points[4 * i + 2] = at[3 * point + 2]!;
      points[4 * i + 3] = rapid[point]!;
    });
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, points, this.gl.STATIC_DRAW);
    this.buffers.set(level, buffer);
    return buffer;
  }
}
