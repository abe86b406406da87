// The job with its progress and the time left, and the button that runs the loaded program.
import type { Job, State } from "../api/contract";
import { h, setAttribute, setText, show } from "../dom/element";
import { ICONS } from "../dom/icons";
import { percent } from "../format/numbers";
import { duration } from "../format/times";
import { ageNow, freshness } from "../state/freshness";
import { pauseText } from "../state/pause_texts";
import { fill, t } from "../texts";
import { button, type Give } from "./command_button";
import type { Model, View } from "./view";

/** The job's name, else its kind, else its number: of another client's ended job neither is known. */
export function jobName({ name, kind, number }: Job): string {
  return name ?? (kind ? t.job.kind[kind] : fill(t.job.number, { number }));
}

/** What the job does now, in a few words. */
export function jobSentence(job: Job, hold: State["hold"], pause?: State["pause"]): string {
  if (job.outcome) return t.job.outcome[job.outcome];
  if (pause) return pauseText(pause, t);
  if (hold?.state === "braking") return t.job.braking;
  if (hold) return fill(t.job.held, { line: hold.line ?? "–" });
  if (job.waits_for_program) return t.job.waits;
  return job.line ? fill(t.job.line, { line: job.line }) : "";
}

export class JobCard implements View {
  readonly element: HTMLElement;
  private readonly name = h("strong", { class: "job-name" });
  private readonly sentence = h("span", { class: "soft" });
  private readonly bar = h("progress", { max: 1, value: 0, "aria-label": t.job.progress });
  private readonly share = h("span", { class: "share" });
  private readonly left = h("span", { class: "left" });
  private readonly run: HTMLButtonElement;
  private program: number | undefined;

  constructor(give: Give) {
    this.run = button(t.commands.run, ICONS.play, "action primary", () => void give("run", this.program === undefined ? {} : { program: this.program }));
    this.element = h("section", { class: "job", "aria-label": t.job.title },
      h("div", { class: "heading" }, h("h2", {}, t.job.title), this.name, this.sentence),
      h("div", { class: "run" }, this.run, h("div", { class: "progress" }, this.bar, h("div", { class: "progress-figures" }, this.share, this.left))));
  }

  show(model: Model): void {
    const { state, role } = model;
    const job = state.job ?? undefined;
    this.program = state.program?.id;
    setText(this.name, job === undefined ? t.job.none : jobName(job));
    setText(this.sentence, job === undefined ? "" : jobSentence(job, state.hold, state.pause));
    setAttribute(this.sentence, "data-look", job?.outcome === "Failed" ? "bad" : undefined);
    const old = ageNow(state.link.age_ms ?? undefined, model.contact_ms, model.now_ms);
    setAttribute(this.element, "data-fresh", freshness(old) === "live" ? "live" : "stale");
    const progress = job?.outcome === "Done" ? 1 : job?.progress ?? undefined;
    this.bar.value = progress ?? 0;
    setText(this.share, job === undefined ? "" : percent(progress));
    setText(this.left, job === undefined || job.outcome ? "" : `${duration(job.time_left_s)} ${t.job.left}`);
    show(this.run, role === "operate");
    setAttribute(this.run, "disabled", state.mode !== "Idle" || state.program === null || state.program === undefined);
  }
}
