/* The machine: all bodies drawn at once, each at its pose. */

import {
  BufferAttribute, Color, DetachedBindMode, DoubleSide, Group, LineBasicMaterial, LineSegments, Matrix4, MeshBasicMaterial, MeshPhongMaterial,
  Object3D, Quaternion, Skeleton, SkinnedMesh, SRGBColorSpace, Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { decodeArray } from "../arrays.js";
import "./rigid_bones.js";
import { coarser } from "./coarse.js";
import { surface } from "./meshes.js";

const LINE = { color: 0x0f141f, transparent: true, opacity: 0.62 };
const ONE = new Vector3(1, 1, 1);
// Triangles of all bodies where pictures must keep up.
const COARSE_TRIANGLES = 1500;

/**
 * A call to the graphics card costs as much as hundreds of triangles, so that the faces of all bodies are one mesh and their edges another:
 * each vertex follows the bone that stands for its body. Bones lie relative to `origin`, near which single precision is fine.
 */
export class Machine {
  /** bodies: with meshes as in animation.py. */
  constructor(bodies) {
    const faces = [], edges = [];
    this.ranges = [];
    let begin = 0;
    bodies.forEach(({ meshes }, k) => {
      for (const mesh of meshes) {
        const drawn = surface(decodeArray(mesh.vertices, Float32Array), decodeArray(mesh.triangles, Uint32Array));
        this.ranges.push([begin, begin += drawn.faces.index.count]);
        faces.push(colored(following(drawn.faces, k), new Color().setRGB(...mesh.color, SRGBColorSpace)));
        if (drawn.edges) edges.push(following(drawn.edges, k));
      }
    });
    this.object = new Group();
    this.places = bodies.map(() => ({ position: new Vector3(), turn: new Quaternion() }));
    const bones = bodies.map(() => new Object3D());
    this.skeleton = new Skeleton(bones, bones.map(() => new Matrix4()));
    const look = { vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    this.materials = { shaded: new MeshPhongMaterial({ ...look, specular: 0x0c0c0c, shininess: 48 }), flat: new MeshBasicMaterial(look) };
    if (faces.length) {
      this.faces = this.add(new SkinnedMesh(mergeGeometries(faces), this.materials.shaded));
      this.fine = this.faces.geometry.index;
      this.faces.castShadow = this.faces.receiveShadow = true;
    }
    if (edges.length) {
      this.edges = this.add(new SkinnedLines(mergeGeometries(edges), new LineBasicMaterial(LINE)));
      this.edges.renderOrder = 1;
    }
  }

  add(mesh) {
    mesh.bindMode = DetachedBindMode;
    mesh.bind(this.skeleton, new Matrix4());
    mesh.frustumCulled = false;
    this.object.add(mesh);
    return mesh;
  }

  /** Draws few triangles, or all. */
  thin(on) {
    if (!this.faces) return;
    if (on) this.coarse ??= this.coarseIndex();
    this.faces.geometry.setIndex(on ? this.coarse : this.fine);
  }

  /** Of each mesh the same share of triangles. */
  coarseIndex() {
    const { geometry } = this.faces, { position, normal } = geometry.attributes, kept = [];
    const share = COARSE_TRIANGLES / (this.fine.count / 3);
    for (const [begin, end] of this.ranges) kept.push(coarser(position, normal, this.fine.array.subarray(begin, end), share));
    return new BufferAttribute(new Uint32Array(kept.flatMap(part => [...part])), 1);
  }

  /** Puts a body at a pose: position and quaternion x y z w, body to world. */
  place(body, pose) {
    this.places[body].position.set(pose[0], pose[1], pose[2]);
    this.places[body].turn.set(pose[3], pose[4], pose[5], pose[6]);
  }

  /** Shows edges and shading, or not; as in World.apply. */
  apply(shown) {
    if (this.faces) this.faces.material = shown.shading ? this.materials.shaded : this.materials.flat;
    if (this.edges) this.edges.visible = shown.edges;
  }

  /** Before a picture: origin is a point near what is looked at. */
  arrange(origin) {
    this.object.position.copy(origin);
    const near = new Vector3();
    this.places.forEach(({ position, turn }, k) => {
      this.skeleton.bones[k].matrixWorld.compose(near.subVectors(position, origin), turn, ONE);
    });
  }
}

/** Lines that follow bones; three.js has such meshes alone, but its shader of lines can do it. */
class SkinnedLines extends LineSegments {
  isSkinnedMesh = true;
  bindMatrix = new Matrix4();
  bindMatrixInverse = new Matrix4();

  bind(skeleton) {
    this.skeleton = skeleton;
  }
}

/** Has each vertex of a geometry follow one bone. */
function following(geometry, bone) {
  const { count } = geometry.getAttribute("position"), bones = new Uint16Array(4 * count), weights = new Float32Array(4 * count);
  for (let k = 0; k < 4 * count; k += 4) [bones[k], weights[k]] = [bone, 1];
  geometry.setAttribute("skinIndex", new BufferAttribute(bones, 4));
  geometry.setAttribute("skinWeight", new BufferAttribute(weights, 4));
  return geometry;
}

function colored(geometry, { r, g, b }) {
  const { count } = geometry.getAttribute("position"), colors = new Float32Array(3 * count);
  for (let k = 0; k < 3 * count; k += 3) [colors[k], colors[k + 1], colors[k + 2]] = [r, g, b];
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  return geometry;
}
