// Made from clients/web/openapi.yaml by clients/web/make_contract.py: change it there. The state comes as patches, in which
// null removes a member, so an absent member counts as null.

export type Maybe<T> = T | null | undefined;

export type Role = "view" | "operate";

export interface Session {
  role: Role;
}

export interface ProblemLine {
  line: number;
  column: number;
  message: string;
}

export interface Problem {
  type?: "about:blank";
  title: string;
  status: number;
  code: string;
  number?: number;
  detail: string;
  place?: string;
  value?: unknown;
  limit?: string;
  remedy?: string;
  errors?: ProblemLine[];
}

export interface Accepted {
  accepted?: true;
  job?: Maybe<number>;
  modes?: Modes;
  jogging?: boolean;
}

export type Modes = string[];

export interface Fault {
  number: number;
  code: string;
  axis?: Maybe<string>;
  motor?: Maybe<string>;
  board?: Maybe<string>;
  cause: string;
  remedy: string;
}

export interface Alarm {
  number: number;
  code: string;
  axis?: Maybe<string>;
  motor?: Maybe<string>;
  board?: Maybe<string>;
  cause: string;
  remedy: string;
  severity: "fault" | "warning";
}

export interface MachineAxis {
  name: string;
  kind: "linear" | "rotary";
  unit: "mm" | "deg";
  position_min: number;
  position_max: number;
  park: number;
  start_velocity: number;
  max_velocity: number;
  max_acceleration: number;
  steps_per_unit: number;
  homed_by: "min" | "max";
  unhomed_jog_velocity?: Maybe<number>;
  host?: Maybe<string>;
}

export interface MachineMotor {
  name: string;
  axes: string[];
  unit: "mm" | "deg";
  steps_per_unit: number;
  host?: Maybe<string>;
}

export interface MachineBoard {
  name: string;
  host?: Maybe<string>;
}

export interface MachineInput {
  name: string;
  motor?: Maybe<string>;
  board?: Maybe<string>;
  use: "emergency-stop" | "door" | "program" | "probe" | "home";
  number?: Maybe<number>;
}

export interface MachineOutput {
  name: string;
  motor?: Maybe<string>;
  board?: Maybe<string>;
  kind: "digital" | "analog" | "pulses";
}

export interface Limits {
  program_bytes: number;
  body_bytes: number;
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
  motors: MachineMotor[];
  boards: MachineBoard[];
  inputs: MachineInput[];
  outputs: MachineOutput[];
  features: string[];
  faults: Record<string, { code: string; cause: string; remedy: string }>;
  coordinate_systems: string[];
  slack_deadline_ms: number;
  step_lateness_limit_us: number;
  limits: Limits;
}

export type Mode = "Unreachable" | "Waiting" | "Idle" | "Homing" | "Running" | "Holding" | "Paused" | "Stopping" | "Fault" | "Jogging";

export interface Job {
  number: number;
  kind?: Maybe<"home" | "move" | "run" | "own-move" | "jog" | "return">;
  name?: Maybe<string>;
  line?: Maybe<number>;
  blocks_done?: Maybe<number>;
  blocks_known?: Maybe<number>;
  progress?: Maybe<number>;
  time_done_s?: Maybe<number>;
  time_left_s?: Maybe<number>;
  waits_for_program: boolean;
  outcome?: Maybe<"Done" | "Stopped" | "Failed">;
  ended_by?: Maybe<Fault>;
}

export interface Pause {
  reason: "program-stop" | "optional-stop" | "tool-change" | "pallet-change" | "hold" | "input" | "input-timeout";
  tool?: Maybe<number>;
  message: string;
  wait_left_s?: Maybe<number>;
  way: Record<string, number>[];
}

export interface PulsesState {
  left: number;
  of: number;
}

export interface OutputState {
  on?: Maybe<boolean>;
  value?: Maybe<number>;
  pulses?: Maybe<PulsesState>;
  asked: number;
}

export interface Offsets {
  revision: number;
  active: string;
  systems: Record<string, { origin: Place; rotation_deg: number }>;
  g92?: Maybe<Place>;
}

export interface State {
  machine: string;
  mode: Mode;
  link: { age_ms?: Maybe<number>; standby: boolean; config_differs: boolean };
  job?: Maybe<Job>;
  program?: Maybe<LoadedProgram>;
  hold?: Maybe<{ state: "braking" | "held"; line?: Maybe<number> }>;
  pause?: Maybe<Pause>;
  override: { feed_percent: number; rapid_percent: number };
  alarms: Alarm[];
  axes: Record<string, AxisState>;
  motors: Record<string, AxisState>;
  boards: Record<string, BoardState>;
  inputs: Record<string, boolean>;
  outputs: Record<string, OutputState>;
  offsets?: Maybe<Offsets>;
  tools?: Maybe<Record<string, Tool>>;
  devices?: Maybe<Devices>;
  writer?: Maybe<Writer>;
  measurement?: Maybe<Measurement>;
  modes: Modes;
  viewers: number;
}

export type MeasureKind = "touch" | "edge" | "angle" | "corner" | "bore" | "boss" | "tool" | "surface";

export interface Measurement {
  number: number;
  kind: MeasureKind;
  touches: number;
  points?: Maybe<number>;
  result?: Maybe<MeasureResult>;
  problem?: Maybe<Problem>;
}

export interface MeasureResult {
  touched: boolean;
  input?: Maybe<string>;
  touch: Record<string, number>;
  behind: number;
  x?: Maybe<number>;
  y?: Maybe<number>;
  diameter_x?: Maybe<number>;
  diameter_y?: Maybe<number>;
  angle_deg?: Maybe<number>;
  tool_length?: Maybe<number>;
  lowest?: Maybe<number>;
  highest?: Maybe<number>;
}

export interface Devices {
  spindle: { direction: "stopped" | "forward" | "reverse"; rpm: number };
  mist: boolean;
  flood: boolean;
  tool?: Maybe<number>;
  outputs: number[];
}

export interface Writer {
  name: string;
  host: string;
  since: string;
  is_this_server: boolean;
}

export type AxisPhase = "Initialize" | "Standby" | "Accelerate" | "Cruise" | "Decelerate" | "Stop" | "Fault";

export interface AxisState {
  present: boolean;
  age_ms?: Maybe<number>;
  position?: Maybe<number>;
  position_steps?: Maybe<number>;
  velocity?: Maybe<number>;
  state?: Maybe<AxisPhase>;
  homed?: Maybe<boolean>;
  at_rest?: Maybe<boolean>;
  following_error_steps?: Maybe<number>;
  corrected_steps?: Maybe<number>;
  clock_error_us?: Maybe<number>;
  fault?: Maybe<Fault>;
  unproved?: Maybe<Fault>;
  switches?: Maybe<("limit_min" | "limit_max" | "home")[]>;
  health?: Maybe<Health>;
}

export interface BoardState {
  present: boolean;
  age_ms?: Maybe<number>;
  state?: Maybe<AxisPhase>;
  clock_error_us?: Maybe<number>;
  fault?: Maybe<Fault>;
  unproved?: Maybe<Fault>;
  health?: Maybe<Health>;
}

export interface Health {
  age_ms: number;
  slack_ms?: Maybe<Spread>;
  lateness_us?: Maybe<Spread>;
  skew_us?: Maybe<number>;
  setpoint_age_ms?: Maybe<number>;
  loop_p99_us: number;
  loop_max_us: number;
  least_free_segments: number;
  refused: number;
}

export interface Spread {
  count: number;
  min: number;
  max: number;
}

export type Place = Record<string, number>;

export interface Tool {
  pocket: number;
  offset: Place;
  diameter: number;
}

export interface LoadedProgram {
  id: number;
  name: string;
  bytes: number;
  lines: number;
  blocks: number;
  notes: { line: number; text: string }[];
}

export interface MdiHistory {
  modes: Modes;
  lines: { line: string; accepted: boolean }[];
}

export interface ReportFile {
  name: string;
  kind: "report" | "incident";
  bytes: number;
  modified: string;
}

export interface Reports {
  files: ReportFile[];
}

export interface JogAxis {
  axis: string;
  velocity: number;
  distance?: number;
}
