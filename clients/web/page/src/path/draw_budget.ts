// Limits the points of a picture by the host's speed: fewer if pictures come slowly, more if they come fast.

const SLOW_MS = 45; // between two pictures of a moving view
const FAST_MS = 25;
const LEAST = 1500;
const MOST = 200_000;
const AT_REST = 6; // a single picture may take longer

export class DrawBudget {
  /** @param points the limit for a moving view until the host's speed is known */
  constructor(private points: number) {}

  /** @param isMoving whether more pictures follow at once */
  most(isMoving: boolean): number {
    return isMoving ? this.points : AT_REST * this.points;
  }

  /** @param time_ms between two pictures of a moving view */
  note(time_ms: number): void {
    if (time_ms > SLOW_MS) this.points = Math.max(LEAST, Math.floor(0.7 * this.points));
    else if (time_ms < FAST_MS) this.points = Math.min(MOST, Math.ceil(1.15 * this.points));
  }
}
