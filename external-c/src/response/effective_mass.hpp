// The mass that a pair of bodies opposes to an impact.
#pragma once

#include <vector>

#include "convex/vector3.hpp"
#include "manifold/contact_set.hpp"

namespace cmb {

// Of a body that is free to move; a fixed one has none.
struct Inertia {
  bool fixed = true;
  double mass = 0.0;
  Vec3 center;                     // of mass, world axes
  const double *tensor = nullptr;  // [3][3] about the centre of mass, body axes, positive definite
  const convex::Mat3 *to_world = nullptr;  // rotation body to world
};

// Where the load of a contact acts, and how stiff the contact is there by one point of weight 1.
struct ContactCenter {
  Vec3 point, normal;
  double weight = 0.0;
};

// The load-weighted mean of the points (at least one) with weight (sum w x)^2/(sum w x^2), which is the sum of weights
// where all depths x are equal, and continuous where points come and go at depth 0.
ContactCenter contact_center(const std::vector<ContactPoint> &points);

// 1/(1/m + (r x n) . I^-1 (r x n)) of both bodies at a contact's centre, for a point of weight 1: divided by the
// contact's weight, since the speed of a mass m on a spring w K is that of m/w on K. Infinite where both are fixed.
double effective_mass(const ContactCenter &contact, const Inertia &a, const Inertia &b);

}  // namespace cmb
