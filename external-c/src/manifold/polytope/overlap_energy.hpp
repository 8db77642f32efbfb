// The elastic energy of two convex polytopes that overlap.
#pragma once

#include "manifold/polytope/depth_below_faces.hpp"
#include "manifold/polytope/overlap_solid.hpp"

namespace cmb {

// With the depth s_f of a place below face f, each body stores
//
//   E = 3/2 softmin over its faces f of (mean of s_f^2 over the overlap),
//
// and both together the mean of their energies. softmin(e) is the sum of e^-7 over that of e^-8. A face pressed in flat by d
// stores d^2/2, whatever its area.
//
// Means over the overlap need its volume, middle and spread alone, and as the depths below a body's faces move with that
// body, only the other one's surface changes them: the gradient is an integral over the surface.
class OverlapEnergy {
 public:
  // `solid`: of A and B at these poses.
  void find(const OverlapSolid &solid, const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
            const Pose &b_in_axes);

  double energy() const { return energy_; }
  // On A; torque about the overlap's middle.
  const Vec3 &force() const { return force_; }
  const Vec3 &torque() const { return torque_; }

 private:
  DepthBelowFaces of_a_, of_b_;
  double energy_ = 0.0;
  Vec3 force_, torque_;
};

}  // namespace cmb
