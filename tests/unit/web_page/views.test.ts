import { describe, expect, test } from "vitest";
import type { AxisState, MachineAxis, MachineOutput, Offsets, Pause } from "../../../clients/web/page/src/api/contract";
import { noAnswer, problemOf } from "../../../clients/web/page/src/api/result";
import { Trace } from "../../../clients/web/page/src/chart/trace";
import { History, MOST_LINES } from "../../../clients/web/page/src/mdi/history";
import { fixed } from "../../../clients/web/page/src/format/numbers";
import { timeOfDay } from "../../../clients/web/page/src/format/times";
import { speedTexts, unitTexts } from "../../../clients/web/page/src/format/units";
import { phaseLook, phaseText, troubleText } from "../../../clients/web/page/src/state/axis_texts";
import { deviceTexts } from "../../../clients/web/page/src/state/device_texts";
import { groupedAlarms } from "../../../clients/web/page/src/state/grouped_alarms";
import { inputTexts } from "../../../clients/web/page/src/state/input_texts";
import { outputTexts } from "../../../clients/web/page/src/state/output_texts";
import { otherWriter } from "../../../clients/web/page/src/state/other_writer";
import { pageRemedy } from "../../../clients/web/page/src/state/page_remedy";
import { mayHandle, pauseText, wayTexts } from "../../../clients/web/page/src/state/pause_texts";
import { placeText } from "../../../clients/web/page/src/state/place_text";
import { switchesText } from "../../../clients/web/page/src/state/switches_text";
import { shownMode } from "../../../clients/web/page/src/state/shown_mode";
import { en } from "../../../clients/web/page/src/texts/en";
import { workPlace } from "../../../clients/web/page/src/views/axes/axis_places";
import { shortcutVerb } from "../../../clients/web/page/src/views/shortcuts";

describe("work coordinates", () => {
  const offsets: Offsets = { revision: 1, active: "G54", systems: { G54: { origin: { X: 10, Y: 20 }, rotation_deg: 0 } }, g92: { Z: 5 } };

  test("take off the origin and G92", () => {
    expect(workPlace({ X: 15, Y: 20, Z: 7 }, offsets)).toEqual({ X: 5, Y: 0, Z: 2 });
  });

  test("undo a rotation about Z", () => {
    const turned = { ...offsets, systems: { G54: { origin: {}, rotation_deg: 90 } }, g92: null };
    const place = workPlace({ X: 0, Y: 3 }, turned);
    expect([place["X"], place["Y"]!].map((v) => Math.round(v! * 1e9) / 1e9)).toEqual([3, 0]);
  });

  test("leave an unknown position unknown", () => {
    expect(workPlace({ X: undefined, Y: 1 }, offsets)).toEqual({ X: undefined, Y: -19 });
  });
});

describe("a pause", () => {
  const change: Pause = { reason: "tool-change", tool: 2, message: "6 mm end mill", way: [{ Z: 20 }, { X: 30, Y: 5.5 }, { Z: -1.5 }] };

  test("says what to do", () => {
    expect(pauseText(change, en)).toBe("Change to tool 2: 6 mm end mill");
    expect(pauseText({ ...change, tool: 0, message: "" }, en)).toBe("Take out the tool");
    expect(pauseText({ reason: "program-stop", message: "turn it over", way: [] }, en)).toBe("Program stop: turn it over");
  });

  test("says how long the wait for an input may still last", () => {
    expect(pauseText({ reason: "input", message: "until clamp is closed", wait_left_s: 6.2, way: [] }, en)).toBe("Waits for an input: until clamp is closed (7 s left)");
  });

  test("lists the moves back to its place", () => {
    expect(wayTexts(change, en)).toEqual(["Z to 20.000", "X to 30.000, Y to 5.500", "Z to −1.500"].map((text) => text.replace("−", fixed(-1, 0)[0]!)));
  });

  test("lets a person jog and touch off, and a hold within a move does not", () => {
    expect(mayHandle({ mode: "Paused", pause: change })).toBe(true);
    expect(mayHandle({ mode: "Holding", pause: null })).toBe(false);
    expect(mayHandle({ mode: "Running", pause: change })).toBe(false);
    expect(mayHandle({ mode: "Idle" })).toBe(true);
  });
});

describe("the history of lines", () => {
  test("is walked back and forth, and keeps what was being written", () => {
    const history = new History(["G0 X1", "G0 X2"]);
    expect([history.earlier("G1"), history.earlier(""), history.earlier(""), history.later(), history.later()]).toEqual(
      ["G0 X2", "G0 X1", "G0 X1", "G0 X2", "G1"]);
  });

  test("keeps a line once, and no more than it may", () => {
    const history = new History();
    ["a", "a", " ", "b"].forEach((line) => history.add(line));
    expect(history.all()).toEqual(["a", "b"]);
    for (let i = 0; i < 2 * MOST_LINES; ++i) history.add(`l${i}`);
    expect(history.all()).toHaveLength(MOST_LINES);
  });
});

describe("the trace of a chart", () => {
  test("has the last seconds, the oldest first, in bounded memory", () => {
    const trace = new Trace(1, 4);
    for (let s = 1; s <= 6; ++s) trace.add(s, [10 * s]);
    expect(trace.since(6, 2.5)).toEqual([[-2, -1, 0], [40, 50, 60]]);
    expect(trace.since(6, 100)[0]).toHaveLength(4);
  });

  test("has gaps where a value is missing", () => {
    const trace = new Trace(2, 4);
    trace.add(1, [1, null]);
    expect(trace.since(1, 5)).toEqual([[0], [1], [null]]);
  });
});

describe("devices", () => {
  test("that are off are not shown", () => {
    expect(deviceTexts(null, en)).toEqual([]);
    expect(deviceTexts({ spindle: { direction: "stopped", rpm: 0 }, mist: false, flood: false, tool: null, outputs: [] }, en)).toEqual([]);
  });

  test("that are on have a text each, the spindle first", () => {
    expect(deviceTexts({ spindle: { direction: "reverse", rpm: 12000 }, mist: true, flood: true, tool: 3, outputs: [0, 2] }, en)).toEqual(
      ["Spindle reverse 12000 rpm", "Mist", "Flood", "Tool 3", "Output 0", "Output 2"]);
    expect(deviceTexts({ spindle: { direction: "forward", rpm: 799.6 } }, en)).toEqual(["Spindle forward 800 rpm"]);
  });
});

describe("a remedy on the page", () => {
  test("names the page's buttons instead of shell commands", () => {
    expect(pageRemedy("find out why the axis reached the switch; then: {reset}, {home}", en)).toBe(
      "Remedy: find out why the axis reached the switch; then: Reset, Home");
    expect(pageRemedy("{status}, {reset}", en)).toBe("Remedy: this page, Reset");
    expect(pageRemedy("use longer slots: {timing}; then: {reset}", en)).toMatch(/^Remedy, in a shell.*: lockstep doctor --timing; then: Reset$/);
  });

  test("says where to type the other shell commands", () => {
    expect(pageRemedy("check whether the machine is up: lockstep up", en)).toBe(
      "Remedy, in a shell on the machine's host: check whether the machine is up: lockstep up");
    expect(pageRemedy("see the axis's log, and start its lockstep-axis if it is not running", en)).toMatch(/^Remedy: see/);
  });
});

describe("units", () => {
  test("are those of the axes, each once", () => {
    const axes = [{ unit: "mm" }, { unit: "mm" }, { unit: "deg" }] as MachineAxis[];
    expect(unitTexts(axes)).toBe("mm, °");
    expect(unitTexts(axes, "/s")).toBe("mm/s, °/s");
  });

  test("are those of speeds, too: the greatest of each unit", () => {
    const axes = [{ name: "X", unit: "mm" }, { name: "Y", unit: "mm" }, { name: "A", unit: "deg" }] as MachineAxis[];
    const speeds: Record<string, number> = { X: 25, Y: 50, A: 90 };
    expect(speedTexts(axes, ({ name }) => speeds[name]!)).toBe("50.0 mm/s, 90.0 °/s");
    expect(speedTexts(axes.slice(2), () => 7)).toBe("7.0 °/s");
  });
});

describe("another writer", () => {
  const writer = { name: "anna", host: "bench", since: "2026-03-01T12:00:00Z", is_this_server: false };

  test("is named to those who may take the machine over", () => {
    expect(otherWriter({ mode: "Idle", writer }, "operate")).toEqual(writer);
    expect(otherWriter({ mode: "Idle", writer }, "view")).toBeUndefined();
    expect(otherWriter({ mode: "Idle", writer: { ...writer, is_this_server: true } }, "operate")).toBeUndefined();
    expect(otherWriter({ mode: "Unreachable", writer }, "operate")).toBeUndefined();
    expect(otherWriter({ mode: "Idle", writer: null }, "operate")).toBeUndefined();
  });

  test("has had the machine since a time of the day", () => {
    expect(timeOfDay("2026-03-01T12:05:00")).toBe("12:05");
    expect(timeOfDay("never")).toBe("–");
  });
});

describe("alarms", () => {
  const stop = { severity: "fault", number: 118, code: "emergency-stopped", cause: "c", remedy: "r" } as const;
  const silent = { severity: "warning", number: 0, code: "axis-not-received", cause: "c", remedy: "r" } as const;

  test("of the machine stand for the same of its axes", () => {
    const groups = groupedAlarms([stop, { ...stop, axis: "X" }, { ...stop, axis: "Y" }, { ...silent, axis: "Y" }]);
    expect(groups.map(({ alarm, axes }) => [alarm.code, axes])).toEqual([["emergency-stopped", []], ["axis-not-received", ["Y"]]]);
  });

  test("of several axes are one, and others stay apart", () => {
    const groups = groupedAlarms([{ ...silent, axis: "X" }, { ...silent, axis: "Z" }, { ...silent, axis: "Y", cause: "other" }]);
    expect(groups.map(({ axes }) => axes)).toEqual([["X", "Z"], ["Y"]]);
    expect(groupedAlarms([])).toEqual([]);
  });
});

describe("what a fault is about", () => {
  test("is one axis, several motors, or the machine", () => {
    const none = { axes: [], motors: [], boards: [] };
    expect(placeText({ ...none, axes: ["X"] }, en)).toBe("Axis X");
    expect(placeText({ ...none, motors: ["Y2"] }, en)).toBe("Motor Y2");
    expect(placeText({ axes: ["X", "Z"], motors: ["Y1", "Y2"], boards: ["IO"] }, en)).toBe("Axes X, Z, Motors Y1, Y2, Board IO");
    expect(placeText(none, en)).toBe("");
  });

  test("is not the machine where a board has it", () => {
    const lost = { severity: "fault", number: 120, code: "device-lost", cause: "c", remedy: "r" } as const;
    expect(groupedAlarms([{ ...lost, board: "IO" }]).map(({ axes, motors, boards }) => [axes, motors, boards])).toEqual([[[], [], ["IO"]]]);
  });

  test("is not the machine where a motor has it", () => {
    const limit = { severity: "fault", number: 103, code: "limit-hit", cause: "c", remedy: "r" } as const;
    expect(groupedAlarms([{ ...limit, motor: "Y2" }, { ...limit, axis: "X" }]).map(({ axes, motors }) => [axes, motors])).toEqual([[["X"], ["Y2"]]]);
    expect(groupedAlarms([limit, { ...limit, motor: "Y2" }]).map(({ axes, motors }) => [axes, motors])).toEqual([[[], []]]);
  });
});

describe("the inputs", () => {
  const machine = [
    { name: "stop", motor: "X", use: "emergency-stop" }, { name: "door", motor: "X", use: "door" }, { name: "part", motor: "X", use: "program", number: 0 },
  ] as const;

  test("have the words and the look of what they do", () => {
    expect(inputTexts(machine, { stop: true, door: true, part: false }, en)).toEqual([
      { text: "stop: emergency stop pressed", look: "bad" }, { text: "door: door open", look: "warning" }, { text: "part: open", look: "good" },
    ]);
  });

  test("that were not received are left out", () => {
    expect(inputTexts(machine, { part: true }, en)).toEqual([{ text: "part: closed", look: "busy" }]);
  });
});

describe("outputs", () => {
  const machine: MachineOutput[] = [{ name: "laser", motor: "X", kind: "analog" }, { name: "air", motor: "Y", kind: "digital" }, { name: "camera", motor: "Y", kind: "pulses" }];
  const digital = (on: boolean | null, asked: number) => ({ on, value: null, pulses: null, asked });
  const analog = (value: number | null, asked: number) => outputTexts(machine, { laser: { on: null, value, pulses: null, asked } }, en)[0];

  test("have the levels and values that their devices report", () => {
    expect(analog(0.305, 0.305)).toEqual({ text: "laser: 30.5 %", look: "busy" });
    expect(analog(0, 0)).toEqual({ text: "laser: 0.0 %", look: "good" });
    expect(outputTexts(machine, { air: digital(true, 1) }, en)).toEqual([{ text: "air: on", look: "busy" }]);
  });

  test("that are analog say what the program asks for where it differs, a warning where it asks for none", () => {
    expect(analog(0.1, 0.3)).toEqual({ text: "laser: 10.0 % (program: 30.0 %)", look: "busy" });
    expect(analog(0.1, 0)).toEqual({ text: "laser: 10.0 % (program: 0.0 %)", look: "warning" });
    expect(analog(null, 0.3)).toEqual({ text: "laser: 30.0 % (program)", look: "busy" });
  });

  test("with pulses at places say how many are left", () => {
    const camera = (pulses: { left: number; of: number } | null) => outputTexts(machine, { camera: { on: null, value: null, pulses, asked: 0 } }, en);
    expect(camera({ left: 7, of: 100 })).toEqual([{ text: "camera: 7 of 100 pulses left", look: "busy" }]);
    expect(camera({ left: 0, of: 100 })).toEqual([{ text: "camera: no pulses left", look: "good" }]);
    expect(camera(null)).toEqual([{ text: "camera: no pulses left", look: "good" }]);
  });

  test("say where the pin and the program differ, and that a pin is not known", () => {
    const text = (on: boolean | null) => outputTexts(machine, { air: digital(on, 1) }, en);
    expect(text(false)).toEqual([{ text: "air: off (program: on)", look: "warning" }]);
    expect(text(null)).toEqual([{ text: "air: not known (program: on)", look: "busy" }]);
  });
});

describe("a motor", () => {
  const rest: AxisState = { present: true, state: "Standby", homed: true, following_error_steps: 0, corrected_steps: 0, fault: null, unproved: null, switches: [] };
  const fault = { number: 103, code: "limit-hit", motor: "Y2", cause: "a limit switch closed", remedy: "" };

  test("has its closed switches in words", () => {
    expect(switchesText([], en)).toBe("");
    expect(switchesText(["limit_max", "home"], en)).toBe("Closed: limit switch at the upper end, home switch");
  });

  test("is named in the trouble of its axis", () => {
    expect(troubleText({ ...rest, fault, following_error_steps: 3 }, en)).toBe("Motor Y2: limit-hit: a limit switch closed · Following error: 3 steps");
    expect(troubleText(rest, en)).toBe("");
  });

  test("says how many lost steps it has made up", () => {
    expect(troubleText({ ...rest, corrected_steps: 20 }, en)).toBe("Lost steps made up: 20");
  });

  test("that is not received says so", () => {
    expect([phaseText({ ...rest, present: false }, en), phaseLook({ ...rest, present: false })]).toEqual(["Not received", "bad"]);
    expect([phaseText(rest, en), phaseLook(rest)]).toEqual(["Standby", "good"]);
  });
});

describe("the mode", () => {
  test("of a hold tells braking from rest", () => {
    expect(shownMode({ mode: "Holding", hold: { state: "braking" } })).toBe("Holding");
    expect(shownMode({ mode: "Holding", hold: { state: "held" } })).toBe("Paused");
    expect(shownMode({ mode: "Paused", hold: { state: "held" } })).toBe("Paused");
    expect(shownMode({ mode: "Running", hold: null })).toBe("Running");
  });
});

describe("keys anywhere on the page", () => {
  const key = (name: string, more = {}) => shortcutVerb({ key: name, repeat: false, ctrlKey: false, altKey: false, metaKey: false, ...more });

  test("stop, hold and resume", () => {
    expect(["F1", "Escape", "F2", "F4", "a", " "].map((name) => key(name))).toEqual(["estop", "stop", "hold", "resume", undefined, undefined]);
  });

  test("do nothing with a modifier or by repetition", () => {
    expect([key("F4", { altKey: true }), key("F1", { repeat: true })]).toEqual([undefined, undefined]);
  });
});

describe("an answer that is an error", () => {
  test("is the server's problem where it is one", () => {
    const problem = { type: "about:blank", title: "Not homed", status: 409, code: "not-homed", detail: "axis X" };
    expect(problemOf(409, "Conflict", JSON.stringify(problem))).toEqual(problem);
  });

  test("still names its status where it is none", () => {
    expect(problemOf(502, "Bad Gateway", "<html>").code).toBe("http-502");
    expect(noAnswer("x").code).toBe("no-answer");
  });
});
