// The outputs of the machine in words: their pins, and what the program asks for where that differs.
import type { MachineOutput, OutputState, State } from "../api/contract";
import { fixed } from "../format/numbers";
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

export interface OutputText {
  text: string;
  look: "good" | "busy" | "warning";
}

/** Of an analog output only what the program asks for is known. */
function outputText({ name, kind }: MachineOutput, { on, asked }: OutputState, { outputs }: Pick<Texts, "outputs">): OutputText {
  const busy = asked > 0 ? "busy" : "good";
  if (kind === "analog") return { text: fill(outputs.analog, { name, percent: fixed(asked * 100, 1) }), look: busy };
  const level = (is: boolean) => is ? outputs.on : outputs.off;
  if (on === null || on === undefined) return { text: fill(outputs.unknown, { name, asked: level(asked > 0) }), look: busy };
  if (on !== asked > 0) return { text: fill(outputs.differs, { name, level: level(on), asked: level(asked > 0) }), look: "warning" };
  return { text: fill(outputs.same, { name, level: level(on) }), look: busy };
}

export function outputTexts(machine: readonly MachineOutput[], state: State["outputs"], texts: Pick<Texts, "outputs">): OutputText[] {
  return machine.flatMap((output) => {
    const now = state[output.name];
    return now === undefined ? [] : [outputText(output, now, texts)];
  });
}
