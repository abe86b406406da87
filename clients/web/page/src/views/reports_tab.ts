// Reports of past jobs and files of incidents, to open.
import { reports } from "../api/client";
import type { ReportFile } from "../api/contract";
import { h, icon, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { bytes } from "../format/numbers";
import { t } from "../texts";
import type { Report } from "./command_button";
import type { Model, View } from "./view";

export class ReportsTab implements View {
  readonly element: HTMLElement;
  private readonly list = h("ul", { class: "reports" });
  private readonly none = h("p", { class: "soft" }, t.reports.none);
  private job = "";

  constructor(private readonly report: Report) {
    this.element = h("div", {}, h("button", { type: "button", class: "action small", on: { click: () => void this.fetch() } }, icon(ICONS.reset), t.reports.refresh), this.none, this.list);
  }

  /** Reads the list again when a job has ended, because the job may have left a file. */
  show({ state }: Model): void {
    const job = `${state.job?.number ?? ""} ${state.job?.outcome ?? ""} ${state.mode}`;
    const ended = !["Running", "Homing", "Jogging", "Holding", "Stopping"].includes(state.mode);
    if (job === this.job || !ended) return;
    this.job = job;
    void this.fetch();
  }

  private async fetch(): Promise<void> {
    const answer = await reports();
    if (!answer.ok) return this.report(answer);
    this.list.replaceChildren(...answer.value.files.map((file) => this.item(file)));
    show(this.none, answer.value.files.length === 0);
  }

  private item(file: ReportFile): HTMLElement {
    const time = new Date(file.modified).toLocaleString();
    return h("li", {}, h("span", { class: "chip", "data-look": file.kind === "incident" ? "warning" : "good" }, t.reports[file.kind]),
      h("a", { href: `/api/reports/${encodeURIComponent(file.name)}`, target: "_blank", rel: "noopener" }, file.name),
      h("span", { class: "soft" }, `${time} · ${bytes(file.bytes)}`));
  }
}
