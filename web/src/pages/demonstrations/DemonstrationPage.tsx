// One demonstration: the reader's findings, its streams, and its exclusion.

import { useState, type SyntheticEvent } from "react";
import { useParams } from "react-router";
import { usePatchDemonstration } from "../../api/mutations";
import { useDemonstration, useReport, useSamples } from "../../api/queries";
import type { Demonstration, Finding } from "../../api/types";
import { formatCount, formatDateTime, formatDuration, formatNumber, humanize } from "../../lib/format";
import { Badge, Card, Facts, PageHead } from "../../ui/basics";
import { Loaded, Problem } from "../../ui/feedback";
import { StreamCharts } from "./StreamCharts";

export function DemonstrationPage() {
  const { id = "" } = useParams();
  const demonstration = useDemonstration(id);
  const samples = useSamples(id);
  return (
    <Loaded query={demonstration}>
      {(data) => (
        <>
          <PageHead
            title={data.name}
            back={{ to: "/demonstrations", label: "Demonstrations" }}
            badge={data.excluded != null && <Badge tone="warn">excluded: {data.excluded}</Badge>}
          />
          <div className="stack">
            <Card>
              <Facts
                facts={[
                  { name: "Duration", value: formatDuration(data.duration_s) },
                  { name: "Streams", value: data.streams.length },
                  { name: "Samples", value: formatCount(data.streams.reduce((sum, stream) => sum + stream.samples, 0)) },
                  { name: "Uploaded", value: formatDateTime(Date.parse(data.created_at)) },
                  { name: "SHA-256", value: <code title={data.sha256}>{data.sha256.slice(0, 16)}…</code> },
                ]}
              />
            </Card>
            <Findings demonstration={data} />
            <Loaded query={samples}>{(view) => <StreamCharts series={view.series} />}</Loaded>
            <Exclusion demonstration={data} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function Findings({ demonstration }: { demonstration: Demonstration }) {
  const report = useReport(demonstration.id);
  return (
    <Card title="Findings">
      <Loaded query={report}>
        {({ findings }) =>
          findings.length === 0 ? (
            <p className="muted">The reader found nothing to report.</p>
          ) : (
            <ul className="stack" style={{ listStyle: "none", padding: 0 }}>
              {findings.map((finding, index) => (
                <li key={index} className={`notice ${finding.severity === "error" ? "tone-bad" : "tone-warn"}`}>
                  <strong>{humanize(finding.code)}</strong> <span className="muted small">{placeOf(finding)}</span>
                  <p>{finding.message}</p>
                  <p>
                    <b>Remedy:</b> {finding.remedy}
                  </p>
                </li>
              ))}
            </ul>
          )
        }
      </Loaded>
    </Card>
  );
}

/** Stream, row, column and time, as far as the finding has them. */
function placeOf({ stream, row, column, time_s: timeS }: Finding): string {
  const parts = [
    stream,
    row == null ? null : `row ${row}`,
    column == null ? null : `column ${column}`,
    timeS == null ? null : `at ${formatNumber(timeS)} s`,
  ];
  return parts.filter((part) => part != null).join(", ");
}

/** Excludes the demonstration from new actions, with a reason, or includes it again. */
function Exclusion({ demonstration: { id, revision, excluded } }: { demonstration: Demonstration }) {
  const patch = usePatchDemonstration(id);
  const [reason, setReason] = useState("");
  const submit = (event: SyntheticEvent) => {
    event.preventDefault();
    patch.mutate({ excluded: excluded == null ? reason.trim() : "", revision });
  };
  return (
    <Card title={excluded == null ? "Exclude" : "Include again"}>
      <form className="row" onSubmit={submit}>
        {excluded == null && (
          <input
            aria-label="Reason for excluding it from new actions"
            placeholder="Reason, for example: the object slipped"
            required
            style={{ flex: "1 1 260px", width: "auto" }}
            value={reason}
            onChange={(event) => setReason(event.currentTarget.value)}
          />
        )}
        <button type="submit" className="button" disabled={patch.isPending}>
          {excluded == null ? "Exclude from new actions" : "Include in new actions"}
        </button>
      </form>
      {patch.error && <Problem error={patch.error} />}
    </Card>
  );
}
