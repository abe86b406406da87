// Waiting for what a slow host delays.
import assert from "node:assert/strict";

export const PATIENCE_MS = 90_000;

export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export async function until(what, holds) {
  for (const end = Date.now() + PATIENCE_MS; Date.now() < end; await pause(50)) if (await holds()) return;
  assert.fail(`never: ${what}`);
}
