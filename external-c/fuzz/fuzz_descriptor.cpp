// Fuzz target: any text is a descriptor or is refused with a column inside it.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scene/descriptor.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  try {
    cmb::parse_descriptor(text);
  } catch (const cmb::DescriptorError &error) {
    if (error.column() < 1 || error.column() > size + 1 || std::string(error.what()).empty()) std::abort();
  }
  return 0;
}
