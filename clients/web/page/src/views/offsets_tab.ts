// Work coordinate systems: edits their origins, and sets them to the machine's position.
import type { Machine } from "../api/contract";
import { h, setAttribute, setText, show } from "../dom/element";
import { fixed } from "../format/numbers";
import { mayHandle } from "../state/pause_texts";
import { fill, t } from "../texts";
import type { Give } from "./command_button";
import { NumberCell } from "./number_cell";
import type { Model, View } from "./view";

export class OffsetsTab implements View {
  readonly element: HTMLElement;
  private readonly cells: { system: string; axis: string; cell: NumberCell }[] = [];
  private readonly rows = new Map<string, HTMLElement>();
  private readonly touches: HTMLButtonElement[];
  private readonly touch: HTMLElement;
  private readonly system: HTMLSelectElement;
  private readonly g92 = h("p", { class: "soft" });
  private readonly pauseNote = h("p", { class: "soft", hidden: true }, t.offsets.pause);

  constructor(machine: Machine, give: Give) {
    const axes = machine.axes.map((axis) => axis.name);
    this.system = h("select", { id: "touch-system" }, ...machine.coordinate_systems.map((name) => h("option", { value: name }, name)));
    this.touches = axes.map((axis) => h("button", { type: "button", class: "action small", on: {
      click: () => void give("touch", { system: this.system.value, axes: { [axis]: 0 } }),
    } }, fill(t.offsets.touch, { axis })));
    this.touch = h("div", { class: "touch" }, h("label", { for: "touch-system" }, t.offsets.system), this.system, ...this.touches);
    const body = machine.coordinate_systems.map((system) => this.row(system, axes, give));
    this.element = h("div", { class: "offsets" }, this.touch, this.pauseNote,
      h("div", { class: "wide", tabindex: 0, role: "region", "aria-label": t.offsets.title }, h("table", {},
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, t.offsets.system),
          ...axes.map((axis) => h("th", { scope: "col" }, axis)), h("th", { scope: "col" }, t.offsets.rotation))),
        h("tbody", {}, ...body))),
      this.g92);
  }

  show({ state, role }: Model): void {
    const offsets = state.offsets ?? undefined;
    const mayEdit = role === "operate" && mayHandle(state) && offsets !== undefined;
    for (const { system, axis, cell } of this.cells) {
      const known = offsets?.systems[system];
      cell.show((axis === "" ? known?.rotation_deg : known?.origin?.[axis]) ?? 0, mayEdit);
    }
    for (const [name, row] of this.rows) setAttribute(row, "aria-current", name === offsets?.active ? "true" : undefined);
    show(this.pauseNote, Boolean(state.pause));
    show(this.touch, role === "operate");
    this.touches.forEach((button) => setAttribute(button, "disabled", !mayEdit));
    const g92 = Object.entries(offsets?.g92 ?? {}).map(([axis, value]) => `${axis} ${fixed(value, 3)}`);
    setText(this.g92, offsets === undefined ? t.offsets.none : g92.length > 0 ? `${t.offsets.g92}: ${g92.join(", ")}` : "");
  }

  private row(system: string, axes: readonly string[], give: Give): HTMLElement {
    const cell = (axis: string) => {
      const body = (value: number) => (axis === "" ? { system, rotation_deg: value } : { system, origin: { [axis]: value } });
      const label = fill(t.offsets.edit, { system, axis: axis === "" ? t.offsets.rotation : axis });
      const made = new NumberCell(label, 3, (value) => void give("offset", body(value)));
      this.cells.push({ system, axis, cell: made });
      return h("td", {}, made.input);
    };
    const row = h("tr", {}, h("th", { scope: "row" }, system), ...axes.map(cell), cell(""));
    this.rows.set(system, row);
    return row;
  }
}
