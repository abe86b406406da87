// Alarms as a person counts them: the same fault of several axes, motors or boards is one.
import type { Alarm } from "../api/contract";
import type { FaultyParts } from "./place_text";

/** All lists are empty for an alarm of the whole machine. */
export interface AlarmGroup extends FaultyParts {
  readonly alarm: Alarm;
}

/** Groups are in the order of their first alarms. A fault of the machine includes the same fault of its parts. */
export function groupedAlarms(alarms: readonly Alarm[]): AlarmGroup[] {
  const groups = new Map<string, Alarm[]>();
  for (const alarm of alarms) {
    const { severity, number, code, cause, remedy } = alarm;
    const key = JSON.stringify([severity, number, code, cause, remedy]);
    groups.set(key, [...(groups.get(key) ?? []), alarm]);
  }
  return [...groups.values()].map((same) => {
    const isOfMachine = same.some(({ axis, motor, board }) => !axis && !motor && !board);
    const names = (of: (alarm: Alarm) => string | null | undefined) => (isOfMachine ? [] : same.flatMap((alarm) => of(alarm) || []));
    return { alarm: same[0]!, axes: names(({ axis }) => axis), motors: names(({ motor }) => motor), boards: names(({ board }) => board) };
  });
}
