// The form of a measurement: its kind, and the values that this kind needs.
import type { Machine, MeasureKind } from "../../api/contract";
import { h, setAttribute, setText, show } from "../../dom/element";
import { FIRST_VALUES, KINDS, NUMBER_FIELDS, type Flag, type NumberField } from "../../probe/kinds";
import { orderOf } from "../../probe/order";
import { t } from "../../texts";
import { parseNumber } from "../number_cell";

const KIND_NAMES = Object.keys(KINDS) as MeasureKind[];
const FLAGS: readonly Flag[] = ["away", "may_miss"];

export class ProbeForm {
  readonly element: HTMLFormElement;
  private readonly kind: HTMLSelectElement;
  private readonly hint = h("p", { class: "soft" });
  private readonly axis = h("select", { id: "probe-axis" });
  private readonly axisRow: HTMLElement;
  private readonly probe: HTMLSelectElement;
  private readonly numbers = new Map<NumberField, { row: HTMLElement; input: HTMLInputElement }>();
  private readonly flags = new Map<Flag, { row: HTMLElement; input: HTMLInputElement }>();
  private readonly start = h("button", { type: "submit", class: "action" }, t.probe.start);

  constructor(private readonly machine: Machine, probes: readonly number[], private readonly send: (body: object) => void) {
    const choose = () => this.choose();
    this.kind = h("select", { id: "probe-kind", on: { change: choose } },
      ...KIND_NAMES.map((name) => h("option", { value: name }, t.probe.kind[name])));
    this.probe = h("select", { id: "probe-number" }, ...probes.map((number) => h("option", { value: number }, String(number))));
    this.axisRow = h("div", {}, h("label", { for: "probe-axis" }, t.probe.axis), this.axis);
    const probeRow = h("div", {}, h("label", { for: "probe-number" }, t.probe.number), this.probe);
    show(probeRow, probes.length > 1);
    for (const name of NUMBER_FIELDS) this.numbers.set(name, this.numberRow(name));
    for (const name of FLAGS) this.flags.set(name, this.flagRow(name));
    const rows = [...this.numbers.values(), ...this.flags.values()].map(({ row }) => row);
    this.element = h("form", { class: "probe-form", on: { submit: (event) => {
      event.preventDefault();
      this.submit();
    } } },
      h("div", { class: "probe-kind" }, h("label", { for: "probe-kind" }, t.probe.what), this.kind), this.hint,
      h("div", { class: "probe-fields" }, this.axisRow, ...rows, probeRow), this.start);
    this.choose();
  }

  enable(mayStart: boolean): void {
    setAttribute(this.start, "disabled", !mayStart);
  }

  private get chosen(): MeasureKind {
    return this.kind.value as MeasureKind;
  }

  private numberRow(name: NumberField): { row: HTMLElement; input: HTMLInputElement } {
    const input = h("input", { type: "text", inputmode: "decimal", id: `probe-${name}`, class: "number-cell", value: FIRST_VALUES[name] ?? "", autocomplete: "off" });
    return { input, row: h("div", {}, h("label", { for: `probe-${name}` }, t.probe.field[name]), input) };
  }

  private flagRow(name: Flag): { row: HTMLElement; input: HTMLInputElement } {
    const input = h("input", { type: "checkbox", id: `probe-${name}` });
    return { input, row: h("div", { class: "check" }, input, h("label", { for: `probe-${name}` }, t.probe.flag[name])) };
  }

  private choose(): void {
    const fields = KINDS[this.chosen];
    setText(this.hint, t.probe.hint[this.chosen]);
    for (const [name, { row }] of this.numbers) show(row, fields.numbers.includes(name));
    for (const [name, { row }] of this.flags) show(row, fields.flags?.includes(name) === true);
    show(this.axisRow, fields.axis !== undefined);
    const axes = fields.axis === "any" ? this.machine.axes.map(({ name }) => name) : ["X", "Y"];
    this.axis.replaceChildren(...axes.map((name) => h("option", { value: name }, name)));
    if (axes.includes("Z")) this.axis.value = "Z";
  }

  private submit(): void {
    const number = (field: NumberField) => parseNumber(this.numbers.get(field)!.input.value);
    for (const [field, { input }] of this.numbers) {
      const isWrong = KINDS[this.chosen].numbers.includes(field) && number(field) === undefined;
      setAttribute(input, "aria-invalid", isWrong ? "true" : undefined);
    }
    const order = orderOf({
      kind: this.chosen, axis: this.axis.value, number, flag: (flag) => this.flags.get(flag)!.input.checked,
      probe: this.probe.options.length > 1 ? Number(this.probe.value) : undefined,
    });
    if ("missing" in order) return this.numbers.get(order.missing)!.input.focus();
    this.send(order.body);
  }
}
