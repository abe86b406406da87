// The result of a request: a value, or a Problem.
import type { Problem } from "./contract";

export type Result<T> = { readonly ok: true; readonly value: T } | { readonly ok: false; readonly problem: Problem };

function isProblem(value: unknown): value is Problem {
  return typeof value === "object" && value !== null && typeof (value as Problem).code === "string"
    && typeof (value as Problem).title === "string";
}

/** Makes a Problem of an error. An answer that is no Problem, such as a proxy's, is named by its status. */
export function problemOf(status: number, statusText: string, body: string): Problem {
  try {
    const parsed: unknown = JSON.parse(body);
    if (isProblem(parsed)) return parsed;
  } catch {
    // the text itself is shown
  }
  return { title: statusText || String(status), status, code: `http-${status}`, detail: body.slice(0, 300) };
}

/** The server did not answer at all. */
export const NO_ANSWER = "no-answer";

export function noAnswer(detail: string): Problem {
  return { title: "", status: 0, code: NO_ANSWER, detail };
}
