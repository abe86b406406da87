import { describe, expect, test } from "vitest";
import { OneAtATime, STOP_WAITS_MS } from "../../../clients/web/page/src/jog/one_at_a_time";

/** Requests that are answered, and time that passes, when the test says so. */
function fixture() {
  const sent: { body: string; signal: AbortSignal; answer: (followed: boolean) => void }[] = [];
  const timers: { ms: number; action: () => void }[] = [];
  let refusals = 0;
  const requests = new OneAtATime<string>(
    (body, signal) => new Promise((resolve) => {
      sent.push({ body, signal, answer: resolve });
      signal.addEventListener("abort", () => resolve(false));
    }),
    { after: (ms, action) => (timers.push({ ms, action }), () => undefined) }, () => ++refusals);
  const answer = async (followed = true) => {
    sent.at(-1)!.answer(followed);
    await Promise.resolve();
    await Promise.resolve();
  };
  return { requests, sent, timers, answer, refusals: () => refusals };
}

describe("jog requests", () => {
  test("wait for the one on its way, and the newest is sent", async () => {
    const f = fixture();
    f.requests.change("start");
    f.requests.renew("renew");
    f.requests.change("other direction");
    f.requests.stop("stop");
    expect(f.sent.map((s) => s.body)).toEqual(["start"]);
    await f.answer();
    expect(f.sent.map((s) => s.body)).toEqual(["start", "stop"]);
  });

  test("drop renewals while one is on its way", async () => {
    const f = fixture();
    f.requests.change("start");
    f.requests.renew("renew");
    await f.answer();
    expect(f.sent).toHaveLength(1);
  });

  test("give up a request that hangs for a stop", async () => {
    const f = fixture();
    f.requests.change("start");
    f.requests.stop("stop");
    expect(f.timers.map((timer) => timer.ms)).toEqual([STOP_WAITS_MS]);
    f.timers[0]!.action();
    expect(f.sent[0]!.signal.aborted).toBe(true);
    await Promise.resolve();
    await Promise.resolve();
    expect(f.sent.map((s) => s.body)).toEqual(["start", "stop"]);
  });

  test("report a jog that the server does not follow, but not a stop", async () => {
    const f = fixture();
    f.requests.change("start");
    await f.answer(false);
    expect(f.refusals()).toBe(1);
    f.requests.stop("stop");
    await f.answer(false);
    expect(f.refusals()).toBe(1);
  });
});
