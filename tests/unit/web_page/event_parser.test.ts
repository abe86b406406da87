import { describe, expect, test } from "vitest";
import { EventParser } from "../../../clients/web/page/src/state/event_parser";
import { LiveState } from "../../../clients/web/page/src/state/live_state";

const STREAM = 'event: stream\ndata: {"stream":"s1"}\n\nevent: state\nid: 1\ndata: {"mode":"Idle",\ndata: "viewers":1}\n\n: still here\n\nevent: delta\r\nid: 2\r\ndata: {"viewers":2}\r\n\r\n';

describe("the event stream", () => {
  test("is read whole", () => {
    expect(new EventParser().take(STREAM)).toEqual([
      { name: "stream", data: '{"stream":"s1"}', id: "" },
      { name: "state", data: '{"mode":"Idle",\n"viewers":1}', id: "1" },
      { name: "delta", data: '{"viewers":2}', id: "2" },
    ]);
  });

  test("gives the same events wherever it is cut", () => {
    const whole = new EventParser().take(STREAM);
    for (let cut = 0; cut <= STREAM.length; ++cut) {
      const parser = new EventParser();
      expect([...parser.take(STREAM.slice(0, cut)), ...parser.take(STREAM.slice(cut))]).toEqual(whole);
    }
  });

  test("becomes a state, the name of the connection, and the place to resume from", () => {
    const live = new LiveState();
    for (const event of new EventParser().take(STREAM)) live.take(event);
    expect({ ...live.state }).toEqual({ mode: "Idle", viewers: 2 });
    expect([live.stream, live.resumeFrom]).toEqual(["s1", "2"]);
    live.disconnected();
    expect([live.stream, live.resumeFrom]).toEqual(["", "2"]);
  });

  test("passes over a patch without a state", () => {
    const live = new LiveState();
    live.take({ name: "delta", data: "{}", id: "5" });
    expect(live.state).toBeUndefined();
    expect(live.resumeFrom).toBe("");
  });
});
