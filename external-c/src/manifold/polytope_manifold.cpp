#include "manifold/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "manifold/load_level.hpp"

namespace cmb {

namespace {

// The contact's axes: z along `up` (unit, world axes), the origin near the contact.
Pose contact_axes(const Vec3 &up, const Vec3 &origin) {
  const Vec3 first = convex::any_perpendicular(up);
  return {transposed(convex::Mat3{{first, cross(up, first), up}}), origin};
}

// Vertices for each metre of height, as they would be spread over a sphere.
double fineness(const convex::Polytope &polytope) {
  return static_cast<double>(polytope.vertices().size()) / (2.0 * polytope.radius());
}

// Where the search for corners that carry the greatest load allowed begins; any place would do. n corners for each metre
// of height that carry a third each have the load n d^2 / 6 within d metres of the deepest.
double first_level(const ContactPolytope &a, const ContactPolytope &b, double depth) {
  const double corners = fineness(a.geometry()) + fineness(b.geometry());
  const double height = 3.0 * std::sqrt(depth / corners);
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
  double level = first_level(a, b, reach);
  for (;;) {
    graph.find_corners(level);
    const double greatest = greatest_depth(graph.corners(), 0);
    if (level == 0.0 || (greatest > 0.0 && load_above(graph.corners(), 0, level) >= greatest)) break;
    level = std::max(0.0, reach - 2.0 * (reach - level));
    if (level < 0.4 * reach) level = 0.0;
  }
  if (graph.corners().empty()) return;
  level = load_level(graph.corners(), 0);
  double load = 0.0;
  Vec3 missing;
  for (const DepthGraph::Corner &corner : graph.corners()) {
    const double above = corner.depth - level;
    if (!(above > 0.0)) continue;
    load += corner.weight * above;
    missing = missing + (0.5 * above * above) * corner.slope;
  }
  if (!(load > 0.0)) return;
  const Vec3 shift{missing.x / load, missing.y / load, 0.0};
  for (const DepthGraph::Corner &corner : graph.corners()) {
    const double weight = level > 0.0 ? corner.weight * (1.0 - level / corner.depth) : corner.weight;
    if (corner.depth > level && weight > 0.0) {
      points.push_back({corner.depth, weight, normal, axes(corner.middle + shift)});
    }
  }
}

}  // namespace cmb
