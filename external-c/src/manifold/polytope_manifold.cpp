#include "manifold/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "manifold/load_limit.hpp"

namespace cmb {

namespace {

// The contact's axes: z along `up` (unit, world axes), the origin near the contact.
Pose contact_axes(const Vec3 &up, const Vec3 &origin) {
  const Vec3 first = convex::any_perpendicular(up);
  return {transposed(convex::Mat3{{first, cross(up, first), up}}), origin};
}

// Down to where corners are looked for at first; any depth would do. Corners carry about a third each.
double first_level(double depth, double fineness) {
  const double height = 2.5 / fineness + load_width(depth, fineness);
  return height < 0.6 * depth ? depth - height : 0.0;
}

// Sums over the corners, each with a part of its weight.
struct CornerSums {
  double greatest = 0.0;  // depth
  double load = 0.0;
  double missing_x = 0.0, missing_y = 0.0;  // torque that shares ask for as they change with the direction
};

template <typename Part>
CornerSums sums_of(const std::vector<DepthGraph::Corner> &corners, const Part &part) {
  CornerSums sums;
  for (const DepthGraph::Corner &corner : corners) {
    const double carried = corner.depth * part(corner.depth), half_square = 0.5 * corner.depth * carried;
    sums.greatest = std::max(sums.greatest, corner.depth);
    sums.load += corner.weight * carried;
    sums.missing_x += half_square * corner.slope.x, sums.missing_y += half_square * corner.slope.y;
  }
  return sums;
}

}  // namespace

void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, DepthGraph &graph,
                      std::vector<ContactPoint> &points) {
  const Pose axes = contact_axes(normal, witness);
  graph.place(a, relative_pose(axes, pose_a), b, relative_pose(axes, pose_b));
  const double reach = graph.reach();
  if (!(reach > 0.0)) return;
  const double fineness = a.fineness() + b.fineness();
  double level = first_level(reach, fineness), width;
  CornerSums sums;
  for (;;) {
    graph.find_corners(level);
    sums = sums_of(graph.corners(), [](double) { return 1.0; });
    width = load_width(sums.greatest, fineness);
    if (level == 0.0 || (sums.greatest > 0.0 && load_kept(graph.corners(), 0, {level, width}) >= sums.greatest)) break;
    level = reach - 2.0 * (reach - level);
    if (level < 0.4 * reach) level = 0.0;
  }
  const LoadLimit limit = load_limit(graph.corners(), 0, sums.greatest, sums.load, width);
  if (sums.load > sums.greatest) {
    sums = sums_of(graph.corners(), [&limit](double depth) { return limit.part(depth); });
  }
  if (!(sums.load > 0.0)) return;
  const Vec3 shift{sums.missing_x / sums.load, sums.missing_y / sums.load, 0.0};
  for (const DepthGraph::Corner &corner : graph.corners()) {
    const double weight = corner.weight * limit.part(corner.depth);
    if (!(weight > 0.0)) continue;
    const Vec3 at = axes(corner.middle + shift);
    points.emplace_back();
    ContactPoint &point = points.back();  // written member by member, which does not wait for a copy
    point.depth = corner.depth, point.weight = weight;
    point.normal.x = normal.x, point.normal.y = normal.y, point.normal.z = normal.z;
    point.position.x = at.x, point.position.y = at.y, point.position.z = at.z;
  }
}

}  // namespace cmb
