// Figures, curves and goal ladder of an execution, during and after the run.

import { Chart } from "../../charts/Chart";
import type { GoalProgress, Job, JobProgress, JobState, TrialProgress } from "../../api/types";
import { formatCount, formatDuration, formatNumber, formatPercent, formatQuantity } from "../../lib/format";
import { isFinal } from "../../lib/states";
import { countVerdicts } from "../../lib/verdicts";
import type { LiveJob } from "../../live/jobLive";
import { Card, Facts, ProgressBar, type Fact } from "../../ui/basics";
import { ProvenanceLegend } from "../../ui/Provenance";
import { useNow } from "../../ui/useNow";
import { GoalLadder } from "./GoalLadder";
import { TrialsChart } from "./Trials";

interface Props {
  job: Job;
  live: LiveJob;
  state: JobState;
  unit: string;
}

export function ExecutionLive({ job, live, state, unit }: Props) {
  const progress = newest(job.progress, live.progress);
  const sameRun = live.goals.length >= progress.finished_goals.length;
  const goals = sameRun && live.goals.length > 0 ? live.goals : progress.finished_goals;
  const searching = !isFinal(state) && goals.length < progress.goals;
  const active = searching
    ? { index: progress.goal_index, evaluations: progress.goal_evaluations, discrepancy: progress.discrepancy }
    : null;
  const kept = progress.trials;
  const tolerance = job.request.kind === "execution" ? (job.request.execution.tolerance ?? null) : null;
  const trials = live.trials.length >= kept.length ? live.trials : kept;
  const cumulative = goals.map((_, index) => goals.slice(0, index + 1).reduce((sum, goal) => sum + goal.evaluations, 0));
  return (
    <>
      <Card>
        <Summary job={job} progress={progress} goals={goals} trials={trials} state={state} unit={unit} />
      </Card>
      <div className="columns">
        {trials.length > 0 ? (
          <Card title="Trials" aside={<RunLabel progress={progress} />}>
            <TrialsChart trials={trials} tolerance={tolerance} unit={unit} />
          </Card>
        ) : (
        <div className="stack">
          <Card title="Discrepancy" aside={<RunLabel progress={progress} />}>
            <DiscrepancyChart live={live} unit={unit} boundaries={cumulative} />
            <ProvenanceLegend counts={{ simulated: formatCount(progress.total_evaluations) }} />
          </Card>
          <Card title="Cumulative evaluations by goal" aside={<RunLabel progress={progress} />}>
            <CumulativeChart cumulative={cumulative} goals={progress.goals} />
          </Card>
        </div>
        )}
        <Card title="Goals" aside={<RunLabel progress={progress} />}>
          <GoalLadder goals={progress.goals} finished={goals} active={active} trials={trials} unit={unit} />
        </Card>
      </div>
    </>
  );
}

/** The newer of two progress reports: progress never decreases, so the larger one wins. */
function newest(fetched: JobProgress, streamed: JobProgress | null): JobProgress {
  return streamed !== null && streamed.total_evaluations >= fetched.total_evaluations && fetched.fraction < 1 ? streamed : fetched;
}

function RunLabel({ progress }: { progress: JobProgress }) {
  if (progress.repetitions <= 1) return null;
  const run = Math.min(progress.repetition + 1, progress.repetitions);
  return (
    <span className="muted small">
      run {run} of {progress.repetitions}
    </span>
  );
}

interface SummaryProps {
  job: Job;
  progress: JobProgress;
  goals: readonly GoalProgress[];
  trials: readonly TrialProgress[];
  state: JobState;
  unit: string;
}

/** Number of goals that the server calls reached, and of those missed. */
function goalsFact({ progress, goals, trials }: Pick<SummaryProps, "progress" | "goals" | "trials">): Fact {
  if (trials.length > 0 && goals.length === 0) {
    return { name: "Goals tried", value: `${new Set(trials.map((trial) => trial.goal)).size} of ${progress.goals}` };
  }
  const { reached, stopped_short, out_of_reach } = countVerdicts(goals);
  const missed = [
    ...(stopped_short > 0 ? [`${stopped_short} stopped short`] : []),
    ...(out_of_reach > 0 ? [`${out_of_reach} out of reach`] : []),
  ];
  const value = [`${reached} of ${progress.goals}`, ...missed].join(", ");
  return { name: "Goals reached", value: progress.goals === 0 ? "–" : value };
}

function Summary({ job, progress, goals, trials, state, unit }: SummaryProps) {
  const now = useNow();
  const started = job.started_at == null ? null : Date.parse(job.started_at);
  const ended = job.finished_at == null ? now : Date.parse(job.finished_at);
  const elapsedS = started === null ? null : Math.max(0, (ended - started) / 1000);
  // A method that reports trials switches between goals, so its remaining time cannot be extrapolated.
  const running = trials.length === 0 && state === "RUNNING" && progress.fraction > 0.02 && elapsedS !== null;
  const leftS = running ? (elapsedS * (1 - progress.fraction)) / progress.fraction : null;
  return (
    <div className="stack">
      <Facts
        large
        facts={[
          goalsFact({ progress, goals, trials }),
          { name: "Evaluations", value: formatCount(progress.total_evaluations) },
          { name: "Best discrepancy", value: formatQuantity(progress.discrepancy, unit) },
          { name: isFinal(state) ? "Ran for" : "Running for", value: formatDuration(elapsedS) },
          { name: leftS === null ? "Progress" : "Time left (est.)", value: leftS === null ? formatPercent(progress.fraction) : formatDuration(leftS) },
        ]}
      />
      <ProgressBar share={progress.fraction} label="Progress of the job" />
    </div>
  );
}

function DiscrepancyChart({ live, unit, boundaries }: { live: LiveJob; unit: string; boundaries: number[] }) {
  const { evaluations, discrepancy } = live.curve;
  if (evaluations.length < 2) return <p className="muted">The curve appears after the first evaluations.</p>;
  const last = discrepancy.at(-1);
  return (
    <Chart
      summary={`Best discrepancy after ${formatCount(evaluations.at(-1))} evaluations: ${formatNumber(last)} ${unit}`}
      x={evaluations}
      xLabel="evaluations"
      counted
      yLabel={unit === "" ? "discrepancy" : `discrepancy, ${unit}`}
      series={[{ label: "best discrepancy", values: discrepancy, color: "simulated", stepped: true }]}
      marks={boundaries}
      legend={false}
    />
  );
}

function CumulativeChart({ cumulative, goals }: { cumulative: number[]; goals: number }) {
  if (cumulative.length === 0) return <p className="muted">The curve appears when the first goal has ended.</p>;
  return (
    <Chart
      summary={`${formatCount(cumulative.at(-1))} evaluations for ${cumulative.length} of ${goals} goals`}
      x={[0, ...cumulative.map((_, index) => index + 1)]}
      xLabel="goals ended"
      counted
      yLabel="evaluations"
      series={[{ label: "evaluations", values: [0, ...cumulative], color: "curve" }]}
      legend={false}
      height={200}
    />
  );
}
