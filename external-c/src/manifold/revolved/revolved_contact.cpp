#include "manifold/revolved/revolved_contact.hpp"

#include "manifold/load_points.hpp"
#include "manifold/revolved/depth_in_revolved.hpp"
#include "math/pose_algebra.hpp"

namespace cmb {

// The energy of polytopes (polytope/overlap_energy.hpp): the mean of what both bodies store, 3/2 of the soft least mean square of the
// depths below their sides. As the depths in a body move with that body, its part changes by the other one's surface alone.
bool revolved_contact(const Shape &revolved, const Pose &revolved_pose, const ContactPolytope &polytope, const Pose &polytope_pose,
                      const Vec3 &witness, double sense, RevolvedScratch &scratch, std::vector<ContactPoint> &points) {
  const RevolvedBody body(revolved.body);
  const Pose in_frame = relative_pose(revolved_pose, polytope_pose);
  const Vec3 place = transposed_times(revolved_pose.rotation, witness - revolved_pose.translation);
  OverlapSurface &surface = scratch.surface;
  if (!scratch.on_polytope.find(body, polytope, in_frame, place, surface)) return false;
  const DepthInRevolved of_revolved(body, surface);
  DepthBelowFaces &of_polytope = scratch.faces;
  const Vec3 middle = surface.place() + surface.middle();
  of_polytope.find(middle, surface.spread(), polytope, in_frame);
  Vec3 force, torque;
  const auto push = [&](const OverlapSurface::Node &node, double less) {
    force = force + less * node.area;
    torque = torque + less * cross(node.at - surface.middle(), node.area);
  };
  const auto excess_in_polytope = [&](const OverlapSurface::Node &node) {
    return of_polytope.squares().at(node.at - surface.middle()) - of_polytope.least();
  };
  const double part = 0.75 / surface.volume();
  for (const OverlapSurface::Node &node : surface.of_b()) push(node, of_revolved.excess(node.at));
  // Over all of the overlap's surface the integral is one over its inside. Of a thin edge both sides nearly cancel: rather the surface
  // that cuts it off.
  const bool over_polytope = surface.area_b() < surface.area_a();
  if (over_polytope) {
    for (const OverlapSurface::Node &node : surface.of_b()) push(node, excess_in_polytope(node));
  } else {
    for (const OverlapSurface::Node &node : surface.of_a()) push(node, -excess_in_polytope(node));
  }
  force = part * force, torque = part * torque;
  if (over_polytope) {
    force = force + 1.5 * of_polytope.squares().linear;
    torque = torque - 0.75 * of_polytope.moment();
  }
  return append_load_points({0.75 * (of_revolved.least() + of_polytope.least()), force, torque, middle, surface.spread()},
                            revolved_pose, {}, sense, points);
}

}  // namespace cmb
