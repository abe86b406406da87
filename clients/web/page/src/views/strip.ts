// Velocity or position of the axes in the last seconds, as a strip chart.
import uPlot from "uplot";
import type { Machine } from "../api/contract";
import { Trace } from "../chart/trace";
import { h, setAttribute, setText } from "../dom/element";
import { onTheme, paletteColour } from "../dom/theme";
import { unitTexts } from "../format/units";
import { fill, t } from "../texts";
import type { Model, View } from "./view";

const SPAN_S = 20;
const MOST_POINTS = 400; // of 20 s, at up to 20 a second
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3], [4, 2], [12, 6]]; // lines differ without colour too

type Signal = "velocity" | "position";

export class Strip implements View {
  readonly element: HTMLElement;
  private readonly plotArea = h("div", { class: "plot" });
  private readonly traces: Record<Signal, Trace>;
  private readonly switches: Record<Signal, HTMLButtonElement>;
  private readonly unit = h("span", { class: "soft" });
  private signal: Signal = "velocity";
  private plot: uPlot | undefined;
  private added_ms = 0;

  constructor(private readonly machine: Machine) {
    const count = machine.axes.length;
    this.traces = { velocity: new Trace(count, MOST_POINTS), position: new Trace(count, MOST_POINTS) };
    const choose = (signal: Signal) => h("button", { type: "button", on: { click: () => this.choose(signal) } }, t.strip[signal]);
    this.switches = { velocity: choose("velocity"), position: choose("position") };
    const legend = machine.axes.map((axis, i) => h("span", { class: `key axis-${i % 6}` }, axis.name));
    this.element = h("section", { class: "strip", "aria-label": fill(t.strip.title, { seconds: SPAN_S }) },
      h("div", { class: "heading" }, h("h2", {}, fill(t.strip.title, { seconds: SPAN_S })), this.unit, h("div", { class: "legend" }, ...legend),
        h("div", { class: "switch", role: "group", "aria-label": fill(t.strip.title, { seconds: SPAN_S }) }, this.switches.velocity, this.switches.position)),
      this.plotArea);
    onTheme(() => this.build());
    new ResizeObserver(() => this.fit()).observe(this.plotArea);
    this.choose("velocity");
  }

  show({ state, now_ms, isConnected }: Model): void {
    if (isConnected && now_ms - this.added_ms >= 1000 * (SPAN_S / MOST_POINTS)) {
      this.added_ms = now_ms;
      for (const signal of ["velocity", "position"] as const) {
        this.traces[signal].add(now_ms / 1000, this.machine.axes.map(({ name }) => state.axes[name]?.[signal] ?? null));
      }
    }
    this.plot?.setData(this.traces[this.signal].since(now_ms / 1000, SPAN_S) as uPlot.AlignedData);
  }

  private choose(signal: Signal): void {
    this.signal = signal;
    setText(this.unit, unitTexts(this.machine.axes, signal === "velocity" ? "/s" : ""));
    for (const [name, button] of Object.entries(this.switches)) setAttribute(button, "aria-pressed", String(name === signal));
    this.build();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.plotArea;
    if (this.plot === undefined) this.build();
    else if (width > 0 && height > 0) this.plot.setSize({ width, height });
  }

  private build(): void {
    this.plot?.destroy();
    this.plot = undefined;
    const { clientWidth: width, clientHeight: height } = this.plotArea;
    if (width === 0 || height === 0) return;
    const axis = { stroke: paletteColour("soft"), grid: { stroke: paletteColour("grid"), width: 1 }, ticks: { show: false }, font: "12px system-ui, sans-serif" };
    this.plot = new uPlot({
      width, height, legend: { show: false }, cursor: { show: false }, padding: [6, 8, 0, 0],
      scales: { x: { time: false, range: () => [-SPAN_S, 0] } },
      axes: [
        { ...axis, size: 24, values: (_, ticks) => ticks.map((tick) => `${tick} s`.replace("-", "−")) },
        { ...axis, size: 48, values: (_, ticks) => ticks.map((tick) => String(tick).replace("-", "−")) },
      ],
      series: [{}, ...this.machine.axes.map(({ name }, i) => ({
        label: name, stroke: paletteColour(`axis-${i % 6}`), width: 1.75, dash: DASHES[i % 6]!, points: { show: false },
      }))],
    }, this.traces[this.signal].since(performance.now() / 1000, SPAN_S) as uPlot.AlignedData, this.plotArea);
  }
}
