// The trajectory in 3-D: the robot from its URDF, the tool's trail next to the goals, the wall's cells as they get painted.

import { useMemo, useState } from "react";
import { useRobot, useRunTrajectory, useUrdf, useWorld } from "../../api/queries";
import type { Robot, Run, RunGoals, Trajectory, World } from "../../api/types";
import type { WallGrid } from "../../lib/coverage";
import { decimateMinMax } from "../../lib/decimate";
import { formatNumber, formatQuantity } from "../../lib/format";
import { indexAt, named, passedBy, positionsAt } from "../../lib/playback";
import { positionReader } from "../../lib/space";
import { Card } from "../../ui/basics";
import { Loaded, Loading } from "../../ui/feedback";
import { mountingOf } from "../../viewer/mounting";
import { Viewer } from "../../viewer/Viewer";
import { Player } from "./Player";
import { usePlayback } from "./usePlayback";

const MAX_TRAIL = 1500;

/** The fields of a trajectory needed to draw it. */
type Motion = Pick<Trajectory, "joint_names" | "points" | "duration_s" | "pose_times_s" | "goal_times_s">;

export function Replay({ run, goals }: { run: Run; goals: RunGoals }) {
  const planned = run.trajectory != null;
  const trajectory = useRunTrajectory(run.id, planned);
  const poses = useMemo(() => throughPoses(goals), [goals]);
  const robot = useRobot(run.robot);
  const urdf = useUrdf(run.robot);
  const world = useWorld(run.world);
  return (
    <Card title={planned ? "Replay" : "Poses found, one per second"} aside={<Legend world={world.data} />}>
      <Loaded query={planned ? trajectory : { data: poses, error: null }}>
        {(path) =>
          robot.data !== undefined && urdf.data !== undefined && world.data !== undefined ? (
            <Scene goals={goals} trajectory={path} robot={robot.data} urdf={urdf.data} world={world.data} />
          ) : (
            <Loading />
          )
        }
      </Loaded>
    </Card>
  );
}

interface SceneProps {
  goals: RunGoals;
  trajectory: Motion;
  robot: Robot;
  urdf: string;
  world: World;
}

function Scene({ goals, trajectory, robot, urdf, world }: SceneProps) {
  const play = usePlayback(trajectory.duration_s);
  const [cells, setCells] = useState(0);
  const mounting = useMemo(() => mountingOf(robot), [robot]);
  const { points, joint_names: names } = trajectory;

  const shown = useMemo(() => {
    const kept = decimateMinMax(points.map((point) => point.t_s), MAX_TRAIL);
    return kept.flatMap((index) => points[index] ?? []);
  }, [points]);
  const path = useMemo(() => shown.map((point) => named(names, point.positions)), [shown, names]);
  const strokes = useMemo(() => posesOf(goals).map((pose) => named(goals.joint_names, pose)), [goals]);
  const targets = useMemo(() => {
    const read = positionReader(goals.features);
    return read === null ? undefined : goals.goals.map((goal) => read(goal.goal));
  }, [goals]);
  const wall = useMemo(() => wallOf(world), [world]);
  const joints = useMemo(() => named(names, positionsAt(points, play.timeS)), [names, points, play.timeS]);

  const passed = passedBy(trajectory.goal_times_s, play.timeS);
  const strokesDone = passedBy(trajectory.pose_times_s, play.timeS);
  const last = goals.goals[passed - 1];
  return (
    <>
      <Viewer
        urdf={urdf}
        mounting={mounting}
        joints={joints}
        path={path}
        pathIndex={indexAt(shown, play.timeS)}
        {...(targets === undefined ? {} : { goals: targets })}
        {...(wall === undefined ? {} : { wall, strokes, strokesDone, onPainted: setCells })}
        summary={`Robot ${robot.name} at ${formatNumber(play.timeS, 3)} seconds, ${passed} of ${goals.goals.length} goals passed`}
      />
      <Player play={play} durationS={trajectory.duration_s} marks={trajectory.goal_times_s} />
      <p className="row between small" style={{ marginTop: 8 }}>
        <span>
          {passed} of {goals.goals.length} goals passed
          {wall !== undefined && ` · ${cells} of ${wall.columns * wall.rows} cells painted`}
        </span>
        {last !== undefined && (
          <span className="muted">
            observed{" "}
            {goals.features.map((feature, column) => `${feature.name} ${formatQuantity(last.observation[column], feature.unit)}`).join(", ")}
          </span>
        )}
      </p>
    </>
  );
}

/** The poses that leave the run's effect, in order; in runs of earlier versions those of the goals. */
function posesOf({ goals, path }: RunGoals): number[][] {
  return path.length > 0 ? path.map((pose) => pose.joints) : goals.map((goal) => goal.joints);
}

/** Stand-in for a missing trajectory: the poses, one second apart. For drawing only, never executed. */
function throughPoses(goals: RunGoals): Motion {
  const poses = posesOf(goals);
  const points = poses.map((positions, index) => ({ t_s: index, positions, velocities: [], accelerations: [] }));
  const pose_times_s = points.map((point) => point.t_s);
  const goal_times_s = goals.path.length > 0 ? goals.path.flatMap((pose, index) => pose.goals.map(() => index)) : pose_times_s;
  return { joint_names: goals.joint_names, points, duration_s: Math.max(1, poses.length - 1), pose_times_s, goal_times_s };
}

function wallOf(world: World): WallGrid | undefined {
  return world.spec.kind === "coverage" ? world.spec : undefined;
}

function Legend({ world }: { world: World | undefined }) {
  const coverage = world?.spec.kind === "coverage";
  const entries = coverage
    ? [
        { name: "tool's trail", color: "trail", shape: "line" },
        { name: "painted", color: "cell-painted", shape: "" },
        { name: "not painted", color: "cell", shape: "" },
      ]
    : [
        { name: "tool's trail", color: "trail", shape: "line" },
        { name: "goals", color: "goal", shape: "" },
      ];
  return (
    <ul className="legend">
      {entries.map((entry) => (
        <li key={entry.name}>
          <i className={entry.shape} style={{ ["--swatch" as string]: `var(--${entry.color})` }} />
          {entry.name}
        </li>
      ))}
    </ul>
  );
}
