import { useId } from "react";
import { formatNumber } from "../../lib/format";
import { Badge } from "../../ui/basics";
import type { MovableJoint } from "./joints";

interface Props {
  joint: MovableJoint;
  value: number;
  onChange: (value: number) => void;
}

const DEGREE = 180 / Math.PI;

/** A slider for one joint between its limits; angles are shown in degrees. */
export function JointSlider({ joint, value, onChange }: Props) {
  const id = useId();
  const prismatic = joint.kind === "prismatic";
  const reach = prismatic ? 1 : Math.PI;
  const show = (at: number) => (prismatic ? `${formatNumber(at, 3)} m` : `${formatNumber(at * DEGREE, 3)}°`);
  const low = joint.lower ?? -reach;
  const high = joint.upper ?? reach;
  return (
    <div className="joint">
      <label htmlFor={id} style={{ minWidth: 0, overflowWrap: "anywhere" }}>
        {joint.name} {joint.free ? null : <Badge tone="idle">fixed</Badge>}
      </label>
      <span className="numeric small">{show(value)}</span>
      <input
        id={id}
        type="range"
        min={low}
        max={high}
        step={(high - low) / 400}
        value={value}
        aria-valuetext={show(value)}
        onChange={(event) => onChange(event.currentTarget.valueAsNumber)}
      />
      <span className="numeric small muted">
        {joint.kind === "continuous" ? "no limits" : `${show(low)} … ${show(high)}`}
      </span>
    </div>
  );
}
