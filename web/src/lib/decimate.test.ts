import { describe, expect, it } from "vitest";
import { decimateMinMax } from "./decimate";

const wave = Array.from({ length: 10_000 }, (_, index) => Math.sin(index / 50) + (index === 4321 ? 9 : 0));

describe("decimateMinMax", () => {
  it("keeps everything that fits", () => {
    expect(decimateMinMax([3, 1, 2], 4)).toEqual([0, 1, 2]);
  });

  it("keeps the ends and the extremes within the budget", () => {
    const kept = decimateMinMax(wave, 200);
    expect(kept.length).toBeLessThanOrEqual(200);
    expect(kept[0]).toBe(0);
    expect(kept.at(-1)).toBe(9999);
    expect(kept).toContain(4321);
    expect(Math.min(...kept.map((index) => wave[index] ?? 0))).toBe(Math.min(...wave));
  });

  it("returns strictly increasing indices", () => {
    const kept = decimateMinMax(wave, 37);
    expect(kept.every((index, at) => at === 0 || index > (kept[at - 1] ?? index))).toBe(true);
  });

  it("refuses a budget that cannot hold ends and extremes", () => {
    expect(() => decimateMinMax(wave, 3)).toThrow(RangeError);
  });
});
