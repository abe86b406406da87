// The tool table.
import type { Tool } from "../api/contract";
import { h, icon, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { fixed } from "../format/numbers";
import { fill, t } from "../texts";
import type { Give } from "./command_button";
import { parseNumber } from "./number_cell";
import type { Model, View } from "./view";

const FIELDS = ["number", "pocket", "length", "diameter"] as const;

export class ToolsTab implements View {
  readonly element: HTMLElement;
  private readonly body = h("tbody", {});
  private readonly none = h("p", { class: "soft" }, t.tools.none);
  private readonly form: HTMLFormElement;
  private readonly inputs: Record<(typeof FIELDS)[number], HTMLInputElement>;
  private shown = "";

  constructor(private readonly give: Give) {
    const input = (name: string) => h("input", { type: "text", inputmode: "decimal", id: `tool-${name}`, class: "number-cell" });
    this.inputs = { number: input("number"), pocket: input("pocket"), length: input("length"), diameter: input("diameter") };
    this.form = h("form", { class: "tool-form", on: { submit: (event) => {
      event.preventDefault();
      void this.save();
    } } }, ...FIELDS.map((name) => h("div", {}, h("label", { for: `tool-${name}` }, t.tools[name]), this.inputs[name])),
      h("button", { type: "submit", class: "action small" }, t.tools.add));
    this.element = h("div", { class: "tools-tab" },
      h("div", { class: "wide", tabindex: 0, role: "region", "aria-label": t.tools.title }, h("table", {},
        h("thead", {}, h("tr", {}, ...FIELDS.map((name) => h("th", { scope: "col" }, t.tools[name])), h("td", {}))), this.body)),
      this.none, this.form);
  }

  show({ state, role }: Model): void {
    const tools = state.tools ?? {};
    show(this.form, role === "operate");
    const now = JSON.stringify([tools, role]);
    if (now === this.shown) return;
    this.shown = now;
    const rows = Object.entries(tools).sort(([a], [b]) => Number(a) - Number(b));
    this.body.replaceChildren(...rows.map(([number, tool]) => this.row(number, tool, role === "operate")));
    show(this.none, rows.length === 0);
  }

  private row(number: string, tool: Tool, mayEdit: boolean): HTMLElement {
    const edit = () => this.fill(number, tool);
    const text = fill(t.tools.remove, { number });
    const remove = h("button", { type: "button", class: "plain tool", title: text, "aria-label": text, on: {
      click: () => void this.give("tool", { number: Number(number), remove: true }),
    } }, icon(ICONS.close));
    return h("tr", {},
      h("th", { scope: "row" }, mayEdit ? h("button", { type: "button", class: "plain", on: { click: edit } }, number) : number),
      h("td", {}, String(tool.pocket ?? 0)), h("td", {}, fixed(tool.offset?.["Z"] ?? 0, 3)), h("td", {}, fixed(tool.diameter ?? 0, 3)),
      h("td", {}, mayEdit ? remove : ""));
  }

  private fill(number: string, tool: Tool): void {
    this.inputs.number.value = number;
    this.inputs.pocket.value = String(tool.pocket ?? 0);
    this.inputs.length.value = String(tool.offset?.["Z"] ?? 0);
    this.inputs.diameter.value = String(tool.diameter ?? 0);
    this.inputs.length.focus();
  }

  private async save(): Promise<void> {
    const value = (name: (typeof FIELDS)[number]) => parseNumber(this.inputs[name].value);
    const [number, pocket, length, diameter] = FIELDS.map(value);
    if (number === undefined) return this.inputs.number.focus();
    const body = {
      number, ...(pocket === undefined ? {} : { pocket }), ...(length === undefined ? {} : { offset: { Z: length } }),
      ...(diameter === undefined ? {} : { diameter }),
    };
    const answer = await this.give("tool", body);
    if (answer.ok) this.form.reset();
  }
}
