import { expect, test } from "vitest";
import { ageNow, freshness, STALE_AFTER_MS } from "../../../clients/web/page/src/state/freshness";

test("a value's age grows from its age at the server", () => {
  expect(ageNow(200, 1000, 1300)).toBe(500);
  expect(ageNow(undefined, 1000, 1300)).toBeUndefined();
});

test("a value is live, then stale; without a value nothing is known", () => {
  expect([0, STALE_AFTER_MS, STALE_AFTER_MS + 1, undefined].map(freshness)).toEqual(["live", "live", "stale", "unknown"]);
});
