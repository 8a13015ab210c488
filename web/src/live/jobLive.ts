// Folds the events of one job into a view. Pure, (state, event) -> state, so that a replay gives the same view as watching.

import type { GoalProgress, JobEvent, JobProgress, JobState, TrialProgress } from "../api/types";

/** Best discrepancy over evaluations within one repetition, as parallel columns. */
export interface Curve {
  repetition: number;
  evaluations: number[];
  discrepancy: number[];
  goal: number[];
}

/** A finished repetition. */
export type FinishedRun = Extract<JobEvent, { type: "run" }>;

export interface LiveJob {
  lastSeq: number;
  state: JobState | null;
  reason: string | null;
  attempt: number | null;
  progress: JobProgress | null;
  /** Finished goals of the repetition shown, by index. */
  goals: GoalProgress[];
  /** Trials of the repetition shown; empty if the method does not report them. */
  trials: TrialProgress[];
  curve: Curve;
  runs: FinishedRun[];
}

/** Curves longer than this drop every second point; a screen cannot show more. */
export const MAX_CURVE = 4000;

const emptyCurve = (repetition: number): Curve => ({ repetition, evaluations: [], discrepancy: [], goal: [] });

export const INITIAL: LiveJob = {
  lastSeq: 0,
  state: null,
  reason: null,
  attempt: null,
  progress: null,
  goals: [],
  trials: [],
  curve: emptyCurve(0),
  runs: [],
};

/** Adds events; those already seen (replayed after a reconnect) are ignored. */
export function applyEvents(live: LiveJob, events: readonly JobEvent[]): LiveJob {
  return events.reduce(applyEvent, live);
}

function applyEvent(live: LiveJob, event: JobEvent): LiveJob {
  if (event.seq <= live.lastSeq) return live;
  const next = { ...live, lastSeq: event.seq };
  switch (event.type) {
    case "state":
      return { ...next, state: event.state, reason: event.reason, attempt: event.attempt };
    case "progress":
      return withProgress(next, event.progress);
    case "goal":
      return withGoal(next, event.goal);
    case "trial":
      return { ...next, trials: withTrial(next.trials, event.trial) };
    case "run":
      return { ...next, runs: withRun(next.runs, event) };
    default:
      // An event type newer than this dashboard.
      return next;
  }
}

function withProgress(live: LiveJob, progress: JobProgress): LiveJob {
  const { repetition, finished_goals: finished } = progress;
  const sameRun = live.curve.repetition === repetition;
  const started = sameRun ? live.curve : emptyCurve(repetition);
  const curve = withPoint(started, progress.evaluations, progress.discrepancy, progress.goal_index);
  // Streamed progress usually leaves finished goals to the goal events, but may carry them if the stream starts late.
  const goals = finished.length > 0 ? finished : sameRun ? live.goals : [];
  return { ...live, progress, curve, goals };
}

function withGoal(live: LiveJob, goal: GoalProgress): LiveJob {
  const sameRun = live.curve.repetition === goal.repetition;
  const before = sameRun ? live.goals.filter((other) => other.index !== goal.index) : [];
  const goals = [...before, goal].sort((a, b) => a.index - b.index);
  const evaluations = goals.reduce((sum, each) => sum + each.evaluations, 0);
  const curve = withPoint(sameRun ? live.curve : emptyCurve(goal.repetition), evaluations, goal.discrepancy, goal.index);
  return { ...live, goals, curve };
}

/** Adds a trial; a trial of a later repetition starts a new list. */
function withTrial(trials: TrialProgress[], trial: TrialProgress): TrialProgress[] {
  return [...trials.filter((other) => other.repetition === trial.repetition && other.index < trial.index), trial];
}

function withPoint(curve: Curve, evaluations: number, discrepancy: number | null, goal: number): Curve {
  const last = curve.evaluations.at(-1) ?? -1;
  // A job resumed from a checkpoint repeats earlier reports; the curve continues where it was.
  if (discrepancy === null || evaluations <= last) return curve;
  const thinned = curve.evaluations.length >= MAX_CURVE ? thin(curve) : curve;
  return {
    repetition: curve.repetition,
    evaluations: [...thinned.evaluations, evaluations],
    discrepancy: [...thinned.discrepancy, discrepancy],
    goal: [...thinned.goal, goal],
  };
}

function thin(curve: Curve): Curve {
  const even = <T>(values: T[]) => values.filter((_, index) => index % 2 === 0);
  return {
    repetition: curve.repetition,
    evaluations: even(curve.evaluations),
    discrepancy: even(curve.discrepancy),
    goal: even(curve.goal),
  };
}

function withRun(runs: FinishedRun[], run: FinishedRun): FinishedRun[] {
  return [...runs.filter((other) => other.repetition !== run.repetition), run];
}
