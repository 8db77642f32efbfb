// coal comes with an octomap of its own, FCL with Debian's: in one program their symbols collide. The module that holds
// coal is therefore loaded with its own symbols first.
#include <dlfcn.h>

#include <cstdio>

#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

void *load() {
#ifdef CMB_COAL_MODULE
  void *module = dlopen(CMB_COAL_MODULE, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module == nullptr) std::fprintf(stderr, "%s\n", dlerror());
  return module;
#else
  return nullptr;
#endif
}

void *coal_module() {
  static void *const module = load();
  return module;
}

// A function of the module; null without coal.
template <typename Function>
Function symbol(const char *name) {
  void *const module = coal_module();
  return module == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(module, name));
}

}  // namespace

std::unique_ptr<ContactPeer> make_coal_collide(const PosedPair &pair, bool with_patch) {
  const auto make = symbol<ContactPeer *(*)(const PosedPair *, int)>("cmb_bench_coal_peer");
  return std::unique_ptr<ContactPeer>(make != nullptr ? make(&pair, with_patch ? 1 : 0) : nullptr);
}

std::unique_ptr<ContactPeer> make_coal_distance(const PosedPair &pair) {
  const auto make = symbol<ContactPeer *(*)(const PosedPair *)>("cmb_bench_coal_distance");
  return std::unique_ptr<ContactPeer>(make != nullptr ? make(&pair) : nullptr);
}

}  // namespace cmb::bench
