// A jog lasts as long as a key is held and the server answers. Pure: time and events come in, requests come out.
//
// The server brakes the axes by itself when renewals cease. This part only makes sure that they cease: when the key is
// released, when the window loses focus, and when a renewal fails.

/** Signed directions by axis name: { X: 1, Y: -1 }. */
export type Direction = Readonly<Record<string, 1 | -1>>;

export type JogRequest =
  | { readonly kind: "start"; readonly direction: Direction }
  | { readonly kind: "renew" }
  | { readonly kind: "stop" };

/** Why a jog ends although a key is still held. */
export type ReleaseReason = "blur" | "hidden" | "refused";

function sum(held: Iterable<Direction>): Record<string, 1 | -1> {
  const total: Record<string, number> = {};
  for (const direction of held) {
    for (const [axis, sign] of Object.entries(direction)) total[axis] = (total[axis] ?? 0) + sign;
  }
  const moving: Record<string, 1 | -1> = {};
  for (const axis of Object.keys(total).sort()) {
    if (total[axis] !== 0) moving[axis] = (total[axis] ?? 0) > 0 ? 1 : -1;
  }
  return moving;
}

export class JogDeadMan {
  private readonly held = new Map<string, Direction>();
  private asked = "{}";
  private renewed_ms = 0;

  /** @param period_ms between two renewals; well below the server's time-out */
  constructor(private readonly period_ms: number) {}

  /** A key, button or finger goes down. `holder` names it; repeated presses of a held one change nothing. */
  press(holder: string, direction: Direction, now_ms: number): JogRequest[] {
    if (this.held.has(holder)) return [];
    this.held.set(holder, direction);
    return this.update(now_ms);
  }

  release(holder: string, now_ms: number): JogRequest[] {
    return this.held.delete(holder) ? this.update(now_ms) : [];
  }

  /** Releases everything, because the page can no longer see whether it is held. */
  releaseAll(_reason: ReleaseReason, now_ms: number): JogRequest[] {
    this.held.clear();
    return this.update(now_ms);
  }

  /** Call it often. Returns the renewal that is due. */
  tick(now_ms: number): JogRequest[] {
    if (!this.isMoving() || now_ms - this.renewed_ms < this.period_ms) return [];
    this.renewed_ms = now_ms;
    return [{ kind: "renew" }];
  }

  isMoving(): boolean {
    return this.asked !== "{}";
  }

  private update(now_ms: number): JogRequest[] {
    const direction = sum(this.held.values());
    const wanted = JSON.stringify(direction);
    if (wanted === this.asked) return [];
    this.asked = wanted;
    this.renewed_ms = now_ms;
    return [wanted === "{}" ? { kind: "stop" } : { kind: "start", direction }];
  }
}
