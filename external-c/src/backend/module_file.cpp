#include "backend/module_file.hpp"

#include <cstdlib>
#include <vector>

#if __has_include(<dlfcn.h>)
#include <dlfcn.h>
#include <unistd.h>
#define CMB_HAS_MODULES 1
#endif

namespace cmb {

#ifdef CMB_HAS_MODULES

namespace {

std::vector<std::string> named_folders() {
  std::vector<std::string> folders;
  const char *const value = std::getenv("CMB_MODULE_PATH");
  std::string text = value == nullptr ? "" : value;
  while (!text.empty()) {
    const std::size_t end = text.find(':');
    if (end > 0) folders.push_back(text.substr(0, end));
    text.erase(0, end == std::string::npos ? end : end + 1);
  }
  return folders;
}

// Where the binary that holds this code lies; empty where the system does not know.
std::string own_folder() {
  static const char inside = 0;
  Dl_info info;
  if (dladdr(&inside, &info) == 0 || info.dli_fname == nullptr) return "";
  const std::string path = info.dli_fname;
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

int flags(ModuleSymbols symbols) {
  int result = RTLD_NOW | RTLD_LOCAL;
  // Sanitizers end the program at a library that looks for its own symbols first.
#if defined(RTLD_DEEPBIND) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (symbols == ModuleSymbols::own_first) result |= RTLD_DEEPBIND;
#else
  (void)symbols;
#endif
  return result;
}

}  // namespace

ModuleFile::ModuleFile(const std::string &name, ModuleSymbols symbols) {
  const std::string file = "lib" + name + ".so";
  std::vector<std::string> folders = named_folders();
  if (const std::string own = own_folder(); !own.empty()) folders.push_back(own);
  std::string places;
  for (const std::string &folder : folders) {
    places += (places.empty() ? "" : ", ") + folder;
    path_ = folder + '/' + file;
    handle_ = dlopen(path_.c_str(), flags(symbols));
    if (handle_ != nullptr) return;
    // A module that is there and does not load is not passed over in silence.
    if (access(path_.c_str(), F_OK) == 0) throw ModuleError("the module cannot be loaded: " + std::string(dlerror()));
  }
  path_ = file;
  handle_ = dlopen(path_.c_str(), flags(symbols));
  if (handle_ == nullptr) throw ModuleError("the module " + file + " is not in " + places);
}

const void *ModuleFile::symbol(const char *name) const {
  const void *const found = dlsym(handle_, name);
  if (found == nullptr) throw ModuleError(path_ + " is not a module of this engine: it has no " + name);
  return found;
}

#else

ModuleFile::ModuleFile(const std::string &name, ModuleSymbols) {
  throw ModuleError("the module " + name + " is not offered on this platform");
}

const void *ModuleFile::symbol(const char *) const { return nullptr; }

#endif

}  // namespace cmb
