// Which axes a machine's jog pad and keys move, and how fast.
import type { JogAxis, Machine, MachineAxis } from "../api/contract";
import type { Direction } from "./dead_man";

/** Keys as on other controls: arrows for the first two axes, Page Up and Page Down for the third. */
export function keyDirections(machine: Machine): Record<string, Direction> {
  const [first, second, third] = machine.axes.map((axis) => axis.name);
  const keys: Record<string, Direction> = {};
  if (first !== undefined) Object.assign(keys, { ArrowRight: { [first]: 1 }, ArrowLeft: { [first]: -1 } });
  if (second !== undefined) Object.assign(keys, { ArrowUp: { [second]: 1 }, ArrowDown: { [second]: -1 } });
  if (third !== undefined) Object.assign(keys, { PageUp: { [third]: 1 }, PageDown: { [third]: -1 } });
  return keys;
}

/** The axis's speed at a share of its greatest, less if it is not homed; undefined if it may not jog. */
export function jogVelocity(axis: MachineAxis, isHomed: boolean, share: number): number | undefined {
  const most = isHomed ? axis.max_velocity : axis.unhomed_jog_velocity;
  if (most === null || most === undefined) return undefined;
  return Math.min(most, share * axis.max_velocity);
}

/** The body of a jog command; axes that may not jog are left out. */
export function jogAxes(
  machine: Machine, isHomed: (axis: string) => boolean, direction: Direction, share: number, distance: number | undefined,
): JogAxis[] {
  return machine.axes.flatMap((axis) => {
    const sign = direction[axis.name];
    const velocity = sign === undefined ? undefined : jogVelocity(axis, isHomed(axis.name), share);
    if (sign === undefined || velocity === undefined) return [];
    const jog = { axis: axis.name, velocity: sign * velocity };
    return [distance === undefined ? jog : { ...jog, distance }];
  });
}
