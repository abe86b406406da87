// The newest measurement: how far it is, what it found or why it found nothing, and where its result is kept.
import type { Machine, Measurement, MeasureResult } from "../../api/contract";
import { heights } from "../../api/client";
import { h, setAttribute, setText, show } from "../../dom/element";
import { fixed } from "../../format/numbers";
import { parseHeights } from "../../probe/height_map";
import { pageRemedy } from "../../state/page_remedy";
import { fill, t } from "../../texts";
import type { Give, Report } from "../command_button";
import { parseNumber } from "../number_cell";
import { HeightView } from "./height_view";

const DIGITS = 4;
const TOUCHES_OF_A_POINT = 2;

type Row = readonly [string, string];

function rowsOf({ kind }: Measurement, result: MeasureResult): Row[] {
  const rows: Row[] = [];
  const put = (name: string, value: number | undefined | null, unit: string) => {
    if (value !== undefined && value !== null) rows.push([name, `${fixed(value, DIGITS)} ${unit}`]);
  };
  if (kind === "touch") for (const [axis, place] of Object.entries(result.touch)) put(axis, place, "mm");
  put("X", result.x, "mm");
  put("Y", result.y, "mm");
  put(t.probe.result.diameterX, result.diameter_x, "mm");
  put(t.probe.result.diameterY, result.diameter_y, "mm");
  put(t.probe.result.angle, result.angle_deg, "°");
  put(t.probe.result.length, result.tool_length, "mm");
  put(t.probe.result.lowest, result.lowest, "mm");
  put(t.probe.result.highest, result.highest, "mm");
  rows.push([t.probe.result.input, result.input ?? t.probe.result.noTouch]);
  return rows;
}

function progressText({ kind, touches, points }: Measurement): string {
  if (points === undefined || points === null) return fill(t.probe.running, { kind: t.probe.kind[kind], touches });
  return fill(t.probe.runningSurface, { point: Math.min(points, Math.floor(touches / TOUCHES_OF_A_POINT) + 1), points });
}

export class ProbeResult {
  readonly element: HTMLElement;
  private readonly title = h("p", { role: "status" });
  private readonly values = h("dl", { class: "probe-values" });
  private readonly problem = h("p", { class: "trouble" });
  private readonly system: HTMLSelectElement;
  private readonly reads = h("input", { type: "text", inputmode: "decimal", id: "probe-reads", class: "number-cell", value: "0" });
  private readonly tool = h("input", { type: "text", inputmode: "numeric", id: "probe-tool", class: "number-cell" });
  private readonly readsRow: HTMLElement;
  private readonly toSystem: HTMLElement;
  private readonly toTool: HTMLElement;
  private readonly kept = h("p", { class: "soft", role: "status" });
  private readonly buttons: HTMLButtonElement[];
  private readonly heightView = new HeightView();
  private shown = "";

  constructor(machine: Machine, private readonly give: Give, private readonly report: Report) {
    this.system = h("select", { id: "probe-system" }, ...machine.coordinate_systems.map((name) => h("option", { value: name }, name)));
    const set = h("button", { type: "button", class: "action small", on: { click: () => void this.keepInSystem() } }, t.probe.set);
    const setTool = h("button", { type: "button", class: "action small", on: { click: () => void this.keepInTool() } }, t.probe.setTool);
    this.buttons = [set, setTool];
    this.readsRow = h("span", { class: "probe-reads" }, h("label", { for: "probe-reads" }, t.probe.reads), this.reads);
    this.toSystem = h("div", { class: "probe-keep" }, h("label", { for: "probe-system" }, t.offsets.system), this.system, this.readsRow, set);
    this.toTool = h("div", { class: "probe-keep" }, h("label", { for: "probe-tool" }, t.tools.number), this.tool, setTool);
    this.element = h("div", { class: "probe-result" }, this.title, this.values, this.problem, this.toSystem, this.toTool, this.kept, this.heightView.element);
  }

  show(measurement: Measurement | undefined, mayKeep: boolean): void {
    show(this.element, measurement !== undefined);
    this.buttons.forEach((button) => setAttribute(button, "disabled", !mayKeep));
    const now = JSON.stringify(measurement);
    if (measurement === undefined || now === this.shown) return;
    this.shown = now;
    const result = measurement.result ?? undefined;
    const problem = measurement.problem ?? undefined;
    const isRunning = result === undefined && problem === undefined;
    setText(this.title, isRunning ? progressText(measurement) : t.probe.kind[measurement.kind]);
    setText(this.problem, problem === undefined ? "" : [problem.detail, problem.remedy ? pageRemedy(problem.remedy, t) : ""].join(" "));
    this.values.replaceChildren(...(result === undefined ? [] : rowsOf(measurement, result).map(([name, value]) =>
      h("div", {}, h("dt", {}, name), h("dd", {}, value)))));
    this.showKeep(measurement, result);
    void this.showHeights(measurement, result);
  }

  private showKeep({ kind }: Measurement, result: MeasureResult | undefined): void {
    const hasPlace = result !== undefined && result.touched && ["touch", "edge", "corner", "bore", "boss"].includes(kind);
    show(this.toSystem, hasPlace || (result !== undefined && kind === "angle"));
    show(this.readsRow, hasPlace);
    show(this.toTool, result !== undefined && kind === "tool");
    setText(this.kept, "");
  }

  private async showHeights({ kind }: Measurement, result: MeasureResult | undefined): Promise<void> {
    const hasHeights = kind === "surface" && result !== undefined;
    show(this.heightView.element, false);
    if (!hasHeights) return;
    const table = await heights();
    this.report(table);
    const map = table.ok ? parseHeights(table.value) : undefined;
    if (map === undefined) return;
    this.heightView.draw(map);
    show(this.heightView.element, true);
  }

  private async keepInSystem(): Promise<void> {
    const reads = parseNumber(this.reads.value);
    if (reads === undefined) return this.reads.focus();
    const answer = await this.give("keep", { system: this.system.value, ...(this.readsRow.hidden ? {} : { reads }) });
    if (answer.ok) setText(this.kept, fill(t.probe.kept, { name: this.system.value }));
  }

  private async keepInTool(): Promise<void> {
    const tool = parseNumber(this.tool.value);
    if (tool === undefined) return this.tool.focus();
    const answer = await this.give("keep", { tool });
    if (answer.ok) setText(this.kept, fill(t.probe.keptTool, { number: tool }));
  }
}
