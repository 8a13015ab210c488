// The 3-D stage: camera, lights, floor, rendering on demand. Knows nothing about robots. ROS axes: x forward, z up, metres.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { token } from "../charts/theme";

export type View = "perspective" | "front" | "side" | "top";

const DIRECTIONS: Record<View, readonly [number, number, number]> = {
  perspective: [-0.6, -1.2, 0.55],
  front: [1, 0, 0.001],
  side: [0, -1, 0.001],
  top: [-0.001, 0, 1],
};

export class Stage {
  readonly root = new THREE.Group();
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
  private readonly renderer: THREE.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly observer: ResizeObserver;
  private readonly host: HTMLElement;
  private frame = 0;
  private floorHeight = 0;

  /** Throws if the browser has no WebGL. */
  constructor(host: HTMLElement) {
    this.host = host;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.domElement.tabIndex = 0;
    this.renderer.domElement.setAttribute("role", "img");
    host.append(this.renderer.domElement);

    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.listenToKeyEvents(this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());

    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(2, -3, 5);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x667788, 2.0), sun, this.root);
    this.recolor();

    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(host);
    this.resize();
  }

  /** Sets the text alternative of the picture. */
  describe(text: string): void {
    this.renderer.domElement.setAttribute("aria-label", text);
  }

  /** Applies the colours of the current scheme. */
  recolor(): void {
    this.scene.background = new THREE.Color(token("scene"));
    this.scene.getObjectByName("floor")?.removeFromParent();
    const floor = new THREE.GridHelper(4, 16, token("border-strong"), token("border"));
    floor.name = "floor";
    floor.rotateX(Math.PI / 2);
    floor.position.z = this.floorHeight;
    this.scene.add(floor);
    this.draw();
  }

  /** Moves the camera to see everything from one side. */
  fit(view: View): void {
    const box = new THREE.Box3().setFromObject(this.root);
    if (box.isEmpty()) box.set(new THREE.Vector3(-0.5, -0.5, 0), new THREE.Vector3(0.5, 0.5, 1));
    this.setFloor(box.min.z);
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const narrow = Math.min(1, this.camera.aspect);
    const distance = sphere.radius / Math.sin(THREE.MathUtils.degToRad(this.camera.fov / 2)) / narrow;
    const direction = new THREE.Vector3(...DIRECTIONS[view]).normalize();
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance * 0.82);
    this.controls.target.copy(sphere.center);
    this.controls.update();
    this.draw();
  }

  /** Requests a render in the next animation frame; cheap to call often. */
  draw(): void {
    if (this.frame === 0) {
      this.frame = requestAnimationFrame(() => {
        this.frame = 0;
        this.renderer.render(this.scene, this.camera);
      });
    }
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.observer.disconnect();
    this.controls.dispose();
    disposeAll(this.scene);
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  /** Below everything that stands there. */
  private setFloor(height: number): void {
    this.floorHeight = height - 0.002;
    const floor = this.scene.getObjectByName("floor");
    if (floor !== undefined) floor.position.z = this.floorHeight;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}

/** Releases the GPU resources of an object and its descendants. */
export function disposeAll(object: THREE.Object3D): void {
  object.traverse((node) => {
    if (!(node instanceof THREE.Mesh || node instanceof THREE.Line)) return;
    const drawn = node as THREE.Mesh;
    drawn.geometry.dispose();
    for (const material of [drawn.material].flat()) material.dispose();
  });
}
