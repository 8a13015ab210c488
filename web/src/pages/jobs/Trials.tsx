// The trials of a few-evaluation method, one point per trial: its distance from the goal it was made for.

import type { TrialProgress } from "../../api/types";
import { Chart } from "../../charts/Chart";
import { formatNumber, formatQuantity } from "../../lib/format";

/** Ratio of the largest to the smallest distance above which the axis is logarithmic. */
const WIDE = 30;

interface Props {
  trials: readonly TrialProgress[];
  /** Distance at which a goal counts as reached; null if the request has none. */
  tolerance: number | null;
  unit: string;
}

export function TrialsChart({ trials, tolerance, unit }: Props) {
  const last = trials.at(-1);
  if (last === undefined) return <p className="muted">Each trial appears here as a point.</p>;
  const away = trials.map((trial) => trial.residual);
  const seen = away.filter((residual) => residual !== null);
  const lost = away.length - seen.length;
  const within = tolerance === null ? [] : [{ label: "tolerance", values: trials.map(() => tolerance), color: "curve", dashed: true, width: 1 }];
  return (
    <>
      <Chart
        summary={`${trials.length} trials; the last one, for goal ${last.goal + 1}, ended ${formatNumber(last.residual)} ${unit} from it`}
        x={trials.map((trial) => trial.index + 1)}
        xLabel="trial"
        counted
        yLabel={unit === "" ? "distance from goal" : `distance from goal, ${unit}`}
        series={[{ label: "trial", values: away, color: "simulated", points: true }, ...within]}
        legend={false}
        logarithmic={seen.length > 1 && Math.min(...seen) > 0 && Math.max(...seen) > WIDE * Math.min(...seen)}
        height={300}
      />
      <p className="small muted">
        Trial {last.index + 1} was made for goal {last.goal + 1}:{" "}
        {last.residual == null ? "its observation was lost." : `${formatQuantity(last.residual, unit)} away.`}
        {tolerance !== null && ` The dashed line is the tolerance, ${formatQuantity(tolerance, unit)}.`}
        {lost > 0 && ` ${lost} of ${trials.length} observations were lost; each still counts as a trial.`}
      </p>
    </>
  );
}

/** The smallest distance among the trials made for `goal`; null if none was observed. */
export function bestOf(trials: readonly TrialProgress[], goal: number): number | null {
  const seen = trials.flatMap((trial) => (trial.goal === goal && trial.residual != null ? [trial.residual] : []));
  return seen.length === 0 ? null : Math.min(...seen);
}
