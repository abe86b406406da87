// Tabs by the pattern of the ARIA practices: arrow keys choose a tab, and the Tab key reaches only the chosen one.
import { h, setAttribute, show } from "../dom/element";

export interface Tab {
  readonly id: string;
  readonly title: string;
  readonly content: HTMLElement;
}

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private readonly panels: HTMLElement[];

  constructor(label: string, private readonly tabs: readonly Tab[]) {
    this.buttons = tabs.map(({ id, title }, i) => h("button", {
      type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`,
      on: { click: () => this.choose(i), keydown: (event) => this.walk(event, i) },
    }, title));
    this.panels = tabs.map(({ id, content }) => h("div", { role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}` }, content));
    this.element = h("section", { class: "tabs" }, h("div", { role: "tablist", "aria-label": label }, ...this.buttons), ...this.panels);
    this.choose(0);
  }

  private choose(chosen: number): void {
    this.buttons.forEach((button, i) => {
      setAttribute(button, "aria-selected", String(i === chosen));
      setAttribute(button, "tabindex", i === chosen ? 0 : -1);
    });
    this.panels.forEach((panel, i) => show(panel, i === chosen));
  }

  private walk(event: KeyboardEvent, from: number): void {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    const to = (from + step + this.tabs.length) % this.tabs.length;
    this.choose(to);
    this.buttons[to]!.focus();
  }
}
