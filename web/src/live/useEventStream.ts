// An event stream as a React hook.

import { useEffect, useRef, useState } from "react";
import { CONNECTING, openEventStream, type StreamHealth } from "./eventStream";
import type { ServerEvent } from "./sse";

interface Options {
  /** No stream is opened if undefined. */
  url: string | undefined;
  /** Called with batches of events; returns true if the stream is complete. */
  onEvents: (events: ServerEvent[]) => boolean;
}

/** Subscribes to `url` and delivers events in batches. */
export function useEventStream({ url, onEvents }: Options): StreamHealth {
  const [health, setHealth] = useState(CONNECTING);
  const handler = useRef(onEvents);
  useEffect(() => {
    handler.current = onEvents;
  });

  useEffect(() => {
    if (url === undefined) return undefined;
    return openEventStream({ url, onEvents: (events) => handler.current(events), onHealth: setHealth });
  }, [url]);

  return health;
}
