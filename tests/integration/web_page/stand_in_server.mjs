// Serves the built page and the interface of clients/web/openapi.yaml for a stand-in machine, on loopback.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { encodePath } from "./stand_in_machine.mjs";

export const TOKENS = { operate: "operate-token", view: "view-token" };
const TYPES = { html: "text/html; charset=utf-8", js: "text/javascript", css: "text/css", svg: "image/svg+xml" };
export const POLICY = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

function patch(before, now) {
  const changed = {};
  for (const key of new Set([...Object.keys(before), ...Object.keys(now)])) {
    if (JSON.stringify(before[key]) === JSON.stringify(now[key])) continue;
    const isObject = (v) => typeof v === "object" && v !== null && !Array.isArray(v);
    changed[key] = !(key in now) ? null : isObject(before[key]) && isObject(now[key]) ? patch(before[key], now[key]) : now[key];
  }
  return changed;
}

async function bodyOf(request) {
  const parts = [];
  for await (const part of request) parts.push(part);
  return Buffer.concat(parts).toString();
}

/** An error for each line with the word BAD. */
function wrongLines(text) {
  return text.split("\n").flatMap((line, i) => (line.includes("BAD") ? [{ line: i + 1, column: line.indexOf("BAD") + 1, message: "a letter that G-code does not know: B" }] : []));
}

export class StandInServer {
  streams = new Set();
  requests = 0;

  constructor(machine, dist, { pointsEachTick = 20 } = {}) {
    this.machine = machine;
    this.dist = dist;
    this.server = createServer((request, response) => void this.handle(request, response));
    this.timer = setInterval(() => {
      machine.tick(pointsEachTick);
      this.publish();
    }, 100);
  }

  async listen(port = 0) {
    await new Promise((resolve) => this.server.listen(port, "127.0.0.1", resolve));
    this.port = this.server.address().port;
    return `http://127.0.0.1:${this.port}`;
  }

  /** Cuts every connection, like a server that dies. */
  async close() {
    clearInterval(this.timer);
    this.server.closeAllConnections();
    await new Promise((resolve) => this.server.close(resolve));
  }

  publish() {
    const now = JSON.parse(JSON.stringify(this.machine.state));
    const delta = this.before ? patch(this.before, now) : {};
    this.before = now;
    if (Object.keys(delta).length === 0) return;
    this.id = (this.id ?? 0) + 1;
    for (const stream of this.streams) stream.write(`event: delta\nid: ${this.id}\ndata: ${JSON.stringify(delta)}\n\n`);
  }

  json(response, value, status = 200, headers = {}) {
    const type = status >= 400 ? "application/problem+json" : "application/json";
    response.writeHead(status, { "Content-Type": type, ...headers }).end(JSON.stringify(value));
  }

  problem(response, status, code, title, more = {}) {
    this.json(response, { type: "about:blank", status, code, title, detail: title, ...more }, status);
  }

  async handle(request, response) {
    const { pathname } = new URL(request.url, "http://machine");
    if (!pathname.startsWith("/api/")) return this.asset(response, pathname === "/" ? "index.html" : pathname.slice(1));
    if (pathname === "/api/session" && request.method === "POST") return this.signIn(request, response);
    const role = /session=(\w+)/.exec(request.headers.cookie ?? "")?.[1];
    if (role === undefined) return this.problem(response, 401, "no-session", "A token is needed", { remedy: "open the address that lockstep-web printed" });
    if (request.method === "POST" && role !== "operate") return this.problem(response, 403, "view-only", "This session may only view");
    this.api(request, response, pathname, role);
  }

  async api(request, response, pathname, role) {
    const { machine } = this;
    if (pathname === "/api/session" && request.method === "DELETE") return this.signOut(response);
    if (pathname === "/api/session") return this.json(response, { role });
    if (pathname === "/api/machine") return this.json(response, this.machine.description);
    if (pathname === "/api/state") return this.json(response, machine.state);
    if (pathname === "/api/events") return this.events(response);
    if (pathname === "/api/mdi") return this.json(response, { lines: [{ line: "G0 X5 Y5", accepted: true }, { line: "G1 X500 F600", accepted: false }], modes: this.machine.state.modes });
    if (pathname === "/api/reports") return this.json(response, { files: [{ name: "plate.html", kind: "report", bytes: 182_333, modified: "2026-01-05T10:00:00Z" }, { name: "incident-3.flight", kind: "incident", bytes: 65_536, modified: "2026-01-04T16:30:00Z" }] });
    if (pathname === "/api/program/path") return machine.program ? response.writeHead(200, { "Content-Type": "application/octet-stream" }).end(encodePath(machine.program.points)) : this.problem(response, 404, "no-program", "No program is loaded");
    if (pathname === "/api/program" && request.method === "GET") return machine.program ? response.writeHead(200, { "Content-Type": "text/plain" }).end(machine.program.text) : this.problem(response, 404, "no-program", "No program is loaded");
    if (pathname === "/api/program") return this.upload(request, response);
    const verb = /^\/api\/commands\/(\w+)$/.exec(pathname)?.[1];
    if (verb === undefined) return this.problem(response, 404, "unknown-path", "There is no such path");
    const refused = machine.command(verb, JSON.parse((await bodyOf(request)) || "{}"));
    if (refused) return this.problem(response, refused.status, refused.code, refused.title, refused);
    this.publish();
    this.json(response, { accepted: true, job: null, ...(verb === "jog" ? { jogging: machine.state.mode === "Jogging" } : {}) });
  }

  asset(response, name) {
    try {
      const content = readFileSync(join(this.dist, name.replaceAll("..", "")));
      response.writeHead(200, { "Content-Type": TYPES[name.split(".").pop()] ?? "text/plain", "Content-Security-Policy": POLICY, "X-Content-Type-Options": "nosniff" }).end(content);
    } catch {
      this.problem(response, 404, "unknown-path", "There is no such path");
    }
  }

  async signIn(request, response) {
    const { token } = JSON.parse(await bodyOf(request));
    const role = Object.keys(TOKENS).find((name) => TOKENS[name] === token);
    if (role === undefined) return this.problem(response, 401, "wrong-token", "The token is wrong", { remedy: "take it from the address that lockstep-web printed" });
    this.json(response, { role }, 200, { "Set-Cookie": `session=${role}; HttpOnly; SameSite=Strict; Path=/` });
  }

  signOut(response) {
    response.writeHead(204, { "Set-Cookie": "session=; HttpOnly; SameSite=Strict; Path=/; Max-Age=0" }).end();
  }

  events(response) {
    response.writeHead(200, { "Content-Type": "text/event-stream", "Cache-Control": "no-store" });
    response.write(`event: stream\ndata: {"stream":"s${++this.requests}"}\n\n`);
    this.before ??= JSON.parse(JSON.stringify(this.machine.state));
    response.write(`event: state\nid: ${this.id ?? 0}\ndata: ${JSON.stringify(this.before)}\n\n`);
    this.streams.add(response);
    response.on("close", () => {
      this.streams.delete(response);
      if (this.machine.state.mode === "Jogging") this.machine.end();
    });
  }

  async upload(request, response) {
    const text = await bodyOf(request);
    const errors = wrongLines(text);
    if (errors.length > 0) return this.problem(response, 422, "bad-program", "The program has errors", { errors: errors.slice(0, 20) });
    const name = new URL(request.url, "http://machine").searchParams.get("name") ?? "";
    this.machine.load(name, 400);
    this.publish();
    this.json(response, this.machine.state.program);
  }
}
