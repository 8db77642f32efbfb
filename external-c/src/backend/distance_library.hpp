// Libraries that can be named as back end: FCL, libccd and coal. Each is behind a module, a shared object of its own that is
// loaded when a scene names it first, so that the engine itself needs none of them.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "backend/distance_backend.hpp"
#include "contact_multibody.h"

namespace cmb {

// What a module gives to the engine. Neither function throws or ends the program.
struct DistanceLibrary {
  // The module was built with the engine of this version, for shapes and answers of these sizes; others are refused.
  const char *engine_version;
  std::size_t shape_size, answer_size;
  // What the library keeps of a convex shape, which the caller deletes; null where it has none. The function is null where
  // the library takes the engine's shapes.
  LibraryShape *(*make_shape)(const Shape &shape);
  // The signed distance of shapes that are no half-spaces and no meshes; false where the library has no answer that it
  // vouches for. Poses map the shapes' frames to the world. A library that keeps shapes (Shape::in_library) answers for
  // these only.
  bool (*distance)(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, SignedDistance &answer);
};

// The name of the module's DistanceLibrary.
constexpr const char *distance_library_symbol = "cmb_distance_library";

// A library that is named and not there.
class LibraryMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The library of a back end, loaded by the first call; null for the engine's own. Throws LibraryMissing, std::bad_alloc.
// A module that was loaded stays until the process ends. From any thread.
const DistanceLibrary *distance_library(cmb_backend backend);

}  // namespace cmb
