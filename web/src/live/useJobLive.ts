// The live view of one job: all its events folded together, and the health of their stream.

import { useQueryClient } from "@tanstack/react-query";
import { useCallback, useState } from "react";
import type { JobEvent } from "../api/types";
import { isFinal } from "../lib/states";
import { INITIAL, applyEvents, type LiveJob } from "./jobLive";
import type { ServerEvent } from "./sse";
import type { StreamHealth } from "./eventStream";
import { useEventStream } from "./useEventStream";

const RESYNC = "resync";

/** Parses a job event; null for anything else in the stream. */
function read(event: ServerEvent): JobEvent | null {
  try {
    const parsed = JSON.parse(event.data) as Partial<JobEvent>;
    return typeof parsed.seq === "number" && typeof parsed.type === "string" ? (parsed as JobEvent) : null;
  } catch {
    return null;
  }
}

export function useJobLive(id: string): { live: LiveJob; health: StreamHealth } {
  const queries = useQueryClient();
  const [live, setLive] = useState(INITIAL);

  const onEvents = useCallback(
    (batch: ServerEvent[]) => {
      const events = batch.flatMap((event) => read(event) ?? []);
      setLive((before) => applyEvents(before, events));
      const states = events.filter((event) => event.type === "state");
      const changed = states.length > 0 || events.some((event) => event.type === "run");
      if (changed || batch.some((event) => event.type === RESYNC)) {
        void queries.invalidateQueries({ queryKey: ["jobs"] });
        void queries.invalidateQueries({ queryKey: ["runs", { job: id }] });
      }
      return states.some((event) => isFinal(event.state));
    },
    [id, queries],
  );

  const health = useEventStream({ url: `/api/v1/jobs/${encodeURIComponent(id)}/events?after_seq=0`, onEvents });
  return { live, health };
}
