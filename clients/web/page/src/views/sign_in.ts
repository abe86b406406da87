// Signs in with the token in the address's fragment, which a browser never sends, or asks for a token. Signs out.
import { session, signIn, signOut } from "../api/client";
import type { Problem, Role } from "../api/contract";
import { h, setText } from "../dom/element";
import { t } from "../texts";
import type { Report } from "./command_button";

/** Removes the token from the address, so that no history and no screenshot shows it. */
export function takeToken(): string | undefined {
  const token = new URLSearchParams(location.hash.slice(1)).get("token");
  if (token === null) return undefined;
  history.replaceState(null, "", location.pathname + location.search);
  return token;
}

/** The role of the address's token or of a valid session; else a Problem, or undefined if there is neither. */
export async function enter(): Promise<Role | Problem | undefined> {
  const token = takeToken();
  const answer = token === undefined ? await session() : await signIn(token);
  if (answer.ok) return answer.value.role;
  return token === undefined && answer.problem.status === 401 ? undefined : answer.problem;
}

/** Asks for a token until one is right. */
export function askForToken(place: HTMLElement, problem: Problem | undefined): Promise<Role> {
  return new Promise((resolve) => {
    const wrong = h("p", { class: "wrong", role: "alert" });
    const say = (p: Problem) => setText(wrong, [p.title || t.commands.noAnswer, p.remedy].filter(Boolean).join(" – "));
    const input = h("input", { type: "password", id: "token", autocomplete: "off", required: true });
    const form = h("form", { class: "sign-in", on: { submit: (event) => {
      event.preventDefault();
      void signIn(input.value.trim()).then((answer) => {
        if (!answer.ok) return say(answer.problem);
        form.remove();
        resolve(answer.value.role);
      });
    } } }, h("h1", {}, t.page.title), h("p", { class: "soft" }, t.signIn.hint),
      h("label", { for: "token" }, t.signIn.token), input, wrong, h("button", { type: "submit", class: "action primary" }, t.signIn.submit));
    if (problem !== undefined) say(problem);
    place.replaceChildren(form);
    input.focus();
  });
}

/** Ends the session and asks for a token, or reports why not. */
export async function leave(report: Report): Promise<void> {
  const answer = await signOut();
  if (!answer.ok) return report(answer);
  location.reload();
}
