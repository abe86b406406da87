// Hold, resume, stop, reset and the emergency stop. They stay in reach when the page is scrolled.
import { ICONS } from "../dom/icons";
import { h, icon, setAttribute, show } from "../dom/element";
import { t } from "../texts";
import { button, type Give } from "./command_button";
import type { Model, View } from "./view";

const ONE_PRESS_MS = 600; // a press sends several events

export class SafetyBar implements View {
  readonly element: HTMLElement;
  private readonly hold: HTMLButtonElement;
  private readonly resume: HTMLButtonElement;
  private readonly stop: HTMLButtonElement;
  private readonly reset: HTMLButtonElement;

  constructor(give: Give, resume: () => void) {
    this.hold = button(t.commands.hold, ICONS.pause, "action", () => void give("hold"));
    this.resume = button(t.commands.resume, ICONS.play, "action good", resume);
    this.stop = button(t.commands.stop, ICONS.stop, "action", () => void give("stop"));
    this.reset = button(t.commands.reset, ICONS.reset, "action", () => void give("reset"));
    this.element = h("div", { class: "safety", role: "group", "aria-label": t.commands.stops },
      this.hold, this.resume, this.stop, this.reset, this.emergency(give));
  }

  show({ state, role }: Model): void {
    const mayOperate = role === "operate";
    const isHeld = state.hold?.state === "held";
    show(this.resume, isHeld);
    show(this.hold, !isHeld);
    show(this.reset, state.mode === "Fault");
    show(this.stop, state.mode !== "Fault");
    setAttribute(this.hold, "disabled", !mayOperate || state.mode !== "Running");
    setAttribute(this.resume, "disabled", !mayOperate);
    setAttribute(this.reset, "disabled", !mayOperate);
    setAttribute(this.stop, "disabled", !mayOperate);
    show(this.element, mayOperate);
  }

  /** Acts when it is pressed, not when it is released. Never disabled, because the shown state may be out of date. */
  private emergency(give: Give): HTMLElement {
    let pressed_ms = -Infinity;
    const press = () => {
      const now = performance.now();
      if (now - pressed_ms > ONE_PRESS_MS) void give("estop");
      pressed_ms = now;
    };
    return h("button", {
      type: "button", class: "emergency", title: t.commands.estopHint,
      on: {
        pointerdown: (event) => event.button === 0 && press(),
        keydown: (event) => ["Enter", " "].includes(event.key) && press(),
        click: press,
      },
    }, icon(ICONS.emergency), h("span", {}, t.commands.estop));
  }
}
