// One job, live: the last fetched state plus the events received since.

import { Link, useParams } from "react-router";
import { useAction, useJob } from "../../api/queries";
import type { Job } from "../../api/types";
import type { LiveJob } from "../../live/jobLive";
import { useJobLive } from "../../live/useJobLive";
import type { StreamHealth } from "../../live/eventStream";
import { isFinal } from "../../lib/states";
import { Card, PageHead, StateBadge } from "../../ui/basics";
import { Loaded, Notice } from "../../ui/feedback";
import { StreamHealthBadge } from "../../ui/StreamHealth";
import { ExecutionLive } from "./ExecutionLive";
import { ExperimentResult } from "./ExperimentResult";
import { JobControls } from "./JobControls";
import { JobSettings } from "./JobSettings";
import { RunsTable } from "./RunsTable";

export function JobPage() {
  const { id = "" } = useParams();
  // The key remounts the page for a new id, so that no state of the previous job's stream survives.
  return <OneJob key={id} id={id} />;
}

function OneJob({ id }: { id: string }) {
  const job = useJob(id);
  const { live, health } = useJobLive(id);
  return <Loaded query={job}>{(data) => <JobView job={data} live={live} health={health} />}</Loaded>;
}

function JobView({ job, live, health }: { job: Job; live: LiveJob; health: StreamHealth }) {
  // The stream is ahead of the last fetch, unless the early events of an old job are no longer stored.
  const ahead = live.lastSeq >= job.last_seq;
  const state = ahead && live.state !== null ? live.state : job.state;
  const reason = ahead ? live.reason : job.state_reason;
  return (
    <>
      <PageHead title={job.name} back={{ to: "/jobs", label: "Jobs" }} badge={<StateBadge state={state} />}>
        {!isFinal(state) && <StreamHealthBadge health={health} />}
        <JobControls job={job} state={state} />
      </PageHead>
      <div className="stack">
        {job.failure != null && (
          <Notice tone="bad" title={`Failed: ${job.failure.code}`}>
            <p>{job.failure.message}</p>
          </Notice>
        )}
        {job.failure == null && reason != null && reason !== "" && <Notice tone="warn" title={reason} />}
        {job.kind === "execution" ? (
          <Execution job={job} live={live} state={state} />
        ) : job.kind === "experiment" ? (
          <ExperimentResult job={job} state={state} />
        ) : (
          <Generalization job={job} />
        )}
        <JobSettings job={job} />
      </div>
    </>
  );
}

function Execution({ job, live, state }: { job: Job; live: LiveJob; state: Job["state"] }) {
  const request = job.request.kind === "execution" ? job.request : null;
  const action = useAction(request?.action ?? "");
  const features = action.data?.features ?? [];
  const units = new Set(features.map((feature) => feature.unit ?? ""));
  const unit = units.size === 1 ? ([...units][0] ?? "") : "";
  return (
    <>
      <ExecutionLive job={job} live={live} state={state} unit={unit} />
      <RunsTable job={job} unit={unit} finishedRuns={live.runs.length} />
    </>
  );
}

function Generalization({ job }: { job: Job }) {
  const action = job.result.action;
  return (
    <Card title="Result">
      {action == null ? (
        <p className="muted">The action appears here once the job has succeeded.</p>
      ) : (
        <div className="row">
          <Link className="button primary" to={`/actions/${action}`}>
            Open the action
          </Link>
        </div>
      )}
    </Card>
  );
}
