import { describe, expect, it } from "vitest";
import type { GoalProgress, JobEvent, JobProgress } from "../api/types";
import { INITIAL, MAX_CURVE, applyEvents } from "./jobLive";

const goal = (index: number, evaluations: number, discrepancy: number): GoalProgress => ({
  repetition: 0,
  index,
  evaluations,
  discrepancy,
  stop_reason: "stagnation",
  judgement: { verdict: "reached", distance: 3, tolerance: 5 },
  joints: [0, 0, 0],
  observation: [1, 2, 3],
  residual: null,
});

const progress = (change: Partial<JobProgress>): JobProgress => ({
  fraction: 0.1,
  repetition: 0,
  repetitions: 2,
  goal_index: 0,
  goals: 9,
  evaluations: 50,
  goal_evaluations: 50,
  total_evaluations: 50,
  discrepancy: 12,
  finished_goals: [],
  trials: [],
  ...change,
});

const at = "2026-11-22T01:00:00.000Z";
const job = "job_0";
const progressEvent = (seq: number, change: Partial<JobProgress>): JobEvent => ({
  seq,
  job,
  at,
  type: "progress",
  progress: progress(change),
});

describe("applyEvents", () => {
  it("follows state, progress, goals and runs", () => {
    const live = applyEvents(INITIAL, [
      { seq: 1, job, at, type: "state", state: "RUNNING", reason: null, attempt: 1 },
      progressEvent(2, {}),
      { seq: 3, job, at, type: "goal", goal: goal(0, 80, 9) },
      progressEvent(4, { goal_index: 1, evaluations: 130, discrepancy: 20 }),
      {
        seq: 5,
        job,
        at,
        type: "run",
        run: "run_0",
        trajectory: null,
        repetition: 0,
        seed: 7,
        evaluations: 900,
        discrepancy: 273,
        painted_percent: null,
        digest: "ab",
      },
    ]);
    expect([live.state, live.attempt, live.lastSeq]).toEqual(["RUNNING", 1, 5]);
    expect(live.curve.evaluations).toEqual([50, 80, 130]);
    expect(live.curve.discrepancy).toEqual([12, 9, 20]);
    expect(live.goals.map((each) => each.index)).toEqual([0]);
    expect(live.runs.map((run) => run.seed)).toEqual([7]);
  });

  it("gives the same whether events come once or again after a reconnection", () => {
    const events = [progressEvent(1, {}), progressEvent(2, { evaluations: 60, discrepancy: 11 })];
    const once = applyEvents(INITIAL, events);
    expect(applyEvents(once, events)).toEqual(once);
  });

  it("starts a new curve and ladder with a new repetition", () => {
    const live = applyEvents(INITIAL, [
      { seq: 1, job, at, type: "goal", goal: goal(0, 500, 9) },
      progressEvent(2, { repetition: 1, evaluations: 40, discrepancy: 30 }),
    ]);
    expect(live.curve).toEqual({ repetition: 1, evaluations: [40], discrepancy: [30], goal: [0] });
    expect(live.goals).toEqual([]);
  });

  it("does not draw backwards when a job resumes from its checkpoint", () => {
    const live = applyEvents(INITIAL, [progressEvent(1, { evaluations: 500 }), progressEvent(2, { evaluations: 300 })]);
    expect(live.curve.evaluations).toEqual([500]);
  });

  it("bounds the curve", () => {
    const events = Array.from({ length: MAX_CURVE + 500 }, (_, index) => progressEvent(index + 1, { evaluations: index + 1 }));
    const live = applyEvents(INITIAL, events);
    expect(live.curve.evaluations.length).toBeLessThanOrEqual(MAX_CURVE);
    expect(live.curve.evaluations.at(-1)).toBe(MAX_CURVE + 500);
  });

  it("passes over an event type it does not know", () => {
    const stranger = { seq: 1, job, at, type: "weather" } as unknown as JobEvent;
    expect(applyEvents(INITIAL, [stranger])).toEqual({ ...INITIAL, lastSeq: 1 });
  });

  it("keeps each trial once and forgets those of the repetition before", () => {
    const trial = (seq: number, repetition: number, index: number): JobEvent => ({
      seq,
      job,
      at,
      type: "trial",
      trial: { repetition, index, goal: 0, residual: 5 - index },
    });
    const first = applyEvents(INITIAL, [trial(1, 0, 0), trial(2, 0, 1), trial(2, 0, 1)]);
    expect(first.trials.map((each) => each.index)).toEqual([0, 1]);
    const second = applyEvents(first, [trial(3, 1, 0)]);
    expect(second.trials.map((each) => each.repetition)).toEqual([1]);
  });
});
