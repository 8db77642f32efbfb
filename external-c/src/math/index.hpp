// Numbers of vertices, edges and faces as subscripts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cmb {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace cmb
