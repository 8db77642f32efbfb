// Contact of a capsule with a cylinder or cone: points that carry the force, the torque and the energy of its axis (axis_energy.hpp).
// What of the obstacle is nearest to a place of the axis pushes it; inside the obstacle its nearest side does.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Appends two points that carry the part of the energy that is returned (carried_part.hpp). `depth` (m, > 0) is the length of the minimum
// translation, `deepest` the capsule's deepest place on its surface, and `sense` 1 where the capsule is the first body of the pair,
// -1 where it is the second one.
double capsule_on_revolved(const Shape &capsule, const convex::Pose &pose, const Shape &revolved, const convex::Pose &revolved_pose,
                           double depth, const Vec3 &deepest, double sense, std::vector<ContactPoint> &points);

}  // namespace cmb
