// The registry of interned scenes.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cmb {

constexpr std::size_t scene_limit = 65536;

// Makes what a back end's library keeps of a convex shape.
using MakeLibraryShape = std::shared_ptr<const LibraryShape> (*)(const Shape &shape);

// The handle of the scene with these arguments, which is made where it does not exist yet. Files are read within
// `folder` only; none where it is empty. `make_shape` belongs to `backend`, null where that keeps no shapes. Throws
// SceneError, std::bad_alloc. Guarded by a mutex.
cmb_scene intern_scene(const char *const *geometry, std::size_t body_count, const int *pairs, std::size_t pair_count,
                       cmb_backend backend, MakeLibraryShape make_shape, const std::string &folder);

// Gives every convex shape what `make_shape`, unless it is null, makes of it.
void attach_library_shapes(std::vector<BodyShapes> &bodies, MakeLibraryShape make_shape);

// The scene of a handle, null where there is none; without locking.
const Scene *find_scene(cmb_scene handle);

// Arguments that make no scene.
class SceneError : public std::runtime_error {
 public:
  SceneError(cmb_status status, const std::string &what) : std::runtime_error(what), status_(status) {}
  cmb_status status() const { return status_; }

 private:
  cmb_status status_;
};

}  // namespace cmb
