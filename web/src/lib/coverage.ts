// Cells of a wall painted by a tool: those whose centre is strictly closer than the radius to a visited pose.

export type Point = readonly [number, number, number];

export interface WallGrid {
  origin_m: readonly number[];
  column_step_m: readonly number[];
  row_step_m: readonly number[];
  columns: number;
  rows: number;
  radius_m: number;
}

const at = (values: readonly number[], index: number) => values[index] ?? 0;

/** Centres of all cells, row by row, in the base frame, metres. */
export function cellCentres(grid: WallGrid): Point[] {
  const along = (axis: number, column: number, row: number) =>
    at(grid.origin_m, axis) + column * at(grid.column_step_m, axis) + row * at(grid.row_step_m, axis);
  return Array.from({ length: grid.rows * grid.columns }, (_, index) => {
    const column = index % grid.columns;
    const row = Math.floor(index / grid.columns);
    return [along(0, column, row), along(1, column, row), along(2, column, row)];
  });
}

/** For each cell, the index of the first visited point that painted it, or null. */
export function paintedBy(grid: WallGrid, visited: readonly Point[]): (number | null)[] {
  return cellCentres(grid).map((centre) => {
    const first = visited.findIndex((point) => distance(point, centre) < grid.radius_m);
    return first < 0 ? null : first;
  });
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
