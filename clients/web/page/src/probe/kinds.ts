// What each kind of measurement needs from a person.
import type { MeasureKind } from "../api/contract";

/** The numbers that a person enters, in this order; the unit is mm, of the feed mm/min. */
export const NUMBER_FIELDS = [
  "way", "way_x", "way_y", "from_x", "to_x", "from_y", "to_y", "diameter", "along", "beside", "spacing", "down", "clearance", "setter", "tip",
  "feed", "back",
] as const;
export type NumberField = (typeof NUMBER_FIELDS)[number];
export type Flag = "away" | "may_miss";

export interface KindFields {
  /** Whether the person chooses the axis of `way`: one of all axes, or of X and Y. */
  readonly axis?: "any" | "plane";
  readonly numbers: readonly NumberField[];
  readonly flags?: readonly Flag[];
}

export const KINDS: Record<MeasureKind, KindFields> = {
  touch: { axis: "any", numbers: ["way", "feed"], flags: ["away", "may_miss"] },
  edge: { axis: "plane", numbers: ["way", "tip", "feed", "back"] },
  angle: { axis: "plane", numbers: ["way", "along", "feed", "back"] },
  corner: { numbers: ["way_x", "way_y", "beside", "tip", "feed", "back"] },
  bore: { numbers: ["diameter", "tip", "feed", "back"] },
  boss: { numbers: ["diameter", "down", "clearance", "tip", "feed", "back"] },
  tool: { numbers: ["down", "setter", "feed", "back"] },
  surface: { numbers: ["from_x", "to_x", "from_y", "to_y", "spacing", "down", "feed", "back"] },
};

export const FIRST_VALUES: Partial<Record<NumberField, string>> = { feed: "60", back: "1" };
