/* Two flat pictures for two eyes, as a test of goggles and display needs them. */

import {
  CanvasTexture, Mesh, MeshBasicMaterial, NearestFilter, OrthographicCamera, PlaneGeometry, Scene, SRGBColorSpace, WebGLRenderer,
} from "three";
import { Outputs } from "./outputs.js";

export class FlatPictures {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    this.outputs = new Outputs(this.renderer);
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
    this.material = new MeshBasicMaterial();
    this.scene = new Scene().add(new Mesh(new PlaneGeometry(2, 2), this.material));
  }

  /** Shows canvases as the eyes' pictures by an output; returns a function that ends it. */
  show(output, swapped, left, right) {
    const textures = { left: texture(left), right: texture(right) };
    let handle = 0;
    const render = eye => {
      this.material.map = textures[eye];
      this.material.needsUpdate = true;
      this.renderer.render(this.scene, this.camera);
    };
    const draw = () => {
      if (output === "plain") render("left");
      else this.outputs.show(output, swapped, true, render);
      if (output === "shutter") handle = requestAnimationFrame(draw);
    };
    draw();
    return () => {
      cancelAnimationFrame(handle);
      for (const each of Object.values(textures)) each.dispose();
    };
  }
}

function texture(canvas) {
  const made = new CanvasTexture(canvas);
  Object.assign(made, { colorSpace: SRGBColorSpace, magFilter: NearestFilter, minFilter: NearestFilter, generateMipmaps: false });
  return made;
}
