// Lines that were entered before, newest last. The arrow keys step through them.

export const MOST_LINES = 100;

export class History {
  private lines: string[];
  private at: number;
  private draft = "";

  constructor(lines: readonly string[] = []) {
    this.lines = lines.slice(-MOST_LINES);
    this.at = this.lines.length;
  }

  /** Adds a line that was sent. Equal lines in a row are kept once. */
  add(line: string): void {
    if (line.trim() !== "" && this.lines.at(-1) !== line) this.lines = [...this.lines, line].slice(-MOST_LINES);
    this.at = this.lines.length;
    this.draft = "";
  }

  /** The line before. Keeps the text being written, to which later() returns. */
  earlier(written: string): string {
    if (this.at === this.lines.length) this.draft = written;
    this.at = Math.max(0, this.at - 1);
    return this.lines[this.at] ?? this.draft;
  }

  later(): string {
    this.at = Math.min(this.lines.length, this.at + 1);
    return this.lines[this.at] ?? this.draft;
  }

  all(): readonly string[] {
    return this.lines;
  }
}
