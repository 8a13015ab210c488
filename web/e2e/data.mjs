// Fills a server through its API: two actions from synthetic demonstrations, a robot, two worlds, jobs.
import { readFileSync } from "node:fs";

const EXAMPLES = new URL("../../examples/", import.meta.url);

/** Where the right arm holds its tool, m, for the genes (rad) shoulder pitch, shoulder roll and elbow pitch. */
function toolPoint(g0, g1, g2) {
  const turn = (angle, u, v) => [u * Math.cos(angle) - v * Math.sin(angle), u * Math.sin(angle) + v * Math.cos(angle)];
  const [a, b] = turn(-Math.PI / 4, 0, 0.00892);
  let [x, y, z] = [a, b, -0.4692];
  [z, x] = turn(-g2, z, x);
  z -= 0.329;
  [y, z] = turn(-g1, y, z);
  [z, x] = turn(-g0, z, x);
  return [x, y - 0.34692, z + 0.7982];
}

/** A loop that the arm can really follow, mm. */
function loopCsv(phase) {
  const rows = ["time_s,x [mm],y [mm],z [mm]"];
  for (let step = 0; step <= 160; step += 1) {
    const angle = (2 * Math.PI * step) / 160;
    const wobble = 0.01 * Math.sin(3 * angle + phase);
    const point = toolPoint(0.6 + 0.4 * Math.sin(angle) + wobble, 0.5 + 0.4 * Math.cos(angle), 1 + 0.3 * Math.sin(angle));
    rows.push([step * 0.1, ...point.map((value) => 1000 * value)].map((value) => value.toFixed(4)).join(","));
  }
  return rows.join("\n");
}

/** A wall painted square by square, %. */
function paintCsv(pace) {
  const rows = ["time_s,painted [%]"];
  for (let step = 0; step < 160; step += 1) rows.push(`${(step * pace).toFixed(3)},${6.25 * (1 + Math.floor(step / 10))}`);
  return rows.join("\n");
}

export async function waitForJob(server, id, done = (job) => ["SUCCEEDED", "FAILED", "CANCELLED"].includes(job.state)) {
  for (let tries = 0; tries < 600; tries += 1) {
    const job = await server.api("GET", `/jobs/${id}`);
    if (done(job)) return job;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`job ${id} did not come to rest within 60 s`);
}

async function upload(server, name, text) {
  const form = new FormData();
  form.set("name", name);
  form.append("files", new Blob([text]), `${name}.csv`);
  return (await server.api("POST", "/demonstrations", form)).id;
}

async function generalize(server, name, demonstrations, tMinS) {
  const job = await server.api("POST", "/jobs", { kind: "generalization", name, demonstrations, t_min_s: tMinS });
  const ended = await waitForJob(server, job.id);
  if (ended.state !== "SUCCEEDED") throw new Error(`generalization failed: ${JSON.stringify(ended.failure)}`);
  return ended.result.action;
}

const WALL = {
  kind: "coverage",
  origin_m: [0.6, -0.8, 0.32],
  column_step_m: [0, 0.2, 0],
  row_step_m: [0, 0, 0.2],
  columns: 4,
  rows: 4,
  radius_m: 0.13,
};

export const sst = (population, stagnation) => ({ name: "sst", population, stagnation });

/** Everything the pages are looked at with; ids by meaning. */
export async function fill(server) {
  const loops = [await upload(server, "loop-1", loopCsv(0)), await upload(server, "loop-2", loopCsv(1.3))];
  const paints = [await upload(server, "paint-1", paintCsv(0.15)), await upload(server, "paint-2", paintCsv(0.16))];
  const loop = await generalize(server, "loop", loops, 1.6);
  const paint = await generalize(server, "paint", paints, 1.5);

  const urdf = readFileSync(new URL("robots/teo_right_arm.urdf", EXAMPLES), "utf8");
  const fixed = { shoulder_yaw: 0, wrist_yaw: -Math.PI / 4, wrist_pitch: 0 };
  const acceleration = { shoulder_pitch: 2, shoulder_roll: 2, elbow_pitch: 2 };
  const robot = (await server.api("POST", "/robots", { name: "teo right arm", urdf, spec: { fixed, acceleration } })).id;
  const space = (await server.api("POST", "/worlds", { name: "tool position", spec: { kind: "tool_position", unit: "mm" } })).id;
  const wall = (await server.api("POST", "/worlds", { name: "wall of 4 x 4", spec: WALL })).id;

  const execution = (change) => ({ kind: "execution", action: loop, robot, world: space, seed: 1, ...change });
  const loopJob = await server.api("POST", "/jobs", execution({ execution: { method: sst(50, 3) } }));
  const paintJob = await server.api("POST", "/jobs", {
    ...execution({ action: paint, world: wall, repetitions: 3 }),
    execution: { method: sst(10, 10), target_discrepancy: 0 },
  });
  const few = { method: { name: "model", noise: 1 }, tolerance: 15, reality: { link_share: 0.05, sensor_noise: 1, lost_share: 0.1 } };
  const fewJob = await server.api("POST", "/jobs", execution({ execution: few, name: "a dozen trials" }));
  const done = [await waitForJob(server, loopJob.id), await waitForJob(server, paintJob.id), await waitForJob(server, fewJob.id)];
  for (const job of done) if (job.state !== "SUCCEEDED") throw new Error(`${job.name}: ${JSON.stringify(job.failure)}`);
  return {
    loop,
    paint,
    robot,
    space,
    wall,
    demonstration: loops[0],
    loopJob: done[0],
    paintJob: done[1],
    fewJob: done[2],
    execution,
  };
}

/** A job slow enough to be watched. */
export function startSlowJob(server, data, perSecond = 150) {
  return server.api("POST", "/jobs", data.execution({ execution: { method: sst(50, 3) }, max_evaluations_per_s: perSecond, name: "slow loop" }));
}
