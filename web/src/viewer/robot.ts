// A robot built from its URDF. Meshes are not stored on the server: a link without a primitive shape is drawn as bones to
// its child links, so that every robot can be seen moving.

import * as THREE from "three";
import URDFLoader, { type URDFJoint, type URDFLink, type URDFRobot } from "urdf-loader";
import { token } from "../charts/theme";
import { disposeAll } from "./scene";

/** The tool's mounting and the values of joints that no trajectory moves. */
export interface Mounting {
  baseLink: string | null;
  tipLink: string | null;
  toolOffset: readonly [number, number, number];
  fixed: Readonly<Record<string, number>>;
}

export class RobotFigure {
  readonly object: URDFRobot;
  /** Number of meshes in the URDF that are not shown. */
  readonly missingMeshes: number;
  private readonly tip: THREE.Object3D;
  private readonly base: THREE.Object3D;
  private readonly tool: THREE.Vector3;

  /** Throws if the text is not a URDF. */
  constructor(urdf: string, mounting: Mounting) {
    let missing = 0;
    const loader = new URDFLoader();
    loader.parseCollision = false;
    loader.loadMeshCb = (_url, _manager, _material, done) => {
      missing += 1;
      done(new THREE.Object3D());
    };
    this.object = loader.parse(urdf);
    this.missingMeshes = missing;
    this.tip = (mounting.tipLink === null ? undefined : this.object.links[mounting.tipLink]) ?? lastLink(this.object);
    this.base = (mounting.baseLink === null ? undefined : this.object.links[mounting.baseLink]) ?? this.object;
    this.tool = new THREE.Vector3(...mounting.toolOffset);
    this.dress();
    this.pose(mounting.fixed);
  }

  /** Sets joints by name, rad or m. Limits are not enforced, so that the executed poses are shown as they were. */
  pose(joints: Readonly<Record<string, number>>): void {
    for (const [name, value] of Object.entries(joints)) {
      const joint = this.object.joints[name];
      if (joint === undefined) continue;
      joint.ignoreLimits = true;
      joint.setJointValue(value);
    }
    this.object.updateMatrixWorld(true);
  }

  /** The tool centre point in the world, metres. */
  toolPoint(): THREE.Vector3 {
    return this.tip.localToWorld(this.tool.clone());
  }

  /** A point of the chain's base frame in the world, metres. */
  fromBase(point: readonly [number, number, number]): THREE.Vector3 {
    return this.base.localToWorld(new THREE.Vector3(...point));
  }

  dispose(): void {
    this.object.removeFromParent();
    disposeAll(this.object);
  }

  private dress(): void {
    const body = new THREE.MeshStandardMaterial({ color: token("robot"), roughness: 0.75, metalness: 0.05 });
    const joint = new THREE.MeshStandardMaterial({ color: token("robot-joint"), roughness: 0.6, metalness: 0.1 });
    for (const link of Object.values(this.object.links)) {
      const shapes = shapesOf(link);
      for (const shape of shapes) if (!hasOwnColor(shape)) shape.material = body;
      if (shapes.length === 0) this.addBones(link, body, joint);
    }
    if (this.tool.lengthSq() > 1e-6) this.tip.add(bone(this.tool, body));
    const point = new THREE.Mesh(new THREE.SphereGeometry(0.018, 20, 14), new THREE.MeshStandardMaterial({ color: token("trail") }));
    point.position.copy(this.tool);
    this.tip.add(point);
  }

  private addBones(link: URDFLink, body: THREE.Material, jointMaterial: THREE.Material): void {
    for (const child of link.children as (URDFJoint | THREE.Object3D)[]) {
      if (!("isURDFJoint" in child)) continue;
      if (child.position.lengthSq() > 1e-6) link.add(bone(child.position, body));
      if (child.jointType !== "fixed") {
        const knob = new THREE.Mesh(new THREE.SphereGeometry(0.026, 20, 14), jointMaterial);
        knob.position.copy(child.position);
        link.add(knob);
      }
    }
  }
}

/** Whether the URDF gives the shape a material; the loader leaves others white. */
function hasOwnColor(shape: THREE.Mesh): boolean {
  const material = [shape.material].flat()[0];
  return material instanceof THREE.MeshPhongMaterial && material.color.getHex() !== 0xffffff;
}

function shapesOf(link: URDFLink): THREE.Mesh[] {
  const found: THREE.Mesh[] = [];
  for (const child of link.children) {
    if ("isURDFJoint" in child) continue;
    child.traverse((node) => {
      if (node instanceof THREE.Mesh) found.push(node as THREE.Mesh);
    });
  }
  return found;
}

/** A slim capsule from the origin to `end`. */
function bone(end: THREE.Vector3, material: THREE.Material): THREE.Mesh {
  const length = end.length();
  const mesh = new THREE.Mesh(new THREE.CapsuleGeometry(Math.min(0.022, length / 4), length, 6, 14), material);
  mesh.position.copy(end).multiplyScalar(0.5);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), end.clone().normalize());
  return mesh;
}

function lastLink(robot: URDFRobot): THREE.Object3D {
  return Object.values(robot.links).findLast((link) => !link.children.some((child) => "isURDFJoint" in child)) ?? robot;
}
