// The texts of the devices that are on, and of the tool, in the order in which they are shown.
import type { Devices, Maybe } from "../api/contract";
import { fixed } from "../format/numbers";
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

export function deviceTexts(state: Maybe<Devices>, { devices }: Texts): string[] {
  if (!state) return [];
  const { spindle, mist, flood, tool, outputs } = state;
  const texts: string[] = [];
  if (spindle?.direction === "forward") texts.push(fill(devices.forward, { rpm: fixed(spindle.rpm, 0) }));
  if (spindle?.direction === "reverse") texts.push(fill(devices.reverse, { rpm: fixed(spindle.rpm, 0) }));
  if (mist) texts.push(devices.mist);
  if (flood) texts.push(devices.flood);
  if (tool) texts.push(fill(devices.tool, { number: tool }));
  return [...texts, ...(outputs ?? []).map((number) => fill(devices.output, { number }))];
}
