// The points that carry an overlap's force and torque and store its energy.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "math/symmetric_matrix.hpp"

namespace cmb {

using convex::Pose;

// What an overlap stores, and what it does to body A by that.
struct OverlapLoad {
  double energy = 0.0;
  Vec3 force, torque, middle;      // torque about the overlap's middle
  convex::SymmetricMatrix spread;  // the mean over the overlap of the products of coordinates, from the middle
};

// Appends four points of equal depth, so that a law of another exponent than 1 keeps their shares of the load: all forces together
// are scaled. They spread along the surface as the corners of a rectangle that is as wide, a box's face that lies on another at its
// corners; their weights and normals follow from what torque the load has about them.
// `load` is in the axes that `axes` maps to world axes, and so are `corner_axes`, which turn with a body. `sense`: 1, or -1 where the
// pair's bodies are exchanged. False where the load is none.
bool append_load_points(const OverlapLoad &load, const Pose &axes, const convex::Mat3 &corner_axes, double sense,
                        std::vector<ContactPoint> &points);

}  // namespace cmb
