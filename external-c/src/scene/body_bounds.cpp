#include "scene/body_bounds.hpp"

#include <algorithm>

#include "shape/bounds.hpp"

namespace cmb {

BodyBounds bounds_of(const BodyShapes &shapes) {
  const auto is_halfspace = [](const Shape &shape) { return shape.kind == ShapeKind::halfspace; };
  if (shapes.empty() || std::any_of(shapes.begin(), shapes.end(), is_halfspace)) return {};
  Bounds all = world_bounds(shapes.front().bounds, shapes.front().in_body);
  for (const Shape &shape : shapes) {
    const Bounds each = world_bounds(shape.bounds, shape.in_body);
    for (int axis = 0; axis < 3; ++axis) {
      all.low.set(axis, std::fmin(all.low[axis], each.low[axis]));
      all.high.set(axis, std::fmax(all.high[axis], each.high[axis]));
    }
  }
  BodyBounds bounds{{0.5 * (all.low + all.high), 0.5 * (all.high - all.low), 0.0}, 0.5 * (all.low + all.high), 0.0};
  for (const Shape &shape : shapes) {
    const double reach = norm(shape.in_body(shape.bound_center) - bounds.center) + shape.bound_radius;
    bounds.radius = std::fmax(bounds.radius, reach);
  }
  return bounds;
}

}  // namespace cmb
