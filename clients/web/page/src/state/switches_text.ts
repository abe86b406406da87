// Closed switches in words.
import type { AxisState } from "../api/contract";
import { fill } from "../texts/fill";
import type { Texts } from "../texts/en";

/** Empty if none is closed. */
export function switchesText(switches: NonNullable<AxisState["switches"]>, { motors }: Pick<Texts, "motors">): string {
  return switches.length === 0 ? "" : fill(motors.closed, { switches: switches.map((name) => motors.switches[name]).join(", ") });
}
