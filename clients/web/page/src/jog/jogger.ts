// Connects the dead-man's switch with the server: held keys become requests, and refusals release the keys.
import { command } from "../api/client";
import type { JogAxis, Problem } from "../api/contract";
import { JogDeadMan, type Direction, type JogRequest, type ReleaseReason } from "./dead_man";
import { OneAtATime } from "./one_at_a_time";
import { JogStepper } from "./stepper";

const TICK_MS = 10;

interface JogBody {
  readonly stream?: string;
  /** The number of the press. A request that arrives after its release starts nothing. */
  readonly press: number;
  readonly jogs: readonly JogAxis[];
  readonly step?: boolean;
}

export interface JogSource {
  /** The axes, speeds and distance that a direction means now. */
  jogs(direction: Direction): JogAxis[];
  /** Whether a press is one step of the chosen distance. */
  isStep(): boolean;
  /** The name of the open connection; empty while there is none. */
  stream(): string;
  /** The jog has ended although the key is held. */
  ended(problem: Problem | undefined): void;
}

export class Jogger {
  private readonly deadMan: JogDeadMan;
  private readonly stepper: JogStepper;
  private readonly requests: OneAtATime<JogBody>;
  private jogs: JogAxis[] = [];
  private pressed = 0;
  private problem: Problem | undefined;

  constructor(renew_ms: number, private readonly source: JogSource) {
    this.deadMan = new JogDeadMan(renew_ms);
    this.stepper = new JogStepper(renew_ms);
    const clock = { after: (ms: number, action: () => void) => {
      const timer = setTimeout(action, ms);
      return () => clearTimeout(timer);
    } };
    this.requests = new OneAtATime((body, signal) => this.send(body, signal), clock, () => this.refused());
    setInterval(() => {
      this.carryOut(this.deadMan.tick(performance.now()));
      this.carryOut(this.stepper.tick(performance.now()));
    }, TICK_MS);
    addEventListener("blur", () => this.releaseAll("blur"));
    addEventListener("pagehide", () => this.releaseAll("hidden"));
    document.addEventListener("visibilitychange", () => document.hidden && this.releaseAll("hidden"));
  }

  press(holder: string, direction: Direction): void {
    if (this.source.isStep() || this.stepper.isStepping()) this.carryOut(this.stepper.press(holder, direction, performance.now()));
    else this.carryOut(this.deadMan.press(holder, direction, performance.now()));
  }

  release(holder: string): void {
    this.stepper.release(holder);
    this.carryOut(this.deadMan.release(holder, performance.now()));
  }

  releaseAll(reason: ReleaseReason): void {
    this.stepper.releaseAll();
    this.carryOut(this.deadMan.releaseAll(reason, performance.now()));
  }

  private carryOut(requests: readonly JogRequest[]): void {
    for (const request of requests) {
      if (request.kind === "start") {
        ++this.pressed;
        this.jogs = this.source.jogs(request.direction);
        this.requests.change(this.body());
      } else if (request.kind === "renew") this.requests.renew(this.body());
      else {
        this.jogs = [];
        this.requests.stop(this.body());
      }
    }
  }

  private body(): JogBody {
    const stream = this.source.stream();
    const step = this.stepper.isStepping() ? { step: true } : {};
    const body = { press: this.pressed, jogs: this.jogs, ...step };
    return stream === "" ? body : { stream, ...body };
  }

  private async send(body: JogBody, signal: AbortSignal): Promise<boolean> {
    const answer = await command("jog", body, signal);
    this.problem = answer.ok ? undefined : answer.problem;
    return answer.ok && answer.value.jogging !== false;
  }

  /** The machine does not move any more: a step is complete, or a jog has ended by itself. */
  private refused(): void {
    if (this.stepper.isStepping() && this.problem === undefined) return this.carryOut(this.stepper.complete(performance.now()));
    const wasMoving = this.deadMan.isMoving() || this.stepper.isStepping();
    this.stepper.end();
    this.releaseAll("refused");
    if (wasMoving) this.source.ended(this.problem);
  }
}
