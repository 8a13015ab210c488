// Merges curves with different x onto a common x, as a chart requires.

export interface Points {
  x: readonly number[];
  y: readonly (number | null)[];
}

export interface Joined {
  x: number[];
  /** One column per curve; null at an x where the curve has no value. */
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
