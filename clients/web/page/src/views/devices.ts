// Spindle, coolant, tool and outputs, in a row that is hidden while all is off.
import { h, setAttribute, show } from "../dom/element";
import { deviceTexts } from "../state/device_texts";
import { ageNow, freshness } from "../state/freshness";
import { t } from "../texts";
import type { Model, View } from "./view";

export class DevicesRow implements View {
  readonly element = h("section", { class: "devices", "aria-label": t.devices.title, hidden: true });
  private shown = "";

  show({ state, contact_ms, now_ms }: Model): void {
    const texts = deviceTexts(state.devices, t);
    show(this.element, texts.length > 0);
    const old = ageNow(state.link.age_ms ?? undefined, contact_ms, now_ms);
    setAttribute(this.element, "data-fresh", freshness(old) === "live" ? "live" : "stale");
    if (texts.join("\n") === this.shown) return;
    this.shown = texts.join("\n");
    const chips = texts.map((text) => h("span", { class: "chip", "data-look": "busy" }, text));
    const areSwitched = deviceTexts(state.devices && { ...state.devices, tool: null }, t).length > 0;
    this.element.replaceChildren(h("span", { class: "soft" }, t.devices.title), ...chips,
      h("span", { class: "soft" }, areSwitched ? t.devices.notConnected : ""));
  }
}
