// Server-sent events over fetch. Unlike EventSource, it exposes the status (401, 404, 410) and the keep-alive comments, so
// that a quiet stream can be distinguished from a dead one.

/** One dispatched event. */
export interface ServerEvent {
  /** The durable sequence number as text; "" if the server sent none. */
  id: string;
  /** Event name, "message" by default. */
  type: string;
  data: string;
}

/** Incremental parser of the event-stream format (WHATWG HTML 9.2.6): text in, complete events out. */
export class SseParser {
  private rest = "";
  private id = "";
  private type = "";
  private data: string[] = [];

  /** Events completed by `chunk`. Comments and unknown fields are skipped. */
  push(chunk: string): ServerEvent[] {
    const text = this.rest + chunk;
    // A trailing CR may be the first half of CRLF: it waits for the next chunk.
    const end = text.endsWith("\r") ? text.length - 1 : text.length;
    const lines = text.slice(0, end).split(/\r\n|\r|\n/);
    this.rest = (lines.pop() ?? "") + text.slice(end);
    return lines.flatMap((line) => this.line(line));
  }

  private line(line: string): ServerEvent[] {
    if (line === "") return this.dispatch();
    const colon = line.indexOf(":");
    if (colon === 0) return [];
    const field = colon < 0 ? line : line.slice(0, colon);
    const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
    if (field === "data") this.data.push(value);
    else if (field === "event") this.type = value;
    else if (field === "id" && !value.includes("\0")) this.id = value;
    return [];
  }

  private dispatch(): ServerEvent[] {
    const event = { id: this.id, type: this.type === "" ? "message" : this.type, data: this.data.join("\n") };
    const empty = this.data.length === 0;
    this.type = "";
    this.data = [];
    return empty ? [] : [event];
  }
}

/** Delay in ms before reconnection number `attempt` (from 0): 0.5 s, doubling up to 15 s, jittered by `random` in [0, 1). */
export function backoffMs(attempt: number, random: number): number {
  const ceiling = Math.min(15_000, 500 * 2 ** Math.min(attempt, 10));
  return ceiling / 2 + (ceiling / 2) * random;
}
