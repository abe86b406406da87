// The body of a command to measure, from what a person entered.
import type { MeasureKind } from "../api/contract";
import { KINDS, type Flag, type NumberField } from "./kinds";

export interface Entered {
  readonly kind: MeasureKind;
  readonly axis: string;
  /** undefined: the machine's only probe. */
  readonly probe: number | undefined;
  /** undefined: not a number. */
  readonly number: (field: NumberField) => number | undefined;
  readonly flag: (flag: Flag) => boolean;
}

export type OrderOrMissing = { readonly body: Record<string, unknown> } | { readonly missing: NumberField };

/** Fields with a name of two parts are members of an object by axis: way_x is way: { X: ... }. */
export function orderOf({ kind, axis, probe, number, flag }: Entered): OrderOrMissing {
  const body: Record<string, unknown> = { kind };
  const put = (member: string, of: string, value: number) => {
    body[member] = { ...(body[member] as object | undefined), [of]: value };
  };
  for (const field of KINDS[kind].numbers) {
    const value = number(field);
    if (value === undefined) return { missing: field };
    const [member, letter] = field.split("_");
    if (field === "way") put(kind === "touch" ? "to" : "way", axis, value);
    else if (letter === undefined) body[field] = value;
    else put(member!, letter.toUpperCase(), value);
  }
  for (const name of KINDS[kind].flags ?? []) if (flag(name)) body[name] = true;
  if (kind === "touch") body["relative"] = true;
  if (probe !== undefined) body["probe"] = probe;
  return { body };
}
