// The machine's name and mode, who watches and who commands.
import { h, icon, setAttribute, setText } from "../dom/element";
import { ICONS } from "../dom/icons";
import { fill, switchLanguage, t } from "../texts";
import { switchTheme } from "../dom/theme";
import { shownMode } from "../state/shown_mode";
import type { Model, View } from "./view";

/** How a mode looks: by colour, and by a sign for those who do not see it. */
const LOOK: Record<string, string> = {
  Idle: "good", Running: "busy", Homing: "busy", Jogging: "busy", Holding: "warning", Paused: "warning", Stopping: "warning",
  Waiting: "warning", Unreachable: "bad", Fault: "bad",
};

export class Header implements View {
  readonly element: HTMLElement;
  private readonly name = h("h1", {});
  private readonly mode = h("strong", { class: "mode", role: "status" });
  private readonly writer = h("span", { class: "soft writer" });
  private readonly standby = h("span", { class: "soft" });
  private readonly viewers = h("span", { class: "soft viewers" });

  constructor(openKeys: () => void, leave: () => void, safety: HTMLElement) {
    const tool = (text: string, drawing: string, press: () => void) =>
      h("button", { type: "button", class: "plain tool", title: text, "aria-label": text, on: { click: press } }, icon(drawing));
    this.element = h("header", {},
      h("div", { class: "identity" }, this.name, this.mode),
      h("div", { class: "people" }, this.standby, this.writer, this.viewers),
      h("div", { class: "tools" }, tool(t.page.keys, ICONS.keyboard, openKeys), tool(t.page.theme, ICONS.theme, switchTheme),
        h("button", { type: "button", class: "plain", on: { click: switchLanguage } }, t.page.language),
        tool(t.signIn.leave, ICONS.leave, leave)),
      safety);
  }

  show({ state, machine, role }: Model): void {
    const mode = t.mode[shownMode(state)] ?? state.mode;
    setText(this.name, machine.name);
    setText(this.mode, mode);
    setAttribute(this.mode, "data-look", LOOK[state.mode] ?? "busy");
    document.title = `${machine.name}: ${mode}`;
    const writer = state.writer;
    const who = !writer ? "" : writer.is_this_server ? t.link.writerHere : fill(t.link.writer, { name: writer.name });
    setText(this.writer, role === "view" ? t.link.viewOnly : who);
    setText(this.viewers, fill(t.link.viewers, { count: state.viewers }));
    setText(this.standby, state.link.standby ? t.link.standby : "");
  }
}
