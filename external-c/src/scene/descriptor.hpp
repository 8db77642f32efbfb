// Descriptor strings: text to shapes.
#pragma once

#include <string_view>

#include "scene/descriptor_text.hpp"
#include "scene/geometry_files.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The shapes a descriptor names; none for a blank descriptor. `files` reads what the descriptor names as file. Throws
// DescriptorError, std::bad_alloc.
BodyShapes parse_descriptor(std::string_view text, GeometryFiles &files);

// The same for descriptors that name no files.
BodyShapes parse_descriptor(std::string_view text);

}  // namespace cmb
