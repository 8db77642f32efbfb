// Contact of two capsules: points that carry the force, the torque and the energy of their axes.
//
// With the depth s = reach - distance of a place on one capsule's axis from the axis of the other, each of the two stores half of
//     E = 1/2 (integral of s^3) / (integral of s)
// over the stretch of its axis where s > 0: d^2 / 2 where they lie along each other, d deep, (12/35) d^2 where they cross, d^2 / 4 where
// an end alone is in contact. Each place pushes along the shortest way to the other axis, which is the gradient of its depth; the load and
// its torque are continuous, also where stretches begin, end or pass over the other's ends.
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
