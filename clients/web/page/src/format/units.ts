// The units of a machine's axes, as a person reads them.
import type { MachineAxis } from "../api/contract";
import { fixed } from "./numbers";

export function unitText(axis: Pick<MachineAxis, "unit">): string {
  return axis.unit === "deg" ? "°" : axis.unit;
}

/** The greatest speed of each unit: "50.0 mm/s, 90.0 °/s". */
export function speedTexts(axes: readonly MachineAxis[], speed: (axis: MachineAxis) => number): string {
  const units = [...new Set(axes.map(unitText))];
  const most = (unit: string) => Math.max(...axes.filter((axis) => unitText(axis) === unit).map(speed));
  return units.map((unit) => `${fixed(most(unit), 1)} ${unit}/s`).join(", ");
}

/** Each unit once, in the order of the axes: "mm, °"; `per`: what each is divided by, such as "/s". */
export function unitTexts(axes: readonly MachineAxis[], per = ""): string {
  return [...new Set(axes.map((axis) => unitText(axis) + per))].join(", ");
}
