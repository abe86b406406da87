// Chromium as Debian builds it for hosts without a screen, which takes half the processor time. Every error on the
// page's console fails the test.
import { chromium } from "playwright-core";
import { PATIENCE_MS } from "./waiting.mjs";

const WITHOUT_GPU = ["--disable-gpu"];
/** WebGL in software: slow, but the same pictures. */
export const WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export function openBrowser(graphics = WITHOUT_GPU) {
  const args = ["--no-sandbox", "--disable-dev-shm-usage", ...graphics];
  return chromium.launch({ executablePath: "/usr/bin/chromium-headless-shell", args });
}

export const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true };
export const DESKTOP = { viewport: { width: 1440, height: 900 } };

const crashes = new WeakMap(); // page: a promise that its first uncaught error rejects

/** A page with its own cookies. `complaints` collects the errors on its console, except those of the network. */
export async function openPage(browser, address, options = DESKTOP) {
  const context = await browser.newContext({ locale: "en-GB", colorScheme: "light", ...options });
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  const complaints = [];
  const crash = new Promise((_, reject) => page.once("pageerror", reject));
  crash.catch(() => {}); // it may be of interest to nobody: it is among the complaints
  crashes.set(page, crash);
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    if (message.type() === "error" && !/Failed to load resource|ERR_/.test(message.text())) complaints.push(message.text());
  });
  await page.goto(address);
  return { page, context, complaints };
}

/** Waits until the page shows its machine. An uncaught error before that is thrown at once. */
export async function shown(page) {
  await Promise.race([page.waitForSelector('html[data-shown="yes"]'), crashes.get(page)]);
}
