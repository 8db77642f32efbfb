"use strict";
/* Draws the study's scene for one eye or for two. All lengths and matrices come from the program. */

const LIGHT = [0.3, 0.6, 0.74];
// A box's faces: outward normal and corners, counter-clockwise seen from outside, in half sizes.
const FACES = [
  [[1, 0, 0], [[1, -1, 1], [1, -1, -1], [1, 1, -1], [1, 1, 1]]],
  [[-1, 0, 0], [[-1, -1, -1], [-1, -1, 1], [-1, 1, 1], [-1, 1, -1]]],
  [[0, 1, 0], [[-1, 1, 1], [1, 1, 1], [1, 1, -1], [-1, 1, -1]]],
  [[0, -1, 0], [[-1, -1, -1], [1, -1, -1], [1, -1, 1], [-1, -1, 1]]],
  [[0, 0, 1], [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]],
  [[0, 0, -1], [[1, -1, -1], [-1, -1, -1], [-1, 1, -1], [1, 1, -1]]],
];

/** A point in the picture, -1 to 1 to the right and up, by a 4 x 4 matrix given row by row. */
function project(matrix, [x, y, z]) {
  const row = k => matrix[4 * k] * x + matrix[4 * k + 1] * y + matrix[4 * k + 2] * z + matrix[4 * k + 3];
  const w = row(3);
  return [row(0) / w, row(1) / w];
}

/** A point turned about the vertical axis through the middle of the scene. */
function swung([x, y, z], angle, depth) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [c * x + s * (z - depth), y, depth - s * x + c * (z - depth)];
}

/** Twice the area of a polygon, positive if counter-clockwise. */
function area(points) {
  return points.reduce((sum, [x, y], k) => {
    const [u, v] = points[(k + 1) % points.length];
    return sum + x * v - u * y;
  }, 0);
}

function fill(context, points, color) {
  const { width, height } = context.canvas;
  context.beginPath();
  points.forEach(([x, y], k) => {
    const at = [(1 + x) * width / 2, (1 - y) * height / 2];
    if (k) context.lineTo(...at); else context.moveTo(...at);
  });
  context.closePath();
  context.fillStyle = color;
  context.strokeStyle = color;  // closes the seams between neighbours
  context.fill();
  context.stroke();
}

function drawFloor(context, matrix, floor) {
  const { height, tile, near, far, half } = floor;
  const columns = Math.round(2 * half / tile), rows = Math.round((near - far) / tile);
  for (let j = rows - 1; j >= 0; j--) {
    for (let i = 0; i < columns; i++) {
      const x = -half + i * tile, z = near - j * tile;
      const corners = [[x, height, z], [x + tile, height, z], [x + tile, height, z - tile], [x, height, z - tile]];
      fill(context, corners.map(p => project(matrix, p)), (i + j) % 2 ? "rgb(78,84,92)" : "rgb(58,63,70)");
    }
  }
}

/** Draws the scene as one eye sees it, the boxes swung by an angle in rad. */
function drawEye(context, matrix, scene, angle) {
  const { width, height } = context.canvas;
  context.fillStyle = "rgb(24,28,36)";
  context.fillRect(0, 0, width, height);
  context.lineWidth = 1;
  const depth = scene.swing.depth;
  drawFloor(context, matrix, scene.floor);
  const boxes = scene.boxes.map(box => ({ ...box, at: swung(box.center, angle, depth) }));
  const far = box => Math.hypot(...box.at);
  for (const box of boxes.sort((a, b) => far(b) - far(a))) {
    for (const [normal, corners] of FACES) {
      const points = corners
        .map(corner => corner.map((sign, k) => box.center[k] + sign * box.size[k] / 2))
        .map(point => project(matrix, swung(point, angle, depth)));
      if (area(points) <= 0) continue;
      const [nx, ny, nz] = swung([normal[0], normal[1], normal[2] + depth], angle, depth);
      const light = 0.45 + 0.55 * Math.max(0, nx * LIGHT[0] + ny * LIGHT[1] + (nz - depth) * LIGHT[2]);
      fill(context, points, `rgb(${box.color.map(value => Math.round(value * light)).join(",")})`);
    }
  }
}

const TO_LINEAR = Float64Array.from({ length: 256 }, (_, k) =>
  k / 255 <= 0.04045 ? k / 255 / 12.92 : Math.pow((k / 255 + 0.055) / 1.055, 2.4));
const TO_DISPLAY = Uint8ClampedArray.from({ length: 4097 }, (_, k) =>
  255 * (k / 4096 <= 0.0031308 ? 12.92 * k / 4096 : 1.055 * Math.pow(k / 4096, 1 / 2.4) - 0.055));

/** Puts the anaglyph of two pictures into the first: sRGB pixels, matrices on linear RGB row by row. */
function anaglyph(left, right, colours) {
  const a = colours.left, b = colours.right;
  for (let k = 0; k < left.length; k += 4) {
    const l0 = TO_LINEAR[left[k]], l1 = TO_LINEAR[left[k + 1]], l2 = TO_LINEAR[left[k + 2]];
    const r0 = TO_LINEAR[right[k]], r1 = TO_LINEAR[right[k + 1]], r2 = TO_LINEAR[right[k + 2]];
    for (let c = 0; c < 3; c++) {
      const value = a[3 * c] * l0 + a[3 * c + 1] * l1 + a[3 * c + 2] * l2
                  + b[3 * c] * r0 + b[3 * c + 1] * r1 + b[3 * c + 2] * r2;
      left[k + c] = TO_DISPLAY[Math.round(4096 * Math.min(1, Math.max(0, value)))];
    }
  }
}

/** Replaces every second row of the left picture by that of the right one, so that rows of one parity are the right eye's. */
function interleaveRows(left, right, width, firstRight) {
  for (let start = 4 * width * firstRight; start < left.length; start += 8 * width) {
    left.set(right.subarray(start, start + 4 * width), start);
  }
}

/** The first row of a canvas for the right eye: displays polarise rows of the screen, even ones for the left eye. */
function firstRightRow(canvas) {
  if (!canvas.isConnected) return 1;
  const above = window.mozInnerScreenY ?? window.screenY + window.outerHeight - window.innerHeight;
  const row = Math.round((above + canvas.getBoundingClientRect().top) * window.devicePixelRatio);
  return row % 2 === 0 ? 1 : 0;
}

/**
 * Shows pictures for both eyes on a canvas, frame by frame if they move, by the output that the technique names.
 * drawEye(context, eye, seconds) draws the picture of the "left" or "right" eye. Returns a function that ends it.
 */
function present(canvas, view, moving, drawEye) {
  const { width, height } = canvas;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const other = document.createElement("canvas");
  Object.assign(other, { width, height });
  const second = other.getContext("2d", { willReadFrequently: true });
  const [first, last] = view.swapped ? ["right", "left"] : ["left", "right"];
  const begin = performance.now();
  let frame = 0, handle = 0;
  function draw(now) {
    const time = (now - begin) / 1000;
    if (view.technique === "plain" || view.technique === "shutter") {
      drawEye(context, view.technique === "shutter" && frame % 2 ? last : first, time);
    } else {
      drawEye(second, last, time);
      if (view.technique === "side-by-side" || view.technique === "top-and-bottom") {
        const half = view.technique === "side-by-side" ? [width / 2, height] : [width, height / 2];
        const place = view.technique === "side-by-side" ? [width / 2, 0] : [0, height / 2];
        context.drawImage(other, ...place, ...half);
        drawEye(second, first, time);
        context.drawImage(other, 0, 0, ...half);
      } else {
        drawEye(context, first, time);
        const mine = context.getImageData(0, 0, width, height);
        const theirs = second.getImageData(0, 0, width, height);
        if (view.technique === "anaglyph") anaglyph(mine.data, theirs.data, view.colours);
        else interleaveRows(mine.data, theirs.data, width, firstRightRow(canvas));
        context.putImageData(mine, 0, 0);
      }
    }
    frame += 1;
    canvas.dataset.frames = String(frame);
    if (moving || view.technique === "shutter") handle = requestAnimationFrame(draw);
  }
  draw(begin);
  return () => cancelAnimationFrame(handle);
}

/** Shows the study's scene on a canvas until stopped: returns a function that stops it. */
function showView(canvas, view, scene) {
  const { angle, period } = scene.swing;
  return present(canvas, view, view.moving, (context, eye, time) =>
    drawEye(context, view[eye], scene, view.moving ? angle * Math.sin(2 * Math.PI * time / period) : 0));
}
