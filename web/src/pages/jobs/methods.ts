// The methods a job can be given, in words.

import type { World } from "../../api/types";

export type MethodName = "auto" | "model" | "particle" | "search" | "broyden" | "cma_es" | "sst";

export interface Method {
  name: MethodName;
  label: string;
  /** What it does and when it is the right one. */
  explanation: string;
  /** The only kind of world it works in; any when absent. */
  world?: World["spec"]["kind"];
  /** It decides every trial of the whole run, and each one counts: made for a real robot. */
  few: boolean;
}

export const METHODS: readonly Method[] = [
  {
    name: "auto",
    label: "Automatic",
    explanation: "Chosen for the features, the world and the constraints when the job is submitted, which tells the choice and why.",
    few: false,
  },
  {
    name: "model",
    label: "MODEL-IET",
    explanation:
      "A dozen evaluations. Learns from each trial what the joints do to the features, and tries next the pose it expects nearest to a goal. It knows when a goal is out of reach and says how near it came.",
    world: "tool_position",
    few: true,
  },
  {
    name: "particle",
    label: "PARTICLE-IET",
    explanation:
      "About one evaluation a cell. Takes the described robot as an uncertain simulator: many slightly different robots vote for the next pose, and each trial tells which of them are wrong.",
    world: "coverage",
    few: true,
  },
  {
    name: "search",
    label: "SEARCH-IET",
    explanation:
      "Nothing is known but the percentage seen: it searches where no trial has been near yet, and more where trials gained. Takes some four times as many evaluations as PARTICLE-IET.",
    world: "coverage",
    few: true,
  },
  {
    name: "broyden",
    label: "Broyden",
    explanation: "Gauss-Newton with an estimated Jacobian, a classical yardstick: few evaluations where it converges, with some bad runs.",
    world: "tool_position",
    few: false,
  },
  {
    name: "cma_es",
    label: "CMA-ES",
    explanation: "An evolution strategy, a yardstick known everywhere: hundreds of evaluations, begun at the previous goal's result.",
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

/** The methods that work in a world; all while it is not chosen. */
export function methodsFor(world: World | undefined): readonly Method[] {
  return METHODS.filter((method) => world === undefined || method.world === undefined || method.world === world.spec.kind);
}
