// Parses server-sent events from the text of a stream, as the HTML standard defines them. Unlike with a browser's
// EventSource, the reader also sees comments arrive. The server sends them so that a silent connection can be told from
// a dead one.

export interface ServerEvent {
  readonly name: string;
  readonly data: string;
  readonly id: string;
}

export class EventParser {
  private rest = "";
  private name = "";
  private data: string[] = [];
  private id = "";

  /** Returns the events that this piece of the stream completes. */
  take(piece: string): ServerEvent[] {
    const lines = (this.rest + piece).split(/\r\n|\n|\r(?!$)/);
    this.rest = lines.pop() ?? "";
    return lines.flatMap((line) => this.line(line));
  }

  private line(line: string): ServerEvent[] {
    if (line === "") return this.dispatch();
    const colon = line.indexOf(":");
    const field = colon < 0 ? line : line.slice(0, colon);
    const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
    if (field === "event") this.name = value;
    else if (field === "data") this.data.push(value);
    else if (field === "id" && !value.includes("\0")) this.id = value;
    return [];
  }

  private dispatch(): ServerEvent[] {
    const event = { name: this.name || "message", data: this.data.join("\n"), id: this.id };
    const isEmpty = this.data.length === 0;
    this.name = "";
    this.data = [];
    return isEmpty ? [] : [event];
  }
}
