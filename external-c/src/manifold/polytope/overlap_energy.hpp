// The elastic energy of two convex polytopes that overlap.
#pragma once

#include <vector>

#include "manifold/polytope/overlap_solid.hpp"

namespace cmb {

// A homogeneous quadratic polynomial of (place, 1).
struct Quadric {
  double xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, zx = 0.0, xy = 0.0;
  Vec3 linear;
  double constant = 0.0;

  // Adds weight * below^2, with below = offset - normal . place.
  void add_square(double weight, const Vec3 &normal, double offset) {
    const Vec3 scaled = weight * normal;
    xx += scaled.x * normal.x, yy += scaled.y * normal.y, zz += scaled.z * normal.z;
    yz += scaled.y * normal.z, zx += scaled.z * normal.x, xy += scaled.x * normal.y;
    linear = linear - offset * scaled;
    constant += weight * offset * offset;
  }
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
  // On A; torque about the solid's origin.
  const Vec3 &force() const { return force_; }
  const Vec3 &torque() const { return torque_; }

 private:
  // A body's soft least mean square, as a sum of weighted squares of depths.
  struct Depth {
    double least = 0.0;
    Quadric squares;
    Vec3 slope, moment;  // means over the overlap of the squares' gradient, and of place x gradient
  };
  void weigh(const OverlapSolid &solid, const ContactPolytope &body, const Pose &in_axes, Depth &depth);

  struct Face {
    Vec3 normal;
    double offset, mean_square;
  };
  std::vector<double> below_;  // of the overlap's middle, by face
  std::vector<Face> faces_;    // that count
  double energy_ = 0.0;
  Vec3 force_, torque_;
};

}  // namespace cmb
