// The form for a new execution, next to the server's dry run of it.

import { useState, type SyntheticEvent } from "react";
import { useNavigate, useSearchParams } from "react-router";
import { bounds } from "../../api/bounds";
import { useCreateJob } from "../../api/mutations";
import { useActions, useMethods, useRobots, useWorlds } from "../../api/queries";
import { Card, PageHead } from "../../ui/basics";
import { Problem } from "../../ui/feedback";
import { NumberField, SelectField, within } from "../../ui/fields";
import { DryRun } from "./DryRun";
import { EMPTY_FORM, requestOf, suggested, type JobForm, type TextKey } from "./jobForm";
import { MethodCard, RealityCard } from "./MethodCard";
import { MotionCard } from "./MotionCard";

const limits = bounds.CreateJobExecution;

export function NewJobPage() {
  const [search] = useSearchParams();
  const [form, setForm] = useState<JobForm>({ ...EMPTY_FORM, action: search.get("action") ?? "" });
  const navigate = useNavigate();
  const create = useCreateJob();
  const change = (part: Partial<JobForm>) => setForm((before) => ({ ...before, ...part }));
  const text = (key: TextKey) => ({ value: form[key], onChange: (value: string) => change({ [key]: value }) });

  const worlds = useWorlds().data?.pages.flatMap((page) => page.items) ?? [];
  const world = worlds.find((each) => each.id === form.world);
  const methods = useMethods().data?.items ?? [];
  const request = requestOf(form, methods.find(({ name }) => name === form.method));
  const submit = (event: SyntheticEvent) => {
    event.preventDefault();
    if (request !== null) create.mutate(request, { onSuccess: (job) => void navigate(`/jobs/${job.id}`) });
  };
  return (
    <>
      <PageHead
        title="New job"
        lead="Finds the joint trajectory with which a robot produces the effects of an action."
        back={{ to: "/jobs", label: "Jobs" }}
      />
      <form className="columns wide-first" onSubmit={submit}>
        <div className="stack">
          <What form={form} change={change} />
          <MethodCard form={form} world={world} methods={methods} change={change} />
          <RealityCard form={form} change={change} />
          <Card title="Stopping criteria">
            <div className="fields">
              <NumberField label="Tolerance" hint="A goal ends when an observation is this close, in the features' unit." min={0} step="any" {...text("tolerance")} />
              <NumberField label="Target discrepancy" hint="A goal ends when the discrepancy of the whole observation so far is this small." min={0} step="any" {...text("target")} />
              <NumberField label="Max. evaluations per goal" min={1} {...text("maxEvaluations")} />
            </div>
          </Card>
          <MotionCard form={form} change={change} />
          <Card title="Repetitions">
            <div className="fields">
              <NumberField label="Runs" hint="Run r uses seed + r." {...within(limits.repetitions)} required {...text("repetitions")} />
              <NumberField label="Seed" hint="Drawn and recorded if empty; the same seed gives the same result, bit for bit." {...within(limits.seed)} {...text("seed")} />
              <NumberField label="Max. evaluations per second" hint="Slows the simulation down so that it can be watched." {...within(limits.max_evaluations_per_s)} step="any" {...text("pace")} />
            </div>
          </Card>
        </div>
        <div className="stack">
          <DryRun request={request} />
          {create.error && <Problem error={create.error} title="The job was rejected" />}
          <button type="submit" className="button primary" disabled={request === null || create.isPending}>
            {create.isPending ? "Starting…" : "Start job"}
          </button>
        </div>
      </form>
    </>
  );
}

function What({ form, change }: { form: JobForm; change: (part: Partial<JobForm>) => void }) {
  const actions = useActions().data?.pages.flatMap((page) => page.items) ?? [];
  const robots = useRobots().data?.pages.flatMap((page) => page.items) ?? [];
  const worlds = useWorlds().data?.pages.flatMap((page) => page.items) ?? [];
  const action = actions.find((each) => each.id === form.action);
  const observed = (features: { name: string }[]) => features.map((feature) => feature.name).join(", ");
  const fits = (features: { name: string }[]) => action === undefined || observed(features) === observed(action.features);
  const choose = (id: string) => {
    const world = worlds.find((each) => each.id === id);
    change({ world: id, ...(world === undefined ? {} : suggested(world)) });
  };
  return (
    <Card title="Task">
      <div className="fields">
        <SelectField
          label="Action"
          required
          value={form.action}
          onChange={(value) => change({ action: value })}
          options={[
            { value: "", label: actions.length === 0 ? "none yet: create one first" : "choose an action" },
            ...actions.map((each) => ({ value: each.id, label: `${each.name}, version ${each.version} (${each.goals} goals)` })),
          ]}
        />
        <SelectField
          label="Robot"
          required
          value={form.robot}
          onChange={(value) => change({ robot: value })}
          options={[
            { value: "", label: "choose a robot" },
            ...robots.map((each) => ({ value: each.id, label: `${each.name}, version ${each.version}` })),
          ]}
        />
        <SelectField
          label="World"
          required
          hint="It must observe the action's features."
          value={form.world}
          onChange={choose}
          options={[
            { value: "", label: "choose a world" },
            ...worlds.map((each) => ({
              value: each.id,
              label: `${each.name} (${observed(each.features)})${fits(each.features) ? "" : ": other features"}`,
            })),
          ]}
        />
      </div>
    </Card>
  );
}
