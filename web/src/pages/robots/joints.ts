// The joints a person may move: those of the chain with the limits that apply to it, then the robot's others.

import type { Robot } from "../../api/types";

export interface MovableJoint {
  name: string;
  kind: string;
  /** Whether an optimiser moves it. */
  free: boolean;
  /** rad or m; null if unlimited. */
  lower: number | null;
  upper: number | null;
}

const MOVABLE = ["revolute", "continuous", "prismatic"];

/** Free joints first, in gene order; mimic joints are left out. */
export function movableJoints({ chain, summary }: Robot): MovableJoint[] {
  const free = chain.free_joints.map(({ name, kind, lower, upper }) => ({ name, kind, lower, upper, free: true }));
  const taken = new Set(free.map((joint) => joint.name));
  const others = summary.joints.filter((joint) => MOVABLE.includes(joint.kind) && joint.mimics == null && !taken.has(joint.name));
  return [
    ...free,
    ...others.map(({ name, kind, limits }) => ({ name, kind, free: false, lower: limits?.[0] ?? null, upper: limits?.[1] ?? null })),
  ];
}
