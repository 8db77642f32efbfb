// The kinds of shape that may come from files: hulls, meshes, height fields.
#pragma once

#include "scene/descriptor_text.hpp"
#include "scene/geometry_files.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Each sets kind and geometry of `shape`, not its bounds. They throw DescriptorError, whose column is that of the file's
// name or of the numbers, and std::bad_alloc.
void parse_hull(Keys &keys, GeometryFiles &files, Shape &shape);
void parse_mesh(Keys &keys, GeometryFiles &files, Shape &shape);
void parse_height_field(Keys &keys, GeometryFiles &files, Shape &shape);

}  // namespace cmb
