// A pause in words: what a person has to do, and the way back to its place.
import type { Maybe, Pause } from "../api/contract";
import { fixed } from "../format/numbers";
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

function reasonText({ reason, tool }: Pause, { pause }: Texts): string {
  if (reason !== "tool-change") return pause.reason[reason];
  return tool ? fill(pause.tool, { tool }) : pause.noTool;
}

/** "Change to tool 2: 6 mm end mill", "Waits for an input: until clamp is closed (7 s left)" */
export function pauseText(of: Pause, texts: Texts): string {
  const text = of.message === "" ? reasonText(of, texts) : `${reasonText(of, texts)}: ${of.message}`;
  if (of.wait_left_s === null || of.wait_left_s === undefined) return text;
  return fill(texts.pause.waitLeft, { text, seconds: Math.ceil(of.wait_left_s) });
}

/** One text for each move: "X to 30.000, Y to 5.000" */
export function wayTexts(of: Pause, { pause }: Texts): string[] {
  return of.way.map((move) => Object.entries(move).map(([axis, to]) => fill(pause.move, { axis, to: fixed(to, 3) })).join(", "));
}

/** Whether axes may be jogged and touched off: in an idle machine, and in a pause. */
export function mayHandle({ mode, pause }: { mode: string; pause?: Maybe<Pause> }): boolean {
  return mode === "Idle" || (mode === "Paused" && Boolean(pause));
}
