// The parameters of a method, each with the input that its values ask for.

import type { Method, Parameter } from "../../api/types";
import { NumberField, SelectField } from "../../ui/fields";
import { keyOf, labelOf, textOf } from "./methods";

/** So many parameters are shown at once. */
const SHOWN = 4;

interface Props {
  method: Method;
  texts: Readonly<Record<string, string>>;
  change: (key: string, text: string) => void;
}

export function MethodParameters({ method, texts, change }: Props) {
  const field = (parameter: Parameter) => {
    const key = keyOf(method, parameter);
    const value = texts[key] ?? textOf(parameter.default);
    return <ParameterField key={key} parameter={parameter} value={value} onChange={(text) => change(key, text)} />;
  };
  const { parameters } = method;
  return (
    <>
      <div className="fields">{parameters.slice(0, SHOWN).map(field)}</div>
      {parameters.length > SHOWN && (
        <details style={{ marginTop: 12 }}>
          <summary>More parameters</summary>
          <div className="fields">{parameters.slice(SHOWN).map(field)}</div>
        </details>
      )}
    </>
  );
}

interface FieldProps {
  parameter: Parameter;
  value: string;
  onChange: (text: string) => void;
}

function ParameterField({ parameter, value, onChange }: FieldProps) {
  const { type, optional, purpose, minimum, maximum } = parameter;
  const common = { label: labelOf(parameter), hint: purpose, required: !optional, value, onChange };
  if (type === "integer" || type === "number") {
    return (
      <NumberField
        {...common}
        step={type === "integer" ? 1 : "any"}
        {...(minimum == null ? {} : { min: minimum })}
        {...(maximum == null ? {} : { max: maximum })}
      />
    );
  }
  const options = type === "choice" ? parameter.options : ["false", "true"];
  const labels: Record<string, string> = { false: "no", true: "yes", "": "any" };
  const all = optional ? ["", ...options] : options;
  return (
    <SelectField
      {...common}
      options={all.map((option) => ({ value: option, label: labels[option] ?? option.replaceAll("_", " ") }))}
    />
  );
}
