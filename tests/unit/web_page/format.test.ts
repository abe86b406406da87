import { expect, test } from "vitest";
import { bytes, fixed, percent } from "../../../clients/web/page/src/format/numbers";
import { age, duration } from "../../../clients/web/page/src/format/times";
import { parseNumber } from "../../../clients/web/page/src/views/number_cell";

test("numbers have a true minus, and no negative zero", () => {
  expect([1.23456, -2, -0.0001, 0, undefined, null, NaN].map((n) => fixed(n, 3))).toEqual(["1.235", "−2.000", "0.000", "0.000", "–", "–", "–"]);
});

test("progress never says 100 % before the end", () => {
  expect([0, 0.999, 1, 2, undefined].map(percent)).toEqual(["0 %", "99 %", "100 %", "100 %", "–"]);
});

test("bytes have a unit", () => {
  expect([12, 4200, 1_600_000].map(bytes)).toEqual(["12 B", "4.2 kB", "1.6 MB"]);
});

test("times left are rounded up", () => {
  expect([0, 6.2, 125, 3723, undefined, -1].map(duration)).toEqual(["0:00", "0:07", "2:05", "1:02:03", "–", "–"]);
});

test("ages get coarser as they grow", () => {
  expect([84, 1440, 12_300, 180_000, 7_300_000, null].map(age)).toEqual(["80 ms", "1.4 s", "12 s", "3 min", "2 h", "–"]);
});

test("a number is read as it is written", () => {
  expect(["1.5", " 2,25 ", "−3", "", "x"].map(parseNumber)).toEqual([1.5, 2.25, -3, undefined, undefined]);
});
