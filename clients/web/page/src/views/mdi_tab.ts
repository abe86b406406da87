// One line of G-code at a time, and the list of earlier lines.
import { mdiLines } from "../api/client";
import { h, setAttribute, setText, show } from "../dom/element";
import { History } from "../mdi/history";
import { t } from "../texts";
import type { Give } from "./command_button";
import type { Model, View } from "./view";

export class MdiTab implements View {
  readonly element: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly send: HTMLButtonElement;
  private readonly modes = h("output", { class: "mdi-modes", for: "mdi", "aria-label": t.mdi.modes });
  private readonly list = h("ol", { class: "mdi-lines", reversed: true, "aria-label": t.mdi.history });
  private history = new History();

  constructor(private readonly give: Give) {
    this.input = h("input", {
      type: "text", id: "mdi", autocomplete: "off", autocapitalize: "characters", spellcheck: "false", maxlength: 1000,
      placeholder: t.mdi.placeholder, on: { keydown: (event) => this.walk(event) },
    });
    this.send = h("button", { type: "submit", class: "action" }, t.mdi.send);
    this.element = h("div", { class: "mdi" },
      h("form", { on: { submit: (event) => {
        event.preventDefault();
        void this.submit();
      } } }, h("label", { for: "mdi" }, t.mdi.label), this.input, this.send),
      h("p", {}, h("span", { class: "soft" }, t.mdi.modes), " ", this.modes),
      h("p", { class: "soft" }, t.mdi.keys), this.list);
    void this.fetch();
  }

  show({ state, role }: Model): void {
    show(this.element.querySelector("form")!, role === "operate");
    setAttribute(this.send, "disabled", state.mode !== "Idle");
    setText(this.modes, state.modes.join(" "));
  }

  private walk(event: KeyboardEvent): void {
    if (event.key === "ArrowUp") this.input.value = this.history.earlier(this.input.value);
    else if (event.key === "ArrowDown") this.input.value = this.history.later();
    else return;
    event.preventDefault();
  }

  private async submit(): Promise<void> {
    const line = this.input.value.trim();
    if (line === "" || this.send.disabled) return;
    const answer = await this.give("mdi", { line });
    this.history.add(line);
    if (answer.ok) this.input.value = "";
    this.append(line, answer.ok);
  }

  private async fetch(): Promise<void> {
    const answer = await mdiLines();
    if (!answer.ok) return;
    this.history = new History(answer.value.lines.map(({ line }) => line));
    answer.value.lines.forEach(({ line, accepted }) => this.append(line, accepted));
  }

  private append(line: string, accepted: boolean): void {
    const again = h("button", { type: "button", class: "plain", on: { click: () => {
      this.input.value = line;
      this.input.focus();
    } } }, h("code", {}, line));
    this.list.prepend(h("li", {}, again, h("span", { class: "chip", "data-look": accepted ? "good" : "bad" }, accepted ? t.mdi.accepted : t.mdi.refused)));
    while (this.list.children.length > 100) this.list.lastElementChild!.remove();
  }
}
