import { Link } from "react-router";
import { useRobots, useWorlds } from "../../api/queries";
import type { Robot, World } from "../../api/types";
import { formatDateTime, formatNumber, humanize } from "../../lib/format";
import { Card, Empty, PageHead } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { More } from "../../ui/More";
import { movableJoints } from "./joints";
import { NewRobot } from "./NewRobot";

export function RobotsPage() {
  const robots = useRobots();
  const worlds = useWorlds();
  return (
    <>
      <PageHead title="Robots" lead="Robots that execute actions, and the worlds they act in. Every version is immutable." />
      <div className="stack">
        <Loaded query={robots}>
          {(data) => (
            <Card title="Robots" flush>
              <RobotTable robots={data.pages.flatMap((page) => page.items)} />
              <More query={robots} />
            </Card>
          )}
        </Loaded>
        <Loaded query={worlds}>
          {(data) => (
            <Card title="Worlds" flush>
              <WorldTable worlds={data.pages.flatMap((page) => page.items)} />
              <More query={worlds} />
            </Card>
          )}
        </Loaded>
        <NewRobot />
      </div>
    </>
  );
}

function RobotTable({ robots }: { robots: Robot[] }) {
  if (robots.length === 0) {
    return (
      <Empty title="No robots yet">
        <p className="muted">Add one below from its URDF.</p>
      </Empty>
    );
  }
  return (
    <table className="cards">
      <thead>
        <tr>
          <th scope="col">Robot</th>
          <th scope="col" className="numeric">Version</th>
          <th scope="col">Chain</th>
          <th scope="col" className="numeric">Free joints</th>
          <th scope="col">Added</th>
        </tr>
      </thead>
      <tbody>
        {robots.map((robot) => (
          <tr key={robot.id} className="link">
            <td>
              <Link to={`/robots/${robot.id}`}>{robot.name}</Link>
            </td>
            <td data-label="Version" className="numeric">{robot.version}</td>
            <td data-label="Chain">
              {robot.chain.base_link} → {robot.chain.tip_link}
            </td>
            <td data-label="Free joints" className="numeric">
              {robot.chain.free_joints.length} of {movableJoints(robot).length}
            </td>
            <td data-label="Added" className="nowrap">{formatDateTime(Date.parse(robot.created_at))}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function WorldTable({ worlds }: { worlds: World[] }) {
  if (worlds.length === 0) {
    return (
      <Empty title="No worlds yet">
        <p className="muted">
          Add worlds through the API: <code>POST /api/v1/worlds</code>.
        </p>
      </Empty>
    );
  }
  return (
    <table className="cards">
      <thead>
        <tr>
          <th scope="col">World</th>
          <th scope="col">Kind</th>
          <th scope="col">Observes</th>
          <th scope="col">Details</th>
        </tr>
      </thead>
      <tbody>
        {worlds.map((world) => (
          <tr key={world.id}>
            <td>{world.name}</td>
            <td data-label="Kind">{humanize(world.spec.kind)}</td>
            <td data-label="Observes">
              {world.features.map((feature) => (feature.unit ? `${feature.name} (${feature.unit})` : feature.name)).join(", ")}
            </td>
            <td data-label="Details">{details(world)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function details({ spec }: World): string {
  if (spec.kind !== "coverage") return "no surface";
  return `${spec.columns} × ${spec.rows} cells, reach ${formatNumber(spec.radius_m)} m`;
}
