#include "scene/thickness.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb {

namespace {

Vec3 extents_of(const mesh::TriangleMesh &mesh) {
  Vec3 low = mesh.vertices().front(), high = low;
  for (const Vec3 &vertex : mesh.vertices()) {
    for (int axis = 0; axis < 3; ++axis) {
      low.set(axis, std::min(low[axis], vertex[axis]));
      high.set(axis, std::max(high[axis], vertex[axis]));
    }
  }
  return high - low;
}

double thickness_of(const Shape &shape) {
  if (shape.kind == ShapeKind::halfspace) return HUGE_VAL;
  if (shape.kind == ShapeKind::mesh) {
    if (!shape.mesh->closed()) return HUGE_VAL;
    const Vec3 extents = extents_of(*shape.mesh);
    return std::min({extents.x, extents.y, extents.z});
  }
  const LocalBounds &bounds = shape.bounds;
  return 2.0 * (std::min({bounds.half.x, bounds.half.y, bounds.half.z}) + bounds.radius);
}

}  // namespace

double thickness_of(const BodyShapes &shapes) {
  double least = HUGE_VAL;
  for (const Shape &shape : shapes) least = std::min(least, thickness_of(shape));
  return least;
}

}  // namespace cmb
