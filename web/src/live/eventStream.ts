// One live stream: connects, resumes after the last event seen, reports its health. No React, so that it can be tested.

import { SseParser, backoffMs, type ServerEvent } from "./sse";

/** `live` once connected; `reconnecting` after a loss; `ended` once the server has nothing more to send. */
export type StreamStatus = "connecting" | "live" | "reconnecting" | "ended" | "rejected";

export interface StreamHealth {
  status: StreamStatus;
  /** Time of the last event or keep-alive, ms since the epoch. */
  lastSignalMs: number | null;
}

export const CONNECTING: StreamHealth = { status: "connecting", lastSignalMs: null };

export interface StreamOptions {
  url: string;
  /** Called with all events of the last `BATCH_MS`. Returns true if the stream is complete. */
  onEvents: (events: ServerEvent[]) => boolean;
  onHealth: (health: StreamHealth) => void;
}

/** How long events are gathered before they are handed on together. */
export const BATCH_MS = 60;

/** Statuses after which reconnecting is pointless. */
const REJECTIONS = new Set([400, 401, 403, 404, 410]);

/** Follows `url` until its end or until the returned function is called. */
export function openEventStream({ url, onEvents, onHealth }: StreamOptions): () => void {
  const abort = new AbortController();
  let health = CONNECTING;
  let queue: ServerEvent[] = [];
  let timer: ReturnType<typeof setTimeout> | undefined;

  const report = (next: StreamHealth) => {
    health = next;
    onHealth(next);
  };
  /** Hands on the batch; returns whether it completes the stream. */
  const flush = () => {
    clearTimeout(timer);
    timer = undefined;
    const batch = queue;
    queue = [];
    const complete = batch.length > 0 && onEvents(batch);
    report({ status: complete ? "ended" : "live", lastSignalMs: Date.now() });
    if (complete) abort.abort();
    return complete;
  };
  const signal = (events: ServerEvent[]) => {
    queue.push(...events);
    // Not an animation frame: a hidden page gets none, and must go on counting.
    timer ??= setTimeout(flush, BATCH_MS);
  };
  const lost = (status: StreamStatus) => {
    if (abort.signal.aborted) return;
    // What arrived before the loss is handed on before it is reported; later it would say "live" again.
    if (timer !== undefined && flush()) return;
    report({ ...health, status });
  };

  void follow(url, abort.signal, signal, lost);
  return () => {
    clearTimeout(timer);
    abort.abort();
  };
}

async function follow(
  url: string,
  signal: AbortSignal,
  onSignal: (events: ServerEvent[]) => void,
  onLost: (status: StreamStatus) => void,
): Promise<void> {
  let lastId = "";
  for (let attempt = 0; !signal.aborted; attempt += 1) {
    try {
      const response = await fetch(url, {
        signal,
        headers: { accept: "text/event-stream", ...(lastId === "" ? {} : { "last-event-id": lastId }) },
      });
      if (response.status === 204 || REJECTIONS.has(response.status)) {
        onLost(response.status === 204 ? "ended" : "rejected");
        return;
      }
      if (response.ok && response.body !== null) {
        attempt = 0;
        onSignal([]);
        lastId = await pump(response.body, lastId, onSignal);
      }
    } catch {
      // A lost connection and an abort look alike; the loop's condition tells them apart.
    }
    onLost("reconnecting");
    await pause(backoffMs(attempt, Math.random()), signal);
  }
}

/** Hands on events until the body ends or breaks; returns the id of the last one. */
async function pump(
  body: ReadableStream<Uint8Array>,
  lastId: string,
  onSignal: (events: ServerEvent[]) => void,
): Promise<string> {
  const parser = new SseParser();
  const reader = body.pipeThrough(new TextDecoderStream() as ReadableWritablePair<string, Uint8Array>).getReader();
  let seen = lastId;
  for (;;) {
    let part;
    try {
      part = await reader.read();
    } catch {
      return seen;
    }
    if (part.done) return seen;
    const events = parser.push(part.value);
    seen = events.findLast((event) => event.id !== "")?.id ?? seen;
    onSignal(events);
  }
}

function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const done = () => {
      clearTimeout(timer);
      resolve();
    };
    const timer = setTimeout(done, milliseconds);
    signal.addEventListener("abort", done, { once: true });
  });
}
