// The parts of the machine that have a fault, in words: axes, motors, boards, or the whole machine.
import { fill } from "../texts/fill";
import type { Texts } from "../texts/en";

export interface FaultyParts {
  readonly axes: readonly string[];
  readonly motors: readonly string[];
  readonly boards: readonly string[];
}

/** "Axis X", "Motors Y1, Y2", "Axes X, Z, Motor Y2, Board IO"; empty for the whole machine. */
export function placeText({ axes, motors, boards }: FaultyParts, { alarms }: Pick<Texts, "alarms">): string {
  const parts = [
    axes.length === 0 ? "" : axes.length === 1 ? fill(alarms.axis, { axis: axes[0]! }) : fill(alarms.axes, { axes: axes.join(", ") }),
    motors.length === 0 ? "" : motors.length === 1 ? fill(alarms.motor, { motor: motors[0]! }) : fill(alarms.motors, { motors: motors.join(", ") }),
    boards.length === 0 ? "" : boards.length === 1 ? fill(alarms.board, { board: boards[0]! }) : fill(alarms.boards, { boards: boards.join(", ") }),
  ];
  return parts.filter((part) => part !== "").join(", ");
}
