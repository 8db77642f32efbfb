/* What pages use of the viewer. */

export { decodeArray, lastNotAfter } from "../arrays.js";
export { Detail } from "./detail.js";
export { FlatPictures } from "./flat_pictures.js";
export { firstRightRow } from "./outputs.js";
export { Viewer } from "./viewer.js";
export { makeViewControls } from "./views_panel.js";
