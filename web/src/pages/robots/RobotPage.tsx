// One robot: a 3-D view that sliders pose within the joint limits, and facts about its chain.

import { useMemo, useState } from "react";
import { useParams } from "react-router";
import { useRobot, useUrdf } from "../../api/queries";
import type { Robot } from "../../api/types";
import { formatDateTime, formatNumber } from "../../lib/format";
import { Card, Facts, PageHead } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { mountingOf } from "../../viewer/mounting";
import { Viewer } from "../../viewer/Viewer";
import { movableJoints } from "./joints";
import { JointSlider } from "./JointSlider";

export function RobotPage() {
  const { id = "" } = useParams();
  const robot = useRobot(id);
  const urdf = useUrdf(id);
  return (
    <Loaded query={robot}>
      {(data) => (
        <>
          <PageHead title={data.name} lead={`Version ${data.version}`} back={{ to: "/robots", label: "Robots" }}>
            <a className="button" download={`${data.name}.urdf`} href={`/api/v1/robots/${data.id}/urdf`}>
              Download URDF
            </a>
          </PageHead>
          <Loaded query={urdf}>{(text) => <Figure key={data.id} robot={data} urdf={text} />}</Loaded>
        </>
      )}
    </Loaded>
  );
}

function Figure({ robot, urdf }: { robot: Robot; urdf: string }) {
  const mounting = useMemo(() => mountingOf(robot), [robot]);
  const [joints, setJoints] = useState(() => atRest(robot));
  const { chain, summary } = robot;
  const movable = useMemo(() => movableJoints(robot), [robot]);
  return (
    <div className="columns wide-first">
      <Card title="3-D view">
        <Viewer urdf={urdf} mounting={mounting} joints={joints} summary={`Robot ${robot.name} in the pose set by the sliders`} />
      </Card>
      <div className="stack">
        <Card
          title="Joints"
          aside={
            <button type="button" className="button small" onClick={() => setJoints(atRest(robot))}>
              Reset
            </button>
          }
        >
          {movable.map((joint) => (
            <JointSlider
              key={joint.name}
              joint={joint}
              value={joints[joint.name] ?? 0}
              onChange={(value) => setJoints((before) => ({ ...before, [joint.name]: value }))}
            />
          ))}
        </Card>
        <Card title="Chain">
          <Facts
            facts={[
              { name: "From", value: chain.base_link },
              { name: "To", value: chain.tip_link },
              { name: "Links of the robot", value: summary.links.length },
              { name: "Tool offset", value: `${(robot.spec.tool_offset_m ?? [0, 0, 0]).map((each) => formatNumber(each)).join(", ")} m` },
              { name: "Added", value: formatDateTime(Date.parse(robot.created_at)) },
              { name: "SHA-256 of the URDF", value: <code>{robot.urdf_sha256.slice(0, 16)}…</code> },
            ]}
          />
        </Card>
      </div>
    </div>
  );
}

function atRest(robot: Robot): Record<string, number> {
  const zeros = movableJoints(robot).map((joint) => [joint.name, 0] as const);
  return { ...Object.fromEntries(zeros), ...robot.chain.fixed_joints };
}
