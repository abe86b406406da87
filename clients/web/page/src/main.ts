// Signs in, reads the machine's description, and shows its state ten times a second.
import "uplot/dist/uPlot.min.css";
import "./styles/palette.css";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/parts.css";
import "./styles/code.css";
import "./styles/probe.css";
import { machine as fetchMachine } from "./api/client";
import type { Machine, Role } from "./api/contract";
import { h } from "./dom/element";
import { startTheme } from "./dom/theme";
import { StateStream } from "./state/stream";
import { language, t } from "./texts";
import { Page } from "./views/page";
import { listenToShortcuts } from "./views/shortcuts";
import { askForToken, enter } from "./views/sign_in";

const SHOWN_EVERY_MS = 100;
const RETRY_MS = 1000;

async function known(place: HTMLElement): Promise<Machine> {
  for (;;) {
    const answer = await fetchMachine();
    if (answer.ok) return answer.value;
    place.replaceChildren(h("p", { class: "loading" }, t.page.loading));
    await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
  }
}

async function start(place: HTMLElement): Promise<void> {
  document.documentElement.lang = language();
  document.title = t.page.title;
  startTheme();
  place.replaceChildren(h("p", { class: "loading" }, t.page.loading));
  const entered = await enter();
  const role: Role = typeof entered === "string" ? entered : await askForToken(place, entered);
  const machine = await known(place);
  run(place, machine, role);
}

function run(place: HTMLElement, machine: Machine, role: Role): void {
  const stream = new StateStream(() => location.reload());
  const page = new Page(place, machine, () => stream.live.stream);
  const show = () => {
    const { state } = stream.live;
    if (state === undefined) return;
    page.show({ machine, state, role, isConnected: stream.connected, contact_ms: stream.contact_ms, now_ms: performance.now() });
    document.documentElement.dataset["shown"] = "yes";
  };
  setInterval(show, SHOWN_EVERY_MS);
  listenToShortcuts(page.give, page.resume, () => role === "operate");
  void stream.run();
}

void start(document.getElementById("page")!);
