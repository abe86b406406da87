// The units of a machine's axes, as a person reads them.
import type { MachineAxis } from "../api/contract";

export function unitText(axis: MachineAxis): string {
  return axis.unit === "deg" ? "°" : axis.unit;
}

/** Each unit once, in the order of the axes: "mm, °"; `per`: what each is divided by, such as "/s". */
export function unitTexts(axes: readonly MachineAxis[], per = ""): string {
  return [...new Set(axes.map((axis) => unitText(axis) + per))].join(", ");
}
