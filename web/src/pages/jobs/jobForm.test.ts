import { describe, expect, it } from "vitest";
import type { Method, Parameter, World } from "../../api/types";
import { EMPTY_FORM, requestOf, suggested } from "./jobForm";
import { labelOf, methodsFor } from "./methods";

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

const needs: Method["needs"] = { effects: "any", reset: true, simulator: "never" };

function method(name: string, parameters: Parameter[], more: Partial<Method> = {}): Method {
  const plain = { label: name, purpose: "", scope: "per_goal", few_evaluations: false, learns_from_earlier_runs: false } as const;
  return { ...plain, name, needs, parameters, ...more };
}

function parameter(name: string, type: Parameter["type"], more: Partial<Parameter> = {}): Parameter {
  const plain = { purpose: "", unit: null, optional: false, minimum: null, exclusive_minimum: null, maximum: null };
  return { ...plain, name, type, default: 0, options: [], ...more };
}

const sst = method("sst", [parameter("population", "integer"), parameter("stagnation", "integer"), parameter("quirk", "flag")]);
const pso = method("pso", [parameter("swarm.max_velocity", "number", { optional: true }), parameter("swarm.inertia", "number")]);
const model = method(
  "model",
  [parameter("prior", "choice", { options: ["none", "simulator"] }), parameter("max_step_deg", "number", { unit: "degrees" })],
  { learns_from_earlier_runs: true, needs: { effects: "smooth", reset: false, simulator: "optional" } },
);
const particle = method("particle", [], { needs: { effects: "accumulating", reset: false, simulator: "required" } });

describe("methods", () => {
  it("fit a world by what they need of it", () => {
    const names = (world: World) => methodsFor([sst, model, particle], world).map(({ name }) => name);
    expect(names(wall)).toEqual(["sst", "particle"]);
    expect(names({ ...wall, spec: { kind: "tool_position", unit: "mm" } })).toEqual(["sst", "model"]);
    expect(names({ ...wall, spec: { ...wall.spec, resets: false } as World["spec"] })).toEqual(["particle"]);
  });

  it("show the names of their parameters in words, with units", () => {
    expect([...pso.parameters, ...model.parameters].map(labelOf)).toEqual(["Max velocity", "Inertia", "Prior", "Max step (degrees)"]);
  });

  it("send what was filled in, each value in its type", () => {
    const chosen = { ...EMPTY_FORM, action: "a", robot: "r", world: "w" };
    const sent = (of: Method, parameters: Record<string, string>) => requestOf({ ...chosen, parameters }, of);
    const swarm = { "pso.swarm.max_velocity": "", "pso.swarm.inertia": "0.7", "sst.population": "9" };
    expect(sent(pso, swarm)).toHaveProperty("execution.method", { name: "pso", swarm: { max_velocity: null, inertia: 0.7 } });
    expect(sent(sst, { "sst.quirk": "true", "sst.stagnation": "4" })).toHaveProperty("execution.method", { name: "sst", stagnation: 4, quirk: true });
  });
});

describe("requestOf", () => {
  it("waits for action, robot, world and method", () => {
    expect(requestOf({ ...EMPTY_FORM, action: "a", robot: "r" }, model)).toBeNull();
    expect(requestOf({ ...EMPTY_FORM, action: "a", robot: "r", world: "w" }, undefined)).toBeNull();
  });

  it("sends numbers, and null for what was left empty", () => {
    const request = requestOf({ ...EMPTY_FORM, ...suggested(wall), action: "a", robot: "r", world: "w", seed: "7" }, sst);
    expect(request).toMatchObject({
      kind: "execution",
      seed: 7,
      repetitions: 1,
      max_evaluations_per_s: null,
      execution: { method: { name: "sst", population: 10, stagnation: 10 }, target_discrepancy: 0, tolerance: null },
    });
  });

  it("asks for half the limits, and for a pause only where the arm stops", () => {
    const chosen = { ...EMPTY_FORM, action: "a", robot: "r", world: "w" };
    const half = { speed: 0.5, acceleration: 0.5, blend: false, timing: "limits", dwell_s: 0.1 };
    expect(requestOf(chosen, sst)).toHaveProperty("planning", half);
    const passing = requestOf({ ...chosen, speed: "80", goals: "pass", timing: "demonstration" }, sst);
    expect(passing).toHaveProperty("planning", { speed: 0.8, acceleration: 0.5, blend: true, timing: "demonstration" });
  });

  it("avoids collisions unless it is told not to", () => {
    const chosen = { ...EMPTY_FORM, action: "a", robot: "r", world: "w" };
    expect(requestOf(chosen, sst)).toHaveProperty("avoid_collisions", true);
    expect(requestOf({ ...chosen, collisions: "ignore" }, sst)).toHaveProperty("avoid_collisions", false);
  });

  it("suggests the method of fewest evaluations that works in the world", () => {
    expect(suggested(wall).method).toBe("particle");
  });

  it("says what a real robot is like in the interface's units, and what earlier runs are for", () => {
    const chosen = { ...EMPTY_FORM, action: "a", robot: "r", world: "w" };
    expect(requestOf(chosen, model)).not.toHaveProperty("earlier_runs");
    expect(requestOf(chosen, model)).not.toHaveProperty("execution.reality");
    const request = requestOf({ ...chosen, earlier: "none", reality: "other", parameters: { "model.prior": "simulator" }, realSeed: "3" }, model);
    expect(request).toMatchObject({
      earlier_runs: [],
      execution: {
        method: { name: "model", prior: "simulator" },
        reality: { link_share: 0.05, base_shift_m: 0.02, lost_share: 0, seed: 3 },
      },
    });
  });
});
