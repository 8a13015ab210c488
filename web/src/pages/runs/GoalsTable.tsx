import type { RunGoals } from "../../api/types";
import { formatCount, formatNumber, humanize } from "../../lib/format";
import { goalVerdict } from "../../lib/verdicts";
import { VerdictBadge } from "../../ui/basics";

/** Goal and observation, side by side for each goal. */
export function GoalsTable({ goals: { features, goals } }: { goals: RunGoals }) {
  return (
    <div className="table-scroll" role="region" aria-label="Goals and observations" tabIndex={0}>
      <table className="compact">
        <thead>
          <tr>
            <th scope="col">Goal</th>
            {features.map((feature) => (
              <th key={feature.name} scope="col" className="numeric">
                {feature.name}
                {feature.unit && `, ${feature.unit}`}
              </th>
            ))}
            <th scope="col" className="numeric">Distance (tolerance)</th>
            <th scope="col" className="numeric">Discrepancy</th>
            <th scope="col" className="numeric">Evaluations</th>
            <th scope="col">Verdict</th>
            <th scope="col">Ended by</th>
          </tr>
        </thead>
        <tbody>
          {goals.map((goal) => (
            <tr key={goal.index}>
              <td>{goal.index + 1}</td>
              {features.map((feature, column) => (
                <td key={feature.name} className="numeric">
                  {formatNumber(goal.goal[column])} <span className="muted">→</span> {formatNumber(goal.observation[column])}
                </td>
              ))}
              <td className="numeric">
                {formatNumber(goal.residual)} <span className="muted">({formatNumber(goal.judgement?.tolerance)})</span>
              </td>
              <td className="numeric">{formatNumber(goal.discrepancy)}</td>
              <td className="numeric">{formatCount(goal.evaluations)}</td>
              <td className="nowrap">
                <VerdictBadge verdict={goalVerdict(goal.judgement)} />
              </td>
              <td className="nowrap">{humanize(goal.stop_reason)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
