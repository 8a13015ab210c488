// The new-job form as data: its defaults per world, and the request built from it.

import type { CreateJob, ExecutionSpec, Method, MethodChoice, Metric, PlanSpec, PlanTiming, World } from "../../api/types";
import { requestOf as methodRequest } from "./methods";

export interface JobForm {
  action: string;
  robot: string;
  world: string;
  method: string;
  /** What was filled in of the methods' parameters, by their place: `sst.population`. */
  parameters: Readonly<Record<string, string>>;
  earlier: "found" | "none";
  metric: Metric;
  tolerance: string;
  target: string;
  maxEvaluations: string;
  reality: "described" | "other";
  links: string;
  base: string;
  sensorNoise: string;
  jointNoise: string;
  lost: string;
  realSeed: string;
  seed: string;
  repetitions: string;
  pace: string;
  speed: string;
  acceleration: string;
  goals: "stop" | "pass";
  pause: string;
  timing: PlanTiming;
  collisions: "avoid" | "ignore";
}

/** The fields that hold a text each. */
export type TextKey = Exclude<keyof JobForm, "parameters">;

export const EMPTY_FORM: JobForm = {
  action: "",
  robot: "",
  world: "",
  method: "model",
  parameters: {},
  earlier: "found",
  metric: "multivariate",
  tolerance: "",
  target: "",
  maxEvaluations: "",
  reality: "described",
  links: "5",
  base: "20",
  sensorNoise: "0",
  jointNoise: "0",
  lost: "0",
  realSeed: "",
  seed: "",
  repetitions: "1",
  pace: "",
  speed: "50",
  acceleration: "50",
  goals: "stop",
  pause: "0.1",
  timing: "limits",
  collisions: "avoid",
};

/** Defaults for a world: the method that needs the fewest evaluations there. For SST on a wall the discrepancy changes in
 * steps, which a small population with long stagnation handles best, and 0 is perfect. */
export function suggested(world: World): Partial<JobForm> {
  if (world.spec.kind !== "coverage") return { method: "model", parameters: {}, target: "" };
  return { method: "particle", parameters: { "sst.population": "10", "sst.stagnation": "10" }, target: "0" };
}

const optional = (text: string) => (text.trim() === "" ? null : Number(text));

/** The request, or null until action, robot and world are chosen. */
export function requestOf(form: JobForm, method: Method | undefined): CreateJob | null {
  if (method === undefined || form.action === "" || form.robot === "" || form.world === "") return null;
  return {
    kind: "execution",
    action: form.action,
    robot: form.robot,
    world: form.world,
    execution: {
      method: methodRequest(method, form.parameters) as MethodChoice,
      metric: form.metric,
      tolerance: optional(form.tolerance),
      target_discrepancy: optional(form.target),
      max_evaluations_per_goal: optional(form.maxEvaluations),
      ...realityOf(form),
    },
    seed: optional(form.seed),
    repetitions: Number(form.repetitions),
    max_evaluations_per_s: optional(form.pace),
    planning: planningOf(form),
    avoid_collisions: form.collisions === "avoid",
    ...(method.learns_from_earlier_runs && form.earlier === "none" ? { earlier_runs: [] } : {}),
  };
}

/** The choices for trajectories; the form has percent, the request shares. */
function planningOf(form: JobForm): PlanSpec {
  const blend = form.goals === "pass";
  return {
    speed: Number(form.speed) / 100,
    acceleration: Number(form.acceleration) / 100,
    blend,
    timing: form.timing,
    ...(blend ? {} : { dwell_s: Number(form.pause) }),
  };
}

/** The simulated real robot's deviation from its description; the form has percent and millimetres, the request SI. */
function realityOf(form: JobForm): Pick<ExecutionSpec, "reality"> {
  if (form.reality === "described") return {};
  return {
    reality: {
      link_share: Number(form.links) / 100,
      base_shift_m: Number(form.base) / 1000,
      sensor_noise: Number(form.sensorNoise),
      joint_noise_deg: Number(form.jointNoise),
      lost_share: Number(form.lost) / 100,
      ...(form.realSeed.trim() === "" ? {} : { seed: Number(form.realSeed) }),
    },
  };
}
