// The methods that a job can use, described for people.

import type { World } from "../../api/types";

export type MethodName = "auto" | "model" | "particle" | "search" | "broyden" | "cma_es" | "sst";

export interface Method {
  name: MethodName;
  label: string;
  /** Purpose, and when to use it. */
  explanation: string;
  /** The only kind of world it works in; any if absent. */
  world?: World["spec"]["kind"];
  /** Whether it needs few evaluations, because it decides every trial of the whole run: made for a real robot. */
  few: boolean;
}

export const METHODS: readonly Method[] = [
  {
    name: "auto",
    label: "Automatic",
    explanation: "Chosen for the features, the world and the constraints when the job is submitted; the choice and its reason are recorded.",
    few: false,
  },
  {
    name: "model",
    label: "MODEL-IET",
    explanation:
      "A dozen evaluations. Learns from each trial how the joints affect the features, then tries the pose expected closest to a goal. A goal out of reach is reported with its best residual.",
    world: "tool_position",
    few: true,
  },
  {
    name: "particle",
    label: "PARTICLE-IET",
    explanation:
      "About one evaluation per cell. Uses the described robot as an uncertain simulator: many slightly different robots vote for the next pose, and each trial reweights them.",
    world: "coverage",
    few: true,
  },
  {
    name: "search",
    label: "SEARCH-IET",
    explanation:
      "Needs no description of the robot: searches where no trial has been close yet, preferably near trials that gained something. Takes about four times as many evaluations as PARTICLE-IET.",
    world: "coverage",
    few: true,
  },
  {
    name: "broyden",
    label: "Broyden",
    explanation: "Gauss-Newton with an estimated Jacobian, a classical baseline: few evaluations if it converges, with some bad runs.",
    world: "tool_position",
    few: false,
  },
  {
    name: "cma_es",
    label: "CMA-ES",
    explanation: "An evolution strategy and standard baseline: hundreds of evaluations, starting from the previous goal's result.",
    few: false,
  },
  {
    name: "sst",
    label: "SST",
    explanation: "The paper's steady-state tournament: thousands of evaluations, for simulation.",
    few: false,
  },
];

export function methodNamed(name: MethodName): Method | undefined {
  return METHODS.find((method) => method.name === name);
}

/** The methods that work in a world; all of them until one is chosen. */
export function methodsFor(world: World | undefined): readonly Method[] {
  if (world === undefined) return METHODS;
  const covers = world.spec.kind === "coverage";
  return METHODS.filter((method) => method.world === undefined || (method.world === "coverage") === covers);
}
