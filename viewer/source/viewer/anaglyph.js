/*
 * Colours of anaglyphs by least squares: the displayed colour that through the goggles is nearest to what both eyes should see
 * (E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001), on linear RGB.
 */

import { Matrix3, Vector3 } from "three";

// Linear sRGB to CIE XYZ (IEC 61966-2-1).
const XYZ = new Matrix3(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041);

/** Shares of the primaries' light that each filter lets through: typical gelatine filters on an sRGB display. */
export const RED_CYAN = { left: [0.80, 0.04, 0.02], right: [0.03, 0.70, 0.75] };

/** Matrices: displayed = left * left eye's colour + right * right eye's; what is white for both eyes is displayed as white. */
export function anaglyphMatrices(goggles = RED_CYAN) {
  const seen = [goggles.left, goggles.right].map(shares => XYZ.clone().multiply(diagonal(shares)));
  const wanted = seen.map(each => each.clone().transpose().multiply(XYZ));
  const normal = seen.map(each => each.clone().transpose().multiply(each));
  const inverse = sum(...normal).invert();
  const [left, right] = wanted.map(each => inverse.clone().multiply(each));
  const white = new Vector3(1, 1, 1).applyMatrix3(sum(left, right));
  const scale = diagonal(white.toArray().map(value => 1 / value));
  return { left: left.premultiply(scale), right: right.premultiply(scale) };
}

function diagonal([a, b, c]) {
  return new Matrix3(a, 0, 0, 0, b, 0, 0, 0, c);
}

function sum(a, b) {
  return new Matrix3().fromArray(a.elements.map((value, k) => value + b.elements[k]));
}
