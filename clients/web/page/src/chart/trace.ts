// Keeps the last seconds of some signals in a ring, so that a page that is open for days needs no more memory.

export class Trace {
  private readonly times: (number | null)[];
  private readonly values: (number | null)[][];
  private next = 0;
  private count = 0;

  /** @param most points that are kept of each signal */
  constructor(signals: number, private readonly most: number) {
    this.times = new Array<number | null>(most).fill(null);
    this.values = Array.from({ length: signals }, () => new Array<number | null>(most).fill(null));
  }

  add(time_s: number, values: readonly (number | null)[]): void {
    this.times[this.next] = time_s;
    this.values.forEach((signal, i) => (signal[this.next] = values[i] ?? null));
    this.next = (this.next + 1) % this.most;
    this.count = Math.min(this.count + 1, this.most);
  }

  /** Returns times relative to `now_s`, then the signals, the oldest first, of the last `span_s` seconds. */
  since(now_s: number, span_s: number): (number | null)[][] {
    const order = Array.from({ length: this.count }, (_, i) => (this.next - this.count + i + this.most) % this.most);
    const kept = order.filter((i) => now_s - (this.times[i] ?? -Infinity) <= span_s);
    return [kept.map((i) => this.times[i]! - now_s), ...this.values.map((signal) => kept.map((i) => signal[i] ?? null))];
  }
}
