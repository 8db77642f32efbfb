#ifdef CMB_COAL_BACKEND_MODULE
#include <dlfcn.h>
#endif

#include "backend/coal_module.hpp"

namespace cmb {

namespace {

// coal comes with an octomap of its own and FCL with Debian's; in one program their symbols collide. The module with
// coal is therefore loaded with its own symbols first. Null where there is none.
CoalDistance load() {
#ifdef CMB_COAL_BACKEND_MODULE
  void *module = dlopen(CMB_COAL_BACKEND_MODULE, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module != nullptr) return reinterpret_cast<CoalDistance>(dlsym(module, coal_distance_symbol));
#endif
  return nullptr;
}

CoalDistance coal() {
  static const CoalDistance loaded = load();
  return loaded;
}

}  // namespace

bool coal_is_available() { return coal() != nullptr; }

std::optional<ConvexAnswer> coal_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                          BackendScratch &) {
  ConvexAnswer answer;
  if (coal() == nullptr || !coal()(a, pose_a, b, pose_b, answer)) return std::nullopt;
  return answer;
}

}  // namespace cmb
