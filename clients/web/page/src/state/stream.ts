// The connection to the server's events. It is opened again when it ends, and probed when it is silent.
import { session } from "../api/client";
import { EventParser } from "./event_parser";
import { LiveState } from "./live_state";

const PROBE_AFTER_MS = 500;
const PROBE_ENDS_AFTER_MS = 3000;
const DEAD_AFTER_MS = 12_000; // the server sends its first event at once, and a comment after 5 s without events
const RETRY_MS = [250, 500, 1000, 2000, 3000];

export class StateStream {
  readonly live = new LiveState();
  connected = false;
  /** When the server last proved that it is there: by an event, a comment or an answer. */
  contact_ms = performance.now();
  private aborted: AbortController | undefined;
  private attempts = 0;
  private received_ms = performance.now();
  private probing = false;

  /** @param denied is called when the session is not valid, or no longer */
  constructor(private readonly denied: () => void) {
    setInterval(() => void this.watch(), PROBE_AFTER_MS / 2);
  }

  /** Runs until the session is denied. */
  async run(): Promise<void> {
    for (;;) {
      const denied = await this.connect();
      this.connected = false;
      this.live.disconnected();
      if (denied) return this.denied();
      const wait = RETRY_MS[Math.min(this.attempts++, RETRY_MS.length - 1)]!;
      await new Promise((resolve) => setTimeout(resolve, wait));
    }
  }

  /** @returns whether the server denies access */
  private async connect(): Promise<boolean> {
    this.aborted = new AbortController();
    const from = this.live.resumeFrom;
    this.received_ms = performance.now();
    try {
      const response = await fetch("/api/events", {
        headers: from === "" ? {} : { "Last-Event-ID": from }, cache: "no-store", signal: this.aborted.signal,
      });
      if (!response.ok || response.body === null) return response.status === 401;
      await this.read(response.body);
    } catch {
      // run() tries again
    }
    return false;
  }

  private async read(body: ReadableStream<Uint8Array>): Promise<void> {
    const parser = new EventParser();
    const text = new TextDecoder();
    const reader = body.getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      this.connected = true;
      this.attempts = 0;
      this.received_ms = this.contact_ms = performance.now();
      for (const event of parser.take(text.decode(value, { stream: true }))) this.live.take(event);
    }
  }

  private async watch(): Promise<void> {
    const now = performance.now();
    if (now - this.received_ms > DEAD_AFTER_MS) this.aborted?.abort();
    if (!this.connected || this.probing || now - this.contact_ms < PROBE_AFTER_MS) return;
    this.probing = true;
    await this.probe();
    this.probing = false;
  }

  /** A state that does not change causes no events, so the answer to a small request proves the connection. */
  private async probe(): Promise<void> {
    const request = new AbortController();
    const timer = setTimeout(() => request.abort(), PROBE_ENDS_AFTER_MS);
    const answer = await session(request.signal);
    clearTimeout(timer);
    if (answer.ok) this.contact_ms = performance.now();
    else if (answer.problem.status === 401) this.aborted?.abort();
  }
}
