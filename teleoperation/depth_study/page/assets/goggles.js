"use strict";
/* A test of goggles and display: random dots in which only two eyes see a square, nearer or farther than the rest. */

const TRIALS = [-1, -1, -1, 1, 1, 1];  // nearer: the right eye's square lies farther to the left

/** Numbers in random order. */
function shuffled(values) {
  return values.map(value => [Math.random(), value]).sort((a, b) => a[0] - b[0]).map(pair => pair[1]);
}

/** Pictures of both eyes: dots of some pixels, those of a square shifted against each other by a disparity in dots. */
function dotPictures(width, height, disparity, dot) {
  const columns = Math.ceil(width / dot), rows = Math.ceil(height / dot);
  const tone = () => (Math.random() < 0.5 ? 40 : 215);
  const field = Array.from({ length: rows }, () => Array.from({ length: columns }, tone));
  const size = Math.round(rows / 2), top = Math.round(rows / 4), start = Math.round((columns - size) / 2);
  const square = Array.from({ length: size }, () => Array.from({ length: size }, tone));
  const shift = { left: -Math.floor(disparity / 2), right: Math.ceil(disparity / 2) };
  return (context, eye) => {
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < columns; i++) {
        const inside = square[j - top]?.[i - start - shift[eye]];
        const value = inside ?? field[j][i];
        context.fillStyle = `rgb(${value},${value},${value})`;
        context.fillRect(i * dot, j * dot, dot, dot);
      }
    }
  };
}

/** What the answers say: each is 1 (farther), -1 (nearer) or 0 (no square), like the truth. */
function gogglesVerdict(truths, answers) {
  const right = truths.filter((truth, k) => answers[k] === truth).length;
  const crossed = truths.filter((truth, k) => answers[k] === -truth).length;
  if (right >= truths.length - 1) return { good: true, text: "You see depth, and left and right are as they should be." };
  if (crossed >= truths.length - 1) {
    return { good: false, crossed: true, text: "Left and right are swapped: what is near looks far. The eyes' pictures are "
      + "exchanged from now on in this tab with this technique; test once more." };
  }
  return { good: false, crossed: false, text: "Depth is not seen for certain. Check goggles, display and the distance from "
    + "which you look. Some people do not see depth by two eyes; then do not take part with goggles." };
}
