import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { StateStream } from "../../../clients/web/page/src/state/stream";

const denied = () => undefined;
const EVENT = "event: state\nid: 1\ndata: {}\n\n";
let connections: AbortSignal[];

const unanswered = (signal: AbortSignal | undefined) =>
  new Promise<Response>((_, reject) => signal?.addEventListener("abort", () => reject(signal.reason)));

/** An answer that begins with `first` and does not end. */
function unending(first: string, signal: AbortSignal): Response {
  return new Response(
    new ReadableStream({
      start(body) {
        body.enqueue(new TextEncoder().encode(first));
        signal.addEventListener("abort", () => body.error(signal.reason));
      },
    }),
  );
}

/** A server that takes connections, sends `first` or nothing, and then no more. It does not answer `lostProbes` probes. */
function serverThatFallsSilent(first: string | undefined, lostProbes = Infinity) {
  vi.stubGlobal("fetch", async (path: string, { signal }: { signal: AbortSignal }) => {
    if (path === "/api/session") return lostProbes-- > 0 ? unanswered(signal) : new Response('{"role":"view"}');
    connections.push(signal);
    return first === undefined ? unanswered(signal) : unending(first, signal);
  });
}

beforeEach(() => {
  connections = [];
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "setInterval", "performance"] });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test.each([
  ["before its first event", undefined],
  ["after its first event", EVENT],
])("a connection that falls silent %s is opened again", async (_, first) => {
  serverThatFallsSilent(first);
  const stream = new StateStream(denied);
  void stream.run();
  await vi.advanceTimersByTimeAsync(11_000);
  expect(connections.map(({ aborted }) => aborted)).toEqual([false]);
  await vi.advanceTimersByTimeAsync(3_000);
  expect(connections.map(({ aborted }) => aborted)).toEqual([true, false]);
});

test("a probe that is not answered ends, and the next one proves the connection", async () => {
  serverThatFallsSilent(EVENT, 1);
  const stream = new StateStream(denied);
  void stream.run();
  await vi.advanceTimersByTimeAsync(3_000);
  expect(performance.now() - stream.contact_ms).toBeGreaterThan(2_900);
  await vi.advanceTimersByTimeAsync(2_000);
  expect(performance.now() - stream.contact_ms).toBeLessThan(1_000);
});
