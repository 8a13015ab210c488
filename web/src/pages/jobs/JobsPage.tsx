import { Link } from "react-router";
import { useJobs } from "../../api/queries";
import type { Job } from "../../api/types";
import { formatAgo, formatCount, formatDateTime, formatPercent, humanize } from "../../lib/format";
import { Card, Empty, PageHead, ProgressBar, StateBadge } from "../../ui/basics";
import { Loaded } from "../../ui/feedback";
import { Icon } from "../../ui/icons";
import { More } from "../../ui/More";
import { useNow } from "../../ui/useNow";

export function JobsPage() {
  const jobs = useJobs();
  return (
    <>
      <PageHead title="Jobs" lead="Generalization jobs turn demonstrations into actions; execution jobs find the joint trajectory.">
        <NewJobLink />
      </PageHead>
      <Loaded query={jobs}>
        {(data) => {
          const items = data.pages.flatMap((page) => page.items);
          return (
            <Card flush>
              {items.length === 0 ? <NoJobs /> : <JobsTable jobs={items} />}
              <More query={jobs} />
            </Card>
          );
        }}
      </Loaded>
    </>
  );
}

function NewJobLink() {
  return (
    <Link className="button primary" to="/jobs/new">
      <Icon name="plus" /> New job
    </Link>
  );
}

function NoJobs() {
  return (
    <Empty title="No jobs yet">
      <p className="muted">
        Upload <Link to="/demonstrations">demonstrations</Link>, turn them into an action, then start a job that
        executes it on a robot.
      </p>
      <NewJobLink />
    </Empty>
  );
}

function JobsTable({ jobs }: { jobs: Job[] }) {
  const now = useNow();
  return (
    <table className="cards">
      <thead>
        <tr>
          <th scope="col">Job</th>
          <th scope="col">State</th>
          <th scope="col">Progress</th>
          <th scope="col" className="numeric">
            Evaluations
          </th>
          <th scope="col">Started</th>
        </tr>
      </thead>
      <tbody>
        {jobs.map((job) => (
          <JobRow key={job.id} job={job} nowMs={now} />
        ))}
      </tbody>
    </table>
  );
}

function JobRow({ job, nowMs }: { job: Job; nowMs: number }) {
  const started = job.started_at ? Date.parse(job.started_at) : null;
  return (
    <tr className="link">
      <td>
        <span>
          <Link to={`/jobs/${job.id}`}>{job.name}</Link>
          <span className="muted small" style={{ display: "block" }}>
            {humanize(job.kind)}
          </span>
        </span>
      </td>
      <td data-label="State">
        <StateBadge state={job.state} />
      </td>
      <td data-label="Progress">
        <Progress job={job} />
      </td>
      <td data-label="Evaluations" className="numeric">
        {job.kind === "execution" ? formatCount(job.progress.total_evaluations) : "–"}
      </td>
      <td data-label="Started" className="nowrap" title={formatDateTime(started)}>
        {started === null ? "not yet" : formatAgo(started, nowMs)}
      </td>
    </tr>
  );
}

function Progress({ job }: { job: Job }) {
  const { fraction, repetition, repetitions } = job.progress;
  return (
    <div style={{ minWidth: 120 }}>
      <ProgressBar slim share={fraction} label={`Progress of ${job.name}`} />
      <span className="muted small">
        {formatPercent(fraction)}
        {repetitions > 1 && ` · run ${Math.min(repetition + 1, repetitions)} of ${repetitions}`}
      </span>
    </div>
  );
}
