// Contact of two capsules in closed form.
#pragma once

#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Appends what the lines of two capsules carry, half of it each: the same sums as line_on_line's to rounding, in closed form
// from the deepest place on, so that what does not carry costs little. False, and nothing appended, where the axes meet.
bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                        std::vector<ContactPoint> &points);

// The contact of capsules A and B, from their poses at once: writes distance, normal and witness of `result` and appends to its
// points. False, and nothing written, where the axes meet or are so near that there may be several contact directions.
bool capsule_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, ContactSet &result);

}  // namespace cmb
