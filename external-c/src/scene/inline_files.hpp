// Descriptors that need no files.
#pragma once

#include <string>
#include <string_view>

#include "scene/geometry_files.hpp"

namespace cmb {

// The same geometry with every file's contents written out, for places where the files will not be. Numbers are written
// so that they read back exactly. Shapes without files stay as they are, letter by letter. Throws DescriptorError, also for
// geometry that parse_descriptor refuses, and std::bad_alloc.
std::string inline_files(std::string_view descriptor, GeometryFiles &files);

}  // namespace cmb
