// A surface's heights as a picture: colours with a scale, contour lines, the points that were touched, and the height
// under the pointer.
import { h, setText } from "../../dom/element";
import { fixed } from "../../format/numbers";
import { colourOf, contourStep } from "../../probe/colour_scale";
import { heightAt, type HeightMap } from "../../probe/height_map";
import { fill, t } from "../../texts";

const LONG_PX = 360; // of the longer side
const LEAST_PX = 60;
const POINT_PX = 4;
const MOST_POINTS_SHOWN = 900;
const DARKER = 0.55; // contour lines

export class HeightView {
  readonly element: HTMLElement;
  private readonly canvas = h("canvas", { class: "heights", role: "img" });
  private readonly scale = h("canvas", { class: "height-scale", width: 1, height: 128, "aria-hidden": "true" });
  private readonly high = h("span", {});
  private readonly low = h("span", {});
  private readonly readout = h("p", { class: "soft", role: "status" });
  private readonly save = h("a", { class: "action small", href: "/api/heights", download: "heights.csv" }, t.probe.saveHeights);
  private map: HeightMap | undefined;

  constructor() {
    this.canvas.addEventListener("pointermove", (event) => this.read(event));
    this.canvas.addEventListener("pointerleave", () => this.describe());
    this.element = h("figure", { class: "height-map" },
      h("div", { class: "height-picture" }, this.canvas, h("div", { class: "height-scale-box" }, this.scale), h("div", { class: "height-ends" }, this.high, this.low)),
      h("figcaption", {}, this.readout), this.save);
  }

  draw(map: HeightMap): void {
    this.map = map;
    const width_mm = map.x.at(-1)! - map.x[0]!;
    const height_mm = map.y.at(-1)! - map.y[0]!;
    const perMm = LONG_PX / Math.max(width_mm, height_mm);
    this.canvas.width = Math.max(LEAST_PX, Math.round(width_mm * perMm));
    this.canvas.height = Math.max(LEAST_PX, Math.round(height_mm * perMm));
    this.paintHeights(map);
    this.paintPoints(map);
    this.paintScale();
    setText(this.high, `${fixed(map.highest, 3)} mm`);
    setText(this.low, `${fixed(map.lowest, 3)} mm`);
    this.describe();
  }

  private describe(): void {
    const map = this.map;
    if (map === undefined) return;
    const text = fill(t.probe.heights, {
      range: fixed(map.highest - map.lowest, 3), step: String(Number(contourStep(map.highest - map.lowest).toFixed(6))),
      from_x: fixed(map.x[0], 1), to_x: fixed(map.x.at(-1), 1), from_y: fixed(map.y[0], 1), to_y: fixed(map.y.at(-1), 1),
    });
    this.canvas.setAttribute("aria-label", text);
    setText(this.readout, text);
  }

  private paintHeights(map: HeightMap): void {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d")!;
    const image = context.createImageData(width, height);
    const range = map.highest - map.lowest;
    const step = contourStep(range);
    const level = (z: number) => (step > 0 ? Math.floor(z / step) : 0);
    let above: number[] = [];
    for (let row = 0; row < height; ++row) {
      const levels: number[] = [];
      for (let column = 0; column < width; ++column) {
        const [x, y] = this.placeOf(map, column + 0.5, row + 0.5);
        const z = heightAt(map, x, y);
        levels.push(level(z));
        const isLine = (column > 0 && levels[column - 1] !== levels[column]) || (row > 0 && above[column] !== levels[column]);
        const share = range > 0 ? (z - map.lowest) / range : 0.5;
        const colour = colourOf(share).map((part) => (isLine ? part * DARKER : part));
        image.data.set([...colour, 255], 4 * (row * width + column));
      }
      above = levels;
    }
    context.putImageData(image, 0, 0);
  }

  private paintPoints(map: HeightMap): void {
    if (map.z.length > MOST_POINTS_SHOWN) return;
    const context = this.canvas.getContext("2d")!;
    const { width, height } = this.canvas;
    const share = (lines: readonly number[], at: number) => (at - lines[0]!) / (lines.at(-1)! - lines[0]!);
    context.lineWidth = 1;
    for (const y of map.y) {
      for (const x of map.x) {
        context.beginPath();
        context.arc(share(map.x, x) * width, (1 - share(map.y, y)) * height, POINT_PX, 0, 2 * Math.PI);
        context.fillStyle = "#ffffff";
        context.strokeStyle = "#000000";
        context.fill();
        context.stroke();
      }
    }
  }

  private paintScale(): void {
    const context = this.scale.getContext("2d")!;
    for (let row = 0; row < this.scale.height; ++row) {
      const [r, g, b] = colourOf(1 - row / (this.scale.height - 1));
      context.fillStyle = `rgb(${r} ${g} ${b})`;
      context.fillRect(0, row, 1, 1);
    }
  }

  /** Y rises upwards. */
  private placeOf(map: HeightMap, column: number, row: number): [number, number] {
    const along = (lines: readonly number[], share: number) => lines[0]! + (lines.at(-1)! - lines[0]!) * share;
    return [along(map.x, column / this.canvas.width), along(map.y, 1 - row / this.canvas.height)];
  }

  private read(event: PointerEvent): void {
    if (this.map === undefined) return;
    const shown = this.canvas.getBoundingClientRect();
    const [x, y] = this.placeOf(this.map, ((event.clientX - shown.left) / shown.width) * this.canvas.width,
      ((event.clientY - shown.top) / shown.height) * this.canvas.height);
    setText(this.readout, fill(t.probe.heightAt, { x: fixed(x, 1), y: fixed(y, 1), z: fixed(heightAt(this.map, x, y), 3) }));
  }
}
