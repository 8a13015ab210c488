import type { Series } from "../../api/types";
import { Chart } from "../../charts/Chart";
import { formatCount } from "../../lib/format";
import { join } from "../../lib/join";
import { Card } from "../../ui/basics";

const COLORS = ["info", "goal", "good", "granule", "warn", "bad", "muted"];

/** One chart per stream and unit: values in different units never share an axis. */
export function StreamCharts({ series }: { series: Series[] }) {
  const groups = Map.groupBy(series, (each) => JSON.stringify([each.stream, each.feature.unit ?? ""]));
  return [...groups.entries()].map(([key, members]) => <Group key={key} members={members} />);
}

function Group({ members }: { members: Series[] }) {
  const [first] = members;
  if (first === undefined) return null;
  const unit = first.feature.unit ?? "";
  const { x, columns } = join(members.map((each) => ({ x: each.t_s, y: each.values })));
  const names = members.map((each) => each.feature.name).join(", ");
  return (
    <Card
      title={first.stream}
      aside={members.some((each) => each.decimated) ? <span className="muted small">thinned for display, extremes kept</span> : null}
    >
      <Chart
        summary={`${names} at ${formatCount(x.length)} points in time`}
        x={x}
        xLabel="time, s"
        yLabel={unit === "" ? names : `${members.length === 1 ? names : "value"}, ${unit}`}
        series={members.map((each, index) => ({
          label: each.feature.name,
          values: columns[index] ?? [],
          color: COLORS[index % COLORS.length] ?? "muted",
          spanGaps: true,
          width: 1.5,
        }))}
        legend={members.length > 1}
      />
    </Card>
  );
}
