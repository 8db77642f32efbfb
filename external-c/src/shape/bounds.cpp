#include "shape/bounds.hpp"

namespace cmb {

LocalBounds local_bounds(const Shape &shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::capsule:
    case ShapeKind::box:
    case ShapeKind::hull:
    case ShapeKind::ellipsoid:
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      Vec3 low, high;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction;
        direction.set(axis, 1.0);
        high.set(axis, convex::core_support(shape.body, direction).point[axis]);
        low.set(axis, convex::core_support(shape.body, -direction).point[axis]);
      }
      return {0.5 * (low + high), 0.5 * (high - low), shape.body.radius};
    }
    default: return {shape.bound_center, {}, shape.bound_radius};
  }
}

}  // namespace cmb
