import { Link } from "react-router";
import { useActions } from "../../api/queries";
import type { Action } from "../../api/types";
import { formatDateTime, formatDuration, humanize } from "../../lib/format";
import { Card, Empty, PageHead } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { More } from "../../ui/More";

export function ActionsPage() {
  const actions = useActions();
  return (
    <>
      <PageHead title="Actions" lead="What the demonstrations have in common: a sequence of goals.">
        <Link className="button primary" to="/demonstrations">
          Create from demonstrations
        </Link>
      </PageHead>
      <Loaded query={actions}>
        {(data) => (
          <Card flush>
            <ActionTable actions={data.pages.flatMap((page) => page.items)} />
            <More query={actions} />
          </Card>
        )}
      </Loaded>
    </>
  );
}

function ActionTable({ actions }: { actions: Action[] }) {
  if (actions.length === 0) {
    return (
      <Empty title="No actions yet">
        <p className="muted">Choose demonstrations of the same action and generalize them.</p>
      </Empty>
    );
  }
  return (
    <table className="cards">
      <thead>
        <tr>
          <th scope="col">Action</th>
          <th scope="col" className="numeric">Version</th>
          <th scope="col" className="numeric">Goals</th>
          <th scope="col">Features</th>
          <th scope="col" className="numeric">Demonstrations</th>
          <th scope="col">Mean duration</th>
          <th scope="col">Weighting</th>
          <th scope="col">Created</th>
        </tr>
      </thead>
      <tbody>
        {actions.map((action) => (
          <tr key={action.id} className="link">
            <td>
              <Link to={`/actions/${action.id}`}>{action.name}</Link>
            </td>
            <td data-label="Version" className="numeric">{action.version}</td>
            <td data-label="Goals" className="numeric">{action.goals}</td>
            <td data-label="Features">{featureList(action)}</td>
            <td data-label="Demonstrations" className="numeric">{action.demonstrations.length}</td>
            <td data-label="Mean duration">{formatDuration(action.mean_duration_s)}</td>
            <td data-label="Weighting">{humanize(action.weighting)}</td>
            <td data-label="Created" className="nowrap">{formatDateTime(Date.parse(action.created_at))}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function featureList(action: Action): string {
  return action.features.map((feature) => (feature.unit ? `${feature.name} (${feature.unit})` : feature.name)).join(", ");
}
