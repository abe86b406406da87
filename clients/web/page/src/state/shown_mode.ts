// The mode as a person reads it.
import type { Mode, State } from "../api/contract";

/** A hold is a mode from its command on, and `hold` tells whether the machine still brakes; a pause is at rest. */
export function shownMode({ mode, hold }: Pick<State, "mode" | "hold">): Mode {
  return hold?.state === "held" ? "Paused" : mode;
}
