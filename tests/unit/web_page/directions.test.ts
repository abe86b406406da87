import { expect, test } from "vitest";
import type { Machine } from "../../../clients/web/page/src/api/contract";
import { jogAxes, jogVelocity, keyDirections } from "../../../clients/web/page/src/jog/directions";

const axis = (name: string, unhomed_jog_velocity: number | null) =>
  ({ name, kind: "linear", unit: "mm", position_min: 0, position_max: 10, max_velocity: 100, unhomed_jog_velocity }) as const;
const machine = { axes: [axis("X", 10), axis("Y", null), axis("Z", 5)] } as unknown as Machine;

test("arrow keys move the first two axes, the page keys the third", () => {
  expect(keyDirections(machine)).toEqual({
    ArrowRight: { X: 1 }, ArrowLeft: { X: -1 }, ArrowUp: { Y: 1 }, ArrowDown: { Y: -1 }, PageUp: { Z: 1 }, PageDown: { Z: -1 },
  });
});

test("an axis that is not homed jogs slowly or not at all", () => {
  expect(jogVelocity(machine.axes[0]!, true, 0.5)).toBe(50);
  expect(jogVelocity(machine.axes[0]!, false, 0.5)).toBe(10);
  expect(jogVelocity(machine.axes[0]!, false, 0.02)).toBe(2);
  expect(jogVelocity(machine.axes[1]!, false, 0.5)).toBeUndefined();
});

test("a jog's body has signed speeds, the distance, and only axes that may move", () => {
  expect(jogAxes(machine, () => true, { X: -1, Y: 1 }, 0.1, undefined)).toEqual([{ axis: "X", velocity: -10 }, { axis: "Y", velocity: 10 }]);
  expect(jogAxes(machine, () => false, { X: -1, Y: 1 }, 1, 0.1)).toEqual([{ axis: "X", velocity: -10, distance: 0.1 }]);
});
