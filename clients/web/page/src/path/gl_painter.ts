// Draws a path with WebGL.
import { clipMatrix } from "./camera";
import { lineProgram, type LineProgram } from "./gl_program";
import { LevelledPainter } from "./levelled_painter";
import type { Level } from "./levels";
import type { Colour, Picture } from "./painter";
import type { Path } from "./path_points";

const POINT_BYTES = 16;
const BY_SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Uses a separate canvas: one that has a context of WebGL can have no other. */
function hasGraphicsProcessor(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (gl === null) return false;
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = names === null ? "" : String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !BY_SOFTWARE.test(renderer);
}

export class GlPainter extends LevelledPainter {
  private readonly lines: LineProgram;
  private readonly corners: WebGLBuffer;
  private readonly buffers = new Map<Level, WebGLBuffer>();

  /**
   * Returns undefined if the browser has no WebGL 2, or only by software: then CanvasPainter is faster.
   * @param byForce accepts software, too
   */
  static on(canvas: HTMLCanvasElement, byForce: boolean): GlPainter | undefined {
    if (!byForce && !hasGraphicsProcessor()) return undefined;
    const gl = canvas.getContext("webgl2", {
      antialias: true, depth: false, preserveDrawingBuffer: true,
    });
    if (gl === null) return undefined;
    try {
      return new GlPainter(gl);
    } catch {
      return undefined;
    }
  }

  private constructor(private readonly gl: WebGL2RenderingContext) {
    super();
    this.lines = lineProgram(gl);
    this.corners = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 0, 1, 1, -1, 1, 1]), gl.STATIC_DRAW);
  }

  override show(path: Path, levels: readonly Level[]): void {
    this.buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
    this.buffers.clear();
    super.show(path, levels);
  }

  protected override prepare({ camera, view, density }: Picture): void {
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

  protected override clear(): void {
    this.gl.clearColor(0, 0, 0, 0);
    this.gl.clear(this.gl.COLOR_BUFFER_BIT);
  }

  protected override paint(level: Level, first: number, last: number, cut: Colour, rapid: Colour): void {
    const { gl, lines } = this;
    gl.uniform4fv(lines.uniform("cutColour"), cut);
    gl.uniform4fv(lines.uniform("rapidColour"), rapid);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer(level));
    for (const [attribute, point] of [[lines.from, first], [lines.to, first + 1]] as const) {
      gl.enableVertexAttribArray(attribute);
      gl.vertexAttribDivisor(attribute, 1);
      gl.vertexAttribPointer(attribute, 4, gl.FLOAT, false, POINT_BYTES, point * POINT_BYTES);
    }
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, last - first);
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
