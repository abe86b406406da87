import { expect, test } from "vitest";
import { DrawBudget } from "../../../clients/web/page/src/path/draw_budget";

test("a slow host draws less, a fast one more, within bounds", () => {
  const budget = new DrawBudget(10_000);
  budget.note(35);
  expect(budget.most(true)).toBe(10_000);
  for (let i = 0; i < 50; ++i) budget.note(200);
  expect(budget.most(true)).toBe(1500);
  for (let i = 0; i < 100; ++i) budget.note(16);
  expect(budget.most(true)).toBe(200_000);
});

test("a view at rest may have more points than a moving one", () => {
  const budget = new DrawBudget(1000);
  expect(budget.most(false)).toBeGreaterThan(budget.most(true));
});
