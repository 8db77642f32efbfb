#include "manifold/polytope/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/polytope/tessellation_load.hpp"
#include "math/pose_algebra.hpp"

namespace cmb {

namespace {

// Sums over the corners, each with a part of its weight.
struct CornerSums {
  double load = 0.0, squares = 0.0;  // of weight * depth, m, and of weight * depth^2, m^2
  // Torque that shares ask for as they change with the direction: of depth * slope / 2 and of depth^2 * slope / 2.
  double linear_x = 0.0, linear_y = 0.0, square_x = 0.0, square_y = 0.0;
};

CornerSums sums_of(const std::vector<PenetrationProfile::Corner> &corners, const TessellationLoad &shared) {
  CornerSums sums;
  for (const PenetrationProfile::Corner &corner : corners) {
    const double carried = corner.depth * shared.part(corner.depth), half_square = 0.5 * corner.depth * carried;
    sums.load += corner.weight * carried;
    sums.squares += corner.weight * carried * corner.depth;
    sums.linear_x += 0.5 * carried * corner.slope.x, sums.linear_y += 0.5 * carried * corner.slope.y;
    sums.square_x += half_square * corner.slope.x, sums.square_y += half_square * corner.slope.y;
  }
  return sums;
}

// Finds the corners that carry, and returns the greatest depth; 0 where there are none. Which carry is not known before that
// depth: it is mostly what the bodies reach, or less by a part of the tessellation's step.
double find_corners(double fineness, PenetrationProfile &graph) {
  const double reach = graph.reach();
  if (!(reach > 0.0)) return 0.0;
  const double slack = std::min(0.15 / fineness + 0.004 * reach, 1.0 / fineness);
  double level = std::max(0.0, TessellationLoad(reach, fineness).level() - slack);
  for (;;) {
    graph.find_corners(level);
    const double greatest = greatest_depth(graph.corners());
    if (level == 0.0) return greatest;
    const double needed = greatest > 0.0 ? TessellationLoad(greatest, fineness).level() : reach - 2.0 * (reach - level);
    if (needed >= level) return greatest;
    level = std::max(0.0, needed);
  }
}

}  // namespace

Pose contact_axes(const Vec3 &normal, const Vec3 &witness) {
  const Vec3 first = convex::any_perpendicular(normal);
  return {transposed(convex::Mat3{{first, cross(normal, first), normal}}), witness};
}

void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, double shortest, PenetrationProfile &graph,
                      std::vector<ContactPoint> &points) {
  const Pose axes = contact_axes(normal, witness);
  graph.place(a, relative_pose(axes, pose_a), b, relative_pose(axes, pose_b));
  const double fineness = a.fineness() + b.fineness();
  const double greatest = find_corners(fineness, graph);
  if (!(greatest > 0.0)) return;
  const TessellationLoad shared(greatest, fineness);
  const CornerSums sums = sums_of(graph.corners(), shared);
  if (!(sums.load > 0.0)) return;
  const TessellationLoad::Scale scale = shared.scale(sums.load, sums.squares, shortest);
  const double inverse = 1.0 / (scale.weight * sums.load);
  const Vec3 shift{(scale.weight * sums.square_x - scale.level * sums.linear_x) * inverse,
                   (scale.weight * sums.square_y - scale.level * sums.linear_y) * inverse, 0.0};
  for (const PenetrationProfile::Corner &corner : graph.corners()) {
    const double weight = scale.weight * corner.weight * shared.part(corner.depth);
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
