// The path drawn by WebGL, which a browser with a graphics processor takes.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openBrowser, openPage, shown, WEBGL } from "./browser.mjs";
import { StandInMachine } from "./stand_in_machine.mjs";
import { StandInServer, TOKENS } from "./stand_in_server.mjs";

/** Counts the pixels of the path's layer that have the colour of the path ahead, or of the path done. */
function pixels(page) {
  return page.evaluate(() => {
    const gl = document.querySelector(".surface").children[1].getContext("webgl2");
    const { width, height } = gl.canvas;
    const seen = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, seen);
    const near = (i, hex) => [0, 1, 2].every((c) => Math.abs(seen[i + c] - Number.parseInt(hex.slice(1 + 2 * c, 3 + 2 * c), 16)) < 12);
    const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    const count = (name) => { let n = 0; for (let i = 0; i < seen.length; i += 4) n += near(i, colour(name)) ? 1 : 0; return n; };
    return { ahead: count("ahead"), done: count("done") };
  });
}

test("WebGL draws what is ahead and what is done", async (t) => {
  const machine = new StandInMachine();
  machine.load("rose.gcode", 600);
  const server = new StandInServer(machine, process.env.PAGE, { pointsEachTick: 30 });
  t.after(() => server.close());
  const browser = await openBrowser(WEBGL);
  t.after(() => browser.close());
  const { page, complaints } = await openPage(browser, `${await server.listen()}/?draw=webgl#token=${TOKENS.operate}`);
  await shown(page);
  await page.getByText("600 segments").waitFor();
  await page.waitForTimeout(500);
  const before = await pixels(page);
  assert.ok(before.ahead > 500 && before.done === 0, JSON.stringify(before));
  machine.command("run", {});
  await page.locator(".job", { hasText: "Done" }).waitFor();
  await page.waitForTimeout(500);
  const after = await pixels(page);
  assert.ok(after.done > 500 && after.ahead < before.ahead / 4, JSON.stringify({ before, after }));
  assert.deepEqual(complaints, []);
});
