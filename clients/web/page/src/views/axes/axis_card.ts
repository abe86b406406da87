// One axis: where it is, how fast, in what state, and how well its steps and setpoints keep their times.
import type { AxisState, Machine, MachineAxis } from "../../api/contract";
import { h, icon, setAttribute, setText, show } from "../../dom/element";
import { ICONS } from "../../dom/icons";
import { fixed } from "../../format/numbers";
import { unitText } from "../../format/units";
import { phaseLook, phaseText, troubleText } from "../../state/axis_texts";
import { ageNow, freshness } from "../../state/freshness";
import { fill, t } from "../../texts";
import { Figures } from "./figures";

export interface AxisMoment {
  readonly machine: Machine;
  readonly state: AxisState;
  /** In the shown coordinates. */
  readonly position: number | undefined;
  readonly contact_ms: number;
  readonly now_ms: number;
  readonly mayOperate: boolean;
  readonly isIdle: boolean;
}

export class AxisCard {
  readonly element: HTMLElement;
  private readonly position = h("output", { class: "position" });
  private readonly velocity = h("span", { class: "velocity" });
  private readonly phase = h("span", { class: "chip" });
  private readonly homed = h("span", { class: "chip" });
  private readonly trouble = h("p", { class: "trouble", hidden: true });
  private readonly place = h("span", { class: "place" });
  private readonly travel: HTMLElement;
  private readonly figures: Figures;
  private readonly homeButton: HTMLButtonElement;

  /** @param hasOwnMotor false: its motors are shown apart */
  constructor(private readonly axis: MachineAxis, index: number, hasOwnMotor: boolean, home: () => void) {
    this.figures = new Figures(hasOwnMotor);
    const text = fill(t.commands.homeAxis, { axis: axis.name });
    this.homeButton = h("button", { type: "button", class: "plain tool", title: text, "aria-label": text, on: { click: home } }, icon(ICONS.home));
    this.travel = h("div", { class: "travel", "aria-hidden": "true" }, this.place);
    this.element = h("article", { class: "axis", "data-axis": axis.name, "aria-label": fill(t.alarms.axis, { axis: axis.name }) },
      h("div", { class: "reading" }, h("span", { class: `letter axis-${index % 6}` }, axis.name), this.position,
        h("span", { class: "unit" }, unitText(axis)), this.velocity),
      this.travel,
      h("div", { class: "chips" }, this.phase, this.homed, this.homeButton),
      this.trouble,
      this.figures.element);
  }

  show(moment: AxisMoment): void {
    const { state, machine } = moment;
    const old = ageNow(state.age_ms ?? undefined, moment.contact_ms, moment.now_ms);
    const isFresh = state.present && freshness(old) === "live";
    setAttribute(this.element, "data-fresh", isFresh ? "live" : "stale");
    setText(this.position, fixed(moment.position, 3));
    setText(this.velocity, `${fixed(state.velocity, 1)} ${unitText(this.axis)}/s`);
    setText(this.phase, phaseText(state, t));
    setAttribute(this.phase, "data-look", phaseLook(state));
    setText(this.homed, state.homed ? t.axes.homed : t.axes.notHomed);
    setAttribute(this.homed, "data-look", state.homed ? "good" : "warning");
    show(this.homed, state.homed !== null && state.homed !== undefined);
    show(this.homeButton, moment.mayOperate);
    setAttribute(this.homeButton, "disabled", !moment.isIdle);
    this.showTravel(state);
    this.figures.show(state, old, machine);
    const trouble = troubleText(state, t);
    setText(this.trouble, trouble);
    show(this.trouble, trouble !== "");
  }

  /** Marks the axis's place within its travel. A script sets the style, because the page allows none in markup. */
  private showTravel({ position }: AxisState): void {
    const { position_min, position_max } = this.axis;
    show(this.place, position !== null && position !== undefined);
    if (position === null || position === undefined) return;
    const share = Math.min(1, Math.max(0, (position - position_min) / (position_max - position_min)));
    this.place.style.setProperty("left", `${(100 * share).toFixed(2)}%`);
  }
}
