// Tests the tab Probe of the page in a real browser, with a simulated mill that has a probe, a tool setter and a crooked
// plate: deploy/examples/crooked-plate.textproto.
import assert from "node:assert/strict";
import { after, before, beforeEach, describe, test } from "node:test";
import { DESKTOP, openBrowser, openPage, PHONE, shown } from "./browser.mjs";
import { lockstep, Server } from "./real_machine.mjs";

const FEED = "30"; // with these slots the axes may go on behind a touch for 0.8 mm at five times as much
const NEAR_MM = 0.006; // two steps and a rounding
const server = new Server();
let browser, page, complaints;

/** The top of the plate, as the machine's file describes it. */
const top = (x, y) =>
  30 + 0.008 * (x - 60) - 0.005 * (y - 40) + 0.15 * Math.sin((2 * Math.PI * (x - 60)) / 120) * Math.sin((2 * Math.PI * (y - 40)) / 120);

before(async () => {
  browser = await openBrowser();
  await server.start();
});
after(async () => {
  await browser.close();
  await server.end();
});
beforeEach(async () => {
  await server.settle();
});

async function enter(role = "operate", options = DESKTOP) {
  ({ page, complaints } = await openPage(browser, server.address(role), options));
  await shown(page);
  await page.getByRole("tab", { name: "Probe" }).click();
}
async function leave() {
  await page.context().close();
  assert.deepEqual(complaints, []);
}
/** Lifts, crosses and goes down, as another client. */
function stand(x, y, z) {
  for (const place of [["Z=60"], [`X=${x}`, `Y=${y}`], [`Z=${z}`]]) lockstep("move", ...place, "--take");
}
/** Chooses a kind, fills in its fields by their names and starts it. Returns the measurement when it is over. */
async function measure(kind, fields, axis) {
  const { measurement: before } = await server.state();
  await page.getByLabel("Measure").selectOption(kind);
  if (axis !== undefined) await page.getByLabel("Axis", { exact: true }).selectOption(axis);
  for (const [name, value] of Object.entries(fields)) await page.locator(`#probe-${name}`).fill(String(value));
  const start = page.getByRole("button", { name: "Start", exact: true });
  await start.and(page.locator(":enabled")).click();
  const { measurement } = await server.becomes(
    `a measured ${kind}`,
    ({ mode, measurement: now }) => mode === "Idle" && now !== null && now.number !== before?.number && (now.result !== null || now.problem !== null),
  );
  assert.equal(measurement.kind, kind);
  return measurement;
}
const near = (value, is, most = NEAR_MM) => assert.ok(Math.abs(value - is) <= most, `${value} instead of ${is}`);
const value = (name) => page.locator(".probe-values div", { has: page.locator("dt", { hasText: new RegExp(`^${name}$`) }) }).locator("dd");

describe("the tab Probe", () => {
  test("measures a bore, and makes its centre the zero of a work offset", async () => {
    await enter();
    stand(133.6, 114.4, 24);
    const { result } = await measure("bore", { diameter: 8, tip: 2, feed: FEED, back: 0.5 });
    near(result.x, 134);
    near(result.y, 114);
    near(result.diameter_x, 8, 2 * NEAR_MM);
    assert.equal(result.input, "tip");
    assert.match(await value("Diameter along X").textContent(), /^(7\.99|8\.00)\d+ mm$/);
    assert.equal(await value("Input").textContent(), "tip");
    await page.locator("#probe-system").selectOption("G55");
    await page.getByRole("button", { name: "Set zero or rotation" }).click();
    await page.getByText("G55 is set.").waitFor();
    const { origin } = (await server.state()).offsets.systems.G55;
    near(origin.X, 134);
    near(origin.Y, 114);
    await leave();
  });

  test("touches the top of the plate, which then reads 1.5 mm", async () => {
    await enter();
    stand(80, 60, 32);
    const { result } = await measure("touch", { way: -4, feed: FEED }, "Z");
    near(result.touch.Z, top(80, 60), 0.05); // the ball touches the crooked plate beside its lowest point
    await page.locator("#probe-reads").fill("1,5");
    await page.getByRole("button", { name: "Set zero or rotation" }).click();
    await page.getByText("G54 is set.").waitFor();
    near((await server.state()).offsets.systems.G54.origin.Z, result.touch.Z - 1.5, 1e-6);
    await leave();
  });

  test("says that nothing was touched", async () => {
    await enter();
    stand(80, 60, 60);
    const { problem } = await measure("touch", { way: -1, feed: FEED }, "Z");
    assert.equal(problem.code, "probe-not-touched");
    await page.locator(".probe-result .trouble", { hasText: "a probing move came to its end without a touch Remedy: check the probe" }).waitFor();
    assert.ok(await page.getByRole("button", { name: "Set zero or rotation" }).isHidden());
    await leave();
  });

  test("measures a tool by the setter, and keeps its length", async () => {
    await enter();
    stand(20, 150, 43);
    await page.getByLabel("Measure").selectOption("tool");
    await page.getByLabel("Probe", { exact: true }).and(page.locator("select")).selectOption("1");
    const { result } = await measure("tool", { down: 4, setter: 30, feed: FEED, back: 0.5 });
    near(result.tool_length, 11.5);
    await page.locator("#probe-tool").fill("3");
    await page.getByRole("button", { name: "Set tool length" }).click();
    await page.getByText("The length of tool 3 is set.").waitFor();
    near((await server.state()).tools[3].offset.Z, 11.5);
    await leave();
  });

  test("draws the heights of a surface, and saves them for --height-map", async () => {
    await enter("operate", PHONE);
    stand(70, 50, 32);
    const { result } = await measure("surface", { from_x: 70, to_x: 110, from_y: 50, to_y: 90, spacing: 20, down: 4, feed: FEED, back: 0.5 });
    const picture = page.locator("canvas.heights");
    await picture.waitFor();
    assert.match(await picture.getAttribute("aria-label"), /^0\.\d+ mm from the lowest to the highest/);
    const colours = await picture.evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return new Set(Array.from({ length: data.length / 4 }, (_, i) => `${data[4 * i]} ${data[4 * i + 1]}`)).size;
    });
    assert.ok(colours > 50, `${colours} colours`);
    const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: "Save heights.csv" }).click()]);
    assert.equal(saved.suggestedFilename(), "heights.csv");
    const table = await (await server.ask("/api/heights")).text();
    const points = table.trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
    assert.equal(points.length, 9);
    for (const [x, y, z] of points) near(z, top(x, y), 0.05);
    near(Math.min(...points.map(([, , z]) => z)), result.lowest, 1e-5);
    await leave();
  });

  test("says what is wrong with a value before anything moves", async () => {
    await enter();
    await page.getByLabel("Measure").selectOption("boss");
    for (const [name, number] of Object.entries({ diameter: 20, down: 1000, clearance: 5, tip: 2, feed: FEED })) {
      await page.locator(`#probe-${name}`).fill(String(number));
    }
    const { job } = await server.state();
    await page.getByRole("button", { name: "Start", exact: true }).click();
    await page.locator(".notice", { hasText: "outside the travel of axis" }).waitFor();
    assert.equal((await server.state()).job?.number, job?.number);
    await page.locator("#probe-tip").fill("ball");
    await page.getByRole("button", { name: "Start", exact: true }).click();
    assert.equal(await page.locator("#probe-tip").getAttribute("aria-invalid"), "true");
    await leave();
  });

  test("shows a viewer the result without its controls", async () => {
    await enter("view");
    assert.equal(await page.getByRole("button", { name: "Start", exact: true }).count(), 0);
    await value("Input").waitFor();
    await leave();
  });
});
