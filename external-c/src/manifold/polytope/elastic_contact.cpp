#include "manifold/polytope/elastic_contact.hpp"

#include "manifold/load_points.hpp"
#include "math/pose_algebra.hpp"

namespace cmb {

namespace {

// Axes whose z is the normal, in world axes.
Pose contact_axes(const Vec3 &normal, const Vec3 &witness) {
  const Vec3 first = convex::any_perpendicular(normal);
  return {transposed(convex::Mat3{{first, cross(normal, first), normal}}), witness};
}

}  // namespace

bool elastic_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                     const Vec3 &normal, const Vec3 &witness, ElasticScratch &scratch, std::vector<ContactPoint> &points) {
  Pose axes = contact_axes(normal, witness), a_in_axes = relative_pose(axes, pose_a), b_in_axes = relative_pose(axes, pose_b);
  const OverlapSolid &solid = scratch.solid;
  if (!scratch.solid.find(a, a_in_axes, b, b_in_axes)) return false;
  if (solid.is_turned()) {
    const Pose turn{solid.turn(), {}};
    for (Vec3 &row : axes.rotation.row) row = solid.turn() * row;
    a_in_axes = compose(turn, a_in_axes), b_in_axes = compose(turn, b_in_axes);
  }
  OverlapEnergy &overlap = scratch.energy;
  overlap.find(solid, a, a_in_axes, b, b_in_axes);
  return append_load_points({overlap.energy(), overlap.force(), overlap.torque(), solid.middle(), solid.spread()}, axes,
                            a_in_axes.rotation, 1.0, points);
}

}  // namespace cmb
