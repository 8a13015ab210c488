import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { BATCH_MS, openEventStream, type StreamHealth } from "./eventStream";
import type { ServerEvent } from "./sse";

/** A server whose answers the test writes and breaks. */
class FakeServer {
  readonly requests: Headers[] = [];
  private body: ReadableStreamDefaultController<Uint8Array> | undefined;
  refuses = false;

  readonly fetch = (_url: string, init: RequestInit): Promise<Response> => {
    this.requests.push(new Headers(init.headers));
    if (this.refuses) return Promise.reject(new TypeError("connection refused"));
    const body = new ReadableStream<Uint8Array>({ start: (controller) => void (this.body = controller) });
    return Promise.resolve(new Response(body, { status: 200 }));
  };

  write(text: string) {
    this.body?.enqueue(new TextEncoder().encode(text));
  }

  die() {
    this.refuses = true;
    this.body?.error(new TypeError("connection reset"));
  }
}

describe("openEventStream", () => {
  const server = { current: new FakeServer() };
  let statuses: string[];
  let events: ServerEvent[];
  let close: () => void;

  const open = (complete: (batch: ServerEvent[]) => boolean = () => false) => {
    close = openEventStream({
      url: "/events",
      onEvents: (batch) => {
        events.push(...batch);
        return complete(batch);
      },
      onHealth: (health: StreamHealth) => {
        if (statuses.at(-1) !== health.status) statuses.push(health.status);
      },
    });
  };

  beforeEach(() => {
    vi.useFakeTimers();
    server.current = new FakeServer();
    vi.stubGlobal("fetch", server.current.fetch);
    [statuses, events] = [[], []];
  });
  afterEach(() => {
    close();
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it("says reconnecting after a loss and not live again, whatever came just before the loss", async () => {
    open();
    await vi.advanceTimersByTimeAsync(BATCH_MS);
    expect(statuses).toEqual(["live"]);
    server.current.write("id: 1\ndata: a\n\n");
    await vi.advanceTimersByTimeAsync(BATCH_MS / 2);
    server.current.die();
    await vi.advanceTimersByTimeAsync(5_000);
    expect(events.map((event) => event.data)).toEqual(["a"]);
    expect(statuses).toEqual(["live", "reconnecting"]);
  });

  it("goes on after the last event once the server is back", async () => {
    open();
    await vi.advanceTimersByTimeAsync(BATCH_MS);
    server.current.write("id: 7\ndata: a\n\n");
    await vi.advanceTimersByTimeAsync(BATCH_MS);
    server.current.die();
    await vi.advanceTimersByTimeAsync(1_000);
    server.current.refuses = false;
    await vi.advanceTimersByTimeAsync(30_000);
    expect(server.current.requests.at(-1)?.get("last-event-id")).toBe("7");
    expect(statuses).toEqual(["live", "reconnecting", "live"]);
  });

  it("ends with the event that completes it, and does not ask again", async () => {
    open((batch) => batch.some((event) => event.data === "last"));
    await vi.advanceTimersByTimeAsync(BATCH_MS);
    server.current.write("id: 1\ndata: last\n\n");
    await vi.advanceTimersByTimeAsync(BATCH_MS);
    server.current.die();
    await vi.advanceTimersByTimeAsync(30_000);
    expect(statuses).toEqual(["live", "ended"]);
    expect(server.current.requests.length).toBe(1);
  });
});
