// Measures how soon the page shows a machine, on loopback. Prints a table, or writes it into docs/page.md.
// Usage: page_on_a_machine.py ROOT PROGRAMS node first_paint.mjs [docs/page.md]
import { readFileSync, writeFileSync } from "node:fs";
import { openBrowser, openPage, shown } from "./browser.mjs";
import { Server } from "./real_machine.mjs";

const LOADS = 15;
const [document_file] = process.argv.slice(2);

/** Runs in the page before its own script: notes when the machine's values are first on the screen. */
function watch() {
  new MutationObserver((_, observer) => {
    if (document.documentElement.dataset.shown !== "yes") return;
    requestAnimationFrame(() => (document.documentElement.dataset.shownAt = String(performance.now())));
    observer.disconnect();
  }).observe(document, { subtree: true, attributes: true, childList: true });
}

async function load(browser, address) {
  const { page, context } = await openPage(browser, "about:blank");
  await context.addInitScript(watch);
  await page.goto(address);
  await shown(page);
  await page.waitForSelector("html[data-shown-at]");
  const figures = await page.evaluate(() => ({
    painted_ms: performance.getEntriesByName("first-contentful-paint")[0].startTime,
    shown_ms: Number(document.documentElement.dataset.shownAt),
    kB: [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")]
      .filter(({ name }) => !name.includes("/api/")).reduce((sum, { transferSize }) => sum + transferSize, 0) / 1024,
  }));
  await context.close();
  return figures;
}

const server = new Server();
await server.start();
const browser = await openBrowser();
await load(browser, server.address()); // the browser itself starts
const loads = [];
for (let i = 0; i < LOADS; ++i) loads.push(await load(browser, server.address()));
await browser.close();
await server.end();

const row = (name, key, unit) => {
  const values = loads.map((figures) => figures[key]).sort((a, b) => a - b);
  return `| ${name} | ${Math.round(values[Math.floor(LOADS / 2)])} ${unit} | ${Math.round(values.at(-1))} ${unit} |`;
};
const table = [
  `| of ${LOADS} loads without a cache | median | most |`, "|---|---|---|", row("first paint", "painted_ms", "ms"),
  row("the machine's values on the screen", "shown_ms", "ms"), row("files that the browser receives", "kB", "kB"),
].join("\n");
console.log(table);
if (document_file) {
  const text = readFileSync(document_file, "utf8");
  const place = /(<!-- first_paint\.mjs -->\n)[^]*?(\n<!-- end -->)/;
  if (!place.test(text)) throw new Error(`${document_file} has no place for the table`);
  writeFileSync(document_file, text.replace(place, (_, begin, end) => begin + table + end));
}
