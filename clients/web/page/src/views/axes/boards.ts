// The boards: devices without a motor, for outputs and inputs. Hidden if the machine has none.
import type { BoardState, Machine, MachineBoard } from "../../api/contract";
import { h, setAttribute, setText, show } from "../../dom/element";
import { phaseLook, phaseText, troubleText } from "../../state/axis_texts";
import { ageNow, freshness } from "../../state/freshness";
import { fill, t } from "../../texts";
import type { Model, View } from "../view";

class BoardRow {
  readonly element: HTMLElement;
  private readonly phase = h("span", { class: "chip" });
  private readonly trouble = h("p", { class: "trouble", hidden: true });

  constructor({ name }: MachineBoard) {
    this.element = h("article", { class: "axis motor", "data-board": name, "aria-label": fill(t.alarms.board, { board: name }) },
      h("div", { class: "reading" }, h("strong", {}, name), h("span", { class: "soft" }, t.boards.has)),
      h("div", { class: "chips" }, this.phase), this.trouble);
  }

  show(state: BoardState, { contact_ms, now_ms }: Model): void {
    const old = ageNow(state.age_ms ?? undefined, contact_ms, now_ms);
    setAttribute(this.element, "data-fresh", state.present && freshness(old) === "live" ? "live" : "stale");
    setText(this.phase, phaseText(state, t));
    setAttribute(this.phase, "data-look", phaseLook(state));
    const trouble = troubleText(state, t);
    setText(this.trouble, trouble);
    show(this.trouble, trouble !== "");
  }
}

export class Boards implements View {
  readonly element: HTMLElement;
  private readonly rows: Map<string, BoardRow>;

  constructor({ boards }: Machine) {
    this.rows = new Map(boards.map((board) => [board.name, new BoardRow(board)]));
    this.element = h("section", { class: "motors boards", "aria-label": t.boards.title, hidden: boards.length === 0 },
      h("div", { class: "heading" }, h("h2", {}, t.boards.title)), ...[...this.rows.values()].map((row) => row.element));
  }

  show(model: Model): void {
    for (const [name, row] of this.rows) {
      const state = model.state.boards[name];
      if (state !== undefined) row.show(state, model);
    }
  }
}
