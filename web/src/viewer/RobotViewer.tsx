// The 3-D view as a component. Exported as default so that it and three load in their own chunk.

import { useEffect, useRef, useState } from "react";
import { Vector3 } from "three";
import { useDarkScheme } from "../charts/theme";
import { cellCentres, paintedBy, type Point, type WallGrid } from "../lib/coverage";
import { goalMarks, Trail, Wall } from "./marks";
import { RobotFigure, type Mounting } from "./robot";
import { disposeAll, Stage, type View } from "./scene";

export interface ViewerProps {
  urdf: string;
  mounting: Mounting;
  /** Current joint values by name, rad or m. */
  joints: Readonly<Record<string, number>>;
  /** Joint values by name of the poses along the tool's path, in order. */
  path?: readonly Readonly<Record<string, number>>[];
  /** Index in `path` of the last pose reached. */
  pathIndex?: number;
  /** Goals in the base frame, metres. */
  goals?: readonly Point[];
  wall?: WallGrid;
  /** Poses at which the tool works on the wall, and how many of them are done. */
  strokes?: readonly Readonly<Record<string, number>>[];
  strokesDone?: number;
  /** Called with the number of painted cells. */
  onPainted?: (cells: number) => void;
  /** Text alternative. */
  summary: string;
}

interface Built {
  stage: Stage;
  figure: RobotFigure;
  trail: Trail | null;
  wall: Wall | null;
  painters: (number | null)[];
}

const VIEWS: { view: View; label: string }[] = [
  { view: "perspective", label: "3-D" },
  { view: "front", label: "Front" },
  { view: "side", label: "Side" },
  { view: "top", label: "Top" },
];

export default function RobotViewer(props: ViewerProps) {
  const { urdf, mounting, joints, path, pathIndex, goals, wall, strokes, strokesDone, onPainted, summary } = props;
  const host = useRef<HTMLDivElement>(null);
  const built = useRef<Built | null>(null);
  const view = useRef<View>("perspective");
  const [failure, setFailure] = useState<string | null>(null);
  const [missing, setMissing] = useState(0);
  const dark = useDarkScheme();

  useEffect(() => {
    const element = host.current;
    if (element === null) return undefined;
    let stage: Stage | null = null;
    try {
      stage = new Stage(element);
      built.current = build(stage, { urdf, mounting, path, goals, wall, strokes });
      setMissing(built.current.figure.missingMeshes);
      setFailure(null);
      stage.fit(view.current);
    } catch (error) {
      setFailure(error instanceof Error ? error.message : String(error));
    }
    return () => {
      built.current?.figure.dispose();
      built.current = null;
      if (stage !== null) {
        disposeAll(stage.root);
        stage.dispose();
      }
    };
  }, [urdf, mounting, path, goals, wall, strokes, dark]);

  useEffect(() => {
    const now = built.current;
    if (now === null) return;
    now.figure.pose(joints);
    now.trail?.showUpTo(pathIndex ?? Infinity);
    const painted = paintedUpTo(now.painters, strokesDone ?? Infinity);
    now.wall?.paint(painted);
    onPainted?.(painted.size);
    now.stage.describe(summary);
    now.stage.draw();
  }, [joints, pathIndex, strokesDone, onPainted, summary, urdf, mounting, path, goals, wall, strokes, dark]);

  const look = (to: View) => {
    view.current = to;
    built.current?.stage.fit(to);
  };

  return (
    <div>
      <div className="viewer" ref={host}>
        {failure !== null && (
          <p className="viewer-message muted" role="alert">
            The 3-D view cannot be shown: {failure}
          </p>
        )}
        <div className="viewer-tools" role="group" aria-label="View from">
          {VIEWS.map((each) => (
            <button key={each.view} type="button" className="button small" onClick={() => look(each.view)}>
              {each.label}
            </button>
          ))}
        </div>
      </div>
      {missing > 0 && (
        <p className="small muted" style={{ marginTop: 6 }}>
          {missing} {missing === 1 ? "mesh" : "meshes"} named in the URDF are not stored here; those links are drawn as bones.
        </p>
      )}
    </div>
  );
}

type Ingredients = Pick<ViewerProps, "urdf" | "mounting" | "path" | "goals" | "wall" | "strokes">;

function build(stage: Stage, { urdf, mounting, path, goals, wall, strokes }: Ingredients): Built {
  const figure = new RobotFigure(urdf, mounting);
  stage.root.add(figure.object);
  const trace = (poses: Ingredients["path"]) =>
    (poses ?? []).map((pose) => {
      figure.pose(pose);
      return figure.toolPoint();
    });

  const trail = path === undefined ? null : new Trail(trace(path));
  if (trail !== null) stage.root.add(trail.object);
  if (goals !== undefined && goals.length > 0) stage.root.add(goalMarks(goals.map((goal) => figure.fromBase(goal))));

  const shown = wall === undefined ? null : new Wall(cells(figure, wall));
  if (shown !== null) stage.root.add(shown.object);
  const visited = trace(strokes).map((point): Point => point.toArray());
  const painters = wall === undefined ? [] : paintedBy(inWorld(figure, wall), visited);
  return { stage, figure, trail, wall: shown, painters };
}

/** Transforms the grid from the chain's base frame to the world frame. */
function inWorld(figure: RobotFigure, wall: WallGrid): WallGrid {
  const origin = figure.fromBase([0, 0, 0]);
  const turn = (step: readonly number[]) => figure.fromBase(triple(step)).sub(origin).toArray();
  return {
    ...wall,
    origin_m: figure.fromBase(triple(wall.origin_m)).toArray(),
    column_step_m: turn(wall.column_step_m),
    row_step_m: turn(wall.row_step_m),
  };
}

function cells(figure: RobotFigure, wall: WallGrid) {
  const grid = inWorld(figure, wall);
  const column = new Vector3(...triple(grid.column_step_m));
  const row = new Vector3(...triple(grid.row_step_m));
  return cellCentres(grid).map((centre) => ({ centre: new Vector3(...centre), column, row }));
}

function triple(values: readonly number[]): Point {
  return [values[0] ?? 0, values[1] ?? 0, values[2] ?? 0];
}

function paintedUpTo(painters: readonly (number | null)[], strokesDone: number): Set<number> {
  return new Set(painters.flatMap((painter, cell) => (painter !== null && painter < strokesDone ? [cell] : [])));
}
