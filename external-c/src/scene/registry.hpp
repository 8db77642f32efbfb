// The registry of interned scenes.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "backend/distance_library.hpp"
#include "scene/scene.hpp"

namespace cmb {

// The handle of the scene from this source, which is made where it does not exist yet; the source's pointers are valid.
// `library` is that of the source's back end, null for the engine's own. Throws SceneError, std::bad_alloc. Guarded by a
// mutex.
cmb_scene intern_scene(const cmb_scene_source &source, const DistanceLibrary *library);

// Takes one intern_scene back; false where there is no such scene.
bool release_scene(cmb_scene handle);

// Lets a library, none where it is null, answer for the scene: gives every convex shape what the library keeps of it.
void attach_library(Scene &scene, cmb_backend backend, const DistanceLibrary *library);

// The scene of a handle, null where there is none; without locking.
const Scene *find_scene(cmb_scene handle);

// The same, to be kept beyond its release.
std::shared_ptr<const Scene> share_scene(cmb_scene handle);

// Arguments that make no scene.
class SceneError : public std::runtime_error {
 public:
  SceneError(cmb_status status, const std::string &what) : std::runtime_error(what), status_(status) {}
  cmb_status status() const { return status_; }

 private:
  cmb_status status_;
};

}  // namespace cmb
