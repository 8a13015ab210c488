// Objects drawn around a robot: the tool's trail, goals in space, the wall's cells.

import * as THREE from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { token } from "../charts/theme";

/** A line through points in the world frame, bold up to one of them and faint beyond. */
export class Trail {
  readonly object = new THREE.Group();
  private readonly done: Line2;
  private readonly segments: number;

  constructor(points: readonly THREE.Vector3[]) {
    this.segments = Math.max(0, points.length - 1);
    this.done = thickLine(points, 3.5, 1);
    if (this.segments > 0) this.object.add(thickLine(points, 2, 0.35), this.done);
  }

  /** Draws the part up to point `index` bold. */
  showUpTo(index: number): void {
    this.done.geometry.instanceCount = Math.max(0, Math.min(this.segments, index));
  }
}

/** A line whose width is in pixels. */
function thickLine(points: readonly THREE.Vector3[], width: number, opacity: number): Line2 {
  const geometry = new LineGeometry();
  geometry.setPositions(points.flatMap((point) => point.toArray()));
  return new Line2(geometry, new LineMaterial({ color: token("trail"), linewidth: width, transparent: opacity < 1, opacity }));
}

/** Goals in space, each a small sphere, joined by a thin line in order. */
export function goalMarks(points: readonly THREE.Vector3[]): THREE.Group {
  const group = new THREE.Group();
  const material = new THREE.MeshStandardMaterial({ color: token("goal"), roughness: 0.5 });
  const sphere = new THREE.SphereGeometry(0.014, 16, 12);
  for (const point of points) {
    const mark = new THREE.Mesh(sphere, material);
    mark.position.copy(point);
    group.add(mark);
  }
  const line = new THREE.LineDashedMaterial({ color: token("goal"), dashSize: 0.02, gapSize: 0.015 });
  const path = new THREE.Line(new THREE.BufferGeometry().setFromPoints([...points]), line);
  path.computeLineDistances();
  group.add(path);
  return group;
}

/** One cell of a wall, in the world frame. */
export interface CellShape {
  centre: THREE.Vector3;
  column: THREE.Vector3;
  row: THREE.Vector3;
}

/** The wall: flat cells that change colour once painted. */
export class Wall {
  readonly object = new THREE.Group();
  private readonly cells: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>[];

  constructor(shapes: readonly CellShape[]) {
    this.cells = shapes.map((shape) => {
      const material = new THREE.MeshStandardMaterial({ side: THREE.DoubleSide, transparent: true, opacity: 0.9, roughness: 0.9 });
      return new THREE.Mesh(square(shape), material);
    });
    if (this.cells.length > 0) this.object.add(...this.cells);
    this.paint(new Set());
  }

  /** Shows the cells with these indices as painted, the others not. */
  paint(painted: ReadonlySet<number>): void {
    this.cells.forEach((cell, index) => {
      cell.material.color.set(token(painted.has(index) ? "cell-painted" : "cell"));
      cell.material.opacity = painted.has(index) ? 0.95 : 0.6;
    });
  }
}

function square({ centre, column, row }: CellShape): THREE.BufferGeometry {
  const corner = (a: number, b: number) => centre.clone().addScaledVector(column, a * 0.46).addScaledVector(row, b * 0.46);
  const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  const geometry = new THREE.BufferGeometry().setFromPoints(corners);
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.computeVertexNormals();
  return geometry;
}
