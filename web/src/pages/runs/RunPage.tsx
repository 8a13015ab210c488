// One finished run: key figures, replay of the trajectory, convergence and goals.

import { useParams } from "react-router";
import { useConvergence, useRun, useRunGoals } from "../../api/queries";
import type { Feature, Run, RunGoals } from "../../api/types";
import { Chart } from "../../charts/Chart";
import { formatCount, formatDateTime, formatNumber, formatQuantity, humanize } from "../../lib/format";
import { runVerdict } from "../../lib/verdicts";
import { Card, Facts, PageHead, VerdictBadge } from "../../ui/basics";
import { Loaded, Notice } from "../../ui/feedback";
import { GoalsTable } from "./GoalsTable";
import { Replay } from "./Replay";
import { ProvenanceLegend } from "../../ui/Provenance";

export function RunPage() {
  const { id = "" } = useParams();
  const run = useRun(id);
  const goals = useRunGoals(id);
  return (
    <Loaded query={run}>
      {(data) => (
        <>
          <PageHead title={`Run ${data.repetition + 1}`} back={{ to: `/jobs/${data.job}`, label: "Job" }} badge={<VerdictBadge verdict={runVerdict(data.verdict)} />}>
            <Exports run={data} />
          </PageHead>
          <div className="stack">
            <Card>
              <RunFacts run={data} features={goals.data?.features ?? []} />
            </Card>
            {data.trajectory == null && (
              <Notice tone="warn" title="This run has no trajectory">
                <p>{data.trajectory_problem}</p>
              </Notice>
            )}
            <Loaded query={goals}>{(reached) => <Replay run={data} goals={reached} />}</Loaded>
            <Card title="Discrepancy">
              <ConvergenceChart run={data} goals={goals.data} />
            </Card>
            <Card title="Goals" flush aside={<span className="muted small">goal → observed</span>}>
              <Loaded query={goals}>{(reached) => <GoalsTable goals={reached} />}</Loaded>
            </Card>
          </div>
        </>
      )}
    </Loaded>
  );
}

export function commonUnit(features: readonly Feature[]): string {
  const units = new Set(features.map((feature) => feature.unit ?? ""));
  return units.size === 1 ? ([...units][0] ?? "") : "";
}

/** The number of fitness values of each origin that occurs. */
function counted({ simulated, real, inherited, granule, penalised }: Run["provenance"]) {
  const origins = Object.entries({ simulated, real, inherited, granule, penalised });
  return Object.fromEntries(origins.filter(([, count]) => count > 0).map(([kind, count]) => [kind, formatCount(count)]));
}

function RunFacts({ run, features }: { run: Run; features: readonly Feature[] }) {
  const unit = commonUnit(features);
  const painted = run.painted_percent == null ? [] : [{ name: "Painted", value: formatQuantity(run.painted_percent, "%") }];
  const along = run.replay?.along;
  const estimate = run.estimate == null ? [] : [{ name: "True discrepancy (95 %)", value: <Estimate estimate={run.estimate} unit={unit} /> }];
  return (
    <div className="stack">
      <Facts
        large
        facts={[
          { name: "Evaluations", value: formatCount(run.evaluations) },
          { name: "Discrepancy", value: formatQuantity(run.discrepancy, unit) },
          ...(along == null ? [] : [{ name: "Along the motion", value: formatQuantity(along.discrepancy, unit) }]),
          ...estimate,
          ...painted,
          { name: "Goals reached", value: run.verdict == null ? `– of ${run.goals}` : `${run.verdict.reached} of ${run.goals}` },
        ]}
      />
      <Facts
        facts={[
          { name: "Method", value: run.method.toUpperCase() },
          { name: "Metric", value: humanize(run.metric) },
          { name: "Seed", value: String(run.seed) },
          ...replayFacts(run, unit),
          { name: "Ended", value: formatDateTime(Date.parse(run.created_at)) },
          { name: "Digest of the result", value: <code title={run.digest}>{run.digest.slice(0, 16)}…</code> },
        ]}
      />
      <ProvenanceLegend counts={counted(run.provenance)} />
    </div>
  );
}

/** What the motion did when it was executed once more in simulation. */
function replayFacts({ replay }: Run, unit: string) {
  if (replay == null) return [];
  const { agrees, along, discrepancy } = replay;
  const shown = agrees ? `as claimed: ${formatQuantity(discrepancy, unit)}` : "differs from what the run claims";
  const swept = along?.painted_percent == null ? [] : [{ name: "Painted if never lifted", value: formatQuantity(along.painted_percent, "%") }];
  return [{ name: "Replayed", value: shown }, ...swept];
}

/** Estimate with its interval: the observed discrepancy contains noise, this one does not. */
function Estimate({ estimate, unit }: { estimate: NonNullable<Run["estimate"]>; unit: string }) {
  return (
    <>
      {formatQuantity(estimate.value, unit)}{" "}
      <span className="muted small">
        {formatNumber(estimate.lower)} to {formatNumber(estimate.upper)}
      </span>
    </>
  );
}

function Exports({ run }: { run: Run }) {
  if (run.trajectory == null) return null;
  const formats = [
    { format: "csv", label: "CSV" },
    { format: "json", label: "JSON" },
    { format: "ros2", label: "ROS 2" },
  ];
  return (
    <span className="row" role="group" aria-label="Download the trajectory">
      <span className="muted small">Trajectory as</span>
      {formats.map(({ format, label }) => (
        <a key={format} className="button small" download href={`/api/v1/trajectories/${run.trajectory}:export?format=${format}`}>
          {label}
        </a>
      ))}
    </span>
  );
}

function ConvergenceChart({ run, goals }: { run: Run; goals: RunGoals | undefined }) {
  const convergence = useConvergence(run.id);
  const unit = commonUnit(goals?.features ?? []);
  const ends = goals?.goals.map((_, index, all) => all.slice(0, index + 1).reduce((sum, goal) => sum + goal.evaluations, 0));
  return (
    <Loaded query={convergence}>
      {({ points }) => (
        <Chart
          summary={`Best discrepancy over ${formatCount(run.evaluations)} evaluations; final value ${formatNumber(run.discrepancy)} ${unit}`}
          x={points.map((point) => point.evaluations)}
          xLabel="evaluations"
          counted
          yLabel={unit === "" ? "discrepancy" : `discrepancy, ${unit}`}
          series={[{ label: "best discrepancy", values: points.map((point) => point.discrepancy), color: "simulated", stepped: true }]}
          marks={ends ?? []}
          legend={false}
          height={280}
        />
      )}
    </Loaded>
  );
}
