// Whether another than this page's server gives the machine its commands.
import type { Role, State, Writer } from "../api/contract";

/** For those who could give commands themselves. */
export function otherWriter(state: Pick<State, "mode" | "writer">, role: Role): Writer | undefined {
  const writer = state.writer;
  const isOther = role === "operate" && writer && !writer.is_this_server && state.mode !== "Unreachable";
  return isOther ? writer : undefined;
}
