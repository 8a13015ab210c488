import { expect, it } from "vitest";
import { countVerdicts, goalVerdict, runVerdict } from "./verdicts";

const judged = (verdict: "reached" | "stopped_short" | "out_of_reach") => ({ judgement: { verdict, distance: 1, tolerance: 2 } });

it("says of a run how many goals it missed", () => {
  const run = (outcome: "complete" | "goals_missed" | "invalid", stopped_short = 0, out_of_reach = 0) =>
    runVerdict({ outcome, reached: 5, stopped_short, out_of_reach })?.label;
  expect(run("complete")).toBe("complete");
  expect(run("goals_missed", 1)).toBe("complete with 1 goal missed");
  expect(run("goals_missed", 1, 2)).toBe("complete with 3 goals missed");
  expect(run("invalid", 1)).toBe("invalid");
  expect(runVerdict(null)).toBeNull();
});

it("counts verdicts and leaves out goals without one", () => {
  const goals = [judged("reached"), judged("out_of_reach"), judged("reached"), { judgement: null }, {}];
  expect(countVerdicts(goals)).toEqual({ reached: 2, stopped_short: 0, out_of_reach: 1 });
  expect(goalVerdict(null)).toBeNull();
  expect(goalVerdict(judged("stopped_short").judgement)?.tone).toBe("warn");
});
