// coal comes with an octomap of its own, FCL with Debian's: in one program their symbols collide. The module that holds
// coal is therefore loaded with its own symbols first.
#include <dlfcn.h>

#include <cstdio>

#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

using MakePeer = ContactPeer *(*)(const PosedPair *, int);

MakePeer load() {
#ifdef CMB_COAL_MODULE
  void *module = dlopen(CMB_COAL_MODULE, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    return nullptr;
  }
  return reinterpret_cast<MakePeer>(dlsym(module, "cmb_bench_coal_peer"));
#else
  return nullptr;
#endif
}

}  // namespace

std::unique_ptr<ContactPeer> make_coal_collide(const PosedPair &pair, bool with_patch) {
  static const MakePeer make = load();
  return std::unique_ptr<ContactPeer>(make != nullptr ? make(&pair, with_patch ? 1 : 0) : nullptr);
}

}  // namespace cmb::bench
