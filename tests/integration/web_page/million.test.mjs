// A program of a million segments is drawn, turned and followed. Times are printed but not checked: they depend on the
// host.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openBrowser, openPage, shown } from "./browser.mjs";
import { StandInMachine } from "./stand_in_machine.mjs";
import { StandInServer, TOKENS } from "./stand_in_server.mjs";

const SEGMENTS = 1_000_000;

/** Milliseconds between the frames that the browser shows while the view is turned. */
function turn(page) {
  return page.evaluate(async () => {
    const surface = document.querySelector(".surface");
    const times = [];
    let before = await new Promise(requestAnimationFrame);
    for (let i = 0; i < 60; ++i) {
      surface.dispatchEvent(new WheelEvent("wheel", { deltaY: i % 20 < 10 ? -30 : 30, clientX: 700, clientY: 400, cancelable: true }));
      const now = await new Promise(requestAnimationFrame);
      times.push(now - before);
      before = now;
    }
    times.sort((a, b) => a - b);
    return { median: times[30], worst: times[59] };
  });
}

test("a million segments", async (t) => {
  const machine = new StandInMachine();
  machine.load("million.gcode", SEGMENTS);
  const server = new StandInServer(machine, process.env.PAGE, { pointsEachTick: 2000 });
  t.after(() => server.close());
  const browser = await openBrowser();
  t.after(() => browser.close());
  const { page, complaints } = await openPage(browser, `${await server.listen()}/#token=${TOKENS.operate}`);
  const started = Date.now();
  await shown(page);
  await page.getByText("1,000,000 segments").waitFor({ timeout: 120_000 });
  console.log(`shown ${((Date.now() - started) / 1000).toFixed(1)} s after the address was opened`);
  await page.waitForTimeout(1000);
  const at_rest = await turn(page);
  console.log(`zoomed: median ${at_rest.median.toFixed(1)} ms a frame, worst ${at_rest.worst.toFixed(1)} ms (no graphics processor)`);
  machine.command("run", {});
  await page.locator(".mode", { hasText: "Running" }).waitFor();
  const running = await turn(page);
  console.log(`zoomed while it runs: median ${running.median.toFixed(1)} ms a frame, worst ${running.worst.toFixed(1)} ms`);
  await page.locator('.code li[aria-current="true"]').waitFor();
  assert.ok((await page.locator(".code li").count()) < 200, "only the lines in view are in the document");
  assert.deepEqual(complaints, []);
});
