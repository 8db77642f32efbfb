#ifdef CMB_COAL_BACKEND_MODULE
#include <dlfcn.h>
#endif

#include "backend/coal_module.hpp"

namespace cmb {

namespace {

// coal comes with an octomap of its own and FCL with Debian's; in one program their symbols collide. The module with
// coal is therefore loaded with its own symbols first. Null where there is none.
const CoalModule *load() {
#ifdef CMB_COAL_BACKEND_MODULE
  void *module = dlopen(CMB_COAL_BACKEND_MODULE, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module != nullptr) return static_cast<const CoalModule *>(dlsym(module, coal_module_symbol));
#endif
  return nullptr;
}

const CoalModule *coal() {
  static const CoalModule *const loaded = load();
  return loaded;
}

}  // namespace

bool coal_is_available() { return coal() != nullptr; }

std::shared_ptr<const LibraryShape> make_coal_shape(const Shape &shape) {
  if (coal() == nullptr) return nullptr;
  return std::shared_ptr<const LibraryShape>(coal()->make_shape(shape));
}

std::optional<ConvexAnswer> coal_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                          BackendScratch &) {
  ConvexAnswer answer;
  if (!a.in_library || !b.in_library) return std::nullopt;
  if (!coal()->distance(*a.in_library, pose_a, *b.in_library, pose_b, answer)) return std::nullopt;
  return answer;
}

}  // namespace cmb
