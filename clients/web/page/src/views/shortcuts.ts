// Keys that work anywhere on the page. None of them is a character, so typing triggers none.
import type { Give } from "./command_button";

const VERBS: Record<string, string> = { F1: "estop", Escape: "stop", F2: "hold", F4: "resume" };

export function shortcutVerb(event: Pick<KeyboardEvent, "key" | "repeat" | "ctrlKey" | "altKey" | "metaKey">): string | undefined {
  if (event.repeat || event.ctrlKey || event.altKey || event.metaKey) return undefined;
  return VERBS[event.key];
}

/** @param mayOperate whether this page may give commands. An open dialog keeps Escape for itself. */
export function listenToShortcuts(give: Give, mayOperate: () => boolean): void {
  addEventListener("keydown", (event) => {
    const verb = shortcutVerb(event);
    if (verb === undefined || !mayOperate()) return;
    if (event.key === "Escape" && document.querySelector("dialog[open]") !== null) return;
    event.preventDefault();
    void give(verb);
  });
}
