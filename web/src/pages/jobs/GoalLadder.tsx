// The goals of a run in order: the verdict on each, its cost, and which one is being searched.

import type { GoalProgress, TrialProgress } from "../../api/types";
import { formatCount, formatNumber, humanize } from "../../lib/format";
import { goalVerdict, type VerdictInfo } from "../../lib/verdicts";
import { VerdictBadge } from "../../ui/basics";
import { bestOf } from "./Trials";

interface Props {
  /** Number of goals; 0 while it is unknown. */
  goals: number;
  finished: readonly GoalProgress[];
  /** The goal being searched; null if none is. */
  active: { index: number; evaluations: number; discrepancy: number | null } | null;
  /** The trials so far; empty if the method does not report them. With trials, a goal's best value is its own distance. */
  trials: readonly TrialProgress[];
  unit: string;
}

interface Rung {
  index: number;
  kind: "done" | "active" | "waiting";
  evaluations: number | null;
  /** Best discrepancy up to this goal or, with trials, the smallest distance from it. */
  best: number | null;
  /** Verdict on a goal that has ended; null if there is none. */
  verdict: VerdictInfo | null;
  /** Reason why it ended, or what is being done about it. */
  note: string;
}

export function GoalLadder({ goals, finished, active, trials, unit }: Props) {
  const one = (index: number) => (trials.length > 0 ? tried(index, finished, active, trials) : rung(index, finished, active));
  const rungs = Array.from({ length: Math.max(goals, finished.length) }, (_, index) => one(index));
  const most = Math.max(1, ...rungs.map((each) => each.evaluations ?? 0));
  if (rungs.length === 0) return <p className="muted">The goals appear once a worker has started the job.</p>;
  return (
    <ol className="ladder">
      <li className="rung head" aria-hidden="true">
        <span>Goal</span>
        <span />
        <span className="numeric">Evaluations</span>
        <span className="numeric">
          {trials.length > 0 ? "Distance" : "Best"}
          {unit && `, ${unit}`}
        </span>
        <span>Verdict</span>
      </li>
      {rungs.map((each) => (
        <li key={each.index} className={`rung ${each.kind}`} aria-label={describe(each)}>
          <span className="rung-mark">{each.index + 1}</span>
          <span className="bar slim">
            <div style={{ width: `${(100 * (each.evaluations ?? 0)) / most}%` }} />
          </span>
          <span className="numeric">{formatCount(each.evaluations)}</span>
          <span className="numeric">{formatNumber(each.best)}</span>
          <span title={each.note}>{each.verdict === null ? each.note : <VerdictBadge verdict={each.verdict} />}</span>
        </li>
      ))}
    </ol>
  );
}

function rung(index: number, finished: readonly GoalProgress[], active: Props["active"]): Rung {
  const done = finished.find((goal) => goal.index === index);
  if (done !== undefined) {
    const { evaluations, discrepancy } = done;
    return { index, kind: "done", evaluations, best: discrepancy, ...ended(done) };
  }
  if (active?.index === index) {
    return { index, kind: "active", evaluations: active.evaluations, best: active.discrepancy, verdict: null, note: "searching" };
  }
  return { index, kind: "waiting", evaluations: null, best: null, verdict: null, note: "waiting" };
}

/** A goal of a method that switches between goals; all of its goals end together. */
function tried(index: number, finished: Props["finished"], active: Props["active"], trials: Props["trials"]): Rung {
  const done = finished.find((goal) => goal.index === index);
  if (done !== undefined) {
    const { evaluations, residual } = done;
    return { index, kind: "done", evaluations, best: residual, ...ended(done) };
  }
  const evaluations = trials.filter((trial) => trial.goal === index).length;
  const best = bestOf(trials, index);
  if (active?.index === index) return { index, kind: "active", evaluations, best, verdict: null, note: "trying" };
  return { index, kind: "waiting", evaluations: evaluations === 0 ? null : evaluations, best, verdict: null, note: evaluations === 0 ? "waiting" : "tried" };
}

function ended(goal: GoalProgress): Pick<Rung, "verdict" | "note"> {
  return { verdict: goalVerdict(goal.judgement), note: `ended by ${humanize(goal.stop_reason)}` };
}

function describe(rung: Rung): string {
  const place = `Goal ${rung.index + 1}, ${rung.verdict === null ? rung.note : `${rung.verdict.label}, ${rung.note}`}`;
  if (rung.evaluations === null) return place;
  return `${place}: ${formatCount(rung.evaluations)} evaluations, best ${formatNumber(rung.best)}`;
}
