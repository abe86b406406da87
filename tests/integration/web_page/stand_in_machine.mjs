// Follows commands like a machine behind lockstep-web, without a real one: for pictures, and for paths of any length.

const FAULTS = {
  emergency: { number: 118, code: "emergency-stopped", axis: null, motor: null, board: null, cause: "an emergency stop was commanded", remedy: "make sure that the machine is safe; an axis that was stopped in motion must be homed again; then: {reset}, {home}" },
};

const axis = (name, max, max_velocity) => ({
  name, kind: "linear", unit: "mm", position_min: 0, position_max: max, park: 5, start_velocity: 10, max_velocity,
  max_acceleration: 1500, steps_per_unit: 80, homed_by: "min", unhomed_jog_velocity: 5, host: null,
});

export const MACHINE = {
  name: "mill", version: "1", axes: [axis("X", 200, 150), axis("Y", 200, 150), axis("Z", 60, 25)], motors: [], boards: [], inputs: [], outputs: [], features: [], faults: {},
  coordinate_systems: ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"], slack_deadline_ms: 8, step_lateness_limit_us: 20,
  limits: { program_bytes: 50_000_000, body_bytes: 65536, jog_renew_ms: 40, jog_life_ms: 120, override_min_percent: 10, override_max_percent: 200, path_points: 1_000_000 },
};

/** A guilloche: turns of a rose, as G-code and as points. */
export function rose(segments) {
  const points = [{ x: 5, y: 5, z: 58, line: 0, rapid: false }], text = ["%", "(rose: a guilloche)", "G21 G90 F3000"];
  const turns = Math.max(7, Math.round(Math.sqrt(segments) / 8));
  const place = (i) => {
    const angle = (2 * Math.PI * turns * i) / segments, radius = 46 + 34 * Math.cos((angle * (turns + 0.4)) / turns * 5) * (0.4 + 0.6 * i / segments);
    return { x: 100 + radius * Math.cos(angle), y: 100 + radius * Math.sin(angle), z: 20 + 3 * Math.cos(angle * 5) };
  };
  const start = place(0);
  points.push({ ...start, z: 58, line: 4, rapid: true }, { ...start, z: 24, line: 5, rapid: true });
  text.push(`G0 X${start.x.toFixed(3)} Y${start.y.toFixed(3)}`, "G0 Z24");
  for (let i = 0; i <= segments - 4; ++i) {
    const p = place(i);
    text.push(`${i === 0 ? "G1 " : ""}X${p.x.toFixed(3)} Y${p.y.toFixed(3)} Z${p.z.toFixed(3)}`);
    points.push({ ...p, line: text.length, rapid: false });
  }
  text.push("G0 Z58", "M2", "%");
  points.push({ ...place(segments - 4), z: 58, line: text.length - 2, rapid: true });
  return { points, text: text.join("\n") + "\n" };
}

export function encodePath(points) {
  const view = new DataView(new ArrayBuffer(16 * points.length));
  points.forEach((p, i) => {
    [p.x, p.y, p.z].forEach((value, n) => view.setFloat32(16 * i + 4 * n, value, true));
    view.setUint32(16 * i + 12, p.line + (p.rapid ? 2 ** 31 : 0), true);
  });
  return Buffer.from(view.buffer);
}

const axisState = (position) => ({
  present: true, age_ms: 0, position, position_steps: Math.round(position * 80), velocity: 0, state: "Standby", homed: true, at_rest: true,
  following_error_steps: 0, corrected_steps: 0, clock_error_us: 0, fault: null, unproved: null, switches: [],
  health: { age_ms: 0, slack_ms: null, lateness_us: null, skew_us: null, setpoint_age_ms: null, loop_p99_us: 120, loop_max_us: 300, least_free_segments: 900, refused: 0 },
});

export class StandInMachine {
  description = MACHINE;
  commands = [];
  program = null;
  jogUntil = 0;
  endsJogs = false;
  state = {
    machine: "mill", mode: "Idle", link: { age_ms: 0, standby: false, config_differs: false }, job: null, program: null, hold: null, pause: null,
    override: { feed_percent: 100, rapid_percent: 100 }, alarms: [], axes: { X: axisState(5), Y: axisState(5), Z: axisState(58) }, motors: {}, boards: {}, inputs: {}, outputs: {},
    offsets: { revision: 1, active: "G54", systems: Object.fromEntries(MACHINE.coordinate_systems.map((s) => [s, { origin: {}, rotation_deg: 0 }])), g92: null },
    tools: { 1: { pocket: 1, offset: { Z: 42.5 }, diameter: 6 }, 2: { pocket: 2, offset: { Z: 38.1 }, diameter: 3 } }, 
    devices: { spindle: { direction: "stopped", rpm: 0 }, mist: false, flood: false, tool: null, outputs: [] }, writer: null, measurement: null,
    modes: ["G80", "G54", "G17", "G21", "G90", "G94", "M5", "M9", "T0", "F0", "S0"], viewers: 1,
  };

  /** Y is moved by Y1 and Y2. Call it before the page is opened. */
  haveTwoMotorsOnY() {
    const motor = (name) => ({ name, axes: ["Y"], unit: "mm", steps_per_unit: 80, host: null });
    this.description = { ...this.description, motors: [motor("Y1"), motor("Y2")] };
    this.state.motors = { Y1: axisState(5), Y2: axisState(5) };
    this.state.axes.Y.health = null;
  }

  /** IO is a device without a motor. Call it before the page is opened. */
  haveABoard() {
    this.description = { ...this.description, boards: [{ name: "IO", host: null }] };
    const { present, age_ms, state, clock_error_us, fault, unproved, health } = axisState(0);
    this.state.boards = { IO: { present, age_ms, state, clock_error_us, fault, unproved, health } };
  }

  /** All are open. Call it before the page is opened. */
  haveInputs() {
    const inputs = [{ name: "stop", motor: "X", board: null, use: "emergency-stop", number: null }, { name: "door", motor: "Y", board: null, use: "door", number: null }, { name: "tool", motor: "Z", board: null, use: "program", number: 3 }];
    this.description = { ...this.description, inputs };
    this.state.inputs = Object.fromEntries(inputs.map(({ name }) => [name, false]));
  }

  /** Call it before the page is opened. */
  haveAProbe() {
    this.description = { ...this.description, inputs: [{ name: "tip", motor: "Z", board: null, use: "probe", number: 0 }] };
    this.state.inputs = { tip: false };
  }

  /** All are off, as the program asks. Call it before the page is opened. */
  haveOutputs() {
    const outputs = [{ name: "laser", motor: "X", board: null, kind: "analog" }, { name: "air", motor: "Y", board: null, kind: "digital" }];
    this.description = { ...this.description, outputs };
    this.state.outputs = { laser: { on: null, value: 0, pulses: null, asked: 0 }, air: { on: false, value: null, pulses: null, asked: 0 } };
  }

  load(name, segments) {
    this.program = rose(segments);
    this.state.program = { id: (this.state.program?.id ?? 0) + 1, name, bytes: this.program.text.length, lines: this.program.text.split("\n").length - 1, blocks: segments, notes: [] };
  }

  /** @returns undefined if the command is accepted, otherwise a problem */
  command(verb, body) {
    if (verb !== "jog" || this.commands.at(-1)?.verb !== "jog" || body.jogs.length === 0) this.commands.push({ verb, body });
    const { state } = this;
    const needs = { run: "Idle", hold: "Running", resume: "Holding", home: "Idle", mdi: "Idle" }[verb];
    if ((needs !== undefined && state.mode !== needs) || (verb === "resume" && state.hold.state !== "held")) {
      return { status: 409, code: "busy", title: "The machine is doing something else", detail: `mode is ${state.mode}`, remedy: "{wait}, or: {stop}" };
    }
    this[verb]?.(body);
    return undefined;
  }

  run() {
    this.state.mode = "Running";
    this.at = 0;
    this.state.job = { number: (this.state.job?.number ?? 0) + 1, kind: "run", name: this.state.program.name, line: 1, blocks_done: 0, blocks_known: this.program.points.length, progress: 0, time_done_s: 0, time_left_s: 60, waits_for_program: false, outcome: null, ended_by: null };
  }
  hold() {
    this.state.mode = "Holding";
    this.state.hold = { state: "braking", line: this.state.job.line };
  }
  resume() {
    this.state.mode = "Running";
    this.state.hold = null;
  }
  stop() {
    if (this.state.job) Object.assign(this.state.job, { outcome: this.state.job.outcome ?? "Stopped" });
    this.end();
  }
  estop() {
    this.stop();
    this.state.mode = "Fault";
    this.state.alarms = [null, "X", "Y", "Z"].map((axis) => ({ ...FAULTS.emergency, axis, severity: "fault" }));
  }
  reset() {
    this.state.mode = "Idle";
    this.state.alarms = [];
  }
  override(body) {
    Object.assign(this.state.override, body);
  }
  jog({ jogs: asked, press, step = false }) {
    const jogs = this.endsJogs ? [] : asked;
    if (step && press === this.stepPress) return;
    this.stepPress = step ? press : undefined;
    this.left = step ? Object.fromEntries(jogs.map(({ axis, distance }) => [axis, distance])) : {};
    this.jogs = jogs;
    this.state.mode = jogs.length > 0 ? "Jogging" : "Idle";
    this.jogUntil = jogs.length > 0 ? Date.now() + MACHINE.limits.jog_life_ms : 0;
    if (jogs.length === 0) this.rest();
  }
  touch({ system = "G54", axes }) {
    for (const [name, value] of Object.entries(axes)) this.state.offsets.systems[system].origin[name] = this.state.axes[name].position - value;
  }
  offset({ system, origin = {}, rotation_deg }) {
    Object.assign(this.state.offsets.systems[system].origin, origin);
    if (rotation_deg !== undefined) this.state.offsets.systems[system].rotation_deg = rotation_deg;
  }
  tool({ number, remove, ...values }) {
    if (remove) delete this.state.tools[number];
    else this.state.tools[number] = { pocket: 0, offset: {}, diameter: 0, ...this.state.tools[number], ...values };
  }

  end() {
    this.state.mode = "Idle";
    this.state.hold = null;
    this.rest();
  }
  rest() {
    for (const a of Object.values(this.state.axes)) Object.assign(a, { velocity: 0, state: "Standby", at_rest: true });
  }

  /** A tenth of a second passes. */
  tick(pointsEachTick) {
    const { state } = this;
    if (state.mode === "Jogging") this.tickJog();
    if (state.hold?.state === "braking") {
      state.hold.state = "held";
      this.rest();
    }
    if (state.mode !== "Running") return;
    const points = this.program.points;
    this.at = Math.min(points.length - 1, this.at + pointsEachTick);
    const p = points[this.at];
    for (const name of ["X", "Y", "Z"]) this.moveAxis(name, p[name.toLowerCase()]);
    Object.assign(state.job, { line: p.line, progress: this.at / (points.length - 1), time_left_s: (points.length - 1 - this.at) / pointsEachTick / 10 });
    if (this.at === points.length - 1) {
      Object.assign(state.job, { outcome: "Done", progress: 1 });
      this.end();
    }
  }
  tickJog() {
    if (this.stepPress !== undefined) return this.tickStep();
    if (Date.now() > this.jogUntil) return this.end();
    for (const { axis: name, velocity } of this.jogs) this.moveAxis(name, Math.min(200, Math.max(0, this.state.axes[name].position + velocity / 10)));
  }
  tickStep() {
    for (const { axis: name, velocity } of this.jogs) {
      const way = Math.min(this.left[name], Math.abs(velocity) / 10);
      this.left[name] -= way;
      this.moveAxis(name, this.state.axes[name].position + Math.sign(velocity) * way);
    }
    if (Object.values(this.left).every((left) => left === 0)) this.end();
  }
  moveAxis(name, to) {
    const a = this.state.axes[name], velocity = 10 * (to - a.position);
    Object.assign(a, { position: to, velocity, state: "Cruise", at_rest: false });
    const late = 0.6 + 0.3 * Math.sin(to);
    if (a.health === null) return; // it is that of its motors
    Object.assign(a.health, { slack_ms: { count: 100, min: 212 + 4 * Math.cos(to), max: 260 }, lateness_us: { count: 800, min: -late, max: late }, skew_us: 1.1 + 0.2 * Math.sin(to * 2) });
  }
}
