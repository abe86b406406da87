// Shows how long pictures take to draw, for the test in a browser: the median of the last ones, as an attribute.

const LAST = 120;

export class FrameTimes {
  private readonly times_ms: number[] = [];

  constructor(private readonly element: HTMLElement) {}

  add(time_ms: number): void {
    this.times_ms.push(time_ms);
    if (this.times_ms.length > LAST) this.times_ms.shift();
    const sorted = [...this.times_ms].sort((a, b) => a - b);
    this.element.dataset["medianDrawMs"] = sorted[sorted.length >> 1]!.toFixed(2);
  }
}
