// The newest state of the machine, from events.
import type { State } from "../api/contract";
import type { ServerEvent } from "./event_parser";
import { mergePatch, type Json } from "./merge_patch";

export class LiveState {
  private whole: Json | undefined;
  private streamName = "";
  private lastId = "";

  /** Ignores a patch without a state to patch. */
  take(event: ServerEvent): void {
    if (event.name === "stream") {
      this.streamName = (JSON.parse(event.data) as { stream: string }).stream;
      return;
    }
    if (event.name === "state") this.whole = JSON.parse(event.data) as Json;
    else if (event.name === "delta" && this.whole !== undefined) {
      this.whole = mergePatch(this.whole, JSON.parse(event.data) as Json);
    } else return;
    this.lastId = event.id;
  }

  get state(): State | undefined {
    return this.whole as unknown as State | undefined;
  }

  /** The name of the connection, for jogs: the server ends a jog with its stream. */
  get stream(): string {
    return this.streamName;
  }

  /** The event after which the server may continue after a lost connection. */
  get resumeFrom(): string {
    return this.lastId;
  }

  /** The connection is lost, so its name is no longer valid. */
  disconnected(): void {
    this.streamName = "";
  }
}
