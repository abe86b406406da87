// One press, one step of exactly the chosen length; a press that is held repeats. Pure: time and events come in, requests
// come out.
//
// The server goes the whole step after one request. So this part does not stop it when the key is released, and asks for
// the next one only when it is complete.
import type { Direction, JogRequest } from "./dead_man";

/** A press that is held for so long repeats, as the keys of a keyboard do. */
export const REPEAT_AFTER_MS = 500;
/** Presses during a step that wait for its end. A person who presses more often is ahead of the machine. */
export const MOST_WAITING = 4;

export class JogStepper {
  private readonly held = new Map<string, { direction: Direction; since_ms: number }>();
  private readonly waiting: Direction[] = [];
  private stepping = false;
  private asked_ms = 0;

  /** @param period_ms between two questions whether a step is complete */
  constructor(private readonly period_ms: number) {}

  /** Repeated presses of a held `holder` change nothing. */
  press(holder: string, direction: Direction, now_ms: number): JogRequest[] {
    if (this.held.has(holder)) return [];
    this.held.set(holder, { direction, since_ms: now_ms });
    if (!this.stepping) return this.start(direction, now_ms);
    if (this.waiting.length < MOST_WAITING) this.waiting.push(direction);
    return [];
  }

  release(holder: string): void {
    this.held.delete(holder);
  }

  /** Drops the steps that wait. The step in progress is completed. */
  releaseAll(): void {
    this.held.clear();
    this.waiting.length = 0;
  }

  /** The server has refused the step or ended it. */
  end(): void {
    this.releaseAll();
    this.stepping = false;
  }

  /** The step in progress is complete. */
  complete(now_ms: number): JogRequest[] {
    this.stepping = false;
    return this.next(now_ms);
  }

  /** Call it often. Returns the question or the step that is due. */
  tick(now_ms: number): JogRequest[] {
    if (!this.stepping) return this.next(now_ms);
    if (now_ms - this.asked_ms < this.period_ms) return [];
    this.asked_ms = now_ms;
    return [{ kind: "renew" }];
  }

  isStepping(): boolean {
    return this.stepping;
  }

  private next(now_ms: number): JogRequest[] {
    const waiting = this.waiting.shift();
    if (waiting !== undefined) return this.start(waiting, now_ms);
    const repeated = [...this.held.values()].find(({ since_ms }) => now_ms - since_ms >= REPEAT_AFTER_MS);
    return repeated === undefined ? [] : this.start(repeated.direction, now_ms);
  }

  private start(direction: Direction, now_ms: number): JogRequest[] {
    this.stepping = true;
    this.asked_ms = now_ms;
    return [{ kind: "start", direction }];
  }
}
