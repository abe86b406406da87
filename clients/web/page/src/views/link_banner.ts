// Says when the shown values may be out of date.
import { h, setText, show } from "../dom/element";
import { age } from "../format/times";
import { ageNow, freshness } from "../state/freshness";
import { fill, t } from "../texts";
import type { Model, View } from "./view";

/** The sentence of the banner; empty while everything is fresh. */
export function linkSentence({ state, contact_ms, now_ms }: Model): string {
  const silent = now_ms - contact_ms;
  if (freshness(silent) === "stale") return fill(t.link.lost, { age: age(silent) });
  if (state.mode === "Unreachable") {
    return state.link.age_ms === null || state.link.age_ms === undefined ? t.link.never : t.link.unreachable;
  }
  const coordinator = ageNow(state.link.age_ms ?? undefined, contact_ms, now_ms);
  if (freshness(coordinator) === "stale") return fill(t.link.stale, { age: age(coordinator) });
  return state.link.config_differs ? t.link.configDiffers : "";
}

export class LinkBanner implements View {
  readonly element = h("p", { class: "banner", role: "status", hidden: true });

  show(model: Model): void {
    const sentence = linkSentence(model);
    setText(this.element, sentence);
    show(this.element, sentence !== "");
  }
}
