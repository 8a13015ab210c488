// Words and colours of the server's verdicts on goals and runs: the only place that has them. Nothing here decides one.

import type { Judgement, RunVerdict } from "../api/types";
import type { Tone } from "./states";

export interface VerdictInfo {
  label: string;
  tone: Tone;
  /** One sentence that explains it. */
  meaning: string;
}

const OF_GOAL: Record<Judgement["verdict"], VerdictInfo> = {
  reached: { label: "reached", tone: "good", meaning: "The executed observation is within the tolerance." },
  stopped_short: { label: "stopped short", tone: "warn", meaning: "The search ended outside the tolerance; a nearer pose may exist." },
  out_of_reach: {
    label: "out of reach",
    tone: "bad",
    meaning: "No pose is expected to come nearer: a restart from another region of the joint space agreed.",
  },
};

/** The verdict on a goal; null if the build that ran it gave none. */
export function goalVerdict(judgement: Judgement | null | undefined): VerdictInfo | null {
  return judgement == null ? null : OF_GOAL[judgement.verdict];
}

/** The verdict on a run; null if the build that ran it gave none. */
export function runVerdict(verdict: RunVerdict | null | undefined): VerdictInfo | null {
  if (verdict == null) return null;
  const { outcome, stopped_short, out_of_reach } = verdict;
  if (outcome === "complete") return { label: "complete", tone: "good", meaning: "Every goal is reached." };
  if (outcome === "invalid") {
    return { label: "invalid", tone: "bad", meaning: "The joints of some goal violate the constraints." };
  }
  const missed = stopped_short + out_of_reach;
  return {
    label: `complete with ${missed} ${missed === 1 ? "goal" : "goals"} missed`,
    tone: "warn",
    meaning: `${stopped_short} stopped short, ${out_of_reach} out of reach.`,
  };
}

/** How many of `goals` ended with each verdict. */
export function countVerdicts(goals: readonly { judgement?: Judgement | null }[]): Record<Judgement["verdict"], number> {
  const counts = { reached: 0, stopped_short: 0, out_of_reach: 0 };
  for (const { judgement } of goals) if (judgement != null) counts[judgement.verdict] += 1;
  return counts;
}
