// How fast the springs of a contact slow the bodies down: what takes the place of an effective mass where several points
// carry. As ContactMultiBody.Internal.Restitution.springDecelerations computes it.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "math/vector3.hpp"

namespace cmb {

// Of a body that is free to move; a fixed one has none.
struct Inertia {
  bool fixed = true;
  double mass = 0.0;
  Vec3 center;                             // of mass, world axes
  const double *tensor = nullptr;          // [3][3] about it, body axes, positive definite; 0: does not turn
  const convex::Mat3 *to_world = nullptr;  // rotation body to world
};

// The deceleration (m/s2) along its normal of each point under the forces weight * stiffness * depth^exponent of all of
// them, by Newton's and Euler's equations of both bodies, at least a tenth of that by its own force alone: so forces do
// not jump where others lever a point into its contact. For one point it is K x^n / m with the effective mass
// 1/m = 1/m_a + 1/m_b + (r_a x n) . I_a^-1 (r_a x n) + (r_b x n) . I_b^-1 (r_b x n).
void spring_decelerations(const std::vector<ContactPoint> &points, double stiffness, double exponent, const Inertia &a,
                          const Inertia &b, std::vector<double> &deceleration);

}  // namespace cmb
