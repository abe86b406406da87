// Pictures of the page for the documents, of a stand-in machine.
// Usage: node take_pictures.mjs PAGE OUT    PAGE: the folder of the built page
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser, openPage, PHONE, shown } from "./browser.mjs";
import { smallPng } from "./small_png.mjs";
import { StandInMachine } from "./stand_in_machine.mjs";
import { StandInServer, TOKENS } from "./stand_in_server.mjs";

const [page_folder, out] = process.argv.slice(2);
const machine = new StandInMachine();
machine.load("rose.gcode", 1500);
const server = new StandInServer(machine, page_folder, { pointsEachTick: 2 });
const address = `${await server.listen()}/#token=${TOKENS.operate}`;
const browser = await openBrowser();

async function picture(name, options, act = async () => undefined) {
  const { page, context, complaints } = await openPage(browser, address, options);
  await shown(page);
  await page.waitForTimeout(22_000); // until the chart is full
  await act(page);
  writeFileSync(join(out, `page-${name}.png`), await smallPng(page, await page.screenshot()));
  if (complaints.length > 0) throw new Error(complaints.join("\n"));
  await context.close();
}

const DESKTOP = { viewport: { width: 1280, height: 800 } };
machine.command("run", {});
await picture("desktop", DESKTOP);
await picture("dark", { ...DESKTOP, colorScheme: "dark" });
await picture("phone", { ...PHONE, deviceScaleFactor: 1.5 });
await picture("alarm", { ...DESKTOP, colorScheme: "dark" }, async (page) => {
  machine.command("estop", {});
  Object.assign(machine.state.axes.Y, { present: false, age_ms: 4200 });
  await page.getByRole("button", { name: "2D" }).click();
  await page.getByRole("tab", { name: "Offsets" }).click();
  await page.waitForTimeout(1500);
});
await browser.close();
await server.close();
