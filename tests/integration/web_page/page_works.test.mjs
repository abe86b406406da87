// Tests the page in a real browser, with a stand-in machine: a person acts, and the screen shows the result.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach, describe, test } from "node:test";
import { DESKTOP, openBrowser, openPage, PHONE, shown } from "./browser.mjs";
import { StandInMachine } from "./stand_in_machine.mjs";
import { StandInServer, TOKENS } from "./stand_in_server.mjs";
import { until } from "./waiting.mjs";

const { PAGE } = process.env; // the folder of the built page
let browser, machine, server, address, open;

before(async () => (browser = await openBrowser()));
after(() => browser.close());
beforeEach(async () => {
  machine = new StandInMachine();
  machine.load("rose.gcode", 600);
  server = new StandInServer(machine, PAGE, { pointsEachTick: 5 });
  address = await server.listen();
  open = [];
});
afterEach(async () => {
  for (const { context, complaints } of open) {
    await context.close();
    assert.deepEqual(complaints, []);
  }
  await server.close();
});

async function enter(role = "operate", options = DESKTOP) {
  const opened = await openPage(browser, `${address}/#token=${TOKENS[role]}`, options);
  open.push(opened);
  await shown(opened.page);
  return opened.page;
}
const button = (page, name) => page.getByRole("button", { name, exact: true });
const mode = (page, text) => page.locator(".mode", { hasText: text }).waitFor();
const verbs = () => machine.commands.map(({ verb }) => verb);

describe("access", () => {
  test("a wrong token is refused with a reason, a right one enters", async () => {
    const opened = await openPage(browser, `${address}/#token=wrong`);
    open.push(opened);
    const { page } = opened;
    await page.getByText("The token is wrong").waitFor();
    await page.getByLabel("Token").fill(TOKENS.view);
    await button(page, "Sign in").click();
    await shown(page);
  });

  test("the token leaves the address", async () => {
    const page = await enter();
    assert.equal(page.url(), `${address}/`);
  });

  test("ends by signing out", async () => {
    const page = await enter("view");
    await button(page, "Sign out").click();
    await page.getByLabel("Token").waitFor();
    await page.reload();
    await page.getByLabel("Token").waitFor();
  });

  test("who may only view has no controls", async () => {
    const page = await enter("view");
    await page.getByText("View only").waitFor();
    for (const name of ["Emergency stop", "Hold", "Run", "Home"]) assert.equal(await button(page, name).count(), 0, name);
    await page.keyboard.press("F1");
    await page.waitForTimeout(200);
    assert.deepEqual(verbs(), []);
  });
});

describe("a job", () => {
  test("runs from the upload to its end", async () => {
    const page = await enter();
    await page.setInputFiles("#program-file", { name: "part.gcode", mimeType: "text/plain", buffer: Buffer.from("G21\nG0 X1\nM2\n") });
    await page.locator(".file-name", { hasText: "part.gcode" }).waitFor();
    await button(page, "Run").click();
    await mode(page, "Running");
    await page.locator('.code li[aria-current="true"]').waitFor();
    await page.locator(".job", { hasText: "Done" }).waitFor();
  });

  test("is refused with each wrong line", async () => {
    const page = await enter();
    await page.setInputFiles("#program-file", { name: "bad.gcode", mimeType: "text/plain", buffer: Buffer.from("G21\nBAD\nG0 X1\nBAD\n") });
    await page.getByText("bad.gcode was not loaded").waitFor();
    assert.equal(await page.getByText("Line 2, column 1").count(), 1);
    assert.equal(await page.locator('.code li[data-look="bad"]').count(), 2);
    await page.locator(".errors").getByRole("button", { name: "Dismiss" }).click();
    await page.locator(".file-name", { hasText: "rose.gcode" }).waitFor();
  });

  test("is held, resumed and stopped", async () => {
    const page = await enter();
    await button(page, "Run").click();
    await mode(page, "Running");
    await button(page, "Hold").click();
    await mode(page, "Held");
    await button(page, "Resume").click();
    await mode(page, "Running");
    await page.keyboard.press("Escape");
    await page.locator(".job", { hasText: "Stopped" }).waitFor();
    assert.deepEqual(verbs(), ["run", "hold", "resume", "stop"]);
  });

  test("that is refused says why, and the remedy", async () => {
    const page = await enter();
    await page.keyboard.press("F4");
    await page.locator(".notice", { hasText: "wait until it has ended" }).waitFor();
  });
});

describe("the emergency stop", () => {
  for (const [how, press] of [
    ["by its button, when it is pressed", (page) => page.locator(".emergency").dispatchEvent("pointerdown", { button: 0 })],
    ["by a click, once", (page) => button(page, "Emergency stop").click()],
    ["by F1", (page) => page.keyboard.press("F1")],
    ["by Enter", async (page) => {
      await button(page, "Emergency stop").focus();
      await page.keyboard.press("Enter");
    }],
  ]) {
    test(how, async () => {
      const page = await enter();
      await press(page);
      await page.locator(".alarm.fault", { hasText: "emergency-stopped (118)" }).waitFor();
      assert.deepEqual(verbs(), ["estop"]);
      await button(page, "Reset").click();
      await mode(page, "Idle");
    });
  }
});

describe("a jog", () => {
  const moved = () => machine.state.axes.X.position !== 5;

  test("lasts while its button is held", async () => {
    const page = await enter();
    await button(page, "Jog X plus").hover();
    await page.mouse.down();
    await until("X moves", moved);
    await mode(page, "Jogging");
    await page.mouse.up();
    await mode(page, "Idle");
    assert.deepEqual(machine.commands.at(-1).body.jogs, []);
    assert.equal(machine.commands[0].body.press, machine.commands.at(-1).body.press);
  });

  test("that the machine ends says so, and not for ever", async () => {
    const page = await enter();
    await button(page, "Jog X plus").hover();
    await page.mouse.down();
    await until("X moves", moved);
    machine.endsJogs = true;
    const ended = page.getByText("The machine ended the jog. Press again.");
    await ended.waitFor();
    await page.mouse.up();
    await ended.waitFor({ state: "detached" });
    await page.getByText("Arrow keys, Page Up and Page Down jog while the focus is here").waitFor();
  });

  test("lasts while its key is held, and needs the focus", async () => {
    const page = await enter();
    await page.keyboard.down("ArrowRight");
    await page.waitForTimeout(200);
    await page.keyboard.up("ArrowRight");
    assert.deepEqual(verbs(), []);
    await button(page, "Jog Y plus").focus();
    await page.keyboard.down("ArrowRight");
    await until("X moves", moved);
    await page.keyboard.up("ArrowRight");
    await mode(page, "Idle");
  });

  for (const [how, end] of [
    ["when the window loses the focus", (page) => page.evaluate(() => dispatchEvent(new Event("blur")))],
    ["when the tab is hidden", (page) => page.evaluate(() => {
      Object.defineProperty(document, "hidden", { value: true });
      document.dispatchEvent(new Event("visibilitychange"));
    })],
    ["when the page is closed", (page) => page.close()],
  ]) {
    test(`ends ${how}`, async () => {
      const page = await enter();
      await button(page, "Jog X plus").hover();
      await page.mouse.down();
      await until("X moves", moved);
      await end(page);
      await until("the machine is idle", () => machine.state.mode === "Idle");
    });
  }

  test("goes a distance, at the chosen speed", async () => {
    const page = await enter();
    await button(page, "0.1").click();
    await button(page, "Jog Z minus").click();
    await until("a jog", () => verbs().includes("jog"));
    const [{ axis, velocity, distance }] = machine.commands[0].body.jogs;
    assert.deepEqual([axis, velocity, distance], ["Z", -6.25, 0.1]);
    assert.match(machine.commands[0].body.stream, /^s\d+$/);
  });

  for (const held_ms of [0, 60, 200]) {
    test(`is one step of exactly its distance for a press of ${held_ms} ms, by button and by key`, async () => {
      const page = await enter();
      await button(page, "10").click();
      const x = () => machine.state.axes.X.position;
      const arrives = async (at) => {
        await until(`X at ${at}`, () => machine.state.mode === "Idle" && Math.abs(x() - at) < 1e-9);
        await page.waitForTimeout(300);
        assert.ok(Math.abs(x() - at) < 1e-9, `X went on to ${x()}`);
      };
      await button(page, "Jog X plus").hover();
      await page.mouse.down();
      await page.waitForTimeout(held_ms);
      await page.mouse.up();
      await arrives(15);
      await button(page, "Jog Y plus").focus();
      await page.keyboard.down("ArrowRight");
      await page.waitForTimeout(held_ms);
      await page.keyboard.up("ArrowRight");
      await arrives(25);
    });
  }

  test("repeats its step while it is held", async () => {
    const page = await enter();
    await button(page, "1").click();
    await button(page, "Jog X plus").hover();
    await page.mouse.down();
    await until("three steps", () => machine.state.axes.X.position >= 8);
    await page.mouse.up();
    await mode(page, "Idle");
    const { position } = machine.state.axes.X;
    assert.ok(Math.abs(position - Math.round(position)) < 1e-9, `X is at ${position}`);
  });

  test("by finger on a phone", async () => {
    const page = await enter("operate", PHONE);
    const pad = button(page, "Jog X plus");
    await pad.scrollIntoViewIfNeeded();
    await pad.tap();
    await until("a jog and its end", () => machine.commands.at(-1)?.verb === "jog" && machine.commands.at(-1).body.jogs.length === 0);
  });
});

describe("what is old", () => {
  test("looks old when the server dies, and live when it is back", async () => {
    const page = await enter();
    const { port } = server;
    await server.close();
    await page.locator(".banner", { hasText: "No connection to the server for" }).waitFor();
    await page.locator('.axis[data-fresh="stale"]').first().waitFor();
    assert.ok(await button(page, "Jog X plus").isDisabled());
    server = new StandInServer(machine, PAGE);
    await server.listen(port);
    await page.locator('.axis[data-fresh="live"]').first().waitFor();
    assert.equal(await page.locator(".banner:visible").count(), 0);
  });

  test("looks old when one axis is silent", async () => {
    const page = await enter();
    Object.assign(machine.state.axes.Y, { present: false, age_ms: 4200 });
    await page.locator('.axis[data-axis="Y"][data-fresh="stale"]', { hasText: /4\.\d s/ }).waitFor(); // 4.2 s, and the time since the server's last answer
    assert.equal(await page.locator('.axis[data-axis="X"][data-fresh="live"]').count(), 1);
  });

  test("stays live while nothing changes", async () => {
    const page = await enter();
    await page.waitForTimeout(4000);
    assert.equal(await page.locator('.axis[data-fresh="live"]').count(), 3);
  });
});

describe("devices", () => {
  test("are shown while something is on, and not while all is off", async () => {
    const page = await enter();
    await page.locator('.axis[data-fresh="live"]').first().waitFor();
    assert.equal(await page.locator(".devices:visible").count(), 0);
    const off = machine.state.devices;
    machine.state.devices = { spindle: { direction: "forward", rpm: 12000 }, mist: false, flood: true, tool: 3, outputs: [2] };
    await page.locator(".devices .chip", { hasText: "Output 2" }).waitFor();
    assert.deepEqual(await page.locator(".devices .chip").allTextContents(), ["Spindle forward 12000 rpm", "Flood", "Tool 3", "Output 2"]);
    machine.state.devices = off;
    await page.locator(".devices").waitFor({ state: "hidden" });
  });
});

describe("motors", () => {
  const motor = (page, name) => page.locator(`.motor[data-motor="${name}"]`);

  test("are not shown where each axis has its own", async () => {
    const page = await enter();
    assert.equal(await page.locator(".motors:visible, .motor").count(), 0);
  });

  test("of an axis with two are shown with their places, switches and faults", async () => {
    machine.haveTwoMotorsOnY();
    const page = await enter();
    await motor(page, "Y2").and(page.locator('[data-fresh="live"]')).waitFor();
    assert.equal(await page.locator('.axis[data-axis="Y"] .figure:visible').count(), 1); // its age; the rest is of its motors
    Object.assign(machine.state.motors.Y2, { position: 7.5, switches: ["limit_max"], following_error_steps: 3, state: "Fault" });
    const fault = { number: 103, code: "limit-hit", axis: null, motor: "Y2", board: null, cause: "a limit switch closed", remedy: "then: {reset}, {home}" };
    machine.state.motors.Y2.fault = fault;
    machine.state.axes.Y.fault = fault;
    machine.state.alarms = [{ ...fault, severity: "fault" }];
    await motor(page, "Y2").locator(".chip", { hasText: "Closed: limit switch at the upper end" }).waitFor();
    await page.locator(".alarm", { hasText: "Motor Y2: limit-hit (103)" }).waitFor();
    await page.locator('.axis[data-axis="Y"] .trouble', { hasText: "Motor Y2: limit-hit" }).waitFor();
    assert.match(await motor(page, "Y2").textContent(), /moves Y.*7\.500 mm.*Fault.*limit-hit: a limit switch closed · Following error: 3 steps/);
    assert.equal(await motor(page, "Y1").locator(".trouble:visible").count(), 0);
  });
});

describe("boards", () => {
  test("are not shown where the machine has none", async () => {
    const page = await enter();
    assert.equal(await page.locator(".boards:visible").count(), 0);
  });

  test("are shown with their state and fault, and without a place", async () => {
    machine.haveABoard();
    const page = await enter();
    const board = page.locator('[data-board="IO"]');
    await board.and(page.locator('[data-fresh="live"]')).waitFor();
    assert.doesNotMatch(await board.textContent(), / mm/);
    const fault = { number: 135, code: "device-lost", axis: null, motor: null, board: "IO", cause: "the device is gone", remedy: "then: {reset}" };
    Object.assign(machine.state.boards.IO, { state: "Fault", fault });
    machine.state.alarms = [{ ...fault, severity: "fault" }];
    await page.locator(".alarm", { hasText: "Board IO: device-lost (135)" }).waitFor();
    await board.locator(".trouble", { hasText: "device-lost: the device is gone" }).waitFor();
  });
});

describe("inputs", () => {
  test("are not shown where the machine has none", async () => {
    const page = await enter();
    assert.equal(await page.locator(".inputs:visible").count(), 0);
  });

  test("are shown with what they mean while they are closed", async () => {
    machine.haveInputs();
    const page = await enter();
    const chip = (look, hasText) => page.locator(`.inputs .chip[data-look="${look}"]`, { hasText });
    for (const name of ["stop", "door", "tool"]) await chip("good", `${name}: open`).waitFor();
    machine.state.inputs = { stop: true, door: true, tool: true };
    await chip("bad", "stop: emergency stop pressed").waitFor();
    await chip("warning", "door: door open").waitFor();
    await chip("busy", "tool: closed").waitFor();
  });
});

describe("outputs", () => {
  test("are not shown where the machine has none", async () => {
    const page = await enter();
    assert.equal(await page.locator(".outputs:visible").count(), 0);
  });

  test("are shown with the levels of their pins, and with the program's where it asks for others", async () => {
    machine.haveOutputs();
    const page = await enter();
    const chip = (look, hasText) => page.locator(`.outputs .chip[data-look="${look}"]`, { hasText });
    await chip("good", "air: off").waitFor();
    machine.state.outputs = { laser: { on: null, value: 0.1, pulses: null, asked: 0.3 }, air: { on: true, value: null, pulses: null, asked: 1 } };
    await chip("busy", "laser: 10.0 % (program: 30.0 %)").waitFor();
    await chip("busy", "air: on").waitFor();
    machine.state.outputs = { laser: { on: null, value: 0, pulses: null, asked: 0 }, air: { on: false, value: null, pulses: null, asked: 1 } };
    await chip("warning", "air: off (program: on)").waitFor();
  });
});

describe("a probe", () => {
  const chosen = async (page) => {
    await page.getByRole("tab", { name: "Probe" }).click();
    return page.getByRole("tabpanel", { name: "Probe" });
  };

  test("is missed where the machine has none, with the reason", async () => {
    const tab = await chosen(await enter());
    await tab.getByText("This machine has no probe").waitFor();
    assert.equal(await tab.getByRole("button", { name: "Start" }).count(), 0);
  });

  test("is asked for what its kind needs, and shows its touches and why it found nothing", async () => {
    machine.haveAProbe();
    const page = await enter();
    const tab = await chosen(page);
    await tab.getByLabel("Measure").selectOption("bore");
    for (const [label, value] of [["Diameter about, mm", "25"], ["Tip diameter, mm", "2"]]) await tab.getByLabel(label).fill(value);
    await tab.getByRole("button", { name: "Start" }).click();
    await until("the command", () => machine.commands.some(({ verb }) => verb === "probe"));
    assert.deepEqual(machine.commands.at(-1), { verb: "probe", body: { kind: "bore", diameter: 25, tip: 2, feed: 60, back: 1 } });
    machine.state.measurement = { number: 1, kind: "bore", touches: 3, points: null, result: null, problem: null };
    await tab.getByText("Bore: 3 touches so far").waitFor();
    machine.state.measurement.problem = { type: "about:blank", title: "no touch", status: 409, code: "probe-not-touched", detail: "the move ended without a touch", remedy: "check the probe; then: {reset}" };
    await tab.getByText("the move ended without a touch Remedy: check the probe; then: Reset").waitFor();
    assert.equal(await tab.getByRole("button", { name: "Set zero or rotation" }).count(), 0);
  });
});

describe("settings", () => {
  test("overrides, work offsets and tools go to the machine and come back", async () => {
    const page = await enter();
    await page.getByLabel("Feed", { exact: true }).fill("150");
    await until("feed", () => machine.state.override.feed_percent === 150);
    await page.getByRole("tab", { name: "Offsets" }).click();
    await button(page, "Set X to 0 here").click();
    await until("touch", () => machine.state.offsets.systems.G54.origin.X === 5);
    await page.getByLabel("G55, Y").fill("12,5");
    await page.getByLabel("G55, Y").press("Enter");
    await until("offset", () => machine.state.offsets.systems.G55.origin.Y === 12.5);
    await button(page, "Work G54").click();
    await page.locator('.axis[data-axis="X"] .position', { hasText: "0.000" }).waitFor();
    await page.getByRole("tab", { name: "Tools" }).click();
    await button(page, "Remove tool 2").click();
    await until("tool", () => machine.state.tools[2] === undefined);
  });

  test("lines of MDI are kept, and Escape in a field takes the change back", async () => {
    const page = await enter();
    await page.getByRole("tab", { name: "MDI" }).click();
    machine.state.modes = ["G1", "G55", "G17", "G21", "G91", "G94", "M5", "M9", "T0", "F600", "S0"];
    await page.getByText("Modes of the next line:").waitFor();
    await until("modes", async () => (await page.locator(".mdi-modes").textContent()) === "G1 G55 G17 G21 G91 G94 M5 M9 T0 F600 S0");
    await page.getByLabel("One line of G-code").fill("G0 X7");
    await page.keyboard.press("Enter");
    await until("mdi", () => machine.commands.some(({ verb, body }) => verb === "mdi" && body.line === "G0 X7"));
    await page.locator(".mdi-lines li", { hasText: "G0 X7" }).waitFor();
    await page.getByLabel("One line of G-code").press("ArrowUp");
    assert.equal(await page.getByLabel("One line of G-code").inputValue(), "G0 X7");
    await page.getByRole("tab", { name: "Offsets" }).click();
    await page.getByLabel("G54, X").fill("99");
    await page.getByLabel("G54, X").press("Escape");
    assert.equal(await page.getByLabel("G54, X").inputValue(), "0.000");
    assert.ok(!verbs().includes("stop"));
  });
});

describe("everybody", () => {
  test("reads it in German", async () => {
    const page = await enter();
    await button(page, "Deutsch").click();
    await button(page, "Not-Halt").waitFor();
    assert.equal(await page.locator("html").getAttribute("lang"), "de");
  });

  for (const width of [320, 390, 800, 1180, 1920]) {
    test(`sees all of it ${width} pixels wide`, async () => {
      const page = await enter("operate", { viewport: { width, height: 800 } });
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      assert.ok(await button(page, "Emergency stop").isVisible());
      const box = await button(page, "Emergency stop").boundingBox();
      assert.ok(box.x >= 0 && box.x + box.width <= width && box.y + box.height <= 800, JSON.stringify(box));
    });
  }

  test("reaches every control by the keyboard, and sees where the focus is", async () => {
    const page = await enter();
    const reached = new Set();
    for (let i = 0; i < 70; ++i) {
      await page.keyboard.press("Tab");
      const focus = await page.evaluate(() => {
        const e = document.activeElement;
        const style = getComputedStyle(e.matches(".hidden-file") ? e.nextElementSibling : e);
        return { name: e.getAttribute("aria-label") ?? (e.textContent.trim() || e.id), outlined: style.outlineStyle !== "none" };
      });
      if (focus.name === "" || reached.has(focus.name)) continue;
      reached.add(focus.name);
      assert.ok(focus.outlined || focus.name.startsWith("Skip"), `no outline: ${focus.name}`);
    }
    for (const name of ["Emergency stop", "Stop", "Home", "Run", "Jog X plus", "feed", "Program", "program-file"]) assert.ok(reached.has(name), `${name} of ${[...reached]}`);
  });

  test("two watch the same machine", async () => {
    const [one, other] = [await enter(), await enter("view")];
    await button(one, "Run").click();
    await Promise.all([mode(one, "Running"), mode(other, "Running")]);
    await button(one, "Stop").click();
    await Promise.all([mode(one, "Idle"), mode(other, "Idle")]);
  });
});
