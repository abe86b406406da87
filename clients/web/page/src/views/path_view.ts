// The program's path, seen from above or in space, its done part, and the head.
import { programPath } from "../api/client";
import type { Machine } from "../api/contract";
import { h, icon, setAttribute, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { fit, FROM_A_CORNER, FROM_ABOVE, type Bounds, type Camera, type Vector } from "../path/camera";
import { attachGestures, type Viewer } from "../path/gestures";
import { PathStage } from "../path/path_stage";
import { fill, t } from "../texts";
import { onTheme } from "../dom/theme";
import type { Model, View } from "./view";

/** The machine's travel in X, Y and Z. */
export function travelOf(machine: Machine): Bounds {
  const range = (letter: string): [number, number] => {
    const axis = machine.axes.find((a) => a.name === letter);
    return axis === undefined ? [0, 0] : [axis.position_min, axis.position_max];
  };
  const [x, y, z] = [range("X"), range("Y"), range("Z")];
  return { low: [x[0], y[0], z[0]], high: [x[1], y[1], z[1]] };
}

export class PathView implements View, Viewer {
  readonly element: HTMLElement;
  is3D = true;
  private readonly stage: PathStage;
  private readonly figures = h("p", { class: "soft figures-line" });
  private readonly twoD: HTMLButtonElement;
  private readonly threeD: HTMLButtonElement;
  private readonly followButton: HTMLButtonElement;
  private follows = false;
  private isFitted = true;
  private shownProgram: number | undefined;

  constructor(private readonly machine: Machine) {
    const surface = h("div", { class: "surface", tabindex: 0, role: "img", "aria-label": t.path.label });
    this.stage = new PathStage(surface, travelOf(machine));
    const choose = (text: string, is3D: boolean) => h("button", { type: "button", on: { click: () => this.look(is3D) } }, text);
    this.twoD = choose(t.path.twoD, false);
    this.threeD = choose(t.path.threeD, true);
    const tool = (text: string, drawing: string, press: () => void) =>
      h("button", { type: "button", class: "plain tool", title: text, "aria-label": text, on: { click: press } }, icon(drawing));
    this.followButton = tool(t.path.follow, ICONS.follow, () => void (this.follows = !this.follows));
    const key = (name: string, text: string) => h("span", { class: `key ${name}` }, text);
    this.element = h("section", { class: "path", "aria-label": t.path.title },
      h("div", { class: "heading" }, h("h2", {}, t.path.title), this.figures,
        h("div", { class: "legend" }, key("done", t.path.done), key("ahead", t.path.ahead), key("rapid", t.path.rapid)),
        h("div", { class: "switch", role: "group", "aria-label": t.path.title }, this.twoD, this.threeD),
        h("div", { class: "tools" }, this.followButton, tool(t.path.fit, ICONS.fit, () => this.fit()))),
      surface);
    attachGestures(surface, this);
    onTheme(() => this.stage.takeColours());
    new ResizeObserver(() => this.stage.resize(() => (this.isFitted ? this.fitted() : undefined))).observe(surface);
    this.look(true);
  }

  get camera(): Camera {
    return this.stage.camera;
  }

  set camera(camera: Camera) {
    this.isFitted = false;
    this.stage.move(camera);
  }

  fit(): void {
    this.isFitted = true;
    this.stage.move(this.fitted());
  }

  show({ state, now_ms, contact_ms }: Model): void {
    const program = state.program ?? undefined;
    if (program?.id !== this.shownProgram) {
      this.shownProgram = program?.id;
      void this.load(program?.id);
    }
    const place = (letter: string, missing: number) => state.axes[letter]?.position ?? missing;
    const { low } = travelOf(this.machine);
    const head: Vector = [place("X", low[0]), place("Y", low[1]), place("Z", low[2])];
    const isLive = state.mode !== "Unreachable" && now_ms - contact_ms < 1500;
    const job = state.job ?? undefined;
    const isOurs = job?.kind === "run" && program !== undefined && job.name === program.name;
    this.stage.setHead(head, isLive, isOurs ? { job: job.number, line: job.line ?? 0, isDone: job.outcome === "Done" } : undefined);
    if (this.follows && job !== undefined && !job.outcome) this.stage.move({ ...this.stage.camera, target: head });
    setAttribute(this.followButton, "aria-pressed", String(this.follows));
  }

  private look(is3D: boolean): void {
    this.is3D = is3D;
    setAttribute(this.twoD, "aria-pressed", String(!is3D));
    setAttribute(this.threeD, "aria-pressed", String(is3D));
    this.fit();
  }

  private fitted(): Camera {
    return fit(this.stage.bounds, this.stage.view, this.is3D ? FROM_A_CORNER : FROM_ABOVE);
  }

  private async load(id: number | undefined): Promise<void> {
    const answer = id === undefined ? undefined : await programPath(this.machine.limits.path_points);
    if (this.shownProgram !== id) return; // another one was loaded meanwhile
    const segments = await this.stage.show(answer?.ok ? answer.value : new ArrayBuffer(0));
    if (segments === undefined) return;
    setText(this.figures, segments > 0 ? fill(t.path.segments, { count: segments.toLocaleString() }) : t.path.empty);
    show(this.figures, true);
    this.fit();
  }
}
