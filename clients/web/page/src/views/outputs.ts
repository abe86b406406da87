// The outputs of the machine: pins that the words of programs switch. Hidden if it has none.
import type { Machine } from "../api/contract";
import { h, setAttribute } from "../dom/element";
import { ageNow, freshness } from "../state/freshness";
import { outputTexts } from "../state/output_texts";
import { t } from "../texts";
import type { Model, View } from "./view";

export class Outputs implements View {
  readonly element: HTMLElement;
  private readonly chips = h("div", { class: "chips" });
  private shown = "";

  constructor(private readonly machine: Machine) {
    this.element = h("section", { class: "motors outputs", "aria-label": t.outputs.title, hidden: machine.outputs.length === 0 },
      h("div", { class: "heading" }, h("h2", {}, t.outputs.title)), this.chips);
  }

  show({ state, contact_ms, now_ms }: Model): void {
    const old = ageNow(state.link.age_ms ?? undefined, contact_ms, now_ms);
    setAttribute(this.element, "data-fresh", freshness(old) === "live" ? "live" : "stale");
    const texts = outputTexts(this.machine.outputs, state.outputs, t);
    const now = JSON.stringify(texts);
    if (now === this.shown) return;
    this.shown = now;
    this.chips.replaceChildren(...texts.map(({ text, look }) => h("span", { class: "chip", "data-look": look }, text)));
  }
}
