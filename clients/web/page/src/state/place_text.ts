// The parts of the machine that have a fault, in words: axes, motors, or the whole machine.
import { fill } from "../texts/fill";
import type { Texts } from "../texts/en";

/** "Axis X", "Motors Y1, Y2", "Axes X, Z, Motor Y2"; empty for the whole machine. */
export function placeText(axes: readonly string[], motors: readonly string[], { alarms }: Pick<Texts, "alarms">): string {
  const parts = [
    axes.length === 0 ? "" : axes.length === 1 ? fill(alarms.axis, { axis: axes[0]! }) : fill(alarms.axes, { axes: axes.join(", ") }),
    motors.length === 0 ? "" : motors.length === 1 ? fill(alarms.motor, { motor: motors[0]! }) : fill(alarms.motors, { motors: motors.join(", ") }),
  ];
  return parts.filter((part) => part !== "").join(", ");
}
