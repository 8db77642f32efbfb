// The elastic energy of two convex polytopes that overlap.
#pragma once

#include <vector>

#include "manifold/polytope/overlap_solid.hpp"
#include "math/symmetric_matrix.hpp"

namespace cmb {

// A quadratic polynomial of a place x: x . (squares x) - 2 linear . x + constant.
struct Quadric {
  convex::SymmetricMatrix squares;
  Vec3 linear;
  double constant = 0.0;
};

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
  // A body's soft least mean square, as a sum of weighted squares of depths.
  struct Depth {
    double least = 0.0;
    Quadric squares;  // of places from the overlap's middle
    Vec3 moment;      // the mean over the overlap of place x the squares' gradient
  };
  void weigh(const OverlapSolid &solid, const ContactPolytope &body, const Pose &in_axes, Depth &depth);

  std::vector<double> bounds_;               // by group of faces
  std::vector<double> below_, mean_square_;  // by face: of the overlap's middle, over the overlap
  std::vector<std::size_t> groups_;          // that were looked at: their first faces
  std::vector<std::size_t> near_;            // faces that count
  std::vector<double> part_;                 // in step: least mean square by the face's
  double energy_ = 0.0;
  Vec3 force_, torque_;
};

}  // namespace cmb
