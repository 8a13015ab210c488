import { useState } from "react";
import { useNavigate } from "react-router";
import { useSteerJob, type JobVerb } from "../../api/mutations";
import type { Job, JobState } from "../../api/types";
import { canCancel, canPause, canResume, isFinal } from "../../lib/states";
import { Problem } from "../../ui/feedback";
import { Icon } from "../../ui/icons";

/** The actions the state allows: pause, resume, cancel (with confirmation), run again. */
export function JobControls({ job, state }: { job: Job; state: JobState }) {
  const steer = useSteerJob(job.id);
  const navigate = useNavigate();
  const [confirming, setConfirming] = useState(false);
  const say = (verb: JobVerb) => {
    setConfirming(false);
    steer.mutate(verb, {
      onSuccess: (answer) => {
        if (verb === "clone") void navigate(`/jobs/${answer.id}`);
      },
    });
  };
  return (
    <>
      {canPause(state) && (
        <button type="button" className="button" disabled={steer.isPending} onClick={() => say("pause")}>
          <Icon name="pause" /> Pause
        </button>
      )}
      {canResume(state) && (
        <button type="button" className="button primary" disabled={steer.isPending} onClick={() => say("resume")}>
          <Icon name="play" /> Resume
        </button>
      )}
      {canCancel(state) && !confirming && (
        <button type="button" className="button danger" disabled={steer.isPending} onClick={() => setConfirming(true)}>
          Cancel
        </button>
      )}
      {canCancel(state) && confirming && (
        <span className="row" role="group" aria-label="Cancel this job?">
          <button type="button" className="button danger" onClick={() => say("cancel")}>
            Confirm cancel
          </button>
          <button type="button" className="button quiet" onClick={() => setConfirming(false)}>
            Keep running
          </button>
        </span>
      )}
      {isFinal(state) && (
        <button type="button" className="button" disabled={steer.isPending} onClick={() => say("clone")}>
          Run again
        </button>
      )}
      {steer.error && <Problem error={steer.error} />}
    </>
  );
}
