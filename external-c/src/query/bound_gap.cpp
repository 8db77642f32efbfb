#include "query/bound_gap.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/halfspace_manifold.hpp"
#include "math/pose_algebra.hpp"
#include "shape/bounds.hpp"

namespace cmb {

namespace {

BoundGap gap_to_halfspace(const Shape &shape, const Pose &pose, const Plane &plane) {
  const Vec3 upwards = transposed_times(pose.rotation, plane.normal);
  const double of_origin = dot(plane.normal, pose.translation) - plane.offset;
  const double height = of_origin + dot(upwards, shape.bound_center);
  const double of_box = of_origin + dot(upwards, shape.bounds.center) - half_extent(shape.bounds, upwards);
  return {std::max(height - shape.bound_radius, of_box), plane.normal,
          pose(shape.bound_center) - (0.5 * (height + shape.bound_radius)) * plane.normal};
}

// The largest gap along the axes of both boxes; where two boxes are apart, as a rule one of these six tells.
double gap_of_boxes(const LocalBounds &a, const Pose &pose_a, const LocalBounds &b, const Pose &pose_b) {
  const Pose to_a = relative_pose(pose_a, pose_b);
  const Vec3 in_a = to_a(b.center) - a.center, in_b = transposed_times(to_a.rotation, in_a);
  double gap = -HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) {
    const double along_a = std::fabs(in_a[axis]) - a.half[axis] - a.radius - half_extent(b, to_a.rotation.row[axis]);
    const double along_b =
        std::fabs(in_b[axis]) - b.half[axis] - b.radius - half_extent(a, to_a.rotation.column(axis));
    gap = std::max({gap, along_a, along_b});
  }
  return gap;
}

// A bounding sphere in a frame, and a box there.
struct Volumes {
  const Vec3 &center;
  double radius;
  const LocalBounds &box;
};

BoundGap gap_of_volumes(const Volumes &a, const Pose &pose_a, const Volumes &b, const Pose &pose_b) {
  const Vec3 center_a = pose_a(a.center), center_b = pose_b(b.center), apart = center_a - center_b;
  const double length = norm(apart);
  const Vec3 normal = length > 0.0 ? (1.0 / length) * apart : Vec3{0, 0, 1};
  return {std::max(length - a.radius - b.radius, gap_of_boxes(a.box, pose_a, b.box, pose_b)), normal,
          0.5 * (center_a + center_b + (b.radius - a.radius) * normal)};
}

}  // namespace

BoundGap bound_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  const bool below_a = b.kind == ShapeKind::halfspace;
  if (below_a || a.kind == ShapeKind::halfspace) {
    BoundGap gap = gap_to_halfspace(below_a ? a : b, below_a ? pose_a : pose_b, world_plane(below_a ? pose_b : pose_a));
    if (!below_a) gap.normal = -gap.normal;
    return gap;
  }
  return gap_of_volumes({a.bound_center, a.bound_radius, a.bounds}, pose_a, {b.bound_center, b.bound_radius, b.bounds}, pose_b);
}

BoundGap bound_gap(const BodyBounds &a, const Pose &pose_a, const BodyBounds &b, const Pose &pose_b) {
  return gap_of_volumes({a.center, a.radius, a.box}, pose_a, {b.center, b.radius, b.box}, pose_b);
}

double sphere_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  if (b.kind == ShapeKind::halfspace) {
    const Plane plane = world_plane(pose_b);
    return dot(plane.normal, pose_a(a.bound_center)) - plane.offset - a.bound_radius;
  }
  if (a.kind == ShapeKind::halfspace) return sphere_gap(b, pose_b, a, pose_a);
  return norm(pose_a(a.bound_center) - pose_b(b.bound_center)) - a.bound_radius - b.bound_radius;
}

}  // namespace cmb
