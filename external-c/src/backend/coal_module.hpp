// What the module that holds coal gives to the engine.
#pragma once

#include "backend/distance_backend.hpp"

namespace cmb {

// coal's signed distance of A and B; false where it has no answer. Never throws.
using CoalDistance = bool (*)(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                              ConvexAnswer &answer);

// The name of that function in the module.
constexpr const char *coal_distance_symbol = "cmb_coal_distance";

}  // namespace cmb
