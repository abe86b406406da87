// The shaders that draw a polyline as rectangles of constant width in pixels, one instance for each segment.

const VERTEX = `#version 300 es
in vec4 from;   // x, y, z in mm; w: 1 where a rapid move leads to the point
in vec4 to;
in vec2 corner; // x: 0 at the begin, 1 at the end; y: -1 or 1 across
uniform mat4 clip;
uniform vec2 view;      // device pixels
uniform float width;    // device pixels
uniform vec4 cutColour;
uniform vec4 rapidColour;
out vec4 paint;
out float along;        // device pixels from the segment's begin
out float isRapid;
void main() {
  vec2 a = (clip * vec4(from.xyz, 1.0)).xy * view * 0.5;
  vec2 b = (clip * vec4(to.xyz, 1.0)).xy * view * 0.5;
  vec2 d = b - a;
  float length_px = length(d);
  vec2 direction = length_px > 0.0 ? d / length_px : vec2(1.0, 0.0);
  float half_px = 0.5 * width * (to.w > 0.5 ? 0.75 : 1.0);
  vec2 across = vec2(-direction.y, direction.x) * half_px * corner.y;
  vec2 longer = direction * half_px * (2.0 * corner.x - 1.0); // corners of the path are closed
  vec2 at = mix(a, b, corner.x) + across + longer;
  paint = to.w > 0.5 ? rapidColour : cutColour;
  along = corner.x * length_px;
  isRapid = to.w;
  gl_Position = vec4(at / (view * 0.5), 0.0, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision mediump float;
in vec4 paint;
in float along;
in float isRapid;
uniform float dash; // device pixels of a dash and its gap
out vec4 pixel;
void main() {
  if (isRapid > 0.5 && fract(along / dash) > 0.55) discard;
  pixel = vec4(paint.rgb * paint.a, paint.a);
}`;

function compile(gl: WebGL2RenderingContext, kind: number, source: string): WebGLShader {
  const shader = gl.createShader(kind);
  if (shader === null) throw new Error("WebGL: no shader");
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`WebGL: ${gl.getShaderInfoLog(shader) ?? ""}`);
  return shader;
}

export interface LineProgram {
  readonly program: WebGLProgram;
  readonly from: number;
  readonly to: number;
  readonly corner: number;
  uniform(name: "clip" | "view" | "width" | "cutColour" | "rapidColour" | "dash"): WebGLUniformLocation | null;
}

/** @throws Error if the driver cannot compile it */
export function lineProgram(gl: WebGL2RenderingContext): LineProgram {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, VERTEX));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, FRAGMENT));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`WebGL: ${gl.getProgramInfoLog(program) ?? ""}`);
  return {
    program,
    from: gl.getAttribLocation(program, "from"),
    to: gl.getAttribLocation(program, "to"),
    corner: gl.getAttribLocation(program, "corner"),
    uniform: (name) => gl.getUniformLocation(program, name),
  };
}
