// How well the steps and setpoints of an axis or a motor keep their times.
import type { AxisState, Machine } from "../../api/contract";
import { h, setAttribute, setText, show } from "../../dom/element";
import { fixed } from "../../format/numbers";
import { age } from "../../format/times";
import { freshness } from "../../state/freshness";
import { t } from "../../texts";

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

export class Figures {
  readonly element: HTMLElement;
  private readonly age = new Figure(t.axes.age, t.axes.hints.age, "");
  private readonly slack = new Figure(t.axes.slack, t.axes.hints.slack, "ms");
  private readonly late = new Figure(t.axes.late, t.axes.hints.late, "µs");
  private readonly skew = new Figure(t.axes.skew, t.axes.hints.skew, "µs");
  private readonly clock = new Figure(t.axes.clock, t.axes.hints.clock, "µs");

  /** @param isServed whether one process measures them; false: an axis whose motors have processes of their own */
  constructor(isServed = true) {
    const measured = [this.slack, this.late, this.skew, this.clock].map((figure) => figure.element);
    measured.forEach((element) => show(element, isServed));
    this.element = h("dl", { class: "figures" }, ...measured, this.age.element);
  }

  /** @param old the age of the state in ms, undefined if none was received */
  show({ present, health, clock_error_us }: AxisState, old: number | undefined, machine: Machine): void {
    const slack = health?.slack_ms?.min;
    this.slack.show(fixed(slack, 0), slack !== undefined && slack < machine.slack_deadline_ms);
    const late = health?.lateness_us;
    const most = late ? Math.max(Math.abs(late.min), Math.abs(late.max)) : undefined;
    const limit = machine.step_lateness_limit_us + (clock_error_us ?? 0);
    this.late.show(fixed(most, 1), most !== undefined && most > limit);
    this.skew.show(fixed(health?.skew_us, 1));
    this.clock.show(fixed(clock_error_us, 1));
    const isFresh = present && freshness(old) === "live";
    this.age.show(old !== undefined && old < FRESH_MS ? t.axes.now : age(old), !isFresh);
  }
}
