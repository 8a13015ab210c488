// Several curves with their own x on one common x, as a chart needs them.

export interface Points {
  x: readonly number[];
  y: readonly (number | null)[];
}

export interface Joined {
  x: number[];
  /** One column for each curve; null where it has no value. */
  columns: (number | null)[][];
}

/** The sorted union of all x, and each curve's value there. */
export function join(curves: readonly Points[]): Joined {
  const x = [...new Set(curves.flatMap((curve) => [...curve.x]))].sort((a, b) => a - b);
  const columns = curves.map((curve) => {
    const at = new Map(curve.x.map((each, index) => [each, curve.y[index] ?? null]));
    return x.map((each) => at.get(each) ?? null);
  });
  return { x, columns };
}
