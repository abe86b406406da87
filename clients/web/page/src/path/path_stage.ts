// Three layers, each drawn only when it changes: the travel's floor, the path, the head.
import type { Bounds, Camera, Size, Vector } from "./camera";
import { CanvasPainter } from "./canvas_painter";
import { DrawBudget } from "./draw_budget";
import { FrameTimes } from "./frame_times";
import { GlPainter } from "./gl_painter";
import { makeLevels } from "./levels";
import { colour, type PathColours, type PathPainter, type Picture } from "./painter";
import { pathBounds, readPath, type Path } from "./path_points";
import { PathProgress } from "./progress";
import { drawFloor, drawHead, drawScale, drawTrail, type SceneColours } from "./scene";
import { paletteColour } from "../dom/theme";

const FRAME_MS = 100; // moves that are closer in time belong to one movement
const AT_REST_MS = 160; // after the camera's last move the path is drawn in full
const LONGEST_TRAIL = 2000; // points
const FIRST_POINTS_GL = 60_000;
const FIRST_POINTS_CANVAS = 6000;

export interface RunPlace {
  readonly job: number;
  readonly line: number;
  readonly isDone: boolean;
}

/** Lets the browser handle input and draw between pieces of work. */
function nextTask(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

function layer(surface: HTMLElement): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-hidden", "true");
  surface.append(canvas);
  return canvas;
}

export class PathStage {
  camera: Camera = { target: [0, 0, 0], mm_per_pixel: 1, yaw: 0, pitch: Math.PI / 2 };
  view: Size = { width: 1, height: 1 };
  private readonly canvases: HTMLCanvasElement[];
  private readonly floor: CanvasRenderingContext2D;
  private readonly above: CanvasRenderingContext2D;
  private readonly painter: PathPainter;
  private readonly budget: DrawBudget;
  private movedAt_ms: number | undefined;
  private readonly times: FrameTimes;
  private path: Path | undefined;
  private coming: Path | undefined;
  private progress: PathProgress | undefined;
  private reached = 0;
  private job: number | undefined;
  private head: { at: Vector; isLive: boolean } | undefined;
  private colours!: { path: PathColours; scene: SceneColours };
  private moved_ms = -Infinity;
  private wanted = { all: false, head: false };
  private scheduled = false;

  constructor(private readonly surface: HTMLElement, private readonly travel: Bounds) {
    const [floor, lines, above] = [layer(surface), layer(surface), layer(surface)] as const;
    this.canvases = [floor, lines, above];
    this.floor = floor.getContext("2d")!;
    this.above = above.getContext("2d")!;
    const gl = GlPainter.on(lines, location.search === "?draw=webgl");
    this.painter = gl ?? new CanvasPainter(lines.getContext("2d")!);
    this.budget = new DrawBudget(gl === undefined ? FIRST_POINTS_CANVAS : FIRST_POINTS_GL);
    this.times = new FrameTimes(surface);
    this.takeColours();
  }

  /** The bounds of a fitted view: of the path, or of the travel if there is none. */
  get bounds(): Bounds {
    return (this.path && pathBounds(this.path.at)) ?? this.travel;
  }

  /** Shows a path once its levels are made; @returns its segments, or undefined if a newer path came meanwhile. */
  async show(bytes: ArrayBuffer): Promise<number | undefined> {
    const path = readPath(bytes);
    this.coming = path;
    const levels = await makeLevels(path.at, path.rapid, nextTask);
    if (this.coming !== path) return undefined;
    this.path = path;
    this.progress = new PathProgress(path);
    this.reached = 0;
    this.painter.show(path, levels);
    this.redraw();
    return Math.max(0, path.line.length - 1);
  }

  move(camera: Camera): void {
    this.camera = camera;
    this.moved_ms = performance.now();
    this.redraw();
    setTimeout(() => this.redraw(), AT_REST_MS + 10);
  }

  /** @param camera returns the camera for the new size, or undefined to keep the old one */
  resize(camera: () => Camera | undefined): void {
    const box = this.surface.getBoundingClientRect();
    this.view = { width: Math.max(1, box.width), height: Math.max(1, box.height) };
    for (const canvas of this.canvases) {
      canvas.width = Math.round(this.view.width * devicePixelRatio);
      canvas.height = Math.round(this.view.height * devicePixelRatio);
    }
    this.camera = camera() ?? this.camera;
    this.redraw();
  }

  setHead(at: Vector, isLive: boolean, run: RunPlace | undefined): void {
    const before = this.head;
    this.head = { at, isLive };
    const changed = before?.isLive !== isLive || at.some((c, i) => c !== before.at[i]);
    if (run !== undefined && this.progress !== undefined && this.path !== undefined) this.advance(at, run);
    if (changed) this.schedule("head");
  }

  takeColours(): void {
    const hex = paletteColour;
    this.colours = {
      path: { ahead: colour(hex("ahead")), rapid: colour(hex("rapid"), 0.9), done: colour(hex("done")) },
      scene: {
        grid: hex("grid"), frame: hex("frame"), label: hex("soft"), head: hex("head"), halo: hex("card"), done: hex("done"),
        axes: [hex("axis-0"), hex("axis-1"), hex("axis-2")],
      },
    };
    this.redraw();
  }

  private advance(at: Vector, run: RunPlace): void {
    const before = this.reached;
    if (run.job !== this.job) this.progress!.restart();
    this.job = run.job;
    this.reached = run.isDone ? this.path!.line.length : this.progress!.advance(run.line, at);
    if (this.reached !== before) this.schedule("head");
  }

  private redraw(): void {
    this.schedule("all");
  }

  private schedule(what: "all" | "head"): void {
    this.wanted[what] = true;
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame((now_ms) => {
      this.scheduled = false;
      this.noteFrame(now_ms);
      const started = performance.now();
      this.draw();
      this.times.add(performance.now() - started);
    });
  }

  /** Adapts the number of points to the time between pictures while the view moves. */
  private noteFrame(now_ms: number): void {
    const isMoving = now_ms - this.moved_ms < FRAME_MS;
    if (isMoving && this.movedAt_ms !== undefined) this.budget.note(now_ms - this.movedAt_ms);
    this.movedAt_ms = isMoving ? now_ms : undefined;
  }

  private draw(): void {
    const isMoving = performance.now() - this.moved_ms < AT_REST_MS;
    const picture: Picture = { camera: this.camera, view: this.view, density: devicePixelRatio, reached: this.reached, most_points: this.budget.most(isMoving) };
    if (this.wanted.all) {
      this.clear(this.floor);
      drawFloor(this.floor, this.camera, this.view, this.travel, this.colours.scene);
      this.painter.draw(picture, this.colours.path);
    } else this.painter.advance(picture, this.colours.path);
    this.wanted = { all: false, head: false };
    this.clear(this.above);
    drawScale(this.above, this.camera, this.view, this.colours.scene);
    if (this.head === undefined) return;
    drawTrail(this.above, this.camera, this.view, this.trail(), this.colours.scene);
    drawHead(this.above, this.camera, this.view, this.head.at, this.travel.low[2], this.head.isLive, this.colours.scene);
  }

  /** The points from the last one that the painter has drawn as done, to the head. */
  private trail(): Vector[] {
    if (this.path === undefined || this.reached < 1 || this.reached >= this.path.line.length) return [];
    const { at } = this.path;
    const points: Vector[] = [];
    for (let i = Math.max(this.painter.drawnTo(), this.reached - LONGEST_TRAIL); i < this.reached; ++i) points.push([at[3 * i]!, at[3 * i + 1]!, at[3 * i + 2]!]);
    return [...points, this.head!.at];
  }

  private clear(pen: CanvasRenderingContext2D): void {
    pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    pen.clearRect(0, 0, this.view.width, this.view.height);
  }
}
