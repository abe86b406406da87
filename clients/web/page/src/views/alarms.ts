// Alarms with cause and remedy, the most serious first.
import type { Alarm, Fault } from "../api/contract";
import { h, icon, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { groupedAlarms } from "../state/grouped_alarms";
import { pageRemedy } from "../state/page_remedy";
import { placeText, type FaultyParts } from "../state/place_text";
import { t } from "../texts";
import type { Model, View } from "./view";

function item(fault: Fault, place: string, kind: string, className: string): HTMLElement {
  const heading = `${place === "" ? "" : `${place}: `}${fault.code}${fault.number > 0 ? ` (${fault.number})` : ""}`;
  return h("li", { class: `alarm ${className}` }, icon(className === "fault" ? ICONS.emergency : ICONS.warning),
    h("div", {}, h("strong", {}, `${kind} – ${heading}`), h("p", {}, fault.cause),
      fault.remedy === "" ? undefined : h("p", { class: "remedy" }, pageRemedy(fault.remedy, t))));
}

function partsOf({ axis, motor, board }: Fault): FaultyParts {
  return { axes: axis ? [axis] : [], motors: motor ? [motor] : [], boards: board ? [board] : [] };
}

export class Alarms implements View {
  private readonly list = h("ul", {});
  readonly element = h("section", { class: "alarms", role: "alert", "aria-label": t.alarms.title, hidden: true }, this.list);
  private shown = "";

  show({ state }: Model): void {
    const alarms: Alarm[] = state.alarms ?? [];
    const ended = alarms.length === 0 && state.job?.outcome === "Failed" ? state.job.ended_by : undefined;
    const now = JSON.stringify([alarms, ended]);
    if (now === this.shown) return;
    this.shown = now;
    this.list.replaceChildren(
      ...groupedAlarms(alarms).map(({ alarm, ...parts }) =>
        item(alarm, placeText(parts, t), alarm.severity === "fault" ? t.alarms.fault : t.alarms.warning, alarm.severity)),
      ...(ended ? [item(ended, placeText(partsOf(ended), t), t.alarms.ended, "warning")] : []));
    show(this.element, this.list.children.length > 0);
  }
}
