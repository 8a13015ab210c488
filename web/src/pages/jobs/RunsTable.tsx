import { Link } from "react-router";
import { useRuns } from "../../api/queries";
import type { Job, Run } from "../../api/types";
import { formatCount, formatQuantity } from "../../lib/format";
import { isFinal } from "../../lib/states";
import { Card } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { More } from "../../ui/More";

/** Finished repetitions, each with a link to its replay. */
export function RunsTable({ job, unit, finishedRuns }: { job: Job; unit: string; finishedRuns: number }) {
  const runs = useRuns(job.id, finishedRuns > 0 || job.result.runs.length > 0 || isFinal(job.state));
  if (!runs.isEnabled) return null;
  return (
    <Card title="Runs" flush>
      <Loaded query={runs}>
        {(data) => {
          const items = data.pages.flatMap((page) => page.items);
          if (items.length === 0) return <p className="muted" style={{ padding: "8px 20px 18px" }}>No run has finished.</p>;
          return <Table runs={items} unit={unit} />;
        }}
      </Loaded>
      <More query={runs} />
    </Card>
  );
}

function Table({ runs, unit }: { runs: Run[]; unit: string }) {
  const coverage = runs.some((run) => run.painted_percent != null);
  return (
    <table className="cards compact">
      <thead>
        <tr>
          <th scope="col">Run</th>
          <th scope="col" className="numeric">Seed</th>
          <th scope="col" className="numeric">Evaluations</th>
          <th scope="col" className="numeric">Discrepancy</th>
          {coverage && <th scope="col" className="numeric">Painted</th>}
          <th scope="col">Digest</th>
          <th scope="col"><span className="hidden-visually">Replay</span></th>
        </tr>
      </thead>
      <tbody>
        {runs.map((run) => (
          <tr key={run.id} className="link">
            <td>
              <Link to={`/runs/${run.id}`}>Run {run.repetition + 1}</Link>
            </td>
            <td data-label="Seed" className="numeric">{String(run.seed)}</td>
            <td data-label="Evaluations" className="numeric">{formatCount(run.evaluations)}</td>
            <td data-label="Discrepancy" className="numeric">{formatQuantity(run.discrepancy, unit)}</td>
            {coverage && <td data-label="Painted" className="numeric">{formatQuantity(run.painted_percent, "%")}</td>}
            <td data-label="Digest"><code title={run.digest}>{run.digest.slice(0, 12)}</code></td>
            <td className="numeric">
              <Link className="button small" to={`/runs/${run.id}`}>Replay in 3-D</Link>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
