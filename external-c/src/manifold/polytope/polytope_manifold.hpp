// Contact of two polytopes.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "manifold/polytope/penetration_profile.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Appends the points at which polytopes A and B touch: the corners of their depth's graph. `normal` (unit, from B to A)
// is the contact normal, `witness` a point near the contact, both in world axes; `shortest` (m, > 0) is the depth of the
// minimum translation. How corners share the load: tessellation_load.hpp. `graph` is room to work in.
//
// Shares that change with the direction ask for a torque, as on a half-space: all points are shifted along the contact
// plane to supply it.
void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, double shortest, PenetrationProfile &graph,
                      std::vector<ContactPoint> &points);

// The axes, in world axes, in which `graph` has the corners of such a contact.
Pose contact_axes(const Vec3 &normal, const Vec3 &witness);

}  // namespace cmb
