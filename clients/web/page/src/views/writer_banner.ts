// Names another writer of the machine, and offers to take the machine over.
import { h, setText, show } from "../dom/element";
import { timeOfDay } from "../format/times";
import { otherWriter } from "../state/other_writer";
import { fill, t } from "../texts";
import type { Give } from "./command_button";
import type { Model, View } from "./view";

export class WriterBanner implements View {
  readonly element: HTMLElement;
  private readonly sentence = h("p", {});

  constructor(give: Give) {
    const take = h("button", { type: "button", on: { click: () => void give("take") } }, t.writer.take);
    this.element = h("div", { class: "banner writer-banner", role: "status", hidden: true }, this.sentence, take);
  }

  show({ state, role }: Model): void {
    const writer = otherWriter(state, role);
    show(this.element, writer !== undefined);
    if (writer === undefined) return;
    setText(this.sentence, fill(t.writer.other, { name: writer.name, host: writer.host, time: timeOfDay(writer.since) }));
  }
}
