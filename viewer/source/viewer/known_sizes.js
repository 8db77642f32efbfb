/* Objects whose size everybody knows, beside the machine at several depths. */

import { CapsuleGeometry, CylinderGeometry, BoxGeometry, Group, Mesh, MeshPhongMaterial, SphereGeometry } from "three";

// Name, height in m, colour, and its parts as geometry that stands on z = 0, with the height of their middle.
const OBJECTS = [
  ["2 euro coin, 25.75 mm", 0.02575, 0xc9b26b, () => [[new CylinderGeometry(0.012875, 0.012875, 0.0022, 40), 0.012875]]],
  ["table-tennis ball, 40 mm", 0.04, 0xf4f1e8, () => [[new SphereGeometry(0.02, 32, 24), 0.02]]],
  ["football, 22 cm", 0.22, 0xf2f2f2, () => [[new SphereGeometry(0.11, 32, 24), 0.11]]],
  ["person, 1.75 m", 1.75, 0x5f7f9f, () => [
    [new CapsuleGeometry(0.17, 1.1, 8, 24).rotateX(Math.PI / 2), 0.72], [new SphereGeometry(0.11, 24, 16), 1.64]]],
  ["shipping container, 2.6 m high", 2.59, 0x9a4f3b, () => [[new BoxGeometry(2.44, 6.06, 2.59), 1.295]]],
];
const FITTING = [0.05, 3];

export class KnownSizes {
  /** radius: of the scene. */
  constructor(radius) {
    const off = ([, height]) => Math.abs(Math.log(height / (0.6 * radius)));
    const [name, height, color, parts] = OBJECTS.reduce((best, each) => off(each) < off(best) ? each : best);
    const share = height / radius;
    /** What stands there; "" if nothing that everybody knows is of about the machine's size. */
    this.name = share >= FITTING[0] && share <= FITTING[1] ? name : "";
    this.object = new Group();
    this.object.visible = false;
    if (!this.name) return;
    const material = new MeshPhongMaterial({ color });
    for (const [x, y] of [[1.1, -0.6], [-1.1, -0.4], [0.7, 1], [-0.6, 1.1]]) {
      for (const [geometry, middle] of parts()) {
        const mesh = new Mesh(geometry, material);
        mesh.position.set(x * radius, y * radius, middle);
        mesh.castShadow = mesh.receiveShadow = true;
        this.object.add(mesh);
      }
    }
  }
}
