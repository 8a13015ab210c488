// Min-max decimation: a drawn curve keeps its extremes and its ends, however many samples it has.

/** Indices (increasing) of at most `maxPoints` samples of `values`: the ends, and each bucket's minimum and maximum. */
export function decimateMinMax(values: ArrayLike<number>, maxPoints: number): number[] {
  const count = values.length;
  if (maxPoints < 4) throw new RangeError(`at least 4 points are needed to decimate, not ${maxPoints}`);
  if (count <= maxPoints) return Array.from({ length: count }, (_, index) => index);

  const buckets = Math.floor((maxPoints - 2) / 2);
  const kept = [0];
  for (let bucket = 0; bucket < buckets; bucket += 1) {
    const from = 1 + Math.floor((bucket * (count - 2)) / buckets);
    const to = 1 + Math.floor(((bucket + 1) * (count - 2)) / buckets);
    const [low, high] = extremes(values, from, to);
    kept.push(Math.min(low, high));
    if (low !== high) kept.push(Math.max(low, high));
  }
  kept.push(count - 1);
  return kept;
}

function extremes(values: ArrayLike<number>, from: number, to: number): [low: number, high: number] {
  let low = from;
  let high = from;
  for (let index = from + 1; index < to; index += 1) {
    const value = values[index] ?? Number.NaN;
    if (value < (values[low] ?? Number.NaN)) low = index;
    if (value > (values[high] ?? Number.NaN)) high = index;
  }
  return [low, high];
}
