// Method, parameters and simulated robot of a new job.

import type { Metric, World } from "../../api/types";
import { Card } from "../../ui/basics";
import { NumberField, SelectField } from "../../ui/fields";
import type { JobForm } from "./jobForm";
import { methodNamed, methodsFor, type MethodName } from "./methods";

const METRICS: { value: Metric; label: string }[] = [
  { value: "multivariate", label: "multivariate: all features jointly" },
  { value: "sum_of_features", label: "sum of features: one path per feature" },
  { value: "aquila", label: "aquila: as in the published runs" },
];

interface Props {
  form: JobForm;
  world: World | undefined;
  change: (part: Partial<JobForm>) => void;
}

type Text = (key: keyof JobForm) => { value: string; onChange: (value: string) => void };

export function MethodCard({ form, world, change }: Props) {
  const text: Text = (key) => ({ value: form[key], onChange: (value) => change({ [key]: value }) });
  const method = methodNamed(form.method);
  return (
    <Card title="Search method">
      <div className="fields">
        <SelectField
          label="Method"
          value={form.method}
          onChange={(value) => change({ method: value as MethodName })}
          options={methodsFor(world).map(({ name, label }) => ({ value: name, label }))}
        />
        <SelectField label="Metric" hint="How discrepancy is measured." options={METRICS} {...text("metric")} />
      </div>
      <p className="small muted" aria-live="polite" style={{ margin: "12px 0" }}>
        {method?.explanation}
      </p>
      <div className="fields">
        {form.method === "model" && <ModelFields form={form} text={text} />}
        {form.method === "sst" && <TournamentFields text={text} />}
        {method?.few === true && (
          <NumberField
            label="Max. step (degrees)"
            hint="Of each joint from one trial to the next; leave empty for no limit."
            min={0}
            step="any"
            {...text("maxStep")}
          />
        )}
      </div>
    </Card>
  );
}

function ModelFields({ form, text }: { form: JobForm; text: Text }) {
  return (
    <>
      <SelectField
        label="Prior knowledge"
        hint={form.prior === "none" ? "The run starts with a small move of each joint." : "Halves the evaluations, even if the description is inaccurate."}
        options={[
          { value: "none", label: "nothing" },
          { value: "simulator", label: "the described robot, as a simulator" },
        ]}
        {...text("prior")}
      />
      <NumberField
        label="Expected sensor noise"
        hint="Standard deviation of a feature, in its unit; 0 means exact."
        min={0}
        step="any"
        required
        {...text("noise")}
      />
      <SelectField
        label="Earlier runs on this robot"
        hint="Trials with the same tool, world and features are as good as new ones."
        options={[
          { value: "found", label: "reuse their trials" },
          { value: "none", label: "ignore them" },
        ]}
        {...text("earlier")}
      />
    </>
  );
}

function TournamentFields({ text }: { text: Text }) {
  return (
    <>
      <NumberField label="Population P" hint="Number of individuals per goal." min={3} required {...text("population")} />
      <NumberField label="Stagnation S" hint="A goal ends after S + 1 generations without improvement." min={0} required {...text("stagnation")} />
      <NumberField label="Mutation probability" hint="After each crossover, 0 to 1." min={0} max={1} step="any" required {...text("mutation")} />
    </>
  );
}

/** The simulated robot of a job: exactly as described, or slightly different, as real robots are. */
export function RealityCard({ form, change }: Omit<Props, "world">) {
  const text: Text = (key) => ({ value: form[key], onChange: (value) => change({ [key]: value }) });
  return (
    <Card title="Simulated real robot">
      <div className="fields">
        <SelectField
          label="The robot is"
          hint="Rehearse a real robot: the method only knows the description."
          options={[
            { value: "described", label: "exactly as described" },
            { value: "other", label: "slightly different from its description" },
          ]}
          {...text("reality")}
        />
        {form.reality === "other" && (
          <>
            <NumberField label="Link length error (%)" min={0} max={90} step="any" required {...text("links")} />
            <NumberField label="Base offset (mm)" min={0} step="any" required {...text("base")} />
            <NumberField label="Sensor noise" hint="Standard deviation, in the features' unit." min={0} step="any" required {...text("sensorNoise")} />
            <NumberField label="Joint noise (degrees)" min={0} step="any" required {...text("jointNoise")} />
            <NumberField label="Lost observations (%)" min={0} max={99} step="any" required {...text("lost")} />
            <NumberField
              label="Robot seed"
              hint="The same seed gives the same robot in every job; leave empty to draw one per run."
              min={0}
              {...text("realSeed")}
            />
          </>
        )}
      </div>
    </Card>
  );
}
