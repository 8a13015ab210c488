import { expect, it } from "vitest";
import { positionReader } from "./space";

const feature = (name: string, unit: string) => ({ name, unit });

it("reads millimetres and metres in any column order", () => {
  const read = positionReader([feature("z", "mm"), feature("X", "m"), feature("y", "mm")]);
  expect(read?.([300, 1.1, -500])).toEqual([1.1, -0.5, 0.3]);
});

it("refuses features without a position, and positions of unknown unit", () => {
  expect(positionReader([feature("painted", "%")])).toBeNull();
  expect(positionReader([feature("x", ""), feature("y", "m"), feature("z", "m")])).toBeNull();
});
