// Measuring with a probe: what to measure, and the newest result.
import type { Machine } from "../../api/contract";
import { h, show } from "../../dom/element";
import { t } from "../../texts";
import type { Give, Report } from "../command_button";
import type { Model, View } from "../view";
import { ProbeForm } from "./probe_form";
import { ProbeResult } from "./probe_result";

export class ProbeTab implements View {
  readonly element: HTMLElement;
  private readonly form: ProbeForm;
  private readonly result: ProbeResult;
  private readonly hasProbe: boolean;

  constructor(machine: Machine, give: Give, report: Report) {
    const probes = [...new Set(machine.inputs.filter(({ use }) => use === "probe").map(({ number }) => number ?? 0))].sort((a, b) => a - b);
    this.hasProbe = probes.length > 0;
    this.form = new ProbeForm(machine, probes, (body) => void give("probe", body));
    this.result = new ProbeResult(machine, give, report);
    this.element = h("div", { class: "probe-tab" }, this.hasProbe ? undefined : h("p", { class: "soft" }, t.probe.none), this.form.element, this.result.element);
  }

  show({ state, role }: Model): void {
    const mayStart = role === "operate" && state.mode === "Idle";
    show(this.form.element, this.hasProbe && role === "operate");
    this.form.enable(mayStart);
    this.result.show(state.measurement ?? undefined, mayStart);
  }
}
