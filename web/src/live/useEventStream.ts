// One live stream as a React hook: connects, resumes after the last event seen, reports its health.

import { useEffect, useRef, useState } from "react";
import { SseParser, backoffMs, type ServerEvent } from "./sse";

/** `live` once connected; `reconnecting` after a loss; `ended` once the server has nothing more to send. */
export type StreamStatus = "connecting" | "live" | "reconnecting" | "ended" | "rejected";

export interface StreamHealth {
  status: StreamStatus;
  /** Time of the last event or keep-alive, ms since the epoch. */
  lastSignalMs: number | null;
}

interface Options {
  /** No stream is opened if undefined. */
  url: string | undefined;
  /** Called at most once per animation frame with the events received since; returns true if the stream is complete. */
  onEvents: (events: ServerEvent[]) => boolean;
}

/** Subscribes to `url` and delivers events in batches. */
export function useEventStream({ url, onEvents }: Options): StreamHealth {
  const [health, setHealth] = useState<StreamHealth>({ status: "connecting", lastSignalMs: null });
  const handler = useRef(onEvents);
  useEffect(() => {
    handler.current = onEvents;
  });

  useEffect(() => {
    if (url === undefined) return undefined;
    const abort = new AbortController();
    let queue: ServerEvent[] = [];
    let frame = 0;
    let complete = false;

    const flush = () => {
      frame = 0;
      const batch = queue;
      queue = [];
      setHealth({ status: "live", lastSignalMs: Date.now() });
      if (batch.length > 0 && handler.current(batch)) {
        complete = true;
        setHealth({ status: "ended", lastSignalMs: Date.now() });
        abort.abort();
      }
    };
    const schedule = (events: ServerEvent[]) => {
      queue.push(...events);
      // A hidden page gets no animation frames, so a timer takes over.
      if (frame === 0) frame = window.setTimeout(flush, 60);
    };
    const lost = (status: StreamStatus) => {
      if (!complete && !abort.signal.aborted) setHealth((now) => ({ ...now, status }));
    };

    void follow(url, abort.signal, schedule, lost);
    return () => {
      abort.abort();
      window.clearTimeout(frame);
    };
  }, [url]);

  return health;
}

/** Statuses after which reconnecting is pointless. */
const REFUSALS = new Set([400, 401, 403, 404, 410]);

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
      if (response.status === 204 || REFUSALS.has(response.status)) {
        onLost(response.status === 204 ? "ended" : "rejected");
        return;
      }
      if (response.ok && response.body !== null) {
        attempt = 0;
        onSignal([]);
        lastId = await pump(response.body, lastId, onSignal);
      }
    } catch {
      // A lost connection and an abort look the same here; the loop's condition distinguishes them.
    }
    onLost("reconnecting");
    await pause(backoffMs(attempt, Math.random()), signal);
  }
}

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
      window.clearTimeout(timer);
      resolve();
    };
    const timer = window.setTimeout(done, milliseconds);
    signal.addEventListener("abort", done, { once: true });
  });
}
