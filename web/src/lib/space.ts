// Recognizes features that form a position in space and converts it to metres.

import type { Feature } from "../api/types";
import type { Point } from "./coverage";

const METRES: Readonly<Record<string, number>> = { m: 1, cm: 0.01, mm: 0.001 };

/** Returns a reader of a row's x, y, z in metres; null if the features do not form a position in one known unit. */
export function positionReader(features: readonly Feature[]): ((row: readonly number[]) => Point) | null {
  const axes = ["x", "y", "z"].map((name) => features.findIndex((feature) => feature.name.toLowerCase() === name));
  const scales = axes.map((axis) => METRES[features[axis]?.unit ?? ""]);
  const [x, y, z] = axes;
  const [sx, sy, sz] = scales;
  if (x === undefined || y === undefined || z === undefined) return null;
  if (sx === undefined || sy === undefined || sz === undefined) return null;
  return (row) => [(row[x] ?? 0) * sx, (row[y] ?? 0) * sy, (row[z] ?? 0) * sz];
}
