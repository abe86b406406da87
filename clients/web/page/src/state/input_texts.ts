// The inputs of the machine in words, each with the look of its effect.
import type { MachineInput, State } from "../api/contract";
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

export interface InputText {
  text: string;
  look: "good" | "busy" | "warning" | "bad";
}

const LOOKS = { "emergency-stop": "bad", door: "warning", program: "busy", probe: "busy", home: "busy" } as const;

/** Inputs that were not received yet are left out. */
export function inputTexts(machine: readonly MachineInput[], state: State["inputs"], { inputs }: Pick<Texts, "inputs">): InputText[] {
  const received = machine.filter(({ name }) => state[name] !== undefined);
  return received.map(({ name, use }) => state[name]
    ? { text: fill(inputs.closed[use], { name }), look: LOOKS[use] }
    : { text: fill(inputs.open, { name }), look: "good" });
}
