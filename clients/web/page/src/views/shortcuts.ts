// Keys that work anywhere on the page. None of them is a character, so typing triggers none.
import type { Give } from "./command_button";

const VERBS: Record<string, string> = { F1: "estop", Escape: "stop", F2: "hold", F4: "resume" };

export function shortcutVerb(event: Pick<KeyboardEvent, "key" | "repeat" | "ctrlKey" | "altKey" | "metaKey">): string | undefined {
  if (event.repeat || event.ctrlKey || event.altKey || event.metaKey) return undefined;
  return VERBS[event.key];
}

/**
 * @param resume continues a job, and may ask first
 * @param mayOperate whether this page may give commands. An open dialog keeps Escape for itself.
 */
export function listenToShortcuts(give: Give, resume: () => void, mayOperate: () => boolean): void {
  addEventListener("keydown", (event) => {
    const verb = shortcutVerb(event);
    if (verb === undefined || !mayOperate()) return;
    if (event.key === "Escape" && document.querySelector("dialog[open]") !== null) return;
    event.preventDefault();
    if (verb === "resume") resume();
    else void give(verb);
  });
}
