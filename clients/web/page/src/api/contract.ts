// The types of clients/web/openapi.yaml. In a state that came as patches, an absent member counts as null.

export type Maybe<T> = T | null | undefined;
export type Role = "view" | "operate";

export interface Fault {
  number: number;
  code: string;
  axis?: Maybe<string>;
  cause: string;
  remedy: string;
}

export interface Alarm extends Fault {
  severity: "fault" | "warning";
}

export interface ProblemLine {
  line: number;
  column: number;
  message: string;
}

/** RFC 9457, with place, value, limit and remedy. */
export interface Problem {
  title: string;
  status: number;
  code: string;
  detail: string;
  place?: string;
  value?: unknown;
  limit?: string;
  remedy?: string;
  errors?: ProblemLine[];
}

export interface MachineAxis {
  name: string;
  kind: "linear" | "rotary";
  unit: "mm" | "deg";
  position_min: number;
  position_max: number;
  max_velocity: number;
  unhomed_jog_velocity?: Maybe<number>;
  host?: Maybe<string>;
}

export interface Limits {
  program_bytes: number;
  jog_renew_ms: number;
  jog_life_ms: number;
  override_min_percent: number;
  override_max_percent: number;
  path_points: number;
}

export interface Machine {
  name: string;
  version: string;
  axes: MachineAxis[];
  features: string[];
  coordinate_systems: string[];
  slack_deadline_ms: number;
  step_lateness_limit_us: number;
  limits: Limits;
}

export interface Spread {
  count: number;
  min: number;
  max: number;
}

export interface Health {
  age_ms: number;
  slack_ms?: Maybe<Spread>;
  lateness_us?: Maybe<Spread>;
  skew_us?: Maybe<number>;
  loop_max_us: number;
  refused: number;
}

export type AxisPhase = "Initialize" | "Standby" | "Accelerate" | "Cruise" | "Decelerate" | "Stop" | "Fault";

export interface AxisState {
  present: boolean;
  age_ms?: Maybe<number>;
  position?: Maybe<number>;
  velocity?: Maybe<number>;
  state?: Maybe<AxisPhase>;
  homed?: Maybe<boolean>;
  at_rest?: Maybe<boolean>;
  following_error_steps?: Maybe<number>;
  clock_error_us?: Maybe<number>;
  fault?: Maybe<Fault>;
  unproved?: Maybe<Fault>;
  health?: Maybe<Health>;
}

export type Mode =
  | "Unreachable" | "Waiting" | "Idle" | "Homing" | "Running" | "Holding" | "Paused" | "Stopping" | "Fault" | "Jogging";

export interface Job {
  number: number;
  kind?: Maybe<"home" | "move" | "run" | "own-move" | "jog">;
  name?: Maybe<string>;
  line?: Maybe<number>;
  progress?: Maybe<number>;
  time_done_s?: Maybe<number>;
  time_left_s?: Maybe<number>;
  waits_for_program?: boolean;
  outcome?: Maybe<"Done" | "Stopped" | "Failed">;
  ended_by?: Maybe<Fault>;
}

export interface LoadedProgram {
  id: number;
  name: string;
  bytes: number;
  lines: number;
  blocks: number;
  notes?: Maybe<{ line: number; text: string }[]>;
}

/** By axis letter; an absent letter counts as 0. */
export type Place = Record<string, number>;

export interface Offsets {
  revision: number;
  active: string;
  systems: Record<string, { origin?: Maybe<Place>; rotation_deg?: Maybe<number> }>;
  g92?: Maybe<Place>;
}

export interface Tool {
  pocket?: Maybe<number>;
  offset?: Maybe<Place>;
  diameter?: Maybe<number>;
}

export interface Devices {
  spindle?: Maybe<{ direction: "stopped" | "forward" | "reverse"; rpm: number }>;
  mist?: Maybe<boolean>;
  flood?: Maybe<boolean>;
  tool?: Maybe<number>;
  outputs?: Maybe<number[]>;
}

export interface Writer {
  name: string;
  host: string;
  since: string;
  is_this_server: boolean;
}

export interface Pause {
  reason: "program-stop" | "optional-stop" | "tool-change" | "pallet-change" | "hold";
  tool?: Maybe<number>;
  message: string;
  /** The moves back to where the job goes on, in machine coordinates; empty if no axis was moved. */
  way: Record<string, number>[];
}

export interface State {
  machine: string;
  mode: Mode;
  link: { age_ms?: Maybe<number>; standby?: Maybe<boolean>; config_differs?: Maybe<boolean> };
  job?: Maybe<Job>;
  program?: Maybe<LoadedProgram>;
  hold?: Maybe<{ state: "braking" | "held"; line?: Maybe<number> }>;
  pause?: Maybe<Pause>;
  override: { feed_percent: number; rapid_percent: number };
  alarms?: Maybe<Alarm[]>;
  axes: Record<string, AxisState>;
  offsets?: Maybe<Offsets>;
  tools?: Maybe<Record<string, Tool>>;
  devices?: Maybe<Devices>;
  writer?: Maybe<Writer>;
  modes: string[];
  viewers: number;
}

export interface Accepted {
  accepted: true;
  job?: Maybe<number>;
  jogging?: boolean;
}

export interface ReportFile {
  name: string;
  kind: "report" | "incident";
  bytes: number;
  modified: string;
}

export interface JogAxis {
  axis: string;
  velocity: number;
  distance?: number;
}
