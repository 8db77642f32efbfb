/* The floor: a grid whose lines are thinner and denser the farther away, and the shadows on it. */

import {
  CanvasTexture, CircleGeometry, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial, RepeatWrapping,
  RingGeometry, ShadowMaterial, SRGBColorSpace,
} from "three";

const TILE = 1024;
const CELLS = 5;
const INK = { light: [0x1f2b42, 0.85, 0.3], dark: [0x05080d, 1, 0.45] };

export class Floor {
  /** radius: of the scene; frame: rotation from (x, y, z) to two directions along the floor and up. */
  constructor(radius, frame, anisotropy) {
    this.tile = CELLS * Math.pow(10, Math.floor(Math.log10(radius / 2)));
    this.frame = frame;
    this.object = new Group();
    this.object.setRotationFromMatrix(frame);
    const texture = new CanvasTexture(drawTile());
    Object.assign(texture, { wrapS: RepeatWrapping, wrapT: RepeatWrapping, anisotropy, colorSpace: SRGBColorSpace });
    const flat = { side: DoubleSide, depthWrite: false, transparent: true };
    this.grid = new Mesh(disc(12 * radius, this.tile), new MeshBasicMaterial({ map: texture, vertexColors: true, ...flat }));
    this.shadow = new Mesh(new CircleGeometry(6 * radius, 32), new ShadowMaterial(flat));
    this.shadow.receiveShadow = true;
    this.grid.renderOrder = 3;
    this.shadow.renderOrder = 2;
    this.object.add(this.grid, this.shadow);
  }

  /** Puts the floor below a point, lines through the world's origin. */
  place(point, height) {
    const { frame, tile, object } = this;
    const local = point.clone().applyMatrix4(frame.clone().transpose());
    object.position.set(Math.round(local.x / tile) * tile, Math.round(local.y / tile) * tile, height).applyMatrix4(frame);
  }

  ink(dark) {
    const [color, strength, shade] = INK[dark ? "dark" : "light"];
    this.grid.material.color.set(color);
    this.grid.material.opacity = strength;
    this.shadow.material.opacity = shade;
  }
}

/** White lines on nothing: a strong one around, weaker ones between. */
function drawTile() {
  const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
  canvas.width = canvas.height = TILE;
  for (let line = 0; line <= CELLS; line++) {
    const strong = line % CELLS === 0, width = strong ? 10 : 6, at = line * TILE / CELLS;
    context.fillStyle = `rgba(255, 255, 255, ${strong ? 0.38 : 0.2})`;
    context.fillRect(at - width / 2, 0, width, TILE);
    context.fillRect(0, at - width / 2, TILE, width);
  }
  return canvas;
}

/** A disc that fades towards its rim, with a texture every so many metres. */
function disc(radius, tile) {
  const geometry = new RingGeometry(0, radius, 64, 12), position = geometry.getAttribute("position"), colors = [], places = [];
  for (let k = 0; k < position.count; k++) {
    const [x, y] = [position.getX(k), position.getY(k)], out = Math.min(1, Math.max(0, (Math.hypot(x, y) / radius - 0.15) / 0.85));
    colors.push(1, 1, 1, 1 - out * out * (3 - 2 * out));
    places.push(x / tile, y / tile);
  }
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 4));
  geometry.setAttribute("uv", new Float32BufferAttribute(places, 2));
  return geometry;
}
