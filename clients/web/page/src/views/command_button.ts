// Makes command buttons, and gives commands and reports their refusals.
import { command } from "../api/client";
import type { Accepted } from "../api/contract";
import type { Result } from "../api/result";
import { h, icon } from "../dom/element";

export type Give = (verb: string, body?: object) => Promise<Result<Accepted>>;

export type Report = (result: Result<unknown>) => void;

/** Gives commands, and reports each refusal. */
export function giver(report: Report): Give {
  return async (verb, body = {}) => {
    const result = await command(verb, body);
    report(result);
    return result;
  };
}

export function button(text: string, drawing: string, className: string, press: () => void): HTMLButtonElement {
  return h("button", { type: "button", class: className, on: { click: press } }, icon(drawing), h("span", {}, text));
}
