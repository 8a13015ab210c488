// The trials of a method that decides each one: a dozen points, one a trial, by how far it came from its goal.

import type { TrialProgress } from "../../api/types";
import { Chart } from "../../charts/Chart";
import { formatNumber, formatQuantity } from "../../lib/format";

export function TrialsChart({ trials, unit }: { trials: readonly TrialProgress[]; unit: string }) {
  const last = trials.at(-1);
  if (last === undefined) return <p className="muted">Each trial appears here as a point.</p>;
  const x = trials.map((trial) => trial.index + 1);
  const seen = trials.map((trial) => trial.residual ?? null);
  const lost = seen.filter((residual) => residual === null).length;
  const nearest = trials.map((trial, index) => bestOf(trials.slice(0, index + 1), trial.goal));
  return (
    <>
      <Chart
        summary={`${trials.length} trials; the last one, for goal ${last.goal + 1}, came ${formatNumber(last.residual)} ${unit} near`}
        x={x}
        xLabel="trial"
        yLabel={unit === "" ? "distance from its goal" : `distance from its goal, ${unit}`}
        series={[
          { label: "trial", values: seen, color: "simulated", points: true },
          { label: "best for that goal", values: nearest, color: "curve", stepped: true, width: 1 },
        ]}
      />
      <p className="small muted">
        Trial {last.index + 1} was made for goal {last.goal + 1}:{" "}
        {last.residual == null ? "its observation was lost." : `${formatQuantity(last.residual, unit)} away.`}
        {lost > 0 && ` ${lost} of ${trials.length} observations were lost; each cost a trial.`}
      </p>
    </>
  );
}

/** The smallest distance of a trial made for `goal`; null while none was seen. */
export function bestOf(trials: readonly TrialProgress[], goal: number): number | null {
  const seen = trials.flatMap((trial) => (trial.goal === goal && trial.residual != null ? [trial.residual] : []));
  return seen.length === 0 ? null : Math.min(...seen);
}
