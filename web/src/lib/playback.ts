// Sampling a trajectory at a point in time.

export interface TimedPositions {
  t_s: number;
  positions: readonly number[];
}

/** Index of the last point at or before `time`; 0 before the first. `points` must be sorted by time. */
export function indexAt(points: readonly TimedPositions[], time: number): number {
  let low = 0;
  let high = points.length - 1;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if ((points[middle]?.t_s ?? Infinity) <= time) low = middle;
    else high = middle - 1;
  }
  return Math.max(0, low);
}

/** Joint positions at `time`: linear between points, constant outside. */
export function positionsAt(points: readonly TimedPositions[], time: number): number[] {
  const index = indexAt(points, time);
  const from = points[index];
  const to = points[index + 1];
  if (from === undefined) return [];
  if (to === undefined || time <= from.t_s) return [...from.positions];
  const share = (time - from.t_s) / (to.t_s - from.t_s);
  return from.positions.map((value, joint) => value + share * ((to.positions[joint] ?? value) - value));
}

/** Pairs names with values, by position. */
export function named(names: readonly string[], values: readonly number[]): Record<string, number> {
  return Object.fromEntries(names.map((name, index) => [name, values[index] ?? 0]));
}

/** Number of goals or poses passed by `time`, within rounding error; whether goals are reached is the verdict's to say. */
export function passedBy(times: readonly number[], time: number): number {
  return times.filter((passed) => passed <= time + 1e-9).length;
}
