// The outputs of the machine in words: their pins, and what the program asks for where that differs.
import type { MachineOutput, OutputState, State } from "../api/contract";
import { fixed } from "../format/numbers";
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

export interface OutputText {
  text: string;
  look: "good" | "busy" | "warning";
}

/** In a ramp, or with power by speed, the value differs from what the program asks for at the feed: this is no warning. */
function analogText(name: string, { value, asked }: OutputState, { outputs }: Pick<Texts, "outputs">): OutputText {
  const percent = (share: number) => fixed(share * 100, 1);
  if (value === null || value === undefined) return { text: fill(outputs.analogAsked, { name, asked: percent(asked) }), look: asked > 0 ? "busy" : "good" };
  const text = value === asked ? outputs.analog : outputs.analogDiffers;
  const look = value === 0 && asked === 0 ? "good" : asked === 0 ? "warning" : "busy";
  return { text: fill(text, { name, percent: percent(value), asked: percent(asked) }), look };
}

function outputText({ name, kind }: MachineOutput, state: OutputState, { outputs }: Pick<Texts, "outputs">): OutputText {
  if (kind === "analog") return analogText(name, state, { outputs });
  const { on, asked, pulses } = state;
  if (kind === "pulses") {
    const left = pulses?.left ?? 0;
    return { text: left > 0 ? fill(outputs.pulses, { name, left, of: pulses?.of ?? left }) : fill(outputs.noPulses, { name }), look: left > 0 ? "busy" : "good" };
  }
  const busy = asked > 0 ? "busy" : "good";
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
