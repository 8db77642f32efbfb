/* What is drawn: bodies with their edges, forces, floor, light and air. */

import {
  Color, DirectionalLight, DoubleSide, Fog, Group, HemisphereLight, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial,
  MeshPhongMaterial, Scene, SRGBColorSpace, Vector3,
} from "three";
import { decodeArray } from "../arrays.js";
import { Floor } from "./floor.js";
import { Forces } from "./forces.js";
import { KnownSizes } from "./known_sizes.js";
import { surface } from "./meshes.js";

const HAZE = 0xb8c7db;
const SHADOW_SIZE = 2048;

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
    this.lineMaterial = new LineBasicMaterial({ color: 0x0f141f, transparent: true, opacity: 0.62 });
    this.lines = [];
    this.surfaces = [];
    this.bodies = data.bodies.map(body => this.makeBody(body));
    this.forces = new Forces(radius, data.largestForce);
    this.floor = new Floor(radius, frame);
    this.known = new KnownSizes(radius);
    this.known.object.setRotationFromMatrix(frame);
    this.fog = new Fog(HAZE);
    this.scene.add(...this.bodies, this.forces.object, this.floor.object, this.known.object);
    this.makeLight();
  }

  makeBody(body) {
    const group = new Group();
    for (const mesh of body.meshes) {
      const { faces, edges } = surface(decodeArray(mesh.vertices, Float32Array), decodeArray(mesh.triangles, Uint32Array));
      const color = new Color().setRGB(...mesh.color, SRGBColorSpace);
      const look = { color, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
      const shaded = new MeshPhongMaterial({ ...look, specular: 0x0c0c0c, shininess: 48 }), flat = new MeshBasicMaterial(look);
      const drawn = new Mesh(faces, shaded);
      drawn.castShadow = drawn.receiveShadow = true;
      group.add(drawn);
      this.surfaces.push({ drawn, shaded, flat });
      if (!edges) continue;
      const lines = new LineSegments(edges, this.lineMaterial);
      lines.renderOrder = 1;
      group.add(lines);
      this.lines.push(lines);
    }
    return group;
  }

  makeLight() {
    const sky = new HemisphereLight(new Color(0.42, 0.45, 0.5), new Color(0.2, 0.18, 0.17), Math.PI);
    sky.position.copy(this.up);
    this.sun = new DirectionalLight(new Color(1, 0.97, 0.92), 0.78 * Math.PI);
    this.fill = new DirectionalLight(0xffffff, 0.16 * Math.PI);
    this.direction = this.up.clone().multiplyScalar(1.5).addScaledVector(this.side, 0.55).addScaledVector(this.front, -0.75).normalize();
    const { radius } = this.data, reach = 1.35 * radius, shadow = this.sun.shadow;
    shadow.mapSize.set(SHADOW_SIZE, SHADOW_SIZE);
    Object.assign(shadow.camera, { left: -reach, right: reach, bottom: -reach, top: reach, near: 0.1 * radius, far: 8 * radius });
    shadow.camera.up.copy(this.front);
    shadow.normalBias = 4e-3 * radius;
    shadow.bias = -5e-4;
    this.scene.add(sky, this.sun, this.sun.target, this.fill, this.fill.target);
  }

  /** What is switched on: edges, floor, forces, and the cues shading, shadows, aerial, texture and knownSizes. */
  apply(shown, dark) {
    for (const { drawn, shaded, flat } of this.surfaces) drawn.material = shown.shading ? shaded : flat;
    for (const lines of this.lines) lines.visible = shown.edges;
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
