// Alarms as a person counts them: the same fault of several axes is one.
import type { Alarm } from "../api/contract";

export interface AlarmGroup {
  readonly alarm: Alarm;
  /** Empty for an alarm of the whole machine. */
  readonly axes: readonly string[];
}

/** Groups are in the order of their first alarms. A fault of the machine includes the same fault of its axes. */
export function groupedAlarms(alarms: readonly Alarm[]): AlarmGroup[] {
  const groups = new Map<string, Alarm[]>();
  for (const alarm of alarms) {
    const { severity, number, code, cause, remedy } = alarm;
    const key = JSON.stringify([severity, number, code, cause, remedy]);
    groups.set(key, [...(groups.get(key) ?? []), alarm]);
  }
  return [...groups.values()].map((same) => {
    const axes = same.map(({ axis }) => axis ?? "");
    return { alarm: same[0]!, axes: axes.includes("") ? [] : axes };
  });
}
