import type { Robot } from "../api/types";
import type { Mounting } from "./robot";

/** Extracts the part of a robot's description that the 3-D view needs. */
export function mountingOf(robot: Robot): Mounting {
  const { spec, chain } = robot;
  const [x = 0, y = 0, z = 0] = spec.tool_offset_m ?? [];
  return {
    baseLink: chain.base_link,
    tipLink: chain.tip_link,
    toolOffset: [x, y, z],
    fixed: chain.fixed_joints,
  };
}
