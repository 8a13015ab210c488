import { useId, useState, type SyntheticEvent } from "react";
import { useNavigate } from "react-router";
import { useCreateJob } from "../../api/mutations";
import type { Demonstration, Weighting } from "../../api/types";
import { formatDuration } from "../../lib/format";
import { Card } from "../../ui/basics";
import { Problem } from "../../ui/feedback";

/** Generalizes the selected demonstrations into an action; shows the expected number of goals. */
export function Generalize({ demonstrations }: { demonstrations: Demonstration[] }) {
  const ids = useId();
  const navigate = useNavigate();
  const create = useCreateJob();
  const [name, setName] = useState("");
  const [tMin, setTMin] = useState("1");
  const [weighting, setWeighting] = useState<Weighting>("per_demonstration");

  const meanS = demonstrations.reduce((sum, each) => sum + each.duration_s, 0) / Math.max(1, demonstrations.length);
  const tMinS = Number(tMin);
  const goals = tMinS > 0 ? Math.floor(meanS / tMinS) : 0;
  const submit = (event: SyntheticEvent) => {
    event.preventDefault();
    const chosen = demonstrations.map((each) => each.id);
    create.mutate(
      { kind: "generalization", name: name.trim(), demonstrations: chosen, t_min_s: tMinS, weighting },
      { onSuccess: (job) => void navigate(`/jobs/${job.id}`) },
    );
  };
  return (
    <Card
      title={`Create an action from ${demonstrations.length} ${demonstrations.length === 1 ? "demonstration" : "demonstrations"}`}
      aside={<span className="muted small">mean duration {formatDuration(meanS)}</span>}
    >
      <form className="stack" onSubmit={submit}>
        <div className="fields">
          <div className="field">
            <label htmlFor={`${ids}name`}>Name of the action</label>
            <input id={`${ids}name`} required value={name} onChange={(event) => setName(event.currentTarget.value)} />
            <span className="hint">An existing name creates a new version.</span>
          </div>
          <div className="field">
            <label htmlFor={`${ids}tmin`}>Min. time between goals (s)</label>
            <input
              id={`${ids}tmin`}
              type="number"
              min="0.001"
              step="any"
              required
              value={tMin}
              onChange={(event) => setTMin(event.currentTarget.value)}
            />
            <span className="hint">{goals >= 1 ? `gives about ${goals} goals` : "must be shorter than the demonstrations"}</span>
          </div>
          <div className="field">
            <label htmlFor={`${ids}weighting`}>Weighting</label>
            <select id={`${ids}weighting`} value={weighting} onChange={(event) => setWeighting(event.currentTarget.value as Weighting)}>
              <option value="per_demonstration">per demonstration</option>
              <option value="per_sample">per sample</option>
            </select>
            <span className="hint">Per sample, a denser recording counts more.</span>
          </div>
        </div>
        {create.error && <Problem error={create.error} title="The action cannot be created" />}
        <div>
          <button type="submit" className="button primary" disabled={create.isPending}>
            Generalize
          </button>
        </div>
      </form>
    </Card>
  );
}
