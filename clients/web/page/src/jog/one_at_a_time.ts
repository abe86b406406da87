// Sends jog requests one after another, so that none overtakes another: a renewal that arrived after the stop would begin
// the jog again. Only the newest request waits; a stop does not wait for long.

export type Send<T> = (body: T, signal: AbortSignal) => Promise<boolean>;

export interface Clock {
  after(ms: number, action: () => void): () => void;
}

/** A stop aborts a request that takes longer. The server's dead-man's switch then brakes the axes. */
export const STOP_WAITS_MS = 150;

export class OneAtATime<T> {
  private sending: AbortController | undefined;
  private next: { body: T; isStop: boolean } | undefined;

  /** @param refused is called if the server does not follow a request other than a stop */
  constructor(private readonly send: Send<T>, private readonly clock: Clock, private readonly refused: () => void) {}

  /** Drops the renewal while another request is on its way, because the next renewal says the same. */
  renew(body: T): void {
    if (this.sending === undefined) void this.start({ body, isStop: false });
  }

  change(body: T): void {
    this.put({ body, isStop: false });
  }

  stop(body: T): void {
    this.put({ body, isStop: true });
    const waitedFor = this.sending;
    if (this.next !== undefined) {
      this.clock.after(STOP_WAITS_MS, () => {
        if (this.sending === waitedFor) waitedFor?.abort();
      });
    }
  }

  private put(request: { body: T; isStop: boolean }): void {
    if (this.sending === undefined) void this.start(request);
    else this.next = request;
  }

  private async start(request: { body: T; isStop: boolean }): Promise<void> {
    const sending = (this.sending = new AbortController());
    const followed = await this.send(request.body, sending.signal);
    this.sending = undefined;
    const next = this.next;
    this.next = undefined;
    if (next !== undefined) void this.start(next);
    else if (!followed && !request.isStop) this.refused();
  }
}
