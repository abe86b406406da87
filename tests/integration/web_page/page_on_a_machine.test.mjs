// Tests the page in a real browser, with lockstep-web and a simulated machine: a person acts, and the machine reacts.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, describe, test } from "node:test";
import { DESKTOP, openBrowser, openPage, PHONE, shown } from "./browser.mjs";
import { lockstep, Server, startLockstep } from "./real_machine.mjs";
import { pause, until } from "./waiting.mjs";

const LONG = `G21 G90\n${"G1 X100 F1200\nG1 X20\n".repeat(40)}M2\n`;
let browser, open;
const server = new Server();

before(async () => {
  browser = await openBrowser();
  await server.start();
});
after(async () => {
  await browser.close();
  await server.end();
});
beforeEach(async () => {
  open = [];
  await server.settle();
});
afterEach(async () => {
  for (const { context, complaints } of open) {
    await context.close();
    assert.deepEqual(complaints, []);
  }
});

async function enter(role = "operate", options = DESKTOP) {
  const opened = await openPage(browser, server.address(role), options);
  open.push(opened);
  await shown(opened.page);
  return opened.page;
}
const button = (page, name) => page.getByRole("button", { name, exact: true });
const mode = (page, text) =>
  page
    .locator(".mode", { hasText: new RegExp(`^${text}$`) })
    .waitFor()
    .catch(async () => {
      const [shownMode, notices] = [await page.locator(".mode").textContent(), await page.locator(".notices").textContent()];
      assert.fail(`not "${text}": the page shows "${shownMode}" and "${notices}", the machine is ${JSON.stringify(await server.state())}`);
    });
const upload = (page, name, text) => page.setInputFiles("#program-file", { name, mimeType: "text/plain", buffer: Buffer.from(text) });

let programs = 0;
/** Run applies to the program that the page shows, so the page must show the new one first. */
async function runLong(page) {
  const name = `long-${++programs}.gcode`;
  await server.load(name, LONG);
  await page.locator(".file-name", { hasText: name }).waitFor();
  await button(page, "Run").click();
  await mode(page, "Running");
}

describe("a job", () => {
  test("runs from its upload to its end, with the time that is left", async () => {
    const page = await enter();
    await upload(page, "square.gcode", "G21 G90\nG0 X50 Y30\nG1 X90 F900\nY70\nX50\nY30\nM2\n");
    await page.locator(".file-name", { hasText: "square.gcode" }).waitFor();
    await button(page, "Run").click();
    await mode(page, "Running");
    await page.locator('.code li[aria-current="true"]').waitFor();
    const left = async () => /^(\d+):(\d\d) left$/.exec(await page.locator(".job .left").textContent());
    await until("the time that is left", async () => (await left()) !== null);
    const first = await left();
    await page.locator(".job", { hasText: "Done" }).waitFor();
    assert.ok(60 * first[1] + Number(first[2]) <= 60, `of a job of 12 s were left: ${first[0]}`);
    assert.equal(await page.locator(".job .left").textContent(), "");
    const { axes } = await server.becomes("idle", (state) => state.mode === "Idle");
    assert.ok(Math.abs(axes.X.position - 50) < 0.02 && Math.abs(axes.Y.position - 30) < 0.02, JSON.stringify(axes));
    await page.locator('.axis[data-axis="X"] .position', { hasText: "50.000" }).waitFor();
  });

  test("with errors is refused, each at its line", async () => {
    const page = await enter();
    await upload(page, "bad.gcode", "G21\nG1 X9999 F100\nHALLO\n");
    await page.getByText("bad.gcode was not loaded").waitFor();
    assert.equal(await page.locator('.code li[data-look="bad"]').count(), 2);
  });

  test("is held at rest, resumed and stopped", async () => {
    const page = await enter();
    await runLong(page);
    await button(page, "Hold").click();
    await mode(page, "Held");
    const held = await server.state();
    assert.deepEqual([held.mode, held.hold.state], ["Holding", "held"]);
    await button(page, "Resume").click();
    await mode(page, "Running");
    await server.becomes("moving", ({ axes }) => axes.X.velocity !== 0);
    await button(page, "Stop").click();
    await page.locator(".job", { hasText: "Stopped" }).waitFor();
    await mode(page, "Idle");
  });
});

describe("the emergency stop", () => {
  test("ends the job, says the way out, and the way leads out", async () => {
    const page = await enter();
    await runLong(page);
    await button(page, "Emergency stop").click();
    const alarm = page.locator(".alarm.fault", { hasText: "emergency-stopped" });
    await alarm.waitFor(); // one alarm, although each axis has the fault too
    assert.match(await alarm.locator(".remedy").textContent(), /then: Reset/);
    await button(page, "Reset").click();
    await mode(page, "Idle");
    await button(page, "Home").click(); // once: a second homing refuses the program
    await server.becomes("homed", (state) => state.mode === "Idle" && Object.values(state.axes).every(({ homed }) => homed));
    await mode(page, "Idle");
    await runLong(page);
  });
});

const CHANGE = "G21 G90\nG0 X50 Y30\nT2 M6 (6 mm end mill)\nG1 X60 F1200\nM2\n";

describe("a pause", () => {
  for (const [where, options] of [["a desktop", DESKTOP], ["a phone", PHONE]]) {
    test(`says what to do, and the machine returns on the way that a person confirms, on ${where}`, async () => {
      const page = await enter("operate", options);
      await server.load("change.gcode", CHANGE);
      assert.equal((await server.command("run")).status, 200);
      const banner = page.locator(".pause-banner");
      await banner.locator(".pause-title", { hasText: /^Change to tool 2: 6 mm end mill$/ }).waitFor();
      const jog = page.getByRole("button", { name: "Jog X plus" });
      await jog.scrollIntoViewIfNeeded();
      await until("a jog in the pause", async () => {
        await jog.dispatchEvent("pointerdown", { button: 0, pointerId: 1 });
        await pause(300);
        await jog.dispatchEvent("pointerup", { button: 0, pointerId: 1 });
        return (await server.state()).axes.X.position > 50.5;
      });
      await server.becomes("a pause again", (state) => state.mode === "Paused" && state.pause.way.length === 1);
      assert.equal((await server.command("resume")).status, 409);
      const dialog = page.getByRole("dialog", { name: "Return and resume" });
      await banner.getByRole("button", { name: "Resume" }).click();
      await dialog.locator("li", { hasText: /^X to 50\.000$/ }).waitFor();
      await dialog.getByRole("button", { name: "Cancel" }).click();
      assert.equal((await server.state()).mode, "Paused");
      await banner.getByRole("button", { name: "Resume" }).click();
      await dialog.getByRole("button", { name: "Return and resume" }).click();
      const { axes, pause: left } = await server.becomes("done", (state) => state.job.outcome === "Done");
      assert.ok(Math.abs(axes.X.position - 60) < 0.02, JSON.stringify(axes));
      assert.equal(left, null);
      await banner.waitFor({ state: "hidden" });
    });
  }
});

describe("a jog", () => {
  for (const held_ms of [0, 60, 200]) {
    test(`of 10 mm goes exactly 10 mm after a press of ${held_ms} ms`, async (context) => {
      const page = await enter();
      await button(page, "10").click();
      const x = async () => (await server.state()).axes.X.position;
      // A host that stalls for long ends a step, or refuses it because the other client's lease is not over: press again.
      await until("an exact step", async () => {
        lockstep("move", "X=20", "--take");
        await page.locator('.axis[data-axis="X"] .position', { hasText: "20.000" }).waitFor();
        await mode(page, "Idle");
        await until("it may jog", () => button(page, "Jog X plus").isEnabled());
        await button(page, "Jog X plus").hover();
        await page.mouse.down();
        await pause(held_ms);
        await page.mouse.up();
        let rests;
        for (let i = 0; i < 60 && rests === undefined; ++i, await pause(50)) {
          const { mode, axes } = await server.state();
          if (mode === "Idle" && axes.X.position > 20.1) rests = axes.X.position;
        }
        if (rests === undefined) {
          context.diagnostic(`nothing moved: ${await page.locator(".notices").textContent()}`);
          return false;
        }
        assert.ok(rests < 30.001, `it went on to ${rests}`);
        return Math.abs(rests - 30) < 0.001;
      });
      await pause(500);
      assert.ok(Math.abs((await x()) - 30) < 0.001, `it went on to ${await x()}`);
    });
  }

  test("ends by itself when its tab is killed", async () => {
    const page = await enter();
    await page.locator("#jog-speed").fill("0"); // so that the axis does not come to the end of its travel meanwhile
    await button(page, "Jog X plus").hover();
    const moves = async () => (await server.state()).axes.X.velocity > 0;
    await until("X moves", async () => {
      await page.mouse.down(); // a host that stalls ends a jog: press again
      for (let i = 0; i < 20; ++i, await pause(50)) if (await moves()) return true;
      await page.mouse.up();
      return false;
    });
    const session = await page.context().newCDPSession(page);
    void session.send("Page.crash").catch(() => undefined);
    await page.waitForEvent("crash");
    const { axes } = await server.becomes("at rest", (state) => state.mode === "Idle" && state.axes.X.at_rest);
    await pause(1000);
    assert.equal((await server.state()).axes.X.position, axes.X.position);
    const { axes: limits } = await (await server.ask("/api/machine")).json();
    assert.ok(axes.X.position < limits[0].position_max - 5, "it went to the end of its travel");
  });
});

describe("two browsers", () => {
  test("command the same machine: one begins, the other holds and resumes", async () => {
    const [one, other] = [await enter(), await enter()];
    await runLong(one);
    await mode(other, "Running");
    assert.ok(await button(other, "Run").isDisabled());
    await button(other, "Hold").click();
    await Promise.all([mode(one, "Held"), mode(other, "Held")]);
    await button(other, "Resume").click();
    await mode(one, "Running");
    const viewer = await enter("view");
    await mode(viewer, "Running");
    assert.equal(await button(viewer, "Stop").count(), 0);
    await button(one, "Stop").click();
    await Promise.all([one, other, viewer].map((page) => mode(page, "Idle")));
  });
});

describe("another client", () => {
  test("has the machine for itself but for holds, until the page takes it over", async () => {
    const page = await enter();
    const folder = mkdtempSync(join(tmpdir(), "page-"));
    writeFileSync(join(folder, "long.gcode"), LONG);
    await server.command("give"); // an open page keeps the machine between two commands
    await server.becomes("free", ({ writer }) => writer === null);
    const other = startLockstep({ LOCKSTEP_WRITER: "anna" }, "run", join(folder, "long.gcode"));
    await mode(page, "Running");
    await page.locator(".writer-banner", { hasText: "anna" }).waitFor();
    await page.getByLabel("Feed", { exact: true }).fill("150");
    await page.locator(".notice", { hasText: "anna" }).waitFor();
    assert.equal((await server.state()).override.feed_percent, 100);
    await button(page, "Hold").click();
    await mode(page, "Held");
    await page.locator(".writer-banner").getByRole("button").click();
    await page.locator(".writer-banner").waitFor({ state: "hidden" });
    await button(page, "Resume").click();
    await mode(page, "Running");
    await button(page, "Stop").click();
    await mode(page, "Idle");
    await other.ended;
    rmSync(folder, { recursive: true });
  });
});

describe("access", () => {
  test("a wrong token is refused with a reason, a right one enters", async () => {
    const opened = await openPage(browser, `${server.origin}/#token=wrong`);
    open.push(opened);
    await opened.page.getByText("the token is wrong").waitFor();
    await opened.page.getByLabel("Token").fill(server.tokens.view);
    await button(opened.page, "Sign in").click();
    await shown(opened.page);
    await opened.page.getByText("View only").waitFor();
    assert.equal(opened.page.url(), `${server.origin}/`);
  });

  test("ends by signing out", async () => {
    const page = await enter();
    await button(page, "Sign out").click();
    await page.getByLabel("Token").waitFor();
    await page.reload();
    await page.getByLabel("Token").waitFor();
  });
});

describe("a page that stays open", () => {
  const fresh = (page) => until("live values", async () => (await page.locator('.axis[data-fresh="stale"]').count()) === 0);
  const stale = (page) => until("values that look old", async () => (await page.locator('.axis[data-fresh="live"]').count()) === 0);

  test("looks old while the machine is down, and lives on when it is up again", async () => {
    const page = await enter();
    await fresh(page);
    lockstep("down");
    await page.locator(".banner", { hasText: "No messages are received from a coordinator" }).waitFor();
    await stale(page);
    await mode(page, "Unreachable");
    assert.ok(await button(page, "Jog X plus").isDisabled());
    lockstep("up");
    await mode(page, "Idle");
    await fresh(page);
    assert.equal(await page.locator(".banner:visible").count(), 0);
    await button(page, "Home").click();
    await server.becomes("homed", ({ axes }) => Object.values(axes).every(({ homed }) => homed));
  });

  test("looks old while its server is away, and lives on without a new token", async () => {
    const page = await enter();
    await fresh(page);
    await server.end();
    await page.locator(".banner", { hasText: "No connection to the server for" }).waitFor();
    await stale(page);
    await server.start();
    await fresh(page);
    await mode(page, "Idle");
  });

  test("keeps neither memory nor elements", async () => {
    const watched_ms = 1000 * Number(process.env.VIEWER_SECONDS ?? 20), settles_ms = 30_000; // until the chart is full
    const page = await enter("view");
    await server.load("long.gcode", LONG);
    const session = await page.context().newCDPSession(page);
    const samples = [];
    for (const begin = Date.now(); Date.now() - begin < settles_ms + watched_ms; await pause(watched_ms / 12)) {
      if ((await server.state()).mode === "Idle") await server.command("run");
      if (Date.now() - begin < settles_ms) continue;
      await session.send("HeapProfiler.collectGarbage");
      const { usedSize } = await session.send("Runtime.getHeapUsage");
      const { nodes, jsEventListeners } = await session.send("Memory.getDOMCounters");
      samples.push({ at_s: Math.round((Date.now() - begin) / 1000), heap_kB: Math.round(usedSize / 1024), nodes, listeners: jsEventListeners });
    }
    console.log(samples.map((sample) => JSON.stringify(sample)).join("\n"));
    const median = (name, part) => part.map((sample) => sample[name]).sort((a, b) => a - b)[Math.floor(part.length / 2)];
    const half = Math.floor(samples.length / 2);
    for (const [name, most] of [["heap_kB", 500], ["nodes", 100], ["listeners", 20]]) {
      const growth = median(name, samples.slice(half)) - median(name, samples.slice(0, half));
      assert.ok(growth < most, `${name} grew by ${growth}`);
    }
  });
});
