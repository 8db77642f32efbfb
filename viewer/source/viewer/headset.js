/* WebXR: the scene around an observer with a headset, at its true size. */

import { Group, Matrix4, PerspectiveCamera, Vector3 } from "three";

export class Headset {
  /** renderer and scene: what is drawn; up: unit vector. */
  constructor(renderer, scene, up) {
    this.renderer = renderer;
    this.up = up;
    this.stand = new Group();
    /** Both eyes' camera, which the headset moves. */
    this.camera = new PerspectiveCamera(50, 1, 0.01, 1000);
    this.stand.add(this.camera);
    scene.add(this.stand);
    renderer.xr.setReferenceSpaceType("local");
  }

  /** Whether this browser knows of a headset. */
  static async isThere() {
    try {
      return Boolean(navigator.xr && await navigator.xr.isSessionSupported("immersive-vr"));
    } catch {
      return false;
    }
  }

  get session() {
    return this.renderer.xr.getSession();
  }

  /** Begins: the observer stands where the camera is, upright, and looks where it looks. paint draws; ended is called afterwards. */
  async begin(camera, paint, ended) {
    const session = await navigator.xr.requestSession("immersive-vr");
    const back = new Vector3(0, 0, 1).applyQuaternion(camera.quaternion).projectOnPlane(this.up).normalize();
    const right = new Vector3().crossVectors(this.up, back);
    this.stand.position.copy(camera.position);
    this.stand.setRotationFromMatrix(new Matrix4().makeBasis(right, this.up, back));
    session.addEventListener("end", () => {
      this.renderer.setAnimationLoop(null);
      this.renderer.xr.enabled = false;
      ended();
    });
    this.renderer.xr.enabled = true;
    await this.renderer.xr.setSession(session);
    this.renderer.setAnimationLoop(paint);
  }
}
