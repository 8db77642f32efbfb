// Contact of two capsules: points that carry the force, the torque and the energy of their axes.
//
// Each of the two carries half of the energy (axis_energy.hpp) that it stores against the other's axis, reached by both radii.
#pragma once

#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Appends up to four points; `answer` is the signed distance (< 0). False, and nothing appended, where the axes meet.
bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                        std::vector<ContactPoint> &points);

// The contact of capsules A and B, from their poses at once: writes distance, normal and witness of `result` and appends to its
// points. False, and nothing written, where the axes meet.
bool capsule_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, ContactSet &result);

}  // namespace cmb
