/* What is drawn: the machine, forces, floor, light and air. */

import { Color, DirectionalLight, Fog, HemisphereLight, Matrix4, Scene, Vector3 } from "three";
import { Floor } from "./floor.js";
import { Forces } from "./forces.js";
import { KnownSizes } from "./known_sizes.js";
import { Machine } from "./machine.js";

const HAZE = 0xb8c7db;
const SHADOW_SIZE = 2048, LEAST_SHADOW = 0.25;
// How far off its own shadow a surface is looked up, by the radius of what is seen: some pixels of the map, or it would shade itself.
const SHADOW_BIAS = 4e-3;

export class World {
  /** data: bodies with meshes, up, center, radius, floor and largestForce as in animation.py. */
  constructor(data) {
    const { radius } = data;
    this.data = data;
    this.scene = new Scene();
    this.center = new Vector3(...data.center);
    this.up = new Vector3(...data.up).normalize();
    this.side = (Math.abs(this.up.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).projectOnPlane(this.up).normalize();
    this.front = new Vector3().crossVectors(this.up, this.side);
    const frame = new Matrix4().makeBasis(this.side, this.front, this.up);
    this.machine = new Machine(data.bodies);
    this.forces = new Forces(radius, data.largestForce);
    this.floor = new Floor(radius, frame);
    this.known = new KnownSizes(radius);
    this.known.object.setRotationFromMatrix(frame);
    this.fog = new Fog(HAZE);
    this.scene.add(this.machine.object, this.forces.object, this.floor.object, this.known.object);
    this.makeLight();
  }

  makeLight() {
    const sky = new HemisphereLight(new Color(0.42, 0.45, 0.5), new Color(0.2, 0.18, 0.17), Math.PI);
    sky.position.copy(this.up);
    this.sun = new DirectionalLight(new Color(1, 0.97, 0.92), 0.78 * Math.PI);
    this.fill = new DirectionalLight(0xffffff, 0.16 * Math.PI);
    this.direction = this.up.clone().multiplyScalar(1.5).addScaledVector(this.side, 0.55).addScaledVector(this.front, -0.75).normalize();
    const { radius } = this.data, reach = 1.35 * radius, shadow = this.sun.shadow;
    Object.assign(shadow.camera, { left: -reach, right: reach, bottom: -reach, top: reach, near: 0.1 * radius, far: 8 * radius });
    shadow.camera.up.copy(this.front);
    shadow.normalBias = SHADOW_BIAS * radius;
    shadow.bias = -5e-4;
    this.scene.add(sky, this.sun, this.sun.target, this.fill, this.fill.target);
  }

  /** Draws shadows with this share of their resolution, up to 1; = true, if they must be drawn anew for that. */
  sharpen(share) {
    const { shadow } = this.sun, size = SHADOW_SIZE * Math.max(share, LEAST_SHADOW);
    if (shadow.mapSize.x === size) return false;
    shadow.mapSize.set(size, size);
    shadow.normalBias = SHADOW_BIAS * this.data.radius * SHADOW_SIZE / size;
    shadow.map?.dispose();
    shadow.map = null;
    return true;
  }

  /** What is switched on: edges, floor, forces, and the cues shading, shadows, aerial, texture and knownSizes. */
  apply(shown, dark) {
    this.machine.apply(shown);
    this.floor.object.visible = shown.floor;
    this.floor.grid.visible = shown.texture;
    this.floor.shadow.visible = this.sun.castShadow = shown.shadows;
    this.floor.ink(dark);
    this.forces.object.visible = shown.forces;
    this.known.object.visible = shown.knownSizes;
    this.scene.fog = shown.aerial ? this.fog : null;
  }

  /** Moves light, floor and air along with what is looked at: way is how far the machine went, rig the camera in the middle. */
  arrange(way, rig, distance) {
    const { radius, floor } = this.data, center = this.center.clone().add(way);
    this.machine.arrange(center);
    this.sun.position.copy(center).addScaledVector(this.direction, 4 * radius);
    this.sun.target.position.copy(center);
    this.fill.position.copy(rig.position);
    this.fill.target.position.copy(center);
    this.floor.place(center, floor - 2e-4 * radius);
    this.known.object.position.copy(center).projectOnPlane(this.up).addScaledVector(this.up, floor);
    this.fog.near = Math.max(0, distance - 1.5 * radius);
    this.fog.far = this.fog.near + 6 * radius;
  }
}
