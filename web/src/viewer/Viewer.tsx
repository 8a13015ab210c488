// The 3-D view; its chunk is loaded on first use. If that fails, the page around it stays.

import { lazy, Suspense } from "react";
import { ErrorBoundary } from "../ui/ErrorBoundary";
import type { ViewerProps } from "./RobotViewer";

const RobotViewer = lazy(() => import("./RobotViewer"));

export function Viewer(props: ViewerProps) {
  const waiting = <div className="viewer viewer-message muted">Loading the 3-D view…</div>;
  return (
    <ErrorBoundary title="The 3-D view could not be loaded">
      <Suspense fallback={waiting}>
        <RobotViewer {...props} />
      </Suspense>
    </ErrorBoundary>
  );
}
