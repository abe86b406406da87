// The motors that are not the only ones of an axis: where they are, in what state, and which of their switches are closed.
import type { AxisState, Machine, MachineMotor } from "../../api/contract";
import { h, setAttribute, setText, show } from "../../dom/element";
import { fixed } from "../../format/numbers";
import { unitText } from "../../format/units";
import { phaseLook, phaseText, troubleText } from "../../state/axis_texts";
import { ageNow, freshness } from "../../state/freshness";
import { switchesText } from "../../state/switches_text";
import { fill, t } from "../../texts";
import { Figures } from "./figures";
import type { Model, View } from "../view";

class MotorRow {
  readonly element: HTMLElement;
  private readonly position = h("output", {});
  private readonly phase = h("span", { class: "chip" });
  private readonly homed = h("span", { class: "chip" });
  private readonly switches = h("span", { class: "chip", "data-look": "warning" });
  private readonly trouble = h("p", { class: "trouble", hidden: true });
  private readonly figures = new Figures();

  constructor(private readonly motor: MachineMotor) {
    this.element = h("article", { class: "axis motor", "data-motor": motor.name, "aria-label": fill(t.alarms.motor, { motor: motor.name }) },
      h("div", { class: "reading" }, h("strong", {}, motor.name), h("span", { class: "soft" }, fill(t.motors.moves, { axes: motor.axes.join(", ") })),
        this.position),
      h("div", { class: "chips" }, this.phase, this.homed, this.switches),
      this.trouble, this.figures.element);
  }

  show(state: AxisState, { machine, contact_ms, now_ms }: Model): void {
    const old = ageNow(state.age_ms ?? undefined, contact_ms, now_ms);
    setAttribute(this.element, "data-fresh", state.present && freshness(old) === "live" ? "live" : "stale");
    setText(this.position, `${fixed(state.position, 3)} ${unitText(this.motor)}`);
    setText(this.phase, phaseText(state, t));
    setAttribute(this.phase, "data-look", phaseLook(state));
    setText(this.homed, state.homed ? t.axes.homed : t.axes.notHomed);
    setAttribute(this.homed, "data-look", state.homed ? "good" : "warning");
    show(this.homed, state.homed !== null && state.homed !== undefined);
    const switches = switchesText(state.switches ?? [], t);
    setText(this.switches, switches);
    show(this.switches, switches !== "");
    const trouble = troubleText({ ...state, fault: state.fault ? { ...state.fault, motor: null } : null }, t); // the row names the motor
    setText(this.trouble, trouble);
    show(this.trouble, trouble !== "");
    this.figures.show(state, old, machine);
  }
}

export class Motors implements View {
  readonly element: HTMLElement;
  private readonly rows: Map<string, MotorRow>;

  constructor({ motors }: Machine) {
    this.rows = new Map(motors.map((motor) => [motor.name, new MotorRow(motor)]));
    this.element = h("section", { class: "motors", "aria-label": t.motors.title, hidden: motors.length === 0 },
      h("div", { class: "heading" }, h("h2", {}, t.motors.title)), ...[...this.rows.values()].map((row) => row.element));
  }

  show(model: Model): void {
    for (const [name, row] of this.rows) {
      const state = model.state.motors[name];
      if (state !== undefined) row.show(state, model);
    }
  }
}
