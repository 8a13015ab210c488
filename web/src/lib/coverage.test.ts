import { describe, expect, it } from "vitest";
import { cellCentres, paintedBy, type WallGrid } from "./coverage";

// The paper's wall: 4 x 4 cells 0.2 m apart.
const wall: WallGrid = {
  origin_m: [0.6, -0.8, 0.32],
  column_step_m: [0, 0.2, 0],
  row_step_m: [0, 0, 0.2],
  columns: 4,
  rows: 4,
  radius_m: 0.13,
};

describe("coverage", () => {
  it("lays the cells row by row", () => {
    const centres = cellCentres(wall);
    expect(centres).toHaveLength(16);
    expect(centres[5]?.map((value) => Number(value.toFixed(9)))).toEqual([0.6, -0.6, 0.52]);
  });

  it("names the first pose that reached a cell", () => {
    const first = paintedBy(wall, [
      [0.6, -0.8, 0.32],
      [0.6, -0.7, 0.32],
    ]);
    expect(first[0]).toBe(0);
    expect(first[1]).toBe(1);
    expect(first.filter((index) => index !== null)).toHaveLength(2);
  });

  it("does not paint a cell at exactly the radius", () => {
    expect(paintedBy({ ...wall, radius_m: 0.25 }, [[0.35, -0.8, 0.32]])[0]).toBeNull();
  });
});
