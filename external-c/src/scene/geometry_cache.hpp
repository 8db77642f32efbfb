// Geometry that several scenes share: made once for a descriptor, kept while a scene has it.
#pragma once

#include <memory>
#include <string>

#include "scene/geometry_files.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The shapes of a descriptor. Those of descriptors that name files are made anew each time, as files may have changed.
// Throws DescriptorError, std::bad_alloc. Thread safe.
std::shared_ptr<const BodyShapes> shared_geometry(const char *descriptor, GeometryFiles &files);

}  // namespace cmb
