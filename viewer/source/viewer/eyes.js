/*
 * Cameras of one eye or two. All lengths are in metres. With parallel axes the frusta are off-axis: both windows coincide at the
 * convergence distance. With convergent axes the cameras are turned towards each other and have symmetric frusta.
 */

import { Matrix4, PerspectiveCamera, Vector3 } from "three";

export const CAMERAS = ["central", "parallel", "convergent"];

/** Lengths of cameras and screen; null: the distance to what the camera looks at, and that from which the screen spans `angle`. */
export const LENGTHS = { eyeDistance: 0.065, convergenceDistance: null, screenWidth: 0.52, viewingDistance: null };

const shear = new Matrix4(), middle = new Vector3();

export class Eyes {
  constructor() {
    this.left = new PerspectiveCamera();
    this.right = new PerspectiveCamera();
  }

  /**
   * Places both cameras.
   * rig: the camera in the middle, with its pose. view: camera (one of CAMERAS), lengths, perspective (else parallel projection),
   * angle (vertical, used without a viewing distance), aspect, near, far, focus (distance of what is looked at), and head, by how much
   * the observer moved his head to the right and up.
   */
  place(rig, view) {
    const half = view.camera === "central" ? 0 : view.lengths.eyeDistance / 2;
    this.placeOne(this.left, rig, view, -half);
    this.placeOne(this.right, rig, view, half);
  }

  placeOne(camera, rig, view, offset) {
    const { screenWidth, viewingDistance, convergenceDistance } = view.lengths, { near, far } = view;
    const distance = convergenceDistance ?? view.focus, x = offset + view.head[0], y = view.head[1];
    const wide = viewingDistance ? screenWidth / (2 * viewingDistance) : Math.tan(view.angle / 2) * view.aspect;
    const high = wide / view.aspect;
    camera.up.setFromMatrixColumn(rig.matrixWorld, 1);
    camera.quaternion.copy(rig.quaternion);
    camera.position.copy(rig.position);
    if (view.perspective) {
      camera.position.add(middle.set(x, y, 0).applyQuaternion(rig.quaternion));
      let [acrossX, acrossY] = [-x / distance, -y / distance];  // where the window's middle lies, per depth
      if (view.camera === "convergent") {
        camera.lookAt(middle.set(0, 0, -distance).applyQuaternion(rig.quaternion).add(rig.position));
        acrossX = acrossY = 0;
      }
      camera.projectionMatrix.makePerspective(
        (acrossX - wide) * near, (acrossX + wide) * near, (acrossY + high) * near, (acrossY - high) * near, near, far);
    } else {
      // Sizes do not depend on depth; that an eye stands aside still shifts what is nearer or farther than the screen.
      shear.set(1, 0, -x / distance, -x, 0, 1, -y / distance, -y, 0, 0, 1, 0, 0, 0, 0, 1);
      camera.projectionMatrix.makeOrthographic(
        -wide * distance, wide * distance, high * distance, -high * distance, -far, far).multiply(shear);
    }
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.updateMatrixWorld();
  }
}
