import { describe, expect, test } from "vitest";
import { JogStepper, MOST_WAITING, REPEAT_AFTER_MS } from "../../../clients/web/page/src/jog/stepper";

const PERIOD_MS = 50;
const starts = (requests: readonly { kind: string }[]) => requests.filter(({ kind }) => kind === "start").length;

/** How many steps a press of `held_ms` begins, if a step lasts `step_ms`. */
function stepsOf(held_ms: number, step_ms: number): number {
  const stepper = new JogStepper(PERIOD_MS);
  let steps = starts(stepper.press("X+", { X: 1 }, 0));
  let complete_ms = step_ms;
  for (let now = 0; now < held_ms + 5000; now += 10) {
    if (now === Math.ceil(held_ms / 10) * 10) stepper.release("X+");
    const begun = starts(stepper.isStepping() && now >= complete_ms ? stepper.complete(now) : stepper.tick(now));
    if (begun > 0) complete_ms = now + step_ms;
    steps += begun;
  }
  return steps;
}

describe("a step jog", () => {
  test.each([0, 60, 200])("of a press of %i ms is one step, however long it lasts", (held_ms) => {
    for (const step_ms of [20, 300, 2000]) expect(stepsOf(held_ms, step_ms)).toBe(1);
  });

  test("repeats while it is held", () => {
    expect(stepsOf(REPEAT_AFTER_MS + 1000, 100)).toBeGreaterThan(8);
    expect(stepsOf(REPEAT_AFTER_MS + 1000, 1200)).toBe(2);
  });

  test("asks until it is complete, and never stops", () => {
    const stepper = new JogStepper(PERIOD_MS);
    expect(stepper.press("X+", { X: 1 }, 0)).toEqual([{ kind: "start", direction: { X: 1 } }]);
    stepper.release("X+");
    expect([10, 49, 50, 60, 100].map((now) => stepper.tick(now).length)).toEqual([0, 0, 1, 0, 1]);
    expect(stepper.complete(120)).toEqual([]);
    expect(stepper.tick(1000)).toEqual([]);
  });

  test("counts each click, up to a bound", () => {
    const stepper = new JogStepper(PERIOD_MS);
    for (let click = 0; click < 10; ++click) {
      stepper.press("X+", { X: 1 }, click);
      stepper.release("X+");
    }
    let steps = 1;
    for (let now = 100; stepper.isStepping(); now += 100) steps += starts(stepper.complete(now));
    expect(steps).toBe(1 + MOST_WAITING);
  });

  test("takes a repeated key for the same press", () => {
    const stepper = new JogStepper(PERIOD_MS);
    stepper.press("key", { Y: -1 }, 0);
    expect(stepper.press("key", { Y: -1 }, 30)).toEqual([]);
    expect(stepper.complete(60)).toEqual([]);
  });

  test("drops what waits when the page lets go of everything", () => {
    const stepper = new JogStepper(PERIOD_MS);
    stepper.press("X+", { X: 1 }, 0);
    stepper.press("Y+", { Y: 1 }, 10);
    stepper.releaseAll();
    expect(stepper.isStepping()).toBe(true);
    expect(stepper.complete(700)).toEqual([]);
  });
});
