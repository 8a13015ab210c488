// Badge for the age of the displayed data: "live", or "data is N s old" once the stream stalls.

import type { StreamHealth } from "../live/eventStream";
import { formatDuration } from "../lib/format";
import { Badge } from "./basics";
import { useNow } from "./useNow";

/** Longer than the server's keep-alive of 15 s. */
const STALLED_AFTER_S = 20;

export function StreamHealthBadge({ health }: { health: StreamHealth }) {
  const now = useNow();
  if (health.status === "ended") return null;
  if (health.status === "connecting") return <span className="stale">Connecting…</span>;
  if (health.status === "rejected") return <Badge tone="bad">No live data: the server rejected the stream</Badge>;
  const ageS = health.lastSignalMs === null ? null : (now - health.lastSignalMs) / 1000;
  const stalled = health.status === "reconnecting" || (ageS !== null && ageS > STALLED_AFTER_S);
  if (!stalled) return <Badge tone="good">Live</Badge>;
  const age = ageS === null ? "No data yet" : `Data is ${formatDuration(Math.max(0, Math.round(ageS)))} old`;
  return (
    <span role="status">
      <Badge tone="warn">{age}, reconnecting</Badge>
    </span>
  );
}
