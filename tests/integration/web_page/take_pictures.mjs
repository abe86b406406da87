// Pictures of the page for the documents, of a simulated machine that mills deploy/examples/plate.gcode.
// Usage: page_on_a_machine.py ROOT PROGRAMS node take_pictures.mjs ROOT OUT
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser, openPage, PHONE, shown } from "./browser.mjs";
import { Server } from "./real_machine.mjs";
import { pause } from "./waiting.mjs";
import { smallPng } from "./small_png.mjs";

const [root, out] = process.argv.slice(2);
const DESKTOP = { viewport: { width: 1280, height: 800 } };
const PICTURES = { desktop: DESKTOP, dark: { ...DESKTOP, colorScheme: "dark" }, phone: { ...PHONE, deviceScaleFactor: 1.5 } };
const CHART_MS = 21_000; // until it is full
const OLD_MS = 5000;

const server = new Server();
await server.start();
await server.settle();
await server.load("plate.gcode", readFileSync(join(root, "deploy/examples/plate.gcode")));
const browser = await openBrowser();
const opened = {};
for (const [name, options] of Object.entries(PICTURES)) {
  opened[name] = await openPage(browser, server.address(), options);
  await shown(opened[name].page);
}

async function keep(name, page) {
  writeFileSync(join(out, `page-${name}.png`), await smallPng(page, await page.screenshot()));
}

/** Signals the process of axis Y. Stopped, it looks as if its board had lost its power. */
function signalAxisY(signal) {
  const state = process.env.LOCKSTEP_STATE;
  const [machine] = readdirSync(state);
  const [, pid] = /^axis-Y (\d+)/m.exec(readFileSync(join(state, machine, "processes"), "utf8"));
  process.kill(Number(pid), signal);
}

await server.command("run");
await pause(CHART_MS);
for (const name of Object.keys(PICTURES)) await keep(name, opened[name].page);
await server.command("estop");
const { page } = opened.dark;
await page.getByRole("button", { name: "2D" }).click();
await page.getByRole("tab", { name: "Offsets" }).click();
signalAxisY("SIGSTOP");
await pause(OLD_MS);
await keep("alarm", page);
signalAxisY("SIGCONT");
for (const { complaints } of Object.values(opened)) if (complaints.length > 0) throw new Error(complaints.join("\n"));
await browser.close();
await server.end();
