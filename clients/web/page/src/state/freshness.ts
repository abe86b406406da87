// How old a value is, and whether it may still count as current.

export type Freshness = "live" | "stale" | "unknown";

/** An older value may no longer describe the machine, which sends a hundred states in this time. */
export const STALE_AFTER_MS = 1500;

/**
 * The age of a value now: its age when the server sent it, and the time that has passed since it arrived here.
 * Undefined if the server never had the value.
 */
export function ageNow(ageWhenSent_ms: number | undefined, arrived_ms: number, now_ms: number): number | undefined {
  return ageWhenSent_ms === undefined ? undefined : ageWhenSent_ms + Math.max(0, now_ms - arrived_ms);
}

export function freshness(age_ms: number | undefined): Freshness {
  if (age_ms === undefined) return "unknown";
  return age_ms > STALE_AFTER_MS ? "stale" : "live";
}
