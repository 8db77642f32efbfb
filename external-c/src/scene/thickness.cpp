#include "scene/thickness.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb {

namespace {

double extent(const Shape &shape, int axis) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  if (shape.kind == ShapeKind::mesh) {
    for (const Vec3 &vertex : shape.mesh->vertices()) {
      low = std::min(low, vertex[axis]);
      high = std::max(high, vertex[axis]);
    }
    return high - low;
  }
  Vec3 direction;
  direction.set(axis, 1.0);
  high = convex::core_support(shape.body, direction).point[axis];
  low = convex::core_support(shape.body, -direction).point[axis];
  return high - low + 2.0 * shape.body.radius;
}

double thickness_of(const Shape &shape) {
  const bool endless =
      shape.kind == ShapeKind::halfspace || (shape.kind == ShapeKind::mesh && !shape.mesh->closed());
  if (endless) return HUGE_VAL;
  return std::min({extent(shape, 0), extent(shape, 1), extent(shape, 2)});
}

}  // namespace

double thickness_of(const BodyShapes &shapes) {
  double least = HUGE_VAL;
  for (const Shape &shape : shapes) least = std::min(least, thickness_of(shape));
  return least;
}

}  // namespace cmb
