// Method, parameters and simulated robot of a new job.

import type { Method, Metric, World } from "../../api/types";
import { Card } from "../../ui/basics";
import { NumberField, SelectField } from "../../ui/fields";
import type { JobForm, TextKey } from "./jobForm";
import { MethodParameters } from "./MethodParameters";
import { methodsFor } from "./methods";

const METRICS: { value: Metric; label: string }[] = [
  { value: "multivariate", label: "multivariate: all features jointly" },
  { value: "sum_of_features", label: "sum of features: one path per feature" },
  { value: "aquila", label: "aquila: as in the published runs" },
];

interface Props {
  form: JobForm;
  world: World | undefined;
  methods: readonly Method[];
  change: (part: Partial<JobForm>) => void;
}

type Text = (key: TextKey) => { value: string; onChange: (value: string) => void };

export function MethodCard({ form, world, methods, change }: Props) {
  const text: Text = (key) => ({ value: form[key], onChange: (value) => change({ [key]: value }) });
  const method = methods.find(({ name }) => name === form.method);
  return (
    <Card title="Search method">
      <div className="fields">
        <SelectField
          label="Method"
          value={form.method}
          onChange={(value) => change({ method: value })}
          options={methodsFor(methods, world).map(({ name, label }) => ({ value: name, label }))}
        />
        <SelectField label="Metric" hint="How discrepancy is measured." options={METRICS} {...text("metric")} />
      </div>
      <p className="small muted" aria-live="polite" style={{ margin: "12px 0" }}>
        {method?.purpose}
      </p>
      {method !== undefined && (
        <MethodParameters
          method={method}
          texts={form.parameters}
          change={(key, value) => change({ parameters: { ...form.parameters, [key]: value } })}
        />
      )}
      {method?.learns_from_earlier_runs === true && (
        <div className="fields" style={{ marginTop: 12 }}>
          <SelectField
            label="Earlier runs on this robot"
            hint="Trials with the same tool, world and features are as good as new ones."
            options={[
              { value: "found", label: "reuse their trials" },
              { value: "none", label: "ignore them" },
            ]}
            {...text("earlier")}
          />
        </div>
      )}
    </Card>
  );
}

/** The simulated robot of a job: exactly as described, or slightly different, as real robots are. */
export function RealityCard({ form, change }: Pick<Props, "form" | "change">) {
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
