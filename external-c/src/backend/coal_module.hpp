// What the module that holds coal gives to the engine.
#pragma once

#include "backend/distance_backend.hpp"

namespace cmb {

struct CoalModule {
  // coal's shape, which the caller deletes; null where it has none. Never throws.
  LibraryShape *(*make_shape)(const Shape &shape);
  // coal's signed distance of two such shapes; false where it has no answer. Never throws.
  bool (*distance)(const LibraryShape &a, const Pose &pose_a, const LibraryShape &b, const Pose &pose_b,
                   ConvexAnswer &answer);
};

// The name of the module's CoalModule.
constexpr const char *coal_module_symbol = "cmb_coal_module";

}  // namespace cmb
