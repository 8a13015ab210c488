import type { ReactNode } from "react";
import { Link } from "react-router";
import { useAction, useRobot, useWorld } from "../../api/queries";
import type { CreateJob, EarlierRun, Job, MethodChoice, PlanSpec } from "../../api/types";
import { formatDateTime, formatNumber, humanize } from "../../lib/format";
import { Card, Facts, type Fact } from "../../ui/basics";

/** The request with its defaults filled in: everything needed to reproduce the job. */
export function JobSettings({ job }: { job: Job }) {
  const at = (time: string | null | undefined) => (time == null ? "–" : formatDateTime(Date.parse(time)));
  return (
    <Card title="Settings">
      <Facts
        facts={[
          ...requestFacts(job.request),
          { name: "Submitted", value: at(job.created_at) },
          { name: "Started", value: at(job.started_at) },
          { name: "Ended", value: at(job.finished_at) },
          { name: "Attempt", value: job.attempt },
        ]}
      />
      <p className="small muted" style={{ marginTop: 12 }}>
        <code>{job.id}</code>
      </p>
    </Card>
  );
}

function requestFacts(request: CreateJob): Fact[] {
  switch (request.kind) {
    case "generalization":
      return [
        { name: "Demonstrations", value: request.demonstrations.length },
        { name: "Min. time between goals", value: `${formatNumber(request.t_min_s)} s` },
        { name: "Weighting", value: humanize(request.weighting) },
        { name: "Features", value: request.features?.join(", ") ?? "all" },
      ];
    case "experiment": {
      const { paper_table: table, cells = [], matrix } = request;
      return [
        ...(table == null ? [] : [{ name: "Paper tables", value: String(table) }]),
        ...(cells.length === 0 ? [] : [{ name: "Custom cells", value: cells.length }]),
        ...(matrix == null ? [] : [{ name: "Matrix presets", value: matrix.presets.join(", ") }]),
        { name: "First seed", value: String(request.seed) },
        { name: "Repetitions per cell", value: request.repetitions ?? 1 },
      ];
    }
    case "execution":
      return executionFacts(request);
    default:
      return plainFacts(request);
  }
}

/** The request of a kind this dashboard has no words for. */
function plainFacts(request: object): Fact[] {
  const fields = Object.entries(request).filter(([name, value]) => name !== "kind" && value != null);
  return fields.map(([name, value]) => ({ name: humanize(name), value: JSON.stringify(value) }));
}

function executionFacts(request: Extract<CreateJob, { kind: "execution" }>): Fact[] {
  const { execution, seed, repetitions = 1, earlier_runs: earlier } = request;
  const given: [string, ReactNode][] = [
    ["Action", <ActionLink key="action" id={request.action} />],
    ["Robot", <RobotLink key="robot" id={request.robot} />],
    ["World", <WorldName key="world" id={request.world} />],
    ["Method", methodName(execution.method)],
    ["Reason for the method", execution.chosen?.reason],
    ["Metric", humanize(execution.metric)],
    ["Tolerance", execution.tolerance],
    ["Target discrepancy", execution.target_discrepancy],
    ["Max. evaluations per goal", execution.max_evaluations_per_goal],
    ["Max. evaluations per second", request.max_evaluations_per_s],
    ["Motion", request.planning == null ? null : motion(request.planning)],
    ["Collisions", request.avoid_collisions == null ? null : request.avoid_collisions ? "avoided" : "not checked"],
    ["First seed", seed == null ? null : String(seed)],
    ["Repetitions", repetitions],
    ["Starts with", earlier == null ? null : <EarlierTrials key="earlier" runs={earlier} />],
  ];
  return given.flatMap(([name, value]) => (value == null ? [] : [{ name, value }]));
}

/** The choices for trajectories in a few words. */
function motion({ speed = 0.5, acceleration = 0.5, blend = false, dwell_s: pause = 0.1, timing = "limits" }: PlanSpec): string {
  const percent = (share: number) => `${formatNumber(100 * share)} %`;
  const goals = blend ? "passes through the goals" : `stops ${formatNumber(pause)} s at each goal`;
  const demonstrated = timing === "demonstration" ? ", timing of the demonstrations" : "";
  return `${percent(speed)} speed, ${percent(acceleration)} acceleration, ${goals}${demonstrated}`;
}

function methodName(method: MethodChoice): string {
  if (typeof method === "string") return humanize(method);
  const name = method.name.replace("_", "-").toUpperCase();
  return method.name === "sst" ? `${name}, P ${method.population ?? 50}, S ${method.stagnation ?? 3}` : name;
}

/** Trials taken from earlier runs on the same robot, with links to their jobs. */
function EarlierTrials({ runs }: { runs: EarlierRun[] }) {
  if (runs.length === 0) return <>no earlier trials</>;
  return (
    <ul className="plain">
      {runs.map(({ run, job, trials }) => (
        <li key={run}>
          {trials ?? "all"} trials from {job == null ? "an earlier run" : <Link to={`/jobs/${job}`}>an earlier job</Link>}
        </li>
      ))}
    </ul>
  );
}

function ActionLink({ id }: { id: string }) {
  const action = useAction(id).data;
  return <Link to={`/actions/${id}`}>{action === undefined ? "open" : `${action.name}, version ${action.version}`}</Link>;
}

function RobotLink({ id }: { id: string }) {
  const robot = useRobot(id).data;
  return <Link to={`/robots/${id}`}>{robot === undefined ? "open" : `${robot.name}, version ${robot.version}`}</Link>;
}

function WorldName({ id }: { id: string }) {
  return <>{useWorld(id).data?.name ?? "–"}</>;
}
