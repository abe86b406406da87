import { describe, expect, test } from "vitest";
import { LineIndex } from "../../../clients/web/page/src/code/line_index";
import { contentHeight, MOST_HEIGHT, scrollTo, windowAt } from "../../../clients/web/page/src/code/window";

describe("lines of a text", () => {
  test("are found, with any ending", () => {
    const index = LineIndex.of("G21\r\nG0 X1\n\nM2");
    expect([index.count, ...[1, 2, 3, 4, 5].map((n) => index.line(n))]).toEqual([4, "G21", "G0 X1", "", "M2", ""]);
    expect([LineIndex.of("").count, LineIndex.of("M2\n").count]).toEqual([0, 1]);
  });

  test("are found in a text of many lines", () => {
    const index = LineIndex.of(Array.from({ length: 5000 }, (_, i) => `N${i + 1}`).join("\n"));
    expect([index.count, index.line(1025), index.line(5000)]).toEqual([5000, "N1025", "N5000"]);
  });
});

describe("the window on a text", () => {
  const short = { count: 100, height: 20, view: 200 };
  const long = { count: 5_000_000, height: 20, view: 200 };

  test("has the lines in view and no more", () => {
    expect(windowAt(short, 0)).toEqual({ first: 0, count: 11, top: 0 });
    expect(windowAt(short, 50)).toEqual({ first: 2, count: 11, top: 40 });
    expect(windowAt(short, 1800)).toEqual({ first: 90, count: 10, top: 1800 });
  });

  test("of a very long text is of a height that browsers draw", () => {
    expect(contentHeight(long)).toBe(MOST_HEIGHT);
    expect(windowAt(long, 0).first).toBe(0);
    const end = windowAt(long, MOST_HEIGHT - 200);
    expect(end.first + end.count).toBe(5_000_000);
  });

  test.each([short, long])("shows each line where it is asked for", (lines) => {
    for (const line of [0, 1, 50, 99, lines.count >> 1, lines.count - 1]) {
      const { first, count } = windowAt(lines, scrollTo(lines, line, 0.35));
      expect(first).toBeLessThanOrEqual(line);
      expect(first + count).toBeGreaterThan(line);
    }
  });

  test("of a text that fits is the whole text", () => {
    expect(windowAt({ count: 3, height: 20, view: 200 }, 0)).toEqual({ first: 0, count: 3, top: 0 });
    expect(scrollTo({ count: 3, height: 20, view: 200 }, 2, 0.5)).toBe(0);
  });
});
