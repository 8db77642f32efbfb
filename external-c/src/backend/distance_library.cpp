#include "backend/distance_library.hpp"

#include <array>
#include <cstring>
#include <mutex>
#include <string>

#include "backend/module_file.hpp"

namespace cmb {

namespace {

struct Named {
  cmb_backend backend;
  const char *library, *module;
  ModuleSymbols symbols;
};

// coal brings an OctoMap of its own along, and so does FCL: the former has to find its own symbols first.
constexpr std::array<Named, 3> libraries{{{CMB_BACKEND_LIBCCD, "libccd", "ContactMultiBodyLibccd", ModuleSymbols::shared},
                                          {CMB_BACKEND_FCL, "FCL", "ContactMultiBodyFcl", ModuleSymbols::shared},
                                          {CMB_BACKEND_COAL, "coal", "ContactMultiBodyCoal", ModuleSymbols::own_first}}};

const DistanceLibrary *load(const Named &named) {
  const std::string remedy = std::string("; choose another back end than ") + named.library + ", or install the module";
  try {
    const ModuleFile module(named.module, named.symbols);
    const auto *library = static_cast<const DistanceLibrary *>(module.symbol(distance_library_symbol));
    if (std::strcmp(library->engine_version, CMB_VERSION) != 0 || library->shape_size != sizeof(Shape) ||
        library->answer_size != sizeof(SignedDistance)) {
      throw LibraryMissing(module.path() + " belongs to another build of the engine (" + library->engine_version +
                           ", this is " + CMB_VERSION + ")" + remedy);
    }
    return library;
  } catch (const ModuleError &error) {
    throw LibraryMissing(error.what() + remedy);
  }
}

}  // namespace

const DistanceLibrary *distance_library(cmb_backend backend) {
  static std::mutex mutex;
  static std::array<const DistanceLibrary *, libraries.size()> loaded{};
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    if (libraries[i].backend != backend) continue;
    const std::lock_guard<std::mutex> lock(mutex);
    if (loaded[i] == nullptr) loaded[i] = load(libraries[i]);
    return loaded[i];
  }
  return nullptr;
}

}  // namespace cmb
