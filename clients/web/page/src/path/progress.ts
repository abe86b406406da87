// Finds how far a program is along its path, from the line in motion and the place of the head.
import type { Path } from "./path_points";
import type { Vector } from "./camera";

function squaredDistanceTo(at: Float32Array, point: number, head: Vector): number {
  const a = 3 * Math.max(0, point - 1), b = 3 * point;
  let length2 = 0, along = 0;
  for (let i = 0; i < 3; ++i) {
    const d = at[b + i]! - at[a + i]!;
    length2 += d * d;
    along += d * (head[i]! - at[a + i]!);
  }
  const share = length2 > 0 ? Math.min(1, Math.max(0, along / length2)) : 0;
  let squared = 0;
  for (let i = 0; i < 3; ++i) {
    const e = head[i]! - (at[a + i]! + share * (at[b + i]! - at[a + i]!));
    squared += e * e;
  }
  return squared;
}

/** Remembers how far the program was, because a line that is repeated has many places on the path. */
export class PathProgress {
  private reached = 0;

  constructor(private readonly path: Path) {}

  /** The point that the head moves to; the head has passed all points before it. Line 0: no line is in motion. */
  advance(line: number, head: Vector): number {
    const first = line > 0 ? this.find(line) : undefined;
    if (first === undefined) return this.reached;
    let best = first, least = Infinity;
    for (let i = first; i < this.path.line.length && this.path.line[i] === this.path.line[first]; ++i) {
      const squared = squaredDistanceTo(this.path.at, i, head);
      if (squared < least) {
        least = squared;
        best = i;
      }
    }
    return (this.reached = best);
  }

  /** A new job starts at the path's beginning. */
  restart(): void {
    this.reached = 0;
  }

  /** The next point of the line, or the first of a later line if all points of the line were left out. */
  private find(line: number): number | undefined {
    const lines = this.path.line;
    if (lines[this.reached] === line) return this.reached;
    const ahead = lines.indexOf(line, this.reached);
    if (ahead >= 0) return ahead;
    const later = lines.findIndex((at, i) => i >= this.reached && at > line);
    const again = lines.indexOf(line);
    if (again >= 0) return again;
    return later >= 0 ? later : undefined;
  }
}
