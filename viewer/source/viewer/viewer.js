/* The viewer: a machine whose bodies are put where they are told, seen by one camera or two. */

import { Color, PerspectiveCamera, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Eyes, LENGTHS } from "./eyes.js";
import { Headset } from "./headset.js";
import { Outputs } from "./outputs.js";
import { World } from "./world.js";

const VIEW_ANGLE = 0.6;
const TURN = -0.62, LIFT = 0.36;
// How far the observer's head goes when the mouse crosses half of the picture, as a share of the distance looked at.
const HEAD_REACH = 0.25;
// Where pictures must keep up, shadows are those of one of so many: they are drawn from the sun, with as many triangles again.
const SHADOW_PERIOD = 3;

/**
 * Draws bodies where `place` put them, and `forces`: arrays of six numbers, point and force in world axes.
 *
 * data: bodies with meshes, up, center, radius, floor, largestForce and follow as in animation.py; with `background` (sRGB, 0 to 1)
 * the picture is opaque; with `stand` ({eye, target}) the camera stays there. Throws if there is no WebGL 2.
 *
 * `shown`: what is drawn and which cues of depth it has. `view`: camera and output, see eyes.js and outputs.js, and whether the
 * eyes are swapped. `way` is how far the machine went: the camera follows it along the floor where `follow` is set. `detail`: share of
 * the resolution that is drawn; less than 1 where pictures must keep up, and then edges are not smoothed and shadows are drawn for one
 * picture in three; `coarse`: bodies have few triangles, see detail.js. Changes show with `draw()`.
 */
export class Viewer {
  constructor(canvas, data) {
    this.canvas = canvas;
    this.data = data;
    this.shown = { edges: true, floor: true, forces: true, perspective: true, shading: true, shadows: true, aerial: false, texture: true,
      knownSizes: false, headMotion: false };
    this.view = { camera: "central", output: "plain", swapped: false, lengths: { ...LENGTHS } };
    this.follow = data.follow;
    this.way = [0, 0, 0];
    this.forces = [];
    this.head = [0, 0];
    this.frames = 0;
    this.detail = 1;
    this.coarse = false;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.autoUpdate = false;
    this.world = new World(data);
    this.outputs = new Outputs(this.renderer);
    this.headset = new Headset(this.renderer, this.world.scene, this.world.up);
    this.eyes = new Eyes();
    this.rig = new PerspectiveCamera();
    this.rig.up.copy(this.world.up);
    this.followed = new Vector3();
    this.controls = new OrbitControls(this.rig, canvas);
    Object.assign(this.controls, { minDistance: 0.03 * data.radius, maxDistance: 60 * data.radius, enabled: !data.stand });
    this.controls.mouseButtons.MIDDLE = this.controls.mouseButtons.RIGHT;
    this.controls.addEventListener("change", () => this.draw());
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("pointermove", event => this.moveHead(event));
    canvas.addEventListener("pointerleave", () => { this.head = [0, 0]; if (this.shown.headMotion) this.draw(); });
    this.reset();
    new ResizeObserver(() => this.paint()).observe(canvas);
  }

  /** Looks at everything from the usual side. */
  reset() {
    const { center, radius, stand } = this.data, { up, side, front } = this.world, { position } = this.rig;
    const aspect = (this.canvas.clientWidth || 16) / (this.canvas.clientHeight || 9);
    const distance = radius / Math.sin(0.3) * (aspect < 1 ? 1 / Math.max(0.35, aspect) : 1) * 0.97, across = Math.cos(LIFT);
    this.controls.target.set(...stand?.target ?? center).add(this.followed);
    position.copy(this.controls.target).addScaledVector(side, distance * across * Math.sin(TURN))
      .addScaledVector(front, -distance * across * Math.cos(TURN)).addScaledVector(up, distance * Math.sin(LIFT));
    if (stand) position.set(...stand.eye);
    this.controls.update();
    this.draw();
  }

  /** Puts a body, counted as in the data, at a pose: position and quaternion x y z w, body to world. */
  place(body, pose) {
    this.world.machine.place(body, pose);
  }

  draw() {
    if (this.pending || this.headset.session) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = null;
      this.paint();
    });
  }

  /** Draws at once, where no headset does; resolves when the picture is drawn, with the milliseconds that took. */
  async show() {
    const gl = this.renderer.getContext(), began = performance.now();
    if (this.headset.session) return 0;
    this.paint();
    const drawn = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (drawn && !gl.isContextLost() && gl.getSyncParameter(drawn, gl.SYNC_STATUS) !== gl.SIGNALED) await new Promise(next => setTimeout(next, 1));
    gl.deleteSync(drawn);
    return performance.now() - began;
  }

  paint() {
    const { renderer, canvas, view, world } = this;
    this.resize();
    const resized = world.sharpen(this.detail);
    this.goAlong();
    const focus = this.rig.position.distanceTo(this.controls.target), stage = this.data.background;
    const dark = !stage && window.matchMedia("(prefers-color-scheme: dark)").matches, inHeadset = Boolean(this.headset.session);
    world.scene.background = stage ? new Color().setRGB(...stage, "srgb") : view.output === "plain" && !inHeadset ? null : this.stageColor();
    world.apply(this.shown, dark);
    world.machine.thin(this.coarse);
    world.forces.show(this.forces);
    world.arrange(this.followed, this.rig, focus);
    this.eyes.place(this.rig, {
      ...view, perspective: this.shown.perspective, angle: VIEW_ANGLE, aspect: canvas.width / canvas.height, focus,
      near: 0.02 * focus, far: 4 * focus + 12 * this.data.radius, head: this.shown.headMotion ? this.head.map(h => h * focus) : [0, 0],
    });
    renderer.shadowMap.needsUpdate = resized || this.detail === 1 || this.frames % SHADOW_PERIOD === 0;
    const render = eye => renderer.render(world.scene, this.eyes[eye]);
    if (inHeadset) renderer.render(world.scene, this.headset.camera);
    else if (view.output === "plain" && this.detail === 1) render("left");
    else this.outputs.show(view.output, view.swapped, this.detail === 1, render);
    this.frames += 1;
    canvas.dataset.frames = String(this.frames);
    if (view.output === "shutter") this.draw();
  }

  /** Shows the scene in a headset, or ends that. */
  async wear(ended) {
    if (this.headset.session) await this.headset.session.end();
    else await this.headset.begin(this.rig, () => this.paint(), () => { ended(); this.draw(); });
  }

  resize() {
    // Rows in turn are rows of the screen.
    const { canvas, renderer } = this, detail = this.view.output === "polarised" ? 1 : this.detail;
    const ratio = Math.min(window.devicePixelRatio || 1, 2) * detail;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (this.headset.session || canvas.width === width && canvas.height === height) return;
    renderer.setSize(width, height, false);
  }

  /** Camera and what it looks at move by what the machine went since last time. */
  goAlong() {
    const now = new Vector3(...this.follow ? this.way : [0, 0, 0]).projectOnPlane(this.world.up), moved = now.clone().sub(this.followed);
    this.followed.copy(now);
    this.rig.position.add(moved);
    this.controls.target.add(moved);
    this.rig.updateMatrixWorld();
  }

  moveHead(event) {
    const box = this.canvas.getBoundingClientRect();
    if (!this.shown.headMotion || event.buttons) return;
    const share = (place, start, size) => HEAD_REACH * (2 * (place - start) / size - 1);
    this.head = [share(event.clientX, box.left, box.width), -share(event.clientY, box.top, box.height)];
    this.draw();
  }

  stageColor() {
    const color = getComputedStyle(this.canvas).getPropertyValue("--stage-bottom").trim();
    return new Color(color || "#cfd8e6");
  }
}
