// The dialog that explains the keys.
import { h } from "../dom/element";
import { t } from "../texts";

export function keysDialog(): HTMLDialogElement {
  const { keys } = t;
  const rows: [string, string][] = [
    [keys.estop, keys.estopText], [keys.stop, keys.stopText], [keys.hold, keys.holdText], [keys.resume, keys.resumeText],
    [keys.jog, keys.jogText], [keys.view, keys.viewText],
  ];
  const dialog = h("dialog", { "aria-label": keys.title }, h("h2", {}, keys.title),
    h("dl", { class: "keys" }, ...rows.flatMap(([key, text]) => [h("dt", {}, h("kbd", {}, key)), h("dd", {}, text)])),
    h("p", { class: "soft" }, t.commands.estopHint),
    h("form", { method: "dialog" }, h("button", { class: "action" }, t.page.close)));
  return dialog;
}
