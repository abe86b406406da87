// All axes, in machine or work coordinates.
import type { Machine } from "../../api/contract";
import { h, icon, setAttribute, setText, show } from "../../dom/element";
import { ICONS } from "../../dom/icons";
import { fill, t } from "../../texts";
import { AxisCard } from "./axis_card";
import { workPlace } from "./axis_places";
import type { Give } from "../command_button";
import type { Model, View } from "../view";

/** Whether the axis has no motor of its own: its motors are shown apart. */
function movesApart(axis: string, { motors }: Machine): boolean {
  return motors.some(({ axes }) => axes.includes(axis));
}

export class Axes implements View {
  readonly element: HTMLElement;
  private readonly cards: Map<string, AxisCard>;
  private readonly machineButton: HTMLButtonElement;
  private readonly workButton: HTMLButtonElement;
  private readonly homeButton: HTMLButtonElement;
  private isWork = false;

  constructor(machine: Machine, give: Give) {
    this.cards = new Map(machine.axes.map((axis, i) => [axis.name, new AxisCard(axis, i, !movesApart(axis.name, machine), () => void give("home", { axes: [axis.name] }))]));
    const choose = (isWork: boolean) => h("button", { type: "button", on: { click: () => void (this.isWork = isWork) } });
    this.machineButton = choose(false);
    this.workButton = choose(true);
    this.machineButton.textContent = t.axes.machine;
    this.homeButton = h("button", { type: "button", class: "action small", on: { click: () => void give("home") } }, icon(ICONS.home), t.commands.home);
    this.element = h("section", { class: "axes", "aria-label": t.axes.title },
      h("div", { class: "heading" }, h("h2", {}, t.axes.title),
        h("div", { class: "switch", role: "group", "aria-label": t.axes.coordinates }, this.machineButton, this.workButton), this.homeButton),
      ...[...this.cards.values()].map((card) => card.element));
  }

  show(model: Model): void {
    const { state, machine, role } = model;
    const offsets = state.offsets ?? undefined;
    const positions = Object.fromEntries(machine.axes.map(({ name }) => [name, state.axes[name]?.position ?? undefined]));
    const shown = this.isWork && offsets !== undefined ? workPlace(positions, offsets) : positions;
    setText(this.workButton, fill(t.axes.work, { system: offsets?.active ?? "" }));
    setAttribute(this.workButton, "disabled", offsets === undefined);
    setAttribute(this.machineButton, "aria-pressed", String(!this.isWork));
    setAttribute(this.workButton, "aria-pressed", String(this.isWork));
    show(this.homeButton, role === "operate");
    setAttribute(this.homeButton, "disabled", state.mode !== "Idle");
    for (const [name, card] of this.cards) {
      const axis = state.axes[name];
      if (axis === undefined) continue;
      card.show({
        machine, state: axis, position: shown[name], contact_ms: model.contact_ms, now_ms: model.now_ms,
        mayOperate: role === "operate", isIdle: state.mode === "Idle",
      });
    }
  }
}
