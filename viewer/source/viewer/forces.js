/* Forces as arrows: once faintly through everything, once where they are really seen. */

import { DynamicDrawUsage, InstancedBufferAttribute, InstancedMesh, Group, Matrix4, MeshPhongMaterial, Quaternion, Vector3 } from "three";
import { arrow } from "./meshes.js";

const COLOR = 0xdb291f;
const SEEN_THROUGH = 0.28;
const Y = new Vector3(0, 1, 0), point = new Vector3(), force = new Vector3(), scale = new Vector3();
const turn = new Quaternion(), matrix = new Matrix4();

export class Forces {
  /** radius: of the scene; largest: force of the longest arrow. */
  constructor(radius, largest) {
    this.radius = radius;
    this.largest = largest;
    this.object = new Group();
    const geometry = arrow();
    geometry.computeVertexNormals();
    this.geometry = geometry;
    this.materials = [
      new MeshPhongMaterial({ color: COLOR, transparent: true, opacity: SEEN_THROUGH, depthTest: false, depthWrite: false }),
      new MeshPhongMaterial({ color: COLOR, transparent: true }),
    ];
    this.makeRoom(64);
  }

  makeRoom(count) {
    this.object.clear();
    const matrices = new InstancedBufferAttribute(new Float32Array(16 * count), 16).setUsage(DynamicDrawUsage);
    this.meshes = this.materials.map((material, k) => {
      const mesh = new InstancedMesh(this.geometry, material, 0);
      mesh.instanceMatrix = matrices;
      mesh.frustumCulled = false;
      mesh.renderOrder = 4 + k;
      this.object.add(mesh);
      return mesh;
    });
    this.room = count;
  }

  /** Shows forces: arrays of six numbers, point and force in world axes. Returns how many are large enough to be seen. */
  show(forces) {
    if (forces.length > this.room) this.makeRoom(2 * forces.length);
    let count = 0;
    for (const each of forces) {
      const size = force.set(each[3], each[4], each[5]).length();
      if (!(size > this.largest * 1e-4)) continue;
      const length = this.radius * (0.12 + 0.55 * Math.sqrt(size / this.largest));
      turn.setFromUnitVectors(Y, force.divideScalar(size));
      matrix.compose(point.set(each[0], each[1], each[2]), turn, scale.setScalar(length));
      matrix.toArray(this.meshes[0].instanceMatrix.array, 16 * count);
      count += 1;
    }
    for (const mesh of this.meshes) mesh.count = count;
    this.meshes[0].instanceMatrix.needsUpdate = true;
    return count;
  }
}
