// The motion of a new job: how fast, whether the arm stops at the goals, and whether collisions are avoided.

import { Card } from "../../ui/basics";
import { NumberField, SelectField } from "../../ui/fields";
import type { JobForm, TextKey } from "./jobForm";

const AT_GOALS = [
  { value: "stop", label: "stop at each goal" },
  { value: "pass", label: "pass through the goals" },
];

const TIMINGS = [
  { value: "limits", label: "as fast as these limits allow" },
  { value: "demonstration", label: "as in the demonstrations, or slower" },
];

const COLLISIONS = [
  { value: "avoid", label: "avoided, with the arm itself and the surface" },
  { value: "ignore", label: "not checked" },
];

export function MotionCard({ form, change }: { form: JobForm; change: (part: Partial<JobForm>) => void }) {
  const text = (key: TextKey) => ({ value: form[key], onChange: (value: string) => change({ [key]: value }) });
  return (
    <Card title="Motion">
      <div className="fields">
        <NumberField label="Speed (%)" hint="Share of the joints' velocity limits." min={0.1} max={100} step="any" required {...text("speed")} />
        <NumberField
          label="Acceleration (%)"
          hint="Share of the joints' acceleration and jerk limits."
          min={0.1}
          max={100}
          step="any"
          required
          {...text("acceleration")}
        />
        <SelectField label="At goals" options={AT_GOALS} {...text("goals")} />
        {form.goals === "stop" && <NumberField label="Pause at goals (s)" min={0} max={60} step="any" required {...text("pause")} />}
        <SelectField label="Timing" options={TIMINGS} {...text("timing")} />
        <SelectField label="Collisions" options={COLLISIONS} {...text("collisions")} />
      </div>
    </Card>
  );
}
