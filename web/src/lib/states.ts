// Labels and tones of job states.

import type { JobState } from "../api/types";

export type Tone = "info" | "good" | "warn" | "bad" | "idle";

interface StateInfo {
  label: string;
  tone: Tone;
  /** The job is making progress without user action. */
  active: boolean;
}

const STATES: Record<JobState, StateInfo> = {
  QUEUED: { label: "Queued", tone: "idle", active: false },
  PREPARING: { label: "Preparing", tone: "info", active: true },
  RUNNING: { label: "Running", tone: "info", active: true },
  PAUSING: { label: "Pausing", tone: "warn", active: true },
  PAUSED: { label: "Paused", tone: "warn", active: false },
  INTERRUPTED: { label: "Interrupted", tone: "warn", active: false },
  CANCELLING: { label: "Cancelling", tone: "idle", active: true },
  CANCELLED: { label: "Cancelled", tone: "idle", active: false },
  SUCCEEDED: { label: "Succeeded", tone: "good", active: false },
  FAILED: { label: "Failed", tone: "bad", active: false },
};

/** Label and tone of a state; a state this dashboard does not know is shown under its own name. */
export function stateInfo(state: JobState): StateInfo {
  return (STATES as Partial<Record<string, StateInfo>>)[state] ?? { label: state, tone: "idle", active: false };
}

export const isFinal = (state: JobState) => state === "SUCCEEDED" || state === "FAILED" || state === "CANCELLED";
export const canPause = (state: JobState) => ["QUEUED", "PREPARING", "RUNNING", "INTERRUPTED"].includes(state);
export const canResume = (state: JobState) => state === "PAUSED" || state === "PAUSING";
export const canCancel = (state: JobState) => !isFinal(state) && state !== "CANCELLING";
