// The place of an axis in the active work coordinate system.
import type { Offsets } from "../../api/contract";

/**
 * Converts machine coordinates to work coordinates: subtracts origin and G92, and undoes the rotation about Z.
 * Axes without a known position stay unknown.
 */
export function workPlace(
  positions: Readonly<Record<string, number | undefined>>, offsets: Offsets,
): Record<string, number | undefined> {
  const system = offsets.systems[offsets.active];
  const work: Record<string, number | undefined> = {};
  for (const [axis, position] of Object.entries(positions)) {
    const offset = (system?.origin?.[axis] ?? 0) + (offsets.g92?.[axis] ?? 0);
    work[axis] = position === undefined ? undefined : position - offset;
  }
  const angle = ((system?.rotation_deg ?? 0) * Math.PI) / 180;
  const { X: x, Y: y } = work;
  if (angle === 0 || x === undefined || y === undefined) return work;
  return { ...work, X: x * Math.cos(angle) + y * Math.sin(angle), Y: y * Math.cos(angle) - x * Math.sin(angle) };
}
