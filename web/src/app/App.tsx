// Providers and the route table.

import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { useSyncExternalStore } from "react";
import { BrowserRouter, Navigate, Route, Routes } from "react-router";
import { ApiError } from "../api/client";
import { session } from "../api/session";
import { ActionPage } from "../pages/actions/ActionPage";
import { ActionsPage } from "../pages/actions/ActionsPage";
import { DemonstrationPage } from "../pages/demonstrations/DemonstrationPage";
import { DemonstrationsPage } from "../pages/demonstrations/DemonstrationsPage";
import { JobPage } from "../pages/jobs/JobPage";
import { JobsPage } from "../pages/jobs/JobsPage";
import { NewJobPage } from "../pages/jobs/NewJobPage";
import { RobotPage } from "../pages/robots/RobotPage";
import { RobotsPage } from "../pages/robots/RobotsPage";
import { RunPage } from "../pages/runs/RunPage";
import { ErrorBoundary } from "../ui/ErrorBoundary";
import { Layout } from "./Layout";
import { NotFound } from "./NotFound";
import { SignedOut } from "./SignedOut";

const queries = new QueryClient({
  defaultOptions: {
    queries: {
      staleTime: 1000,
      // A request the server rejected will be rejected again; one that did not reach it may succeed.
      retry: (failures, error) => failures < 2 && !(error instanceof ApiError && error.status >= 400 && error.status < 500),
    },
  },
});

export function App() {
  const signedOut = useSyncExternalStore(session.subscribe, session.isSignedOut);
  if (signedOut) return <SignedOut />;
  return (
    <QueryClientProvider client={queries}>
      <BrowserRouter>
        <Layout>
          <ErrorBoundary title="This page crashed">
            <Pages />
          </ErrorBoundary>
        </Layout>
      </BrowserRouter>
    </QueryClientProvider>
  );
}

function Pages() {
  return (
    <Routes>
      <Route path="/" element={<Navigate to="/jobs" replace />} />
      <Route path="/jobs" element={<JobsPage />} />
      <Route path="/jobs/new" element={<NewJobPage />} />
      <Route path="/jobs/:id" element={<JobPage />} />
      <Route path="/runs/:id" element={<RunPage />} />
      <Route path="/demonstrations" element={<DemonstrationsPage />} />
      <Route path="/demonstrations/:id" element={<DemonstrationPage />} />
      <Route path="/actions" element={<ActionsPage />} />
      <Route path="/actions/:id" element={<ActionPage />} />
      <Route path="/robots" element={<RobotsPage />} />
      <Route path="/robots/:id" element={<RobotPage />} />
      <Route path="*" element={<NotFound />} />
    </Routes>
  );
}
