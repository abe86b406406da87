// Alarms as a person counts them: the same fault of several axes or motors is one.
import type { Alarm } from "../api/contract";

export interface AlarmGroup {
  readonly alarm: Alarm;
  /** Both are empty for an alarm of the whole machine. */
  readonly axes: readonly string[];
  readonly motors: readonly string[];
}

/** Groups are in the order of their first alarms. A fault of the machine includes the same fault of its axes and motors. */
export function groupedAlarms(alarms: readonly Alarm[]): AlarmGroup[] {
  const groups = new Map<string, Alarm[]>();
  for (const alarm of alarms) {
    const { severity, number, code, cause, remedy } = alarm;
    const key = JSON.stringify([severity, number, code, cause, remedy]);
    groups.set(key, [...(groups.get(key) ?? []), alarm]);
  }
  return [...groups.values()].map((same) => {
    const isOfMachine = same.some(({ axis, motor }) => !axis && !motor);
    const names = (of: (alarm: Alarm) => string | null | undefined) => (isOfMachine ? [] : same.flatMap((alarm) => of(alarm) || []));
    return { alarm: same[0]!, axes: names(({ axis }) => axis), motors: names(({ motor }) => motor) };
  });
}
