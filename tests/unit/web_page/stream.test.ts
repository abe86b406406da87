import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { StateStream } from "../../../clients/web/page/src/state/stream";

const listener = { changed: () => undefined, denied: () => undefined };
let connections: AbortSignal[];

/** A server that takes connections, sends `first` or nothing, and then no more. */
function serverThatFallsSilent(first?: string) {
  const answer = (signal: AbortSignal) =>
    new Promise((resolve, reject) => {
      connections.push(signal);
      signal.addEventListener("abort", () => reject(signal.reason));
      if (first === undefined) return;
      const body = new ReadableStream({
        start(stream) {
          stream.enqueue(new TextEncoder().encode(first));
          signal.addEventListener("abort", () => stream.error(signal.reason));
        },
      });
      resolve(new Response(body));
    });
  const unanswered = new Promise(() => undefined);
  vi.stubGlobal("fetch", (path: string, options: { signal: AbortSignal }) =>
    path === "/api/events" ? answer(options.signal) : unanswered,
  );
}

beforeEach(() => {
  connections = [];
  vi.useFakeTimers({ toFake: ["setTimeout", "setInterval", "performance"] });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test.each([
  ["before its first event", undefined],
  ["after its first event", "event: state\nid: 1\ndata: {}\n\n"],
])("a connection that falls silent %s is opened again", async (_, first) => {
  serverThatFallsSilent(first);
  const stream = new StateStream(listener);
  void stream.run();
  await vi.advanceTimersByTimeAsync(11_000);
  expect(connections.map(({ aborted }) => aborted)).toEqual([false]);
  await vi.advanceTimersByTimeAsync(3_000);
  expect(connections.map(({ aborted }) => aborted)).toEqual([true, false]);
});
