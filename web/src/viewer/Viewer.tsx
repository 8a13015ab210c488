// The 3-D view; its chunk is loaded on first use.

import { lazy, Suspense } from "react";
import type { ViewerProps } from "./RobotViewer";

const RobotViewer = lazy(() => import("./RobotViewer"));

export function Viewer(props: ViewerProps) {
  const waiting = <div className="viewer viewer-message muted">Loading the 3-D view…</div>;
  return (
    <Suspense fallback={waiting}>
      <RobotViewer {...props} />
    </Suspense>
  );
}
