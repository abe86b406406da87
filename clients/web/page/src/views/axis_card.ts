// One axis: where it is, how fast, in what state, and how well its steps and setpoints keep their times.
import type { AxisState, Machine, MachineAxis } from "../api/contract";
import { h, icon, setAttribute, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { fixed } from "../format/numbers";
import { age } from "../format/times";
import { unitText } from "../format/units";
import { ageNow, freshness } from "../state/freshness";
import { fill, t } from "../texts";

const FRESH_MS = 1000; // below this the exact age is not shown

class Figure {
  private readonly value = h("dd", {});
  readonly element: HTMLElement;

  constructor(name: string, hint: string, private readonly unit: string) {
    this.element = h("div", { class: "figure", title: hint }, h("dt", {}, name), this.value);
  }

  show(text: string, isAlarm = false): void {
    setText(this.value, text === "–" || this.unit === "" ? text : `${text} ${this.unit}`);
    setAttribute(this.element, "data-look", isAlarm ? "bad" : undefined);
  }
}

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
  private readonly age = new Figure(t.axes.age, t.axes.hints.age, "");
  private readonly slack = new Figure(t.axes.slack, t.axes.hints.slack, "ms");
  private readonly late = new Figure(t.axes.late, t.axes.hints.late, "µs");
  private readonly skew = new Figure(t.axes.skew, t.axes.hints.skew, "µs");
  private readonly clock = new Figure(t.axes.clock, t.axes.hints.clock, "µs");
  private readonly homeButton: HTMLButtonElement;

  constructor(private readonly axis: MachineAxis, index: number, home: () => void) {
    const text = fill(t.commands.homeAxis, { axis: axis.name });
    this.homeButton = h("button", { type: "button", class: "plain tool", title: text, "aria-label": text, on: { click: home } }, icon(ICONS.home));
    this.travel = h("div", { class: "travel", "aria-hidden": "true" }, this.place);
    this.element = h("article", { class: "axis", "data-axis": axis.name, "aria-label": fill(t.alarms.axis, { axis: axis.name }) },
      h("div", { class: "reading" }, h("span", { class: `letter axis-${index % 6}` }, axis.name), this.position,
        h("span", { class: "unit" }, unitText(axis)), this.velocity),
      this.travel,
      h("div", { class: "chips" }, this.phase, this.homed, this.homeButton),
      this.trouble,
      h("dl", { class: "figures" }, ...[this.slack, this.late, this.skew, this.clock, this.age].map((f) => f.element)));
  }

  show(moment: AxisMoment): void {
    const { state, machine } = moment;
    const old = ageNow(state.age_ms ?? undefined, moment.contact_ms, moment.now_ms);
    const isFresh = state.present && freshness(old) === "live";
    setAttribute(this.element, "data-fresh", isFresh ? "live" : "stale");
    setText(this.position, fixed(moment.position, 3));
    setText(this.velocity, `${fixed(state.velocity, 1)} ${unitText(this.axis)}/s`);
    const phase = state.state ?? undefined;
    setText(this.phase, !state.present ? t.axes.missing : phase === undefined ? "–" : t.phase[phase]);
    setAttribute(this.phase, "data-look", this.phaseLook(state));
    setText(this.homed, state.homed ? t.axes.homed : t.axes.notHomed);
    setAttribute(this.homed, "data-look", state.homed ? "good" : "warning");
    show(this.homed, state.homed !== null && state.homed !== undefined);
    show(this.homeButton, moment.mayOperate);
    setAttribute(this.homeButton, "disabled", !moment.isIdle);
    this.showTravel(state);
    this.showFigures(state, machine);
    const freshEnough = old !== undefined && old < FRESH_MS;
    this.age.show(freshEnough ? t.axes.now : age(old), !isFresh);
    this.showTrouble(state);
  }

  private phaseLook({ present, state }: AxisState): string {
    if (!present || state === "Fault") return "bad";
    return state === "Standby" ? "good" : state === "Stop" ? "warning" : "busy";
  }

  /** Marks the axis's place within its travel. A script sets the style, because the page allows none in markup. */
  private showTravel({ position }: AxisState): void {
    const { position_min, position_max } = this.axis;
    show(this.place, position !== null && position !== undefined);
    if (position === null || position === undefined) return;
    const share = Math.min(1, Math.max(0, (position - position_min) / (position_max - position_min)));
    this.place.style.setProperty("left", `${(100 * share).toFixed(2)}%`);
  }

  private showFigures({ health, clock_error_us }: AxisState, machine: Machine): void {
    const slack = health?.slack_ms?.min;
    this.slack.show(fixed(slack, 0), slack !== undefined && slack < machine.slack_deadline_ms);
    const late = health?.lateness_us;
    const most = late ? Math.max(Math.abs(late.min), Math.abs(late.max)) : undefined;
    const limit = machine.step_lateness_limit_us + (clock_error_us ?? 0);
    this.late.show(fixed(most, 1), most !== undefined && most > limit);
    this.skew.show(fixed(health?.skew_us, 1));
    this.clock.show(fixed(clock_error_us, 1));
  }

  private showTrouble({ fault, unproved, homed, following_error_steps }: AxisState): void {
    const lines = [
      fault ? `${fault.code}: ${fault.cause}` : "",
      unproved && !homed ? fill(t.axes.unproved, { cause: unproved.cause }) : "",
      following_error_steps ? fill(t.axes.following, { steps: following_error_steps }) : "",
    ].filter((line) => line !== "");
    setText(this.trouble, lines.join(" · "));
    show(this.trouble, lines.length > 0);
  }
}
