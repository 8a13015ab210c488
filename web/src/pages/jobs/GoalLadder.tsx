// The goals of a run in their order: which are reached at which cost, which one is sought now.

import type { GoalProgress } from "../../api/types";
import { formatCount, formatNumber, humanize } from "../../lib/format";

interface Props {
  /** Number of goals; 0 while it is unknown. */
  goals: number;
  finished: readonly GoalProgress[];
  /** The goal sought now; null when none is. */
  active: { index: number; evaluations: number; discrepancy: number | null } | null;
  unit: string;
}

interface Rung {
  index: number;
  kind: "done" | "active" | "waiting";
  evaluations: number | null;
  discrepancy: number | null;
  note: string;
}

export function GoalLadder({ goals, finished, active, unit }: Props) {
  const rungs = Array.from({ length: Math.max(goals, finished.length) }, (_, index) => rung(index, finished, active));
  const most = Math.max(1, ...rungs.map((each) => each.evaluations ?? 0));
  if (rungs.length === 0) return <p className="muted">The goals are known once a worker has the job.</p>;
  return (
    <ol className="ladder">
      <li className="rung head" aria-hidden="true">
        <span>Goal</span>
        <span />
        <span className="numeric">Evaluations</span>
        <span className="numeric">Best{unit && `, ${unit}`}</span>
        <span>Ended by</span>
      </li>
      {rungs.map((each) => (
        <li key={each.index} className={`rung ${each.kind}`} aria-label={describe(each)}>
          <span className="rung-mark">{each.index + 1}</span>
          <span className="bar slim">
            <div style={{ width: `${(100 * (each.evaluations ?? 0)) / most}%` }} />
          </span>
          <span className="numeric">{formatCount(each.evaluations)}</span>
          <span className="numeric">{formatNumber(each.discrepancy)}</span>
          <span>{each.note}</span>
        </li>
      ))}
    </ol>
  );
}

function rung(index: number, finished: readonly GoalProgress[], active: Props["active"]): Rung {
  const done = finished.find((goal) => goal.index === index);
  if (done !== undefined) {
    const { evaluations, discrepancy } = done;
    return { index, kind: "done", evaluations, discrepancy, note: humanize(done.stop_reason) };
  }
  if (active?.index === index) return { ...active, kind: "active", note: "searching" };
  return { index, kind: "waiting", evaluations: null, discrepancy: null, note: "waiting" };
}

function describe(rung: Rung): string {
  const place = `Goal ${rung.index + 1}, ${rung.note}`;
  if (rung.evaluations === null) return place;
  return `${place}: ${formatCount(rung.evaluations)} evaluations, best discrepancy ${formatNumber(rung.discrepancy)}`;
}
