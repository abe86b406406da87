// The whole page: its parts, and where they are.
import type { Machine } from "../api/contract";
import { h } from "../dom/element";
import { t } from "../texts";
import { Alarms } from "./alarms";
import { Axes } from "./axes/axes";
import { giver, type Give, type Report } from "./command_button";
import { DevicesRow } from "./devices";
import { Inputs } from "./inputs";
import { Header } from "./header";
import { JobCard } from "./job_card";
import { JogPad } from "./jog_pad";
import { keysDialog } from "./keys_dialog";
import { LinkBanner } from "./link_banner";
import { MdiTab } from "./mdi_tab";
import { Boards } from "./axes/boards";
import { Motors } from "./axes/motors";
import { Notices } from "./notices";
import { OffsetsTab } from "./offsets_tab";
import { Outputs } from "./outputs";
import { Overrides } from "./overrides";
import { PathView } from "./path_view";
import { PauseBanner } from "./pause_banner";
import { ProbeTab } from "./probe/probe_tab";
import { ProgramTab } from "./program_tab";
import { ReportsTab } from "./reports_tab";
import { SafetyBar } from "./safety_bar";
import { leave } from "./sign_in";
import { Strip } from "./strip";
import { Tabs } from "./tabs";
import { ToolsTab } from "./tools_tab";
import type { Model, View } from "./view";
import { WriterBanner } from "./writer_banner";

export class Page {
  readonly give: Give;
  readonly resume: () => void;
  private readonly views: View[];

  constructor(place: HTMLElement, machine: Machine, stream: () => string) {
    const notices = new Notices();
    const report: Report = notices.report;
    const give = giver(report);
    const pause = new PauseBanner(give);
    this.give = give;
    this.resume = () => pause.resume();
    const keys = keysDialog();
    const safety = new SafetyBar(give, this.resume);
    const header = new Header(() => keys.showModal(), () => void leave(report), safety.element);
    const [banner, writer, alarms] = [new LinkBanner(), new WriterBanner(this.give), new Alarms()];
    const [axes, motors, jog] = [new Axes(machine, this.give), new Motors(machine), new JogPad(machine, stream, report)];
    const [boards, inputs, outputs] = [new Boards(machine), new Inputs(machine), new Outputs(machine)];
    const [path, strip] = [new PathView(machine), new Strip(machine)];
    const [job, devices, overrides] = [new JobCard(this.give), new DevicesRow(), new Overrides(machine, this.give)];
    const [program, mdi] = [new ProgramTab(machine, report), new MdiTab(this.give)];
    const probe = new ProbeTab(machine, this.give, report);
    const [offsets, tools, reports] = [new OffsetsTab(machine, this.give), new ToolsTab(this.give), new ReportsTab(report)];
    const tabs = new Tabs(t.program.title, [
      { id: "program", title: t.program.title, content: program.element }, { id: "mdi", title: t.mdi.title, content: mdi.element },
      { id: "probe", title: t.probe.title, content: probe.element },
      { id: "offsets", title: t.offsets.title, content: offsets.element }, { id: "tools", title: t.tools.title, content: tools.element },
      { id: "reports", title: t.reports.title, content: reports.element },
    ]);
    this.views = [header, safety, banner, writer, pause, alarms, axes, motors, boards, inputs, outputs, jog, path, strip, job, devices, overrides, program, mdi, probe, offsets, tools, reports];
    place.replaceChildren(
      h("a", { class: "skip", href: "#main" }, t.page.skip), header.element,
      h("main", { id: "main", tabindex: -1 },
        h("div", { class: "top" }, banner.element, writer.element, pause.element, alarms.element),
        h("div", { class: "left" }, axes.element, jog.element, motors.element, boards.element, inputs.element, outputs.element),
        h("div", { class: "middle" }, path.element, strip.element),
        h("div", { class: "right" }, h("div", { class: "job-area" }, job.element, devices.element, overrides.element), tabs.element)),
      notices.element, keys, pause.dialog);
  }

  show(model: Model): void {
    for (const view of this.views) view.show(model);
  }
}
