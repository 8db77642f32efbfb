/* The floor: a grid whose lines are thinner and denser the farther away, and the shadows on it. */

import { CircleGeometry, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial, RingGeometry, ShadowMaterial } from "three";

const CELLS = 5;
const INK = { light: [0x1f2b42, 0.85, 0.3], dark: [0x05080d, 1, 0.45] };

export class Floor {
  /** radius: of the scene; frame: rotation from (x, y, z) to two directions along the floor and up. */
  constructor(radius, frame) {
    this.tile = CELLS * Math.pow(10, Math.floor(Math.log10(radius / 2)));
    this.frame = frame;
    this.object = new Group();
    this.object.setRotationFromMatrix(frame);
    const flat = { side: DoubleSide, depthWrite: false, transparent: true };
    this.grid = new Mesh(disc(12 * radius, this.tile), gridMaterial(flat));
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

/**
 * Lines, a strong one around each tile and weaker ones between. A pixel shows how much of it they cover: of lines one apart the exact share
 * of an interval, along and across, for which no renderer needs a texture's filters.
 */
const LINES = `
float covered(float at, float size, float width) {
  vec2 ends = at + 0.5 * width + 0.5 * vec2(-size, size), lines = width * floor(ends) + min(fract(ends), width);
  return (lines.y - lines.x) / size;
}
float grid(vec2 at, float width) {
  vec2 size = max(vec2(length(vec2(dFdx(at.x), dFdy(at.x))), length(vec2(dFdx(at.y), dFdy(at.y)))), 1e-6);
  float along = covered(at.x, size.x, width), across = covered(at.y, size.y, width);
  return along + across - along * across;
}`;
const STRONG = [0.012, 0.4], WEAK = [0.035, 0.23];

function gridMaterial(look) {
  const material = new MeshBasicMaterial({ vertexColors: true, ...look });
  const lines = ([width, strength], cells) => `${strength.toFixed(2)} * grid(vUv * ${cells.toFixed(1)}, ${width.toFixed(3)})`;
  material.defines = { USE_UV: "" };
  material.onBeforeCompile = shader => {
    shader.fragmentShader = shader.fragmentShader.replace("void main()", `${LINES}\nvoid main()`)
      .replace("#include <map_fragment>", `diffuseColor.a *= max(${lines(STRONG, 1)}, ${lines(WEAK, CELLS)});`);
  };
  return material;
}

/** A disc that fades towards its rim, with a tile every so many metres. */
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
