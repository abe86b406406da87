// Feed and rapid overrides. The slider shows the machine's value, except while the user moves it.
import type { Machine } from "../api/contract";
import { h, icon, setAttribute, setText } from "../dom/element";
import { ICONS } from "../dom/icons";
import { t } from "../texts";
import type { Give } from "./command_button";
import type { Model, View } from "./view";

const STEP_PERCENT = 5;
const SETTLES_MS = 1500; // until the state has the value that was set

class Override {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly value = h("output", { class: "value" });
  private changed_ms = -Infinity;

  constructor(id: string, text: string, { limits }: Machine, private readonly set: (percent: number) => void) {
    this.slider = h("input", {
      type: "range", id, min: limits.override_min_percent, max: limits.override_max_percent, step: STEP_PERCENT, value: 100,
      on: { input: () => this.moved(), change: () => this.commit(Number(this.slider.value)) },
    });
    const normal = h("button", {
      type: "button", class: "plain tool", title: t.overrides.normal, "aria-label": `${text}: ${t.overrides.normal}`, on: { click: () => this.commit(100) },
    }, icon(ICONS.reset));
    this.element = h("div", { class: "slider" }, h("label", { for: id }, text), this.slider, this.value, normal);
  }

  show(percent: number, mayOperate: boolean, now_ms: number): void {
    setAttribute(this.slider, "disabled", !mayOperate);
    if (now_ms - this.changed_ms < SETTLES_MS) return;
    this.slider.value = String(percent);
    setText(this.value, `${percent} ${t.overrides.unit}`);
  }

  private moved(): void {
    this.changed_ms = performance.now();
    setText(this.value, `${this.slider.value} ${t.overrides.unit}`);
  }

  private commit(percent: number): void {
    this.slider.value = String(percent);
    this.moved();
    this.set(percent);
  }
}

export class Overrides implements View {
  readonly element: HTMLElement;
  private readonly feed: Override;
  private readonly rapid: Override;

  constructor(machine: Machine, give: Give) {
    this.feed = new Override("feed", t.overrides.feed, machine, (percent) => void give("override", { feed_percent: percent }));
    this.rapid = new Override("rapid", t.overrides.rapid, machine, (percent) => void give("override", { rapid_percent: percent }));
    this.element = h("section", { class: "overrides", "aria-label": t.overrides.title }, this.feed.element, this.rapid.element);
  }

  show({ state, role, now_ms }: Model): void {
    this.feed.show(state.override.feed_percent, role === "operate", now_ms);
    this.rapid.show(state.override.rapid_percent, role === "operate", now_ms);
  }
}
