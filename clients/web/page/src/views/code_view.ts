// Shows the program's text. Only the lines in view are in the document; the line in motion is marked and followed.
import { h, setAttribute, setText } from "../dom/element";
import { LineIndex } from "../code/line_index";
import { contentHeight, scrollTo, windowAt, type Lines } from "../code/window";
import { t } from "../texts";

const LINE_PIXELS = 20; // as in code.css
const FOLLOW_SHARE = 0.35; // of the view above the line in motion

export class CodeView {
  readonly element: HTMLElement;
  private readonly content = h("div", { class: "code-content" });
  private readonly rows = h("ol", { class: "code-rows" });
  private readonly scroller: HTMLElement;
  private index = LineIndex.of("");
  private current = 0;
  private errors = new Set<number>();
  private follows = true;
  private readonly followBox: HTMLInputElement;

  constructor() {
    this.content.append(this.rows);
    this.scroller = h("div", { class: "code", tabindex: 0, role: "region", "aria-label": t.program.text, on: {
      scroll: () => this.draw(),
      wheel: () => this.follow(false), pointerdown: () => this.follow(false), keydown: () => this.follow(false),
    } }, this.content);
    this.followBox = h("input", { type: "checkbox", id: "follow-code", checked: true, on: { change: () => this.follow(this.followBox.checked) } });
    this.element = h("div", { class: "code-view" }, this.scroller,
      h("div", { class: "check" }, this.followBox, h("label", { for: "follow-code" }, t.program.follow)));
    new ResizeObserver(() => this.draw()).observe(this.scroller);
  }

  show(text: string): void {
    this.index = LineIndex.of(text);
    this.errors.clear();
    this.content.style.setProperty("height", `${contentHeight(this.lines())}px`);
    this.scroller.scrollTop = 0;
    this.draw();
  }

  /** @param line in motion, from 1; 0: none */
  setCurrent(line: number): void {
    if (line === this.current) return;
    this.current = line;
    if (this.follows && line > 0) this.scroller.scrollTop = scrollTo(this.lines(), line - 1, FOLLOW_SHARE);
    this.draw();
  }

  /** Marks lines with errors, and shows one of them. */
  showErrors(lines: readonly number[], shown: number): void {
    this.errors = new Set(lines);
    this.follow(false);
    this.scroller.scrollTop = scrollTo(this.lines(), Math.max(0, shown - 1), FOLLOW_SHARE);
    this.draw();
  }

  private lines(): Lines {
    return { count: this.index.count, height: LINE_PIXELS, view: this.scroller.clientHeight };
  }

  private follow(follows: boolean): void {
    this.follows = this.followBox.checked = follows;
  }

  private draw(): void {
    const { first, count, top } = windowAt(this.lines(), this.scroller.scrollTop);
    while (this.rows.children.length > count) this.rows.lastElementChild!.remove();
    while (this.rows.children.length < count) this.rows.append(h("li", {}, h("span", { class: "number" }), h("code", {})));
    this.rows.style.setProperty("transform", `translateY(${top}px)`);
    [...this.rows.children].forEach((row, i) => {
      const number = first + i + 1;
      setText(row.firstElementChild!, String(number));
      setText(row.lastElementChild!, this.index.line(number));
      setAttribute(row, "aria-current", number === this.current ? "true" : undefined);
      setAttribute(row, "data-look", this.errors.has(number) ? "bad" : undefined);
    });
  }
}
