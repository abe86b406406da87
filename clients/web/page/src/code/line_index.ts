// Indexes where each line of a text begins, so that any line of a long program is found at once.

export class LineIndex {
  private constructor(private readonly text: string, private readonly starts: Uint32Array) {}

  static of(text: string): LineIndex {
    let starts = new Uint32Array(1024), count = 1;
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) {
      if (at + 1 === text.length) break; // a line break at the end begins no further line
      if (count === starts.length) {
        const more = new Uint32Array(2 * count);
        more.set(starts);
        starts = more;
      }
      starts[count++] = at + 1;
    }
    return new LineIndex(text, starts.slice(0, text.length === 0 ? 0 : count));
  }

  get count(): number {
    return this.starts.length;
  }

  /** @param number from 1 */
  line(number: number): string {
    const start = this.starts[number - 1];
    if (start === undefined) return "";
    const end = this.starts[number] ?? this.text.length;
    return this.text.slice(start, end).replace(/\r?\n$/, "");
  }
}
