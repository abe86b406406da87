// The heights of a surface at the points of a grid, from the server's table.

export interface HeightMap {
  readonly x: readonly number[];
  readonly y: readonly number[];
  /** By row of y, then by x. */
  readonly z: readonly number[];
  readonly lowest: number;
  readonly highest: number;
}

/** Undefined if it is no table x_mm,y_mm,z_mm of a grid with two lines in X and in Y or more. */
export function parseHeights(table: string): HeightMap | undefined {
  const rows = table.trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
  if (rows.some((row) => row.length !== 3 || row.some((value) => !Number.isFinite(value)))) return undefined;
  const rising = (column: 0 | 1) => [...new Set(rows.map((row) => row[column]!))].sort((a, b) => a - b);
  const [x, y] = [rising(0), rising(1)];
  if (x.length < 2 || y.length < 2 || rows.length !== x.length * y.length) return undefined;
  const places = new Map(rows.map((row) => [`${row[0]} ${row[1]}`, row[2]!]));
  const z = y.flatMap((b) => x.map((a) => places.get(`${a} ${b}`)));
  if (z.some((height) => height === undefined)) return undefined;
  const heights = z as number[];
  const [lowest, highest] = heights.reduce(([low, high], height) => [Math.min(low, height), Math.max(high, height)], [Infinity, -Infinity]);
  return { x, y, z: heights, lowest, highest };
}

function cellOf(lines: readonly number[], at: number): { cell: number; share: number } {
  let cell = 0;
  while (cell < lines.length - 2 && at > lines[cell + 1]!) ++cell;
  const share = (at - lines[cell]!) / (lines[cell + 1]! - lines[cell]!);
  return { cell, share: Math.min(1, Math.max(0, share)) };
}

/** Bilinear between the points, as a program is bent; beyond the map that of its edge. */
export function heightAt({ x, y, z }: HeightMap, atX: number, atY: number): number {
  const [a, b] = [cellOf(x, atX), cellOf(y, atY)];
  const at = (dx: number, dy: number) => z[(b.cell + dy) * x.length + a.cell + dx]!;
  const low = at(0, 0) + (at(1, 0) - at(0, 0)) * a.share;
  const high = at(0, 1) + (at(1, 1) - at(0, 1)) * a.share;
  return low + (high - low) * b.share;
}
