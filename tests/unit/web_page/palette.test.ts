import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { contrast } from "../../../clients/web/page/src/format/contrast";

const css = readFileSync(new URL("../../../clients/web/page/src/styles/palette.css", import.meta.url), "utf8");
const blocks = [...css.matchAll(/:root[^{]*\{([^{}]*)\}/g)].map((match) =>
  Object.fromEntries([...match[1]!.matchAll(/--([\w-]+): (#[0-9a-f]{6});/g)].map((entry) => [entry[1]!, entry[2]!])));

const AXES = [0, 1, 2, 3, 4, 5].map((n) => `axis-${n}`);
// Text on its ground; WCAG 2.2, 1.4.3.
const TEXT: [string, string][] = [
  ...["card", "paper", "raised"].flatMap((ground): [string, string][] => [["ink", ground], ["soft", ground]]),
  ["accent", "card"], ["accent", "raised"], ["on-accent", "accent"], ["on-emergency", "emergency"], ["bad", "card"],
  ...["good", "warning", "bad", "busy"].map((look): [string, string] => [look, `${look}-ground`]),
  ["ink", "warning-ground"], ["ink", "bad-ground"], ...AXES.map((axis): [string, string] => [axis, "card"]),
];
// Signs and edges of controls beside their ground; WCAG 2.2, 1.4.11.
const SIGNS: [string, string][] = [
  ["edge", "card"], ["edge", "raised"], ["focus", "card"], ["focus", "paper"], ["ahead", "card"], ["rapid", "card"], ["done", "card"], ["head", "card"],
  ["warning", "card"], ["emergency-edge", "card"], ["ink", "line"],
];

describe.each([["light", 0], ["dark, by the system", 1], ["dark, as chosen", 2]] as const)("the palette %s", (_, n) => {
  test.each(TEXT)("has text in %s on %s that is read", (ink, ground) => {
    expect(contrast(blocks[n]![ink]!, blocks[n]![ground]!)).toBeGreaterThanOrEqual(4.5);
  });

  test.each(SIGNS)("has signs in %s on %s that are seen", (sign, ground) => {
    expect(contrast(blocks[n]![sign]!, blocks[n]![ground]!)).toBeGreaterThanOrEqual(3);
  });
});

test("contrast is that of WCAG", () => {
  expect(contrast("#000000", "#ffffff")).toBeCloseTo(21, 5);
  expect(contrast("#777777", "#ffffff")).toBeCloseTo(4.48, 2);
});

test("both ways to the dark palette lead to the same", () => {
  expect(blocks[2]).toEqual(blocks[1]);
  expect(Object.keys(blocks[1]!)).toEqual(Object.keys(blocks[0]!));
});
