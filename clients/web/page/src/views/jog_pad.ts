// Buttons that move an axis while they are held: by pointer, finger or key.
import type { Machine } from "../api/contract";
import { h, icon, setAttribute, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { speedTexts } from "../format/units";
import { jogAxes, jogVelocity, keyDirections } from "../jog/directions";
import type { Direction } from "../jog/dead_man";
import { Jogger } from "../jog/jogger";
import { mayHandle } from "../state/pause_texts";
import { fill, t } from "../texts";
import type { Report } from "./command_button";
import type { Model, View } from "./view";

const DISTANCES = [undefined, 0.01, 0.1, 1, 10] as const;
const SHARES = [0.02, 0.05, 0.1, 0.25, 0.5, 1];
const FIRST_SHARE = 3;
const SHOWN_MS = 6000; // that the machine ended a jog
const JOG_OVER = "jog-over"; // the machine or another client ended it

export class JogPad implements View {
  readonly element: HTMLElement;
  private readonly jogger: Jogger;
  private readonly hint = h("p", { class: "soft hint", role: "status" });
  private readonly speed = h("output", { class: "value" });
  private readonly distances: HTMLButtonElement[];
  private readonly buttons: { button: HTMLButtonElement; axis: string }[] = [];
  private share = SHARES[FIRST_SHARE]!;
  private distance: number | undefined;
  private model: Model | undefined;
  private endNoted_ms = -Infinity;

  constructor(private readonly machine: Machine, stream: () => string, report: Report) {
    this.jogger = new Jogger(machine.limits.jog_renew_ms, {
      stream,
      isStep: () => this.distance !== undefined,
      jogs: (direction) => jogAxes(machine, (axis) => this.isHomed(axis), direction, this.share, this.distance),
      ended: (problem) => {
        if (problem !== undefined && problem.code !== JOG_OVER) report({ ok: false, problem });
        else if (this.distance === undefined) this.noteEnd();
      },
    });
    this.distances = DISTANCES.map((distance) => h("button", { type: "button", on: { click: () => this.choose(distance) } },
      distance === undefined ? t.jog.continuous : String(distance)));
    this.element = h("section", { class: "jog", "aria-label": t.jog.title },
      h("div", { class: "heading" }, h("h2", {}, t.jog.title),
        h("div", { class: "switch", role: "group", "aria-label": t.jog.distance }, ...this.distances)),
      this.pads(), this.speedSlider(), this.hint);
    this.choose(undefined);
    this.listenToKeys();
  }

  show(model: Model): void {
    this.model = model;
    const mayJog = model.isConnected && (mayHandle(model.state) || model.state.mode === "Jogging");
    show(this.element, model.role === "operate");
    if (!mayJog) this.jogger.releaseAll("refused");
    for (const { button, axis } of this.buttons) setAttribute(button, "disabled", !mayJog || this.velocity(axis) === undefined);
    setText(this.speed, speedTexts(this.machine.axes, ({ name }) => this.velocity(name) ?? 0));
    if (model.state.mode === "Jogging") this.endNoted_ms = -Infinity;
    this.showHint();
  }

  private noteEnd(): void {
    this.endNoted_ms = performance.now();
    setTimeout(() => this.showHint(), SHOWN_MS + 1);
    this.showHint();
  }

  private showHint(): void {
    const blocked = this.machine.axes.filter(({ name }) => this.velocity(name) === undefined).map(({ name }) => name);
    const sentence = blocked.length > 0 ? fill(t.jog.blocked, { axes: blocked.join(", ") }) : t.jog.keys;
    setText(this.hint, performance.now() - this.endNoted_ms < SHOWN_MS ? t.jog.ended : sentence);
  }

  private isHomed(axis: string): boolean {
    return this.model?.state.axes[axis]?.homed === true;
  }

  private velocity(name: string): number | undefined {
    const axis = this.machine.axes.find((a) => a.name === name);
    return axis && jogVelocity(axis, this.isHomed(name), this.share);
  }

  private choose(distance: number | undefined): void {
    this.distance = distance;
    this.distances.forEach((button, i) => setAttribute(button, "aria-pressed", String(DISTANCES[i] === distance)));
  }

  private pads(): HTMLElement {
    const [first, second, ...others] = this.machine.axes.map((axis) => axis.name);
    const plane = h("div", { class: "plane" });
    if (second !== undefined) plane.append(this.button(second, 1, ICONS.up, "north"), this.button(second, -1, ICONS.down, "south"));
    if (first !== undefined) plane.append(this.button(first, -1, ICONS.left, "west"), this.button(first, 1, ICONS.right, "east"));
    const columns = others.map((axis) => h("div", { class: "column" },
      this.button(axis, 1, ICONS.up, ""), h("span", { class: "soft" }, axis), this.button(axis, -1, ICONS.down, "")));
    return h("div", { class: "pads" }, plane, ...columns);
  }

  private button(axis: string, sign: 1 | -1, drawing: string, place: string): HTMLButtonElement {
    const holder = `${axis}${sign}`;
    const name = fill(t.jog.move, { axis, sign: sign > 0 ? t.jog.plus : t.jog.minus });
    const press = () => this.jogger.press(holder, { [axis]: sign });
    const release = () => this.jogger.release(holder);
    const button = h("button", {
      type: "button", class: `pad ${place}`, "aria-label": name, title: name,
      on: {
        pointerdown: (event) => {
          if (event.button !== 0) return;
          button.setPointerCapture(event.pointerId);
          press();
        },
        pointerup: release, pointercancel: release, lostpointercapture: release, blur: release,
        contextmenu: (event) => event.preventDefault(),
        keydown: (event) => {
          if (![" ", "Enter"].includes(event.key)) return;
          event.preventDefault();
          press();
        },
        keyup: (event) => [" ", "Enter"].includes(event.key) && release(),
      },
    }, icon(drawing), h("span", {}, `${axis}${sign > 0 ? "+" : "−"}`));
    this.buttons.push({ button, axis });
    return button;
  }

  private speedSlider(): HTMLElement {
    const slider = h("input", {
      type: "range", id: "jog-speed", min: 0, max: SHARES.length - 1, step: 1, value: FIRST_SHARE,
      on: { input: () => void (this.share = SHARES[Number(slider.value)]!) },
    });
    return h("div", { class: "slider" }, h("label", { for: "jog-speed" }, t.jog.velocity), slider, this.speed);
  }

  /** Keys jog only while the focus is on a button of the pad. */
  private listenToKeys(): void {
    const directions: Record<string, Direction> = keyDirections(this.machine);
    const pads = this.element.querySelector<HTMLElement>(".pads")!;
    pads.addEventListener("keydown", (event) => {
      const direction = directions[event.key];
      if (direction === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.jogger.press(`key ${event.key}`, direction);
    });
    addEventListener("keyup", (event) => this.jogger.release(`key ${event.key}`));
    pads.addEventListener("focusout", (event) => {
      if (!pads.contains(event.relatedTarget as Node | null)) Object.keys(directions).forEach((key) => this.jogger.release(`key ${key}`));
    });
  }
}
