// How many points a picture may have. It follows the host: fewer where pictures come slowly, more where they come at once.

const SLOW_MS = 45; // between two pictures of a moving view
const FAST_MS = 25;
const LEAST = 1500;
const MOST = 200_000;
const AT_REST = 6; // a single picture may take longer

export class DrawBudget {
  /** @param points of a picture of a moving view, until it is known how fast the host is */
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
