// Labelled inputs with an optional hint.

import { useId } from "react";

interface FieldProps {
  label: string;
  hint?: string;
  required?: boolean;
  value: string;
  onChange: (value: string) => void;
}

interface NumberProps extends FieldProps {
  min?: number;
  max?: number;
  step?: number | "any";
}

/** The bounds of a request's field as those of an input. */
export function within(bounds: { minimum?: number; maximum?: number }): Pick<NumberProps, "min" | "max"> {
  return {
    ...(bounds.minimum === undefined ? {} : { min: bounds.minimum }),
    ...(bounds.maximum === undefined ? {} : { max: bounds.maximum }),
  };
}

export function NumberField({ label, hint, value, onChange, required = false, step = 1, min, max }: NumberProps) {
  const id = useId();
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        type="number"
        inputMode="decimal"
        aria-describedby={hint === undefined ? undefined : `${id}hint`}
        required={required}
        step={step}
        min={min}
        max={max}
        value={value}
        onChange={(event) => onChange(event.currentTarget.value)}
      />
      <Hint id={id} text={hint} />
    </div>
  );
}

interface SelectProps extends FieldProps {
  options: { value: string; label: string }[];
}

export function SelectField({ label, hint, value, onChange, required = false, options }: SelectProps) {
  const id = useId();
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <select
        id={id}
        aria-describedby={hint === undefined ? undefined : `${id}hint`}
        required={required}
        value={value}
        onChange={(event) => onChange(event.currentTarget.value)}
      >
        {options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.label}
          </option>
        ))}
      </select>
      <Hint id={id} text={hint} />
    </div>
  );
}

function Hint({ id, text }: { id: string; text: string | undefined }) {
  return text === undefined ? null : (
    <span className="hint" id={`${id}hint`}>
      {text}
    </span>
  );
}
