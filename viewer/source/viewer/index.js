/* What pages use of the viewer. */

export { decodeArray, lastNotAfter } from "../arrays.js";
export { anaglyphMatrices } from "./anaglyph.js";
export { firstRightRow, Outputs, OUTPUTS } from "./outputs.js";
export { Viewer } from "./viewer.js";
export { makeViewControls } from "./views_panel.js";
