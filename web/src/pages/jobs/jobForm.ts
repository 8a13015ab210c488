// The new-job form as data: its defaults by world, and the request it makes.

import type { CreateJob, Metric, World } from "../../api/types";

export interface JobForm {
  action: string;
  robot: string;
  world: string;
  population: string;
  stagnation: string;
  mutation: string;
  metric: Metric;
  tolerance: string;
  target: string;
  maxEvaluations: string;
  seed: string;
  repetitions: string;
  pace: string;
}

export const EMPTY_FORM: JobForm = {
  action: "",
  robot: "",
  world: "",
  population: "50",
  stagnation: "3",
  mutation: "0.6",
  metric: "multivariate",
  tolerance: "",
  target: "",
  maxEvaluations: "",
  seed: "",
  repetitions: "1",
  pace: "",
};

/** What a world suggests: covering a wall is a stepwise score that small, patient populations climb, and 0 is perfect. */
export function suggested(world: World): Partial<JobForm> {
  if (world.spec.kind === "coverage") return { population: "10", stagnation: "10", target: "0" };
  return { population: "50", stagnation: "3", target: "" };
}

const optional = (text: string) => (text.trim() === "" ? null : Number(text));

/** The request, or null while action, robot or world is not chosen. */
export function requestOf(form: JobForm): CreateJob | null {
  if (form.action === "" || form.robot === "" || form.world === "") return null;
  return {
    kind: "execution",
    action: form.action,
    robot: form.robot,
    world: form.world,
    execution: {
      method: {
        name: "sst",
        population: Number(form.population),
        stagnation: Number(form.stagnation),
        mutation_probability: Number(form.mutation),
      },
      metric: form.metric,
      tolerance: optional(form.tolerance),
      target_discrepancy: optional(form.target),
      max_evaluations_per_goal: optional(form.maxEvaluations),
    },
    seed: optional(form.seed),
    repetitions: Number(form.repetitions),
    max_evaluations_per_s: optional(form.pace),
  };
}
