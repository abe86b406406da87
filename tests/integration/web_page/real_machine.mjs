// The machine that page_on_a_machine.py has brought up, and lockstep-web beside it.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { createInterface } from "node:readline";
import { until } from "./waiting.mjs";

const { PROGRAMS } = process.env;

export function lockstep(...words) {
  const ran = spawnSync(`${PROGRAMS}/lockstep`, words, { encoding: "utf8" });
  assert.equal(ran.status, 0, `lockstep ${words}: ${ran.stdout}${ran.stderr}`);
}

/** A command of another client, which runs in parallel to the test until `ended`. */
export function startLockstep(env, ...words) {
  const process_ = spawn(`${PROGRAMS}/lockstep`, words, { stdio: "ignore", env: { ...process.env, ...env } });
  return { ended: new Promise((resolve) => process_.once("exit", resolve)) };
}

export class Server {
  async start() {
    this.process = spawn(`${PROGRAMS}/lockstep-web`, ["--port", String(this.port ?? 0)], { stdio: ["ignore", "pipe", "inherit"] });
    const lines = createInterface({ input: this.process.stdout })[Symbol.asyncIterator]();
    await lines.next();
    const [operate, view] = [await lines.next(), await lines.next()].map(({ value }) => new URL(value));
    this.port = Number(operate.port);
    this.origin = operate.origin;
    this.tokens = Object.fromEntries([["operate", operate], ["view", view]].map(([role, url]) => [role, url.hash.slice("#token=".length)]));
  }

  async end() {
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    this.process.kill("SIGTERM");
    assert.equal(await ended, 0, "lockstep-web did not end as asked");
  }

  address(role = "operate") {
    return `${this.origin}/#token=${this.tokens[role]}`;
  }

  ask(path, options = {}) {
    return fetch(this.origin + path, { ...options, headers: { Authorization: `Bearer ${this.tokens.operate}`, ...options.headers } });
  }

  async state() {
    return (await this.ask("/api/state")).json();
  }

  async command(verb, body = {}) {
    return this.ask(`/api/commands/${verb}`, { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json" } });
  }

  async load(name, text) {
    const answer = await this.ask(`/api/program?name=${name}`, { method: "POST", body: text, headers: { "Content-Type": "text/plain" } });
    assert.equal(answer.status, 200, await answer.text());
  }

  async becomes(what, holds) {
    let state;
    await until(what, async () => holds((state = await this.state())));
    return state;
  }

  /** Brings the machine from any state to Idle, homed, at 100 %. */
  async settle() {
    await this.becomes("a machine", ({ mode }) => !["Unreachable", "Waiting"].includes(mode));
    await until("idle", async () => {
      const { mode } = await this.state();
      if (mode === "Fault") await this.command("reset");
      else if (mode !== "Idle") await this.command("stop");
      return mode === "Idle";
    });
    const isHomed = ({ axes }) => Object.values(axes).every(({ homed }) => homed);
    if (!isHomed(await this.state())) await this.command("home");
    await this.becomes("homed", (state) => state.mode === "Idle" && isHomed(state));
    await this.command("override", { feed_percent: 100, rapid_percent: 100 });
  }
}
