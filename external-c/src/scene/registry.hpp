// The registry of interned scenes.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "backend/distance_library.hpp"
#include "scene/scene.hpp"

namespace cmb {

constexpr std::size_t scene_limit = 65536;

// The handle of the scene with these arguments, which is made where it does not exist yet. Files are read within
// `folder` only; none where it is empty. `library` is that of `backend`, null for the engine's own. Throws
// SceneError, std::bad_alloc. Guarded by a mutex.
cmb_scene intern_scene(const char *const *geometry, std::size_t body_count, const int *pairs, std::size_t pair_count,
                       cmb_backend backend, const DistanceLibrary *library, const std::string &folder);

// Lets a library, none where it is null, answer for the scene: gives every convex shape what the library keeps of it.
void attach_library(Scene &scene, cmb_backend backend, const DistanceLibrary *library);

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
