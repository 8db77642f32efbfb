#include "query/bound_gap.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/halfspace_manifold.hpp"
#include "math/lanes.hpp"
#include "shape/bounds.hpp"

namespace cmb {

namespace {

using convex::Lanes;
using convex::magnitude;
using convex::Mat3;
using convex::sum_of;

BoundGap gap_to_halfspace(const Shape &shape, const Pose &pose, const Plane &plane) {
  const Vec3 upwards = transposed_times(pose.rotation, plane.normal);
  const double of_origin = dot(plane.normal, pose.translation) - plane.offset;
  const double height = of_origin + dot(upwards, shape.bound_center);
  const double of_box = of_origin + dot(upwards, shape.bounds.center) - half_extent(shape.bounds, upwards);
  return {std::max(height - shape.bound_radius, of_box), plane.normal,
          pose(shape.bound_center) - (0.5 * (height + shape.bound_radius)) * plane.normal};
}

// The largest gap along the axes of both boxes, of which b's centre is `apart` from that of a, in the world; where two boxes are apart, as
// a rule one of these six tells. Axes of b go two and one at a time.
double gap_of_boxes(const LocalBounds &a, const Mat3 &axes_a, const LocalBounds &b, const Mat3 &axes_b, const Vec3 &apart) {
  const Vec3(&of_a)[3] = axes_a.row, (&of_b)[3] = axes_b.row;
  const Lanes b_x{of_b[0].x, of_b[0].y}, b_y{of_b[1].x, of_b[1].y}, b_z{of_b[2].x, of_b[2].y}, half_b{b.half.x, b.half.y};
  const double radii = a.radius + b.radius;
  Lanes reach_b = half_b + Lanes{radii, radii};
  double last_reach_b = b.half.z + radii, gap = -HUGE_VAL;
  const auto along_a = [&](double x, double y, double z, double half) {
    const Lanes turned = magnitude(x * b_x + y * b_y + z * b_z);
    const double last = std::fabs(x * of_b[0].z + y * of_b[1].z + z * of_b[2].z);
    reach_b += half * turned;
    last_reach_b += half * last;
    const double reach = half + radii + sum_of(turned * half_b) + last * b.half.z;
    gap = std::max(gap, std::fabs(x * apart.x + y * apart.y + z * apart.z) - reach);
  };
  along_a(of_a[0].x, of_a[1].x, of_a[2].x, a.half.x);
  along_a(of_a[0].y, of_a[1].y, of_a[2].y, a.half.y);
  along_a(of_a[0].z, of_a[1].z, of_a[2].z, a.half.z);
  const Lanes along_b = magnitude(apart.x * b_x + apart.y * b_y + apart.z * b_z) - reach_b;
  const double last = std::fabs(apart.x * of_b[0].z + apart.y * of_b[1].z + apart.z * of_b[2].z) - last_reach_b;
  return std::max(std::max(gap, last), std::max(along_b[0], along_b[1]));
}

// A bounding sphere in the world, and a box in a frame whose axes and centre are given there.
struct Volumes {
  Vec3 center;
  double radius;
  const LocalBounds &box;
  const Mat3 &axes;
  Vec3 center_of_box;
};

BoundGap gap_of_volumes(const Volumes &a, const Volumes &b) {
  const Vec3 apart = a.center - b.center;
  const double length = norm(apart);
  const Vec3 normal = length > 0.0 ? (1.0 / length) * apart : Vec3{0, 0, 1};
  const double of_boxes = gap_of_boxes(a.box, a.axes, b.box, b.axes, b.center_of_box - a.center_of_box);
  return {std::max(length - a.radius - b.radius, of_boxes), normal,
          0.5 * (a.center + b.center + (b.radius - a.radius) * normal)};
}

Volumes volumes(const Shape &shape, const Pose &pose) {
  return {pose(shape.bound_center), shape.bound_radius, shape.bounds, pose.rotation, pose(shape.bounds.center)};
}

Volumes volumes(const BodyBounds &body, const Pose &pose) {
  const Vec3 center = pose(body.center);
  return {center, body.radius, body.box, pose.rotation, center};
}

}  // namespace

BoundGap bound_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  const bool below_a = b.kind == ShapeKind::halfspace;
  if (below_a || a.kind == ShapeKind::halfspace) {
    BoundGap gap = gap_to_halfspace(below_a ? a : b, below_a ? pose_a : pose_b, world_plane(below_a ? pose_b : pose_a));
    if (!below_a) gap.normal = -gap.normal;
    return gap;
  }
  return gap_of_volumes(volumes(a, pose_a), volumes(b, pose_b));
}

BoundGap bound_gap(const BodyBounds &a, const Pose &pose_a, const BodyBounds &b, const Pose &pose_b) {
  return gap_of_volumes(volumes(a, pose_a), volumes(b, pose_b));
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
