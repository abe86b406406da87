// Finds a writer, other than this page's server, that gives the machine its commands.
import type { Role, State, Writer } from "../api/contract";

/** Undefined for a role that may not give commands. */
export function otherWriter(state: Pick<State, "mode" | "writer">, role: Role): Writer | undefined {
  const writer = state.writer;
  const isOther = role === "operate" && writer && !writer.is_this_server && state.mode !== "Unreachable";
  return isOther ? writer : undefined;
}
