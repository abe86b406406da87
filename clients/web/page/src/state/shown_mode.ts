// The mode as a person reads it.
import type { Mode, State } from "../api/contract";

/** The mode is Holding from the command on; `hold` tells when the machine is at rest. Then it is shown as Paused. */
export function shownMode({ mode, hold }: Pick<State, "mode" | "hold">): Mode {
  return hold?.state === "held" ? "Paused" : mode;
}
