// Demonstrations: drop files, read the findings, select some and generalize them into an action.

import { useState } from "react";
import { Link } from "react-router";
import { useDemonstrations } from "../../api/queries";
import type { Demonstration } from "../../api/types";
import { formatCount, formatDateTime, formatDuration } from "../../lib/format";
import { Badge, Card, Empty, PageHead } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { More } from "../../ui/More";
import { Generalize } from "./Generalize";
import { UploadCard } from "./UploadCard";

export function DemonstrationsPage() {
  const demonstrations = useDemonstrations();
  const [chosen, setChosen] = useState<ReadonlySet<string>>(new Set());
  const toggle = (id: string) => {
    const next = new Set(chosen);
    if (!next.delete(id)) next.add(id);
    setChosen(next);
  };
  return (
    <>
      <PageHead title="Demonstrations" lead="Recordings of people performing an action: features of the world over time." />
      <div className="stack">
        <UploadCard />
        <Loaded query={demonstrations}>
          {(data) => {
            const items = data.pages.flatMap((page) => page.items);
            return (
              <>
                {chosen.size > 0 && <Generalize demonstrations={items.filter((item) => chosen.has(item.id))} />}
                <Card title="Stored demonstrations" flush aside={<span className="muted small">Select some to create an action</span>}>
                  <Table demonstrations={items} chosen={chosen} onToggle={toggle} />
                  <More query={demonstrations} />
                </Card>
              </>
            );
          }}
        </Loaded>
      </div>
    </>
  );
}

interface TableProps {
  demonstrations: Demonstration[];
  chosen: ReadonlySet<string>;
  onToggle: (id: string) => void;
}

function Table({ demonstrations, chosen, onToggle }: TableProps) {
  if (demonstrations.length === 0) {
    return (
      <Empty title="No demonstrations yet">
        <p className="muted">Drop files above: CSV with a header and a time column, YARP logs, or canonical JSON.</p>
      </Empty>
    );
  }
  return (
    <table className="cards">
      <thead>
        <tr>
          <th scope="col">Demonstration</th>
          <th scope="col">Features</th>
          <th scope="col" className="numeric">Samples</th>
          <th scope="col">Duration</th>
          <th scope="col">Findings</th>
          <th scope="col">Uploaded</th>
        </tr>
      </thead>
      <tbody>
        {demonstrations.map((item) => (
          <tr key={item.id} className="link">
            <td>
              <span className="check">
                <input
                  type="checkbox"
                  aria-label={`Select ${item.name}`}
                  checked={chosen.has(item.id)}
                  disabled={item.excluded != null}
                  onChange={() => onToggle(item.id)}
                />
                <Link to={`/demonstrations/${item.id}`}>{item.name}</Link>
                {item.excluded != null && <Badge tone="warn">excluded</Badge>}
              </span>
            </td>
            <td data-label="Features">{features(item)}</td>
            <td data-label="Samples" className="numeric">
              {formatCount(item.streams.reduce((sum, stream) => sum + stream.samples, 0))}
            </td>
            <td data-label="Duration" className="nowrap">{formatDuration(item.duration_s)}</td>
            <td data-label="Findings">{item.findings === 0 ? <Badge tone="good">none</Badge> : <Badge tone="warn">{item.findings}</Badge>}</td>
            <td data-label="Uploaded" className="nowrap">{formatDateTime(Date.parse(item.created_at))}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function features(item: Demonstration): string {
  const all = item.streams.flatMap((stream) => stream.features);
  const names = all.map((feature) => (feature.unit ? `${feature.name} (${feature.unit})` : feature.name));
  return names.length > 6 ? `${names.slice(0, 5).join(", ")} and ${names.length - 5} more` : names.join(", ");
}
