/* Fewer triangles for pictures that must keep up. */

// Cells along the longest side of a mesh, finest first.
const CELLS = [32, 20, 12, 8, 5, 3];
// A mesh has at least so many triangles.
const LEAST = 24;

/**
 * An index of a share of a mesh's triangles over the same vertices: those in a cell of a grid that look the same way become one.
 * position, normal: BufferAttributes; index: array of three vertices a triangle. Returns an array like index.
 */
export function coarser(position, normal, index, share) {
  const most = Math.max(LEAST, share * index.length / 3);
  let found = index;
  for (const cells of CELLS) {
    if (found.length / 3 <= most) break;
    found = clustered(position, normal, index, cells);
  }
  return found;
}

function clustered(position, normal, index, cells) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], axes = [0, 1, 2];
  for (const k of index) {
    for (const i of axes) {
      const value = position.getComponent(k, i);
      low[i] = Math.min(low[i], value);
      high[i] = Math.max(high[i], value);
    }
  }
  const size = Math.max(...axes.map(i => high[i] - low[i])) / cells || 1, firsts = new Map(), kept = [];
  const first = k => {
    const place = axes.map(i => Math.round((position.getComponent(k, i) - low[i]) / size));
    const key = [...place, ...axes.map(i => Math.round(1.2 * normal.getComponent(k, i)))].join();
    if (!firsts.has(key)) firsts.set(key, k);
    return firsts.get(key);
  };
  const apart = (a, b) => axes.some(i => position.getComponent(a, i) !== position.getComponent(b, i));
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [first(index[k]), first(index[k + 1]), first(index[k + 2])];
    if (apart(a, b) && apart(b, c) && apart(c, a)) kept.push(a, b, c);
  }
  return kept;
}
