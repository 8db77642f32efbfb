/* Geometry of what is drawn: surfaces with smooth and sharp edges, arrows. */

import { BufferAttribute, BufferGeometry, EdgesGeometry, LatheGeometry, MathUtils, Vector2 } from "three";
import { mergeVertices, toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";

// Faces that meet at less share their normals; steeper and open edges are drawn as lines.
const CREASE = 35;
// three.js tells points apart by absolute distances; at this size they are a millionth of the mesh.
const WORKING_SIZE = 1e4;

/**
 * Faces and feature edges of a triangle mesh; without such edges null.
 * vertices: Float32Array of three numbers a vertex; triangles: Uint32Array of three vertices a triangle.
 */
export function surface(vertices, triangles) {
  const size = vertices.reduce((most, value) => Math.max(most, Math.abs(value)), 0) || 1, scale = WORKING_SIZE / size;
  const grown = new BufferGeometry();
  grown.setAttribute("position", new BufferAttribute(vertices.map(value => value * scale), 3));
  grown.setIndex(new BufferAttribute(triangles, 1));
  // Corners that triangles share are computed once.
  const edges = new EdgesGeometry(grown, CREASE), faces = mergeVertices(toCreasedNormals(grown, MathUtils.degToRad(CREASE)));
  for (const geometry of [edges, faces]) geometry.scale(1 / scale, 1 / scale, 1 / scale);
  return { faces, edges: edges.getAttribute("position").count ? edges : null };
}

/** An arrow of length 1 along y. */
export function arrow() {
  const outline = [[0, 0], [0.022, 0], [0.022, 0.76], [0.06, 0.76], [0, 1]].map(point => new Vector2(...point));
  return new LatheGeometry(outline, 20).toNonIndexed().deleteAttribute("uv").deleteAttribute("normal");
}
