// The server's catalogue of methods, as the form needs it.

import type { Method, Parameter, World } from "../../api/types";

/** The methods that work in a world; all while none is chosen. */
export function methodsFor(methods: readonly Method[], world: World | undefined): readonly Method[] {
  return methods.filter(({ needs }) => world === undefined || meets(world.spec, needs));
}

function meets(world: World["spec"], { effects, reset }: Method["needs"]): boolean {
  const surface = world.kind === "coverage";
  if (effects === "smooth" && surface) return false;
  if (effects === "accumulating" && !surface) return false;
  return !(reset && surface && world.resets === false);
}

/** The name in words, with the unit: `max_step_deg` is "Max step (degrees)", `swarm.inertia` "Inertia". */
export function labelOf({ name, unit }: Parameter): string {
  const own = name.slice(name.lastIndexOf(".") + 1);
  const words = own.replace(/_(deg|m|s)$/, "").replaceAll("_", " ");
  const label = words.charAt(0).toUpperCase() + words.slice(1);
  return unit == null ? label : `${label} (${unit})`;
}

/** A default as an input shows it; nothing for `null`. */
export function textOf(value: unknown): string {
  return typeof value === "string" || typeof value === "number" || typeof value === "boolean" ? String(value) : "";
}

/** Where the text of a method's parameter is kept. */
export const keyOf = (method: Method, parameter: Parameter) => `${method.name}.${parameter.name}`;

/** The method with the parameters that were filled in; the others keep the server's defaults. */
export function requestOf(method: Method, texts: Readonly<Record<string, string>>): Record<string, unknown> {
  const request: Record<string, unknown> = { name: method.name };
  for (const parameter of method.parameters) {
    const text = texts[keyOf(method, parameter)];
    if (text !== undefined) put(request, parameter.name.split("."), valueOf(parameter, text));
  }
  return request;
}

/** Puts a value at its path into nested objects, which are made where they lack. */
function put(object: Record<string, unknown>, [key = "", ...rest]: readonly string[], value: unknown): void {
  if (rest.length === 0) {
    object[key] = value;
    return;
  }
  const inner = (object[key] ?? {}) as Record<string, unknown>;
  object[key] = inner;
  put(inner, rest, value);
}

function valueOf({ type }: Parameter, text: string): unknown {
  if (text.trim() === "") return null;
  if (type === "flag") return text === "true";
  return type === "choice" ? text : Number(text);
}
