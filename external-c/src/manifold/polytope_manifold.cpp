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

}  // namespace

void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, DepthGraph &graph,
                      std::vector<ContactPoint> &points) {
  const Pose axes = contact_axes(normal, witness);
  graph.place(a, relative_pose(axes, pose_a), b, relative_pose(axes, pose_b));
  const double reach = graph.reach();
  if (!(reach > 0.0)) return;
  const double fineness = a.fineness() + b.fineness();
  double level = first_level(reach, fineness), greatest, width;
  for (;;) {
    graph.find_corners(level);
    greatest = greatest_depth(graph.corners(), 0);
    width = load_width(greatest, fineness);
    if (level == 0.0 || (greatest > 0.0 && load_kept(graph.corners(), 0, {level, width}) >= greatest)) break;
    level = reach - 2.0 * (reach - level);
    if (level < 0.4 * reach) level = 0.0;
  }
  if (graph.corners().empty()) return;
  const LoadLimit limit = load_limit(graph.corners(), 0, greatest, width);
  double load = 0.0;
  Vec3 missing;
  for (const DepthGraph::Corner &corner : graph.corners()) {
    const double carried = corner.depth * limit.part(corner.depth);
    load += corner.weight * carried;
    missing = missing + (0.5 * corner.depth * carried) * corner.slope;
  }
  if (!(load > 0.0)) return;
  const Vec3 shift{missing.x / load, missing.y / load, 0.0};
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
