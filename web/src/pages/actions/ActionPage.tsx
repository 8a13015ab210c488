// One action: its goals as a table and as one curve per feature.

import { Link, useParams } from "react-router";
import { useAction, useActionGoals, useInterpolation } from "../../api/queries";
import type { Action } from "../../api/types";
import { Chart } from "../../charts/Chart";
import { formatDateTime, formatDuration, formatNumber, humanize } from "../../lib/format";
import { join } from "../../lib/join";
import { Card, Facts, PageHead } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";

const CURVE_POINTS = 400;

export function ActionPage() {
  const { id = "" } = useParams();
  const action = useAction(id);
  return (
    <Loaded query={action}>
      {(data) => (
        <>
          <PageHead title={data.name} lead={`Version ${data.version}`} back={{ to: "/actions", label: "Actions" }}>
            <a className="button" download href={`/api/v1/actions/${data.id}:export?format=csv`}>
              Goals as CSV
            </a>
            <Link className="button primary" to={`/jobs/new?action=${data.id}`}>
              Execute on a robot
            </Link>
          </PageHead>
          <div className="stack">
            <Card>
              <ActionFacts action={data} />
            </Card>
            <Goals action={data} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function ActionFacts({ action }: { action: Action }) {
  return (
    <Facts
      facts={[
        { name: "Goals", value: action.goals },
        { name: "Demonstrations", value: action.demonstrations.length },
        { name: "Mean duration", value: formatDuration(action.mean_duration_s) },
        { name: "Min. time between goals", value: formatDuration(action.t_min_s) },
        { name: "Weighting", value: humanize(action.weighting) },
        { name: "Metric", value: humanize(action.metric) },
        { name: "Created", value: formatDateTime(Date.parse(action.created_at)) },
        { name: "Created by", value: <Link to={`/jobs/${action.job}`}>its job</Link> },
      ]}
    />
  );
}

function Goals({ action }: { action: Action }) {
  const goals = useActionGoals(action.id);
  return (
    <Loaded query={goals}>
      {(data) => (
        <div className="columns">
          <div className="stack">
            {data.features.map((feature, column) => (
              <FeatureCard
                key={feature.name}
                action={action}
                column={column}
                title={feature.unit ? `${feature.name}, ${feature.unit}` : feature.name}
                values={data.goals.map((row) => row[column] ?? null)}
              />
            ))}
          </div>
          <Card title="Goals" flush>
            <div className="table-scroll" role="region" aria-label="Goals" tabIndex={0}>
              <table className="compact">
                <thead>
                  <tr>
                    <th scope="col">Goal</th>
                    {data.features.map((feature) => (
                      <th key={feature.name} scope="col" className="numeric">
                        {feature.name}
                        {feature.unit && `, ${feature.unit}`}
                      </th>
                    ))}
                  </tr>
                </thead>
                <tbody>
                  {data.goals.map((row, index) => (
                    <tr key={index}>
                      <td>{index + 1}</td>
                      {row.map((value, column) => (
                        <td key={column} className="numeric">
                          {formatNumber(value, 6)}
                        </td>
                      ))}
                    </tr>
                  ))}
                </tbody>
              </table>
            </div>
          </Card>
        </div>
      )}
    </Loaded>
  );
}

interface FeatureProps {
  action: Action;
  column: number;
  title: string;
  values: (number | null)[];
}

/** One feature: the goals as points, the radial-basis-function curve through them as a line. */
function FeatureCard({ action, column, title, values }: FeatureProps) {
  const curve = useInterpolation(action.id, CURVE_POINTS);
  const last = Math.max(1, values.length - 1);
  const { x, columns } = join([
    { x: (curve.data?.x ?? []).map((share) => 1 + share * last), y: (curve.data?.values ?? []).map((row) => row[column] ?? null) },
    { x: values.map((_, index) => index + 1), y: values },
  ]);
  return (
    <Card title={title}>
      <Chart
        summary={`Feature ${title} over ${values.length} goals, from ${formatNumber(values[0])} to ${formatNumber(values.at(-1))}`}
        x={x}
        xLabel="goal"
        counted
        yLabel={title}
        series={[
          { label: "curve", values: columns[0] ?? [], color: "curve", spanGaps: true },
          { label: "goals", values: columns[1] ?? [], color: "goal", points: true },
        ]}
        height={220}
        legend={false}
      />
    </Card>
  );
}
