import { describe, expect, test } from "vitest";
import { colourOf, contourStep } from "../../../clients/web/page/src/probe/colour_scale";
import { heightAt, parseHeights } from "../../../clients/web/page/src/probe/height_map";
import { KINDS, type NumberField } from "../../../clients/web/page/src/probe/kinds";
import { orderOf, type Entered } from "../../../clients/web/page/src/probe/order";
import { de } from "../../../clients/web/page/src/texts/de";
import { en } from "../../../clients/web/page/src/texts/en";

const entered = (kind: Entered["kind"], numbers: Partial<Record<NumberField, number>>, more: Partial<Entered> = {}): Entered => ({
  kind, axis: "X", probe: undefined, number: (field) => numbers[field], flag: () => false, ...more,
});

describe("an order to measure", () => {
  test("has the members of its kind", () => {
    expect(orderOf(entered("bore", { diameter: 25, tip: 2, feed: 60, back: 1, down: 3 }))).toEqual({
      body: { kind: "bore", diameter: 25, tip: 2, feed: 60, back: 1 },
    });
    expect(orderOf(entered("corner", { way_x: 10, way_y: -8, beside: 5, tip: 2, feed: 60, back: 1 }))).toEqual({
      body: { kind: "corner", way: { X: 10, Y: -8 }, beside: 5, tip: 2, feed: 60, back: 1 },
    });
    expect(orderOf(entered("surface", { from_x: 1, to_x: 9, from_y: 2, to_y: 8, spacing: 4, down: 5, feed: 60, back: 1 }, { probe: 1 }))).toEqual({
      body: { kind: "surface", from: { X: 1, Y: 2 }, to: { X: 9, Y: 8 }, spacing: 4, down: 5, feed: 60, back: 1, probe: 1 },
    });
  });

  test("of one touch goes from where the axis stands, with its flags", () => {
    expect(orderOf(entered("touch", { way: -5, feed: 30 }, { axis: "Z", flag: (flag) => flag === "away" }))).toEqual({
      body: { kind: "touch", to: { Z: -5 }, feed: 30, away: true, relative: true },
    });
  });

  test("names the first field that is no number", () => {
    expect(orderOf(entered("edge", { way: 5, feed: 60 }))).toEqual({ missing: "tip" });
  });

  test("has a text for each kind and field, in both languages", () => {
    for (const texts of [en, de]) {
      for (const [kind, { numbers }] of Object.entries(KINDS)) {
        expect(texts.probe.hint[kind as Entered["kind"]]).not.toBe("");
        for (const field of numbers) expect(texts.probe.field[field]).toMatch(/, mm(\/min)?$/);
      }
    }
  });
});

describe("a map of heights", () => {
  const table = "x_mm,y_mm,z_mm\n10,20,1\n20,20,2\n40,20,4\n10,30,3\n20,30,4\n40,30,6\n";

  test("is a grid, in any order of its lines", () => {
    const map = parseHeights(table)!;
    expect([map.x, map.y, map.z, map.lowest, map.highest]).toEqual([[10, 20, 40], [20, 30], [1, 2, 4, 3, 4, 6], 1, 6]);
    const [head, ...lines] = table.trim().split("\n");
    expect(parseHeights([head, ...lines.reverse()].join("\n"))).toEqual(map);
  });

  test("is none of a table with a point too few or no number", () => {
    expect(parseHeights(table.replace("40,30,6\n", ""))).toBeUndefined();
    expect(parseHeights(table.replace("40,30,6", "40,30,high"))).toBeUndefined();
    expect(parseHeights("x_mm,y_mm,z_mm\n1,1,0\n2,1,0\n")).toBeUndefined();
  });

  test("is bilinear between its points, and beyond them as its edge", () => {
    const map = parseHeights(table)!;
    expect([[15, 25], [30, 20], [40, 30], [100, 0]].map(([x, y]) => heightAt(map, x!, y!))).toEqual([2.5, 3, 6, 4]);
  });
});

describe("the colours of heights", () => {
  test("get brighter from low to high", () => {
    const brightness = Array.from({ length: 11 }, (_, i) => colourOf(i / 10)).map(([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
    expect([...brightness].sort((a, b) => a - b)).toEqual(brightness);
    expect([colourOf(-1), colourOf(2)]).toEqual([colourOf(0), colourOf(1)]);
  });

  test("have 4 to 10 contour lines at round heights", () => {
    expect([1, 0.35, 0.04, 12, 0].map(contourStep)).toEqual([0.1, 0.05, 0.005, 2, 0].map((step) => expect.closeTo(step, 12)));
  });
});
