// An experiment's table over the runs finished so far, refreshed while the job runs.

import { useExperimentTable } from "../../api/queries";
import type { ExperimentTable, Job, JobState } from "../../api/types";
import { formatCount, formatNumber } from "../../lib/format";
import { isFinal } from "../../lib/states";
import { Card, ProgressBar } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";

type Summary = ExperimentTable["cells"][number]["evaluations"];

export function ExperimentResult({ job, state }: { job: Job; state: JobState }) {
  const table = useExperimentTable(job.result.experiment ?? "", isFinal(state));
  return <Loaded query={table}>{(data) => <Result table={data} />}</Loaded>;
}

function Result({ table }: { table: ExperimentTable }) {
  const share = table.finished_runs / Math.max(table.runs, 1);
  const exportFile = (format: string) => `/api/v1/experiments/${table.experiment}:export?format=${format}`;
  return (
    <Card title="Table" aside={`${formatCount(table.finished_runs)} of ${formatCount(table.runs)} runs`} flush>
      <div style={{ padding: "0 20px 12px" }}>
        <ProgressBar share={share} label="Finished runs" />
      </div>
      <Cells cells={table.cells} />
      <div className="row" style={{ padding: "12px 20px 18px" }}>
        <a className="button small" href={exportFile("csv")} download>CSV</a>
        <a className="button small" href={exportFile("markdown")} download>Markdown</a>
      </div>
    </Card>
  );
}

function Cells({ cells }: { cells: ExperimentTable["cells"] }) {
  return (
    <table className="cards compact">
      <thead>
        <tr>
          <th scope="col">Table</th>
          <th scope="col">Action</th>
          <th scope="col">Setting</th>
          <th scope="col" className="numeric">Runs</th>
          <th scope="col" className="numeric">Evaluations</th>
          <th scope="col" className="numeric">Discrepancy</th>
          <th scope="col" className="numeric">Painted %</th>
          <th scope="col" className="numeric">Invalid</th>
        </tr>
      </thead>
      <tbody>
        {cells.map((cell) => (
          <tr key={`${cell.table} ${cell.action} ${cell.setting}`}>
            <td>{cell.table}</td>
            <td data-label="Action">{cell.action}</td>
            <td data-label="Setting">{cell.setting}</td>
            <td data-label="Runs" className="numeric">{formatCount(cell.repetitions)}</td>
            <td data-label="Evaluations" className="numeric">{spread(cell.evaluations)}</td>
            <td data-label="Discrepancy" className="numeric">{spread(cell.discrepancy)}</td>
            <td data-label="Painted %" className="numeric">{spread(cell.painted)}</td>
            <td data-label="Invalid" className="numeric">{formatCount(cell.invalid)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** Mean and standard deviation. */
function spread(summary: Summary): string {
  if (summary == null) return "–";
  return summary.sd == null ? formatNumber(summary.mean) : `${formatNumber(summary.mean)} ± ${formatNumber(summary.sd)}`;
}
