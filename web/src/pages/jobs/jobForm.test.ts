import { describe, expect, it } from "vitest";
import type { World } from "../../api/types";
import { EMPTY_FORM, requestOf, suggested } from "./jobForm";
import { methodsFor } from "./methods";

const wall: World = {
  id: "world_1",
  name: "wall",
  created_at: "2026-01-01T00:00:00.000Z",
  features: [{ name: "painted", unit: "%" }],
  spec: {
    kind: "coverage",
    origin_m: [0.6, -0.8, 0.32],
    column_step_m: [0, 0.2, 0],
    row_step_m: [0, 0, 0.2],
    columns: 4,
    rows: 4,
    radius_m: 0.13,
  },
};

describe("requestOf", () => {
  it("waits for action, robot and world", () => {
    expect(requestOf({ ...EMPTY_FORM, action: "a", robot: "r" })).toBeNull();
  });

  it("sends numbers, and null for what was left empty", () => {
    const request = requestOf({ ...EMPTY_FORM, ...suggested(wall), method: "sst", action: "a", robot: "r", world: "w", seed: "7" });
    expect(request).toMatchObject({
      kind: "execution",
      seed: 7,
      repetitions: 1,
      max_evaluations_per_s: null,
      execution: { method: { name: "sst", population: 10, stagnation: 10 }, target_discrepancy: 0, tolerance: null },
    });
  });

  it("suggests the method of fewest evaluations that works in the world", () => {
    expect(suggested(wall).method).toBe("particle");
    expect(methodsFor(wall).map((method) => method.name)).not.toContain("model");
  });

  it("says what a real robot is like in the interface's units, and what earlier runs are for", () => {
    const chosen = { ...EMPTY_FORM, action: "a", robot: "r", world: "w" };
    expect(requestOf(chosen)).not.toHaveProperty("earlier_runs");
    expect(requestOf(chosen)).not.toHaveProperty("execution.reality");
    const request = requestOf({ ...chosen, earlier: "none", reality: "other", prior: "simulator", realSeed: "3" });
    expect(request).toMatchObject({
      earlier_runs: [],
      execution: {
        method: { name: "model", prior: "simulator", noise: 0 },
        reality: { link_share: 0.05, base_shift_m: 0.02, lost_share: 0, seed: 3 },
      },
    });
  });
});
