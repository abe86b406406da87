// Loads a program. The server checks it first, and names each line with an error.
import { loadProgram, programText } from "../api/client";
import type { LoadedProgram, Machine, Problem, ProblemLine } from "../api/contract";
import { h, icon, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { bytes } from "../format/numbers";
import { fill, t } from "../texts";
import { CodeView } from "./code_view";
import type { Report } from "./command_button";
import type { Model, View } from "./view";

const NOT_LOADED = 0; // no program has this id

export class ProgramTab implements View {
  readonly element: HTMLElement;
  private readonly code = new CodeView();
  private readonly name = h("strong", { class: "file-name" });
  private readonly figures = h("span", { class: "soft" });
  private readonly errors = h("div", { class: "errors", role: "alert", hidden: true });
  private readonly notes = h("details", { class: "notes", hidden: true });
  private readonly file: HTMLInputElement;
  private readonly load: HTMLElement;
  private shown = NOT_LOADED;

  constructor(private readonly machine: Machine, private readonly report: Report) {
    this.file = h("input", { type: "file", id: "program-file", class: "hidden-file", on: { change: () => void this.upload(this.file.files?.[0]) } });
    this.load = h("label", { for: "program-file", class: "action" }, icon(ICONS.upload), h("span", {}, t.program.load));
    this.element = h("div", { class: "program", on: {
      dragover: (event) => event.preventDefault(),
      drop: (event) => {
        event.preventDefault();
        void this.upload(event.dataTransfer?.files[0]);
      },
    } }, h("div", { class: "file" }, this.file, this.load, h("div", { class: "file-text" }, this.name, this.figures)), this.errors, this.notes, this.code.element);
  }

  show({ state, role }: Model): void {
    const program = state.program ?? undefined;
    if ((program?.id ?? -1) !== this.shown) {
      this.shown = program?.id ?? -1;
      void this.display(program);
    }
    show(this.load, role === "operate");
    this.file.disabled = role !== "operate";
    const job = state.job ?? undefined;
    const isOurs = job?.kind === "run" && program !== undefined && job.name === program.name && job.outcome !== "Done";
    if (this.errors.hidden) this.code.setCurrent(isOurs ? job.line ?? 0 : 0);
  }

  private async display(program: LoadedProgram | undefined): Promise<void> {
    setText(this.name, program?.name ?? t.program.none);
    setText(this.figures, program ? fill(t.program.figures, { lines: program.lines.toLocaleString(), size: bytes(program.bytes) }) : t.program.drop);
    const notes = program?.notes ?? [];
    this.notes.replaceChildren(h("summary", {}, fill(t.program.notes, { count: notes.length })),
      h("ul", {}, ...notes.map((note) => h("li", {}, fill(t.program.noteAt, note)))));
    show(this.notes, notes.length > 0);
    const text = program === undefined ? undefined : await programText();
    if (this.shown !== (program?.id ?? -1)) return;
    this.code.show(text?.ok ? text.value : "");
  }

  private async upload(file: File | undefined): Promise<void> {
    this.file.value = ""; // so that the same file can be chosen again
    if (file === undefined || this.file.disabled) return;
    const limit = this.machine.limits.program_bytes;
    if (file.size > limit) {
      const detail = fill(t.program.tooLong, { size: bytes(file.size), limit: bytes(limit) });
      return this.refused(file, { title: detail, status: 413, code: "too-long", detail });
    }
    setText(this.figures, t.program.checking);
    const answer = await loadProgram(file.name, file);
    if (answer.ok) this.dismiss();
    else await this.refused(file, answer.problem);
  }

  /** Shows the refused file's text, so that each error is at its line. */
  private async refused(file: File, problem: Problem): Promise<void> {
    const errors = problem.errors ?? [];
    if (errors.length === 0) {
      this.dismiss();
      return this.report({ ok: false, problem });
    }
    this.errors.replaceChildren(h("strong", {}, fill(t.program.failed, { name: file.name })),
      h("button", { type: "button", class: "plain tool", "aria-label": t.page.dismiss, on: { click: () => this.dismiss() } }, icon(ICONS.close)),
      h("ul", {}, ...errors.map((error) => this.errorLine(error, errors))));
    show(this.errors, true);
    setText(this.name, file.name);
    setText(this.figures, "");
    this.code.show(await file.text());
    this.code.showErrors(errors.map((error) => error.line), errors[0]!.line);
  }

  private errorLine(error: ProblemLine, errors: readonly ProblemLine[]): HTMLElement {
    const text = fill(error.line > 0 ? t.program.errorAt : t.program.error, { ...error });
    const go = () => this.code.showErrors(errors.map((e) => e.line), error.line);
    return h("li", {}, h("button", { type: "button", class: "plain", on: { click: go } }, text));
  }

  /** Shows the server's program again. */
  private dismiss(): void {
    show(this.errors, false);
    this.shown = NOT_LOADED;
  }
}
