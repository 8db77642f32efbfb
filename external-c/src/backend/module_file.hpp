// Shared objects that are loaded while the program runs.
#pragma once

#include <stdexcept>
#include <string>

namespace cmb {

class ModuleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ModuleSymbols {
  shared,    // what the program has loaded already serves the module too
  own_first  // the module's own libraries come first
};

// A module that is loaded, and stays so until the process ends. `name` is without prefix and ending. It is looked for in
// the folders of the environment variable CMB_MODULE_PATH, then in the folder of the binary that this code is part of (an
// FMU's, a program's or a library's), then where the system looks for libraries (run path of that binary,
// LD_LIBRARY_PATH).
class ModuleFile {
 public:
  // Throws ModuleError, which names the places.
  ModuleFile(const std::string &name, ModuleSymbols symbols);
  // The file, or its name alone where the system found it.
  const std::string &path() const { return path_; }
  // Never null. Throws ModuleError.
  const void *symbol(const char *name) const;

 private:
  std::string path_;
  void *handle_ = nullptr;
};

}  // namespace cmb
