import { describe, expect, test } from "vitest";
import { JogDeadMan } from "../../../clients/web/page/src/jog/dead_man";

const PERIOD_MS = 50;

describe("the jog's dead man", () => {
  test("starts with the press, renews while it is held, stops with the release", () => {
    const jog = new JogDeadMan(PERIOD_MS);
    expect(jog.press("key", { X: 1 }, 0)).toEqual([{ kind: "start", direction: { X: 1 } }]);
    expect([10, 49, 50, 60, 100].map((now) => jog.tick(now).length)).toEqual([0, 0, 1, 0, 1]);
    expect(jog.release("key", 110)).toEqual([{ kind: "stop" }]);
    expect(jog.tick(1000)).toEqual([]);
  });

  test("takes a repeated key for the same press", () => {
    const jog = new JogDeadMan(PERIOD_MS);
    jog.press("key", { X: 1 }, 0);
    expect(jog.press("key", { X: 1 }, 30)).toEqual([]);
  });

  test("joins two keys, and goes on with the one that is still held", () => {
    const jog = new JogDeadMan(PERIOD_MS);
    jog.press("right", { X: 1 }, 0);
    expect(jog.press("up", { Y: 1 }, 5)).toEqual([{ kind: "start", direction: { X: 1, Y: 1 } }]);
    expect(jog.release("right", 9)).toEqual([{ kind: "start", direction: { Y: 1 } }]);
    expect(jog.release("up", 12)).toEqual([{ kind: "stop" }]);
  });

  test("stops where two keys oppose each other", () => {
    const jog = new JogDeadMan(PERIOD_MS);
    jog.press("right", { X: 1 }, 0);
    expect(jog.press("left", { X: -1 }, 5)).toEqual([{ kind: "stop" }]);
    expect(jog.tick(500)).toEqual([]);
  });

  test.each(["blur", "hidden", "refused"] as const)("lets go of everything with %s, until a key is pressed anew", (reason) => {
    const jog = new JogDeadMan(PERIOD_MS);
    jog.press("right", { X: 1 }, 0);
    jog.press("up", { Y: 1 }, 0);
    expect(jog.releaseAll(reason, 20)).toEqual([{ kind: "stop" }]);
    expect(jog.release("right", 30)).toEqual([]);
    expect(jog.tick(500)).toEqual([]);
    expect(jog.isMoving()).toBe(false);
  });

  test("never renews without a held key, whatever the order of events", () => {
    let seed = 7;
    const random = (n: number) => (seed = (seed * 48271) % 0x7fffffff) % n;
    for (let round = 0; round < 200; ++round) {
      const jog = new JogDeadMan(PERIOD_MS);
      const held = new Set<string>();
      let moving = false;
      for (let now = 0; now < 2000; now += random(40)) {
        const holder = `k${random(3)}`, kind = random(8);
        const asked = kind < 3 ? jog.press(holder, { [holder]: 1 }, now) : kind < 6 ? jog.release(holder, now)
          : kind === 6 ? jog.tick(now) : jog.releaseAll("blur", now);
        if (kind < 3) held.add(holder);
        else if (kind < 6) held.delete(holder);
        else if (kind === 7) held.clear();
        for (const request of asked) {
          if (request.kind === "renew") expect(moving).toBe(true);
          moving = request.kind !== "stop";
        }
        expect(moving).toBe(held.size > 0);
      }
    }
  });
});
