// Says why the job waits for a person, and continues it. Axes that were moved in the pause return first, on a way that the
// person has seen and confirmed.
import type { Pause } from "../api/contract";
import { h, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { pauseText, wayTexts } from "../state/pause_texts";
import { t } from "../texts";
import { button, type Give } from "./command_button";
import type { Model, View } from "./view";

export class PauseBanner implements View {
  readonly element: HTMLElement;
  readonly dialog: HTMLDialogElement;
  private readonly title = h("strong", { class: "pause-title" });
  private readonly hint = h("p", {});
  private readonly way = h("ol", { class: "way" });
  private readonly resumeButton: HTMLButtonElement;
  private pause: Pause | undefined;
  private shownWay = "";

  constructor(private readonly give: Give) {
    this.resumeButton = button(t.commands.resume, ICONS.play, "action good", () => this.resume());
    this.element = h("div", { class: "banner pause-banner", role: "status", hidden: true }, h("div", {}, this.title, this.hint), this.resumeButton);
    const confirm = button(t.pause.confirm, ICONS.play, "action good", () => {
      this.dialog.close();
      void this.give("resume", { return: true });
    });
    this.dialog = h("dialog", { "aria-label": t.pause.title, class: "return-dialog" }, h("h2", {}, t.pause.title), h("p", {}, t.pause.explain), this.way,
      h("form", { method: "dialog", class: "choices" }, confirm, h("button", { class: "action" }, t.page.cancel)));
  }

  /** Continues the job at once if its axes are at the place of the pause; otherwise asks first. */
  resume(): void {
    if (this.pause === undefined || this.pause.way.length === 0) void this.give("resume");
    else if (!this.dialog.open) this.dialog.showModal();
  }

  show({ state, role }: Model): void {
    this.pause = state.pause ?? undefined;
    show(this.element, this.pause !== undefined);
    if (this.pause === undefined || state.mode !== "Paused") this.dialog.close();
    if (this.pause === undefined) return;
    setText(this.title, pauseText(this.pause, t));
    setText(this.hint, state.mode === "Running" ? t.pause.returning : this.pause.way.length > 0 ? t.pause.away : t.pause.hint);
    show(this.resumeButton, role === "operate" && state.mode === "Paused");
    const moves = wayTexts(this.pause, t);
    if (moves.join() === this.shownWay) return;
    this.shownWay = moves.join();
    this.way.replaceChildren(...moves.map((move) => h("li", {}, move)));
  }
}
