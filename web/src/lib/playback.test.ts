import { describe, expect, it } from "vitest";
import { indexAt, named, passedBy, positionsAt } from "./playback";

const points = [
  { t_s: 0, positions: [0, 1] },
  { t_s: 1, positions: [2, 1] },
  { t_s: 3, positions: [2, 5] },
];

describe("positionsAt", () => {
  it.each([
    [-1, [0, 1]],
    [0.5, [1, 1]],
    [1, [2, 1]],
    [2, [2, 3]],
    [9, [2, 5]],
  ])("at %d s", (time, positions) => {
    expect(positionsAt(points, time)).toEqual(positions);
  });

  it("is empty without points", () => {
    expect(positionsAt([], 1)).toEqual([]);
  });
});

it("finds the point before a time", () => {
  expect([-1, 0, 0.99, 1, 2.9, 3, 7].map((time) => indexAt(points, time))).toEqual([0, 0, 0, 1, 1, 2, 2]);
});

it("counts goals passed", () => {
  expect(passedBy([0.1, 0.3, 0.9], 0.1 + 0.2)).toBe(2);
});

it("pairs names with values", () => {
  expect(named(["a", "b"], [1, 2])).toEqual({ a: 1, b: 2 });
});
