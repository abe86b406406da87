// The state of an axis or a motor in words.
import type { AxisState } from "../api/contract";
import { fill } from "../texts/fill";
import type { Texts } from "../texts/en";

export function phaseText({ present, state }: Pick<AxisState, "present" | "state">, { axes, phase }: Pick<Texts, "axes" | "phase">): string {
  if (!present) return axes.missing;
  return state ? phase[state] : "–";
}

export function phaseLook({ present, state }: Pick<AxisState, "present" | "state">): string {
  if (!present || state === "Fault") return "bad";
  return state === "Standby" ? "good" : state === "Stop" ? "warning" : "busy";
}

/** Empty if nothing is wrong. */
export function troubleText(state: Pick<AxisState, "fault" | "unproved" | "homed" | "following_error_steps" | "corrected_steps">, { axes, alarms }: Pick<Texts, "axes" | "alarms">): string {
  const { fault, unproved, homed, following_error_steps, corrected_steps } = state;
  const motor = fault?.motor ? `${fill(alarms.motor, { motor: fault.motor })}: ` : "";
  return [
    fault ? `${motor}${fault.code}: ${fault.cause}` : "",
    unproved && !homed ? fill(axes.unproved, { cause: unproved.cause }) : "",
    following_error_steps ? fill(axes.following, { steps: following_error_steps }) : "",
    corrected_steps ? fill(axes.corrected, { steps: corrected_steps }) : "",
  ].filter((line) => line !== "").join(" · ");
}
