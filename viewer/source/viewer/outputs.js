/* How the pictures of both eyes become one: anaglyph, rows in turn, frames in turn, halves of the screen. */

import {
  HalfFloatType, Mesh, NoBlending, OrthographicCamera, PlaneGeometry, ShaderMaterial, SRGBColorSpace, WebGLRenderTarget,
} from "three";
import { anaglyphMatrices } from "./anaglyph.js";

/** Outputs by name, with what a person calls them. */
export const OUTPUTS = {
  "plain": "plain",
  "anaglyph": "anaglyph, red and cyan",
  "side-by-side": "side by side",
  "top-and-bottom": "top and bottom",
  "polarised": "rows in turn, polarised",
  "shutter": "frames in turn, shutter",
};

const MODES = ["one", "anaglyph", "polarised", "side-by-side", "top-and-bottom"];
const ONE_EYE = ["plain", "shutter"];
// What is drawn into them is smoothed by four samples a pixel, which where processors draw takes most of the time, or is not.
const SMOOTH = { samples: 4, type: HalfFloatType }, QUICK = { colorSpace: SRGBColorSpace };
const VERTEX = "varying vec2 place; void main() { place = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }";
const FRAGMENT = `
varying vec2 place; uniform sampler2D left, right; uniform mat3 fromLeft, fromRight; uniform int mode, firstRight, height;
void main() {
  vec4 l, r;
  if (mode == 3) {
    gl_FragColor = place.x < 0.5 ? texture2D(left, vec2(2.0 * place.x, place.y)) : texture2D(right, vec2(2.0 * place.x - 1.0, place.y));
  } else if (mode == 4) {
    gl_FragColor = place.y > 0.5 ? texture2D(left, vec2(place.x, 2.0 * place.y - 1.0)) : texture2D(right, vec2(place.x, 2.0 * place.y));
  } else {
    l = texture2D(left, place);
    r = texture2D(right, place);
    gl_FragColor = l;
    if (mode == 1) gl_FragColor = vec4(clamp(fromLeft * l.rgb + fromRight * r.rgb, 0.0, 1.0), 1.0);
    if (mode == 2 && (height - 1 - int(gl_FragCoord.y)) % 2 == firstRight) gl_FragColor = r;
  }
  // Where a picture is transparent its colour is multiplied by its opacity; what is encoded is the colour.
  if (gl_FragColor.a > 0.0) gl_FragColor.rgb /= gl_FragColor.a;
  #include <colorspace_fragment>
  gl_FragColor.rgb *= gl_FragColor.a;
}`;

/** The first row of a canvas for the right eye: displays polarise rows of the screen, even ones for the left eye. */
export function firstRightRow(canvas) {
  if (!canvas.isConnected) return 1;
  const above = window.mozInnerScreenY ?? window.screenY + window.outerHeight - window.innerHeight;
  const row = Math.round((above + canvas.getBoundingClientRect().top) * window.devicePixelRatio);
  return row % 2 === 0 ? 1 : 0;
}

export class Outputs {
  constructor(renderer) {
    this.renderer = renderer;
    this.frame = 0;
    const pair = options => ({ left: new WebGLRenderTarget(1, 1, options), right: new WebGLRenderTarget(1, 1, options) });
    this.targets = { smooth: pair(SMOOTH), quick: pair(QUICK) };
    const matrices = anaglyphMatrices();
    this.uniforms = {
      left: { value: null }, right: { value: null }, mode: { value: 0 }, firstRight: { value: 1 }, height: { value: 1 },
      fromLeft: { value: matrices.left }, fromRight: { value: matrices.right },
    };
    const material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms, depthTest: false, depthWrite: false, blending: NoBlending,
    });
    this.screen = new Mesh(new PlaneGeometry(2, 2), material);
    this.screen.frustumCulled = false;
    this.camera = new OrthographicCamera();
  }

  /** Shows by an output what `render` draws for an eye, "left" or "right", on the canvas; smooth: whether edges are smoothed. */
  show(output, swapped, smooth, render) {
    const { renderer, uniforms } = this, canvas = renderer.domElement, { width, height } = canvas;
    const targets = this.targets[smooth ? "smooth" : "quick"], one = ONE_EYE.includes(output);
    const first = output === "shutter" && this.frame % 2 ? "right" : "left", other = { left: "right", right: "left" };
    this.frame += 1;
    for (const side of one ? ["left"] : ["left", "right"]) {
      const eye = one ? first : side;
      targets[side].setSize(width, height);
      renderer.setRenderTarget(targets[side]);
      render(swapped && output !== "plain" ? other[eye] : eye);
    }
    renderer.setRenderTarget(null);
    uniforms.left.value = targets.left.texture;
    uniforms.right.value = targets.right.texture;
    uniforms.mode.value = one ? 0 : MODES.indexOf(output);
    uniforms.firstRight.value = firstRightRow(canvas);
    uniforms.height.value = height;
    renderer.render(this.screen, this.camera);
  }
}
