import { expect, it } from "vitest";
import { join } from "./join";

it("lays curves on a common x with gaps", () => {
  const joined = join([
    { x: [0, 2], y: [10, 12] },
    { x: [1, 2], y: [null, 22] },
  ]);
  expect(joined.x).toEqual([0, 1, 2]);
  expect(joined.columns).toEqual([
    [10, null, 12],
    [null, null, 22],
  ]);
});

it("is empty without curves", () => {
  expect(join([])).toEqual({ x: [], columns: [] });
});
