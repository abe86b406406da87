// Notices of refused requests: what was refused, where, why, and the remedy.
import type { Problem } from "../api/contract";
import { NO_ANSWER, type Result } from "../api/result";
import { h, icon } from "../dom/element";
import { ICONS } from "../dom/icons";
import { pageRemedy } from "../state/page_remedy";
import { fill, t } from "../texts";

const MOST_NOTICES = 3;
const STAYS_MS = 15_000;

function details(problem: Problem): string {
  const parts = [
    problem.detail === problem.title ? "" : problem.detail,
    problem.place === undefined || problem.value === undefined ? "" :
      fill(t.commands.place, { place: problem.place, value: JSON.stringify(problem.value) }),
    problem.limit === undefined ? "" : fill(t.commands.limit, { limit: problem.limit }),
  ];
  return parts.filter((part) => part !== "").join(" · ");
}

export class Notices {
  readonly element = h("div", { class: "notices", role: "status", "aria-live": "polite" });

  /** Shows a refusal; ignores an accepted request. */
  readonly report = (result: Result<unknown>): void => {
    if (!result.ok) this.show(result.problem);
  };

  private show(problem: Problem): void {
    const isSilent = problem.code === NO_ANSWER;
    const remedy = isSilent ? t.commands.noAnswerRemedy : problem.remedy;
    this.add(
      isSilent ? t.commands.noAnswer : fill(t.commands.refused, { title: problem.title }),
      isSilent ? "" : details(problem),
      remedy === undefined || remedy === "" ? "" : pageRemedy(remedy, t),
    );
  }

  private add(title: string, detail: string, remedy: string): void {
    const same = [...this.element.children].find((notice) => notice.querySelector("strong")?.textContent === title);
    same?.remove();
    const notice = h("div", { class: "notice" }, icon(ICONS.warning),
      h("div", {}, h("strong", {}, title), h("p", {}, detail), h("p", { class: "remedy" }, remedy)),
      h("button", { type: "button", class: "plain", "aria-label": t.page.dismiss, on: { click: () => notice.remove() } }, icon(ICONS.close)));
    this.element.append(notice);
    while (this.element.children.length > MOST_NOTICES) this.element.firstElementChild?.remove();
    setTimeout(() => notice.remove(), STAYS_MS);
  }
}
